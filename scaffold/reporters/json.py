"""One JSON object for programs."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TextIO

from scaffold.check.session import Result, Summary
from scaffold.diagnostic import Diagnostic
from scaffold.printable import json_text
from scaffold.reporters import ReportOptions
from scaffold.reporters.paths import shown


def report(results: Sequence[Result], out: TextIO, options: ReportOptions) -> None:  # noqa: ARG001  same shape as the others
    """Write ``{"diagnostics": [...], "summary": {...}}``."""
    diagnostics = [
        _as_data(diagnostic, shown(result.package, diagnostic.location.path))
        for result in results
        for diagnostic in result.diagnostics
    ]
    summary = Summary.of(results)._asdict()
    out.write(json_text({"diagnostics": diagnostics, "summary": summary}) + "\n")


def _as_data(diagnostic: Diagnostic, path: str) -> dict[str, object]:
    at = diagnostic.location
    return {
        "code": diagnostic.code,
        "name": diagnostic.name,
        "severity": diagnostic.severity.value,
        "path": path,
        "line": at.line,
        "column": at.column,
        "end_line": at.end_line,
        "end_column": at.end_column,
        "message": diagnostic.message,
        "fixable": diagnostic.fix is not None,
    }
