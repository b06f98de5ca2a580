"""Reimplementation of ament's linters: the same findings, faster, with fixes."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.ament.backend import StyleCheck
from scaffold.ament.codes import CODES, LINT_CMAKE, XMLLINT
from scaffold.diagnostic import Diagnostic
from scaffold.model.package import Package

__all__ = ["StyleCheck", "diagnostics"]


def diagnostics(package: Package, code: str) -> Iterator[Diagnostic]:
    """Yield the findings with one code of an ament linter other than those of Python style.

    Raises:
        ViewError: a file that the linter reads is missing.
    """
    linters = CODES[code].linters
    if linters == LINT_CMAKE:
        from scaffold.ament import cmake_diagnostics

        return cmake_diagnostics.diagnostics(package, code)
    if linters == XMLLINT:
        from scaffold.ament.xml import diagnostics as xml_diagnostics

        return xml_diagnostics.diagnostics(package, code)
    from scaffold.ament import copyright_diagnostics

    return copyright_diagnostics.diagnostics(package, code)
