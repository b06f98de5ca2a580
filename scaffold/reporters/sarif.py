"""SARIF 2.1.0 reports, for code scanning and editors."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, TextIO
from urllib.parse import quote

from scaffold import __version__
from scaffold.check.rules.engine_rules import RuleCrashed
from scaffold.diagnostic import Diagnostic, Severity
from scaffold.printable import json_text, printable
from scaffold.reporters import ReportOptions, rule_pages
from scaffold.reporters.fingerprints import Fingerprints, line_hash
from scaffold.reporters.fixes import Repetitions, placed
from scaffold.reporters.paths import in_repository
from scaffold.reporters.rule_pages import RulePage

if TYPE_CHECKING:
    from scaffold.check.result import Result
    from scaffold.edits import Fix
    from scaffold.model.package import Package
    from scaffold.source import Location

SCHEMA = "https://json.schemastore.org/sarif-2.1.0.json"
_LEVELS = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.INFO: "note"}
_PROBLEMS = {**_LEVELS, Severity.INFO: "recommendation"}
_MAX_CHARACTERS = 1024
"""The maximum length of a description; code scanning rejects longer ones."""

Data = dict[str, Any]


def report(results: Sequence[Result], out: TextIO, options: ReportOptions) -> None:  # noqa: ARG001  same shape as the others
    """Write one run with every finding, and the rules of these."""
    pages = rule_pages.of(
        diagnostic.code for result in results for diagnostic in result.diagnostics
    )
    numbers = {code: number for number, code in enumerate(pages)}
    run: Data = {
        "tool": {
            "driver": {
                "name": rule_pages.DISTRIBUTION,
                "version": __version__,
                "semanticVersion": __version__,
                "rules": [_rule(page) for page in pages.values()],
            }
        },
        "automationDetails": {"id": f"{rule_pages.DISTRIBUTION}/"},
        "columnKind": "unicodeCodePoints",
        "invocations": [{"executionSuccessful": RuleCrashed.code not in pages}],
        "results": _results(results, numbers),
    }
    out.write(json_text({"$schema": SCHEMA, "version": "2.1.0", "runs": [run]}) + "\n")


def _rule(page: RulePage) -> Data:
    rule: Data = {
        "id": page.code,
        "name": page.name,
        "shortDescription": {"text": _shortened(page.summary)},
        "fullDescription": {"text": _shortened(_without_markup(page.markdown))},
        "help": {"text": _without_markup(page.markdown), "markdown": page.markdown},
        "defaultConfiguration": {"level": _LEVELS[page.severity]},
        "properties": {
            "tags": ["ROS 2", *page.linters],
            "precision": "very-high" if page.linters else "high",
            "problem.severity": _PROBLEMS[page.severity],
        },
    }
    if page.url is not None:
        rule["helpUri"] = page.url
    return rule


def _results(results: Sequence[Result], numbers: dict[str, int]) -> list[Data]:
    fingerprints = Fingerprints()
    written: list[Data] = []
    for result in results:
        package, repetitions = result.package, Repetitions()
        for diagnostic in result.diagnostics:
            data = _result(package, diagnostic, numbers[diagnostic.code])
            data["partialFingerprints"]["finding/v1"] = fingerprints.of(package, diagnostic)
            fix, number = diagnostic.fix, len(written)
            if fix is not None and repetitions.first(fix, number) == number:
                change = _fix(package, fix)
                data |= {"fixes": [change]} if change else {}
            written.append(data)
    return written


def _result(package: Package, diagnostic: Diagnostic, number: int) -> Data:
    at = diagnostic.location
    return {
        "ruleId": diagnostic.code,
        "ruleIndex": number,
        "level": _LEVELS[diagnostic.severity],
        "message": {"text": printable(diagnostic.text)},
        "locations": [
            {
                "physicalLocation": {
                    "artifactLocation": _file(package, at.path),
                    "region": _region(at),
                }
            }
        ],
        "partialFingerprints": {"primaryLocationLineHash": line_hash(package, at.path, at.line)},
    }


def _fix(package: Package, fix: Fix) -> Data | None:
    """Return a fix; ``None`` for one that does more than edit files, which SARIF lacks."""
    changes = placed(package, fix)
    if changes is None or len(changes.replacements) < len(fix.changes):
        return None
    by_file: dict[str, list[Data]] = {}
    for place, text in changes.replacements:
        replacement = {"deletedRegion": _region(place), "insertedContent": {"text": text}}
        by_file.setdefault(place.path, []).append(replacement)
    return {
        "description": {"text": fix.title},
        "artifactChanges": [
            {"artifactLocation": _file(package, path), "replacements": replacements}
            for path, replacements in by_file.items()
        ],
        "properties": {"safety": fix.safety.value},
    }


def _file(package: Package, path: str) -> Data:
    return {"uri": quote(os.fsencode(in_repository(package, path)))}


def _region(at: Location) -> dict[str, int]:
    return {
        "startLine": at.line,
        "startColumn": at.column,
        "endLine": at.end_line,
        "endColumn": at.end_column,
    }


def _without_markup(markdown: str) -> str:
    return markdown.replace("**", "").replace("`", "")


def _shortened(text: str) -> str:
    return text if len(text) <= _MAX_CHARACTERS else f"{text[: _MAX_CHARACTERS - 1]}…"
