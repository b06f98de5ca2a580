"""The verdicts of ament's linters: Python style at ruff's speed, and those about other files."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.ament.backend import StyleCheck
from scaffold.diagnostic import Diagnostic
from scaffold.model.package import Package

__all__ = ["StyleCheck", "diagnostics"]


def diagnostics(package: Package, code: str) -> Iterator[Diagnostic]:
    """Yield what a linter of ament, other than those of Python style, reports under one code.

    Raises:
        ViewError: the package does not have what the linter reads.
    """
    if code.startswith("CM"):
        from scaffold.ament import cmake_diagnostics as linter
    return linter.diagnostics(package, code)
