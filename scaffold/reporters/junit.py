"""JUnit reports for ``colcon test-result`` and CI servers: a case per rule and file."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TextIO
from xml.etree import ElementTree as ET

from scaffold.check.result import Result
from scaffold.check.rules.engine_rules import RuleCrashed
from scaffold.diagnostic import Diagnostic, Severity
from scaffold.printable import printable
from scaffold.reporters import ReportOptions
from scaffold.reporters.paths import shown

_TOOL = "ros2_scaffold"


def report(results: Sequence[Result], out: TextIO, options: ReportOptions) -> None:  # noqa: ARG001  same shape as the others
    """Write a suite per package; advice is not a failure, as it does not affect the exit code."""
    suites = [_suite(result) for result in results]
    write(suites or [suite_of(_TOOL, [case_of(_TOOL, "check", [])])], out)


def write(suites: Sequence[ET.Element], out: TextIO) -> None:
    """Write suites as a JUnit file."""
    root = ET.Element("testsuites", name=_TOOL)
    root.extend(suites)
    for name in ("tests", "failures", "errors"):
        root.set(name, str(sum(int(suite.get(name, "0")) for suite in root)))
    ET.indent(root)
    out.write('<?xml version="1.0" encoding="UTF-8"?>\n')
    out.write(ET.tostring(root, encoding="unicode") + "\n")


def _suite(result: Result) -> ET.Element:
    package = printable(result.package.identity.name)
    by_case: dict[tuple[str, str, str], list[str]] = {}
    for diagnostic in result.diagnostics:
        at = diagnostic.location
        path = printable(shown(result.package, at.path))
        line = f"{path}:{at.line}:{at.column}: {diagnostic.code} {printable(diagnostic.text)}"
        by_case.setdefault((f"{diagnostic.code} {path}", path, _outcome(diagnostic)), []).append(
            line
        )
    cases = [
        case_of(package, name, lines, outcome, path)
        for (name, path, outcome), lines in by_case.items()
    ]
    return suite_of(package, cases or [case_of(package, "check", [])])


def _outcome(diagnostic: Diagnostic) -> str:
    if diagnostic.code == RuleCrashed.code:
        return "error"
    return "system-out" if diagnostic.severity is Severity.INFO else "failure"


def case_of(
    package: str, name: str, lines: Sequence[str], outcome: str = "", path: str = ""
) -> ET.Element:
    """Return a case; ``outcome`` is empty, ``failure``, ``error`` or ``system-out``."""
    case = ET.Element("testcase", classname=f"{package}.{_TOOL}", name=name)
    if path:
        case.set("file", path)
    if outcome:
        text = "\n".join(lines)
        child = ET.SubElement(case, outcome)
        child.text = text
        if outcome != "system-out":
            child.set("message", text)
    return case


def suite_of(name: str, cases: Sequence[ET.Element], seconds: float = 0) -> ET.Element:
    """Return a suite with its counts."""
    suite = ET.Element("testsuite", name=name, tests=str(len(cases)))
    suite.set("failures", str(sum(case.find("failure") is not None for case in cases)))
    suite.set("errors", str(sum(case.find("error") is not None for case in cases)))
    suite.set("skipped", str(sum(case.find("skipped") is not None for case in cases)))
    suite.set("time", f"{seconds:.3f}" if seconds else "0")
    suite.extend(cases)
    return suite
