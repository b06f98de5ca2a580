"""GitHub workflow annotations and a job summary of a smoke run."""

from __future__ import annotations

import secrets
from collections.abc import Iterator
from typing import TextIO

from scaffold.printable import printable
from scaffold.reporters.github import cell, code, command
from scaffold.smoke.reports import text
from scaffold.smoke.reports.details import count
from scaffold.smoke.result import PackageResult, Smoke

_MAX_ROWS = 100
"""The maximum number of executables in a summary, which may have 1 MiB."""


def report(result: Smoke, out: TextIO, *, verbose: bool = False) -> None:
    """Write a workflow command for each problem, and the text report."""
    if result.ended_early:
        title = {"title": "smoke ended early"}
        out.write(command("error", _printable(title), printable(result.ended_early)))
    for package in result.packages:
        out.writelines(_annotations(package))
    # The output of executables may look like a command.
    token = secrets.token_hex()
    out.write(f"::stop-commands::{token}\n")
    text.report(result, out, verbose=verbose)
    out.write(f"::{token}::\n")


def job_summary(result: Smoke) -> str:
    """Return the summary of a job as Markdown."""
    result = text.without_escapes(result)
    lines = ["### ros2-scaffold smoke", "", cell(text.summary(result)), ""]
    rows = [row for package in result.packages for row in _rows(package)]
    lines += [
        "| package | executable | result | observed |",
        "|---|---|---|---|",
        *rows[:_MAX_ROWS],
    ]
    if len(rows) > _MAX_ROWS:
        lines += ["", f"The first {_MAX_ROWS} of {len(rows)} lines."]
    return "\n".join(lines) + "\n"


def _annotations(package: PackageResult) -> Iterator[str]:
    if not package.build.ok and not package.build.interrupted:
        properties = {"file": package.manifest, "title": f"{package.name} does not build"}
        yield command("error", _printable(properties), _lines(package.build.errors))
    for case in package.tests.failed if package.tests else ():
        properties = {"file": package.manifest, "title": f"{package.name}: {case.name} failed"}
        yield command("error", _printable(properties), _lines(case.message))
    for executable in package.runs:
        title = f"{package.name} {executable.name}"
        properties = {"file": executable.source or package.manifest, "title": title}
        for problem in executable.problems:
            message = _lines((problem.message, *problem.output))
            yield command("error", _printable(properties), message)


def _printable(properties: dict[str, str]) -> dict[str, object]:
    return {name: printable(value) for name, value in properties.items() if value}


def _lines(lines: tuple[str, ...]) -> str:
    return "\n".join(map(printable, lines))


def _rows(package: PackageResult) -> Iterator[str]:
    build = package.build
    if not build.ok:
        first = cell(next(iter(build.errors), ""))
        verdict = "not built yet" if build.interrupted else "does not build"
        yield f"| {code(package.name)} | | {verdict} | {first} |"
    for executable in package.runs:
        topics = [
            f"{code(topic.name)} {count(topic.count, 'message')}"
            + ("" if topic.rate_hz is None else f", {topic.rate_hz:.2f} Hz")
            for topic in executable.observation.topics
            if topic.publishers
        ]
        problems = [cell(problem.message) for problem in executable.problems]
        verdict = "ok" if executable.ok else "not ok"
        verdict = "interrupted" if executable.interrupted else verdict
        seen = "<br>".join([*problems, *topics])
        yield f"| {code(package.name)} | {code(executable.name)} | {verdict} | {seen} |"
