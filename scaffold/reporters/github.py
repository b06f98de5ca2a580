"""GitHub workflow annotations, and the job summary."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from typing import TextIO

from scaffold.check.result import Result
from scaffold.diagnostic import Diagnostic, Severity
from scaffold.model.package import Package
from scaffold.printable import printable
from scaffold.reporters import ReportOptions
from scaffold.reporters.order import SEVERITIES
from scaffold.reporters.paths import in_repository
from scaffold.reporters.summary import summary
from scaffold.reporters.terminal.entries import Entry, Place, in_order

_COMMANDS = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.INFO: "notice"}
_MAX_LISTED = 100
"""The maximum number of findings in a summary, which may have 1 MiB."""


def report(results: Sequence[Result], out: TextIO, options: ReportOptions) -> None:  # noqa: ARG001  same shape as the others
    """Write one workflow command per finding, errors first: GitHub shows the first ten of a step.

    The location is in the message as well, as the log of the step shows nothing else.
    """
    for package, diagnostic in _worst_first(results):
        at = diagnostic.location
        path = printable(in_repository(package, at.path))
        properties = {
            "file": path,
            "line": at.line,
            "endLine": at.end_line,
            "col": at.column,
            "endColumn": at.end_column,
            "title": f"{diagnostic.code} {diagnostic.name}",
        }
        if at.line != at.end_line:
            del properties["col"], properties["endColumn"]  # only supported within one line
        message = f"{path}:{at.line}:{at.column}: {diagnostic.code} {printable(diagnostic.text)}"
        out.write(command(_COMMANDS[diagnostic.severity], properties, message))


def command(level: str, properties: Mapping[str, object], message: str) -> str:
    """Return the workflow command for an annotation.

    Args:
        level: ``error``, ``warning`` or ``notice``.
        properties: Such as ``file``, ``line`` and ``title``.
        message: It may have several lines.
    """
    words = ",".join(f"{name}={_property(value)}" for name, value in properties.items())
    return f"::{level} {words}::{_data(message)}\n"


def job_summary(results: Sequence[Result], options: ReportOptions) -> str:
    """Return the job summary as Markdown: errors first, then counts by code."""
    findings = _worst_first(results)
    lines = ["### ros2-scaffold check", "", summary(results, options._replace(unsafe=False)), ""]
    if findings:
        lines += _table(findings[:_MAX_LISTED])
        if len(findings) > _MAX_LISTED:
            lines += ["", f"The first {_MAX_LISTED} of {len(findings)} findings."]
        lines += ["", *_counts([item for _, item in findings])]
    return "\n".join(lines) + "\n"


def _worst_first(results: Sequence[Result]) -> list[tuple[Package, Diagnostic]]:
    findings = [
        Entry((Place(result.package, diagnostic),))
        for result in results
        for diagnostic in result.diagnostics
    ]
    return [(item.package, item.first) for item in in_order(findings)]


def _table(findings: Sequence[tuple[Package, Diagnostic]]) -> Iterator[str]:
    yield "| severity | place | code | message |"
    yield "|---|---|---|---|"
    for package, diagnostic in findings:
        place = f"{in_repository(package, diagnostic.location.path)}:{diagnostic.location.line}"
        message = cell(diagnostic.message)
        cells = (diagnostic.severity.value, code(place), diagnostic.code, message)
        yield f"| {' | '.join(cells)} |"


def _counts(diagnostics: Sequence[Diagnostic]) -> Iterator[str]:
    yield "| code | name | severity | findings |"
    yield "|---|---|---|--:|"
    counts = Counter(
        (diagnostic.code, diagnostic.name, diagnostic.severity) for diagnostic in diagnostics
    )
    for (code, name, severity), number in sorted(
        counts.items(), key=lambda item: (SEVERITIES.index(item[0][2]), -item[1], item[0][0])
    ):
        yield f"| {code} | {name} | {severity.value} | {number} |"


def cell(text: str) -> str:
    """Return text for a cell of a table, with Markdown and HTML escaped."""
    escaped = "".join(f"\\{item}" if item in "\\`*_[]|~" else item for item in printable(text))
    return escaped.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")


def code(text: str) -> str:
    """Return text in code font for a cell of a table."""
    return f"`{printable(text)}`" if not {*"`|"} & {*text} else cell(text)


def _data(text: str) -> str:
    return text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def _property(value: object) -> str:
    return _data(str(value)).replace(":", "%3A").replace(",", "%2C")
