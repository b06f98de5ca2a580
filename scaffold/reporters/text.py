"""Text for people: one line per diagnostic that terminals and editors can jump to."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from typing import TextIO

from scaffold.check.session import Result, Summary
from scaffold.diagnostic import Severity
from scaffold.edits import Safety
from scaffold.printable import printable
from scaffold.reporters import ReportOptions
from scaffold.reporters.paths import shown

_COLORS = {Severity.ERROR: "31", Severity.WARNING: "33", Severity.INFO: "36"}


def report(results: Sequence[Result], out: TextIO, options: ReportOptions) -> None:
    """Write the diagnostics and a summary; see `Reporter`."""
    paint = _painter(out)
    for result in results:
        for diagnostic in result.diagnostics:
            at = diagnostic.location
            place = f"{printable(shown(result.package, at.path))}:{at.line}:{at.column}:"
            severity = paint(diagnostic.severity.value, _COLORS[diagnostic.severity])
            code = paint(diagnostic.code, "1")
            message = printable(diagnostic.message)
            out.write(f"{place} {severity} {code} {message} [{diagnostic.name}]\n")
    out.write(_summary(results, unsafe=options.unsafe) + "\n")


def _summary(results: Sequence[Result], *, unsafe: bool) -> str:
    summary = Summary.of(results)
    checked = f"{_count(summary.packages, 'package')}, {_count(summary.files, 'file')}"
    if not any(result.diagnostics for result in results):
        return f"{checked}: no findings"
    found = [
        _count(number, noun)
        for number, noun in (
            (summary.errors, "error"),
            (summary.warnings, "warning"),
            (summary.infos, "info"),
        )
        if number
    ]
    return f"{checked}: {', '.join(found)}{_fixable(results, unsafe=unsafe)}"


def _fixable(results: Sequence[Result], *, unsafe: bool) -> str:
    """Say how many fixes there are, and which flags apply them."""
    fixes = [d.fix for result in results for d in result.diagnostics if d.fix is not None]
    careful = 0 if unsafe else sum(fix.safety is Safety.SAFE for fix in fixes)
    others = len(fixes) - careful
    parts = [f"{careful} fixable with --fix"] if careful else []
    if others:
        what = "more" if careful else "fixable"
        parts.append(f"{others} {what} with --fix --unsafe-fixes")
    return f"; {', '.join(parts)}" if parts else ""


def _count(number: int, noun: str) -> str:
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"


def _painter(out: TextIO) -> Callable[[str, str], str]:
    """Return a function that wraps text in a color when a terminal shows it."""
    if out.isatty() and not os.environ.get("NO_COLOR"):
        return lambda text, color: f"\033[{color}m{text}\033[0m"
    return lambda text, color: text  # noqa: ARG005  same shape as the other
