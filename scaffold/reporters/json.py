"""The JSON report."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TextIO

from scaffold.check.result import Result, Summary
from scaffold.diagnostic import Diagnostic
from scaffold.edits import Fix
from scaffold.model.package import Package
from scaffold.printable import json_text
from scaffold.reporters import ReportOptions, rule_pages
from scaffold.reporters.fixes import Repetitions, placed
from scaffold.reporters.paths import shown
from scaffold.source import Location

SCHEMA_VERSION = 1
"""Incremented when a field changes its meaning or is removed, but not for new fields."""


def report(results: Sequence[Result], out: TextIO, options: ReportOptions) -> None:
    """Write ``{"schema_version": 1, "diagnostics": [...], "summary": {...}}``."""
    checked = [distribution.name for distribution in options.distributions]
    summary = {**Summary.of(results)._asdict(), "distributions": checked}
    data = {
        "schema_version": SCHEMA_VERSION,
        "diagnostics": [*diagnostics(results, checked)],
        "summary": summary,
    }
    out.write(json_text(data) + "\n")


def diagnostics(results: Sequence[Result], checked: Sequence[str]) -> Iterator[dict[str, object]]:
    """Yield findings as data.

    Args:
        results: Of all packages.
        checked: The names of the distributions that were checked for.
    """
    pages = rule_pages.of(item.code for result in results for item in result.diagnostics)
    number = 0
    for result in results:
        repetitions = Repetitions()
        for diagnostic in result.diagnostics:
            data = _as_data(diagnostic, shown(result.package, diagnostic.location.path))
            data["cause"] = diagnostic.cause or None
            data["distributions"] = [*(diagnostic.distributions or checked)]
            data["url"] = pages[diagnostic.code].url
            fix = diagnostic.fix
            first = number if fix is None else repetitions.first(fix, number)
            data["fix"] = None if fix is None else _fix(result.package, fix, first, number)
            yield data
            number += 1


def _as_data(diagnostic: Diagnostic, path: str) -> dict[str, object]:
    return {
        "code": diagnostic.code,
        "name": diagnostic.name,
        "severity": diagnostic.severity.value,
        "path": path,
        **_place(diagnostic.location),
        "message": diagnostic.message,
        "fixable": diagnostic.fix is not None,
    }


def _place(at: Location) -> dict[str, int]:
    return {
        "line": at.line,
        "column": at.column,
        "end_line": at.end_line,
        "end_column": at.end_column,
    }


def _fix(package: Package, fix: Fix, first: int, number: int) -> dict[str, object] | None:
    head = {"title": fix.title, "safety": fix.safety.value}
    if first != number:
        return {**head, "same_as": first}
    changes = placed(package, fix)
    if changes is None:
        return None
    return {
        **head,
        "edits": [
            {"path": shown(package, place.path), **_place(place), "text": text}
            for place, text in changes.replacements
        ],
        "creates": [{"path": shown(package, path), "text": text} for path, text in changes.created],
        "makes_executable": [shown(package, path) for path in changes.executable],
        "removes": [shown(package, path) for path in changes.removed],
    }
