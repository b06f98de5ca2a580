"""Reports of smoke runs: each format is a module of this package."""

from __future__ import annotations

from importlib import import_module
from typing import TextIO

from scaffold.smoke.result import Smoke

FORMATS = ("text", "json", "junit", "github")
"""A format is a module of this package, of that name, with a function ``report``."""


def report(result: Smoke, form: str, out: TextIO, *, verbose: bool = False) -> None:
    """Write the result in one of ``FORMATS``.

    Args:
        result: The result of the run.
        form: The format.
        out: The stream.
        verbose: Whether text formats show all measurements; other formats always do.
    """
    import_module(f"{__name__}.{form}").report(result, out, verbose=verbose)
