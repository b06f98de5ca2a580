"""The JUnit report of a smoke run: a suite per package, a case per executable."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TextIO
from xml.etree import ElementTree as ET

from scaffold.printable import printable
from scaffold.reporters import junit
from scaffold.smoke.reports.text import lines_of, without_escapes
from scaffold.smoke.result import Executable, PackageResult, Smoke

_BUILD = "smoke build"


def report(result: Smoke, out: TextIO, *, verbose: bool = False) -> None:
    """Write the suites; the observation of an executable is the output of its case."""
    suites = [_suite(package, verbose=verbose) for package in without_escapes(result).packages]
    junit.write(suites, out)


def _suite(package: PackageResult, *, verbose: bool) -> ET.Element:
    cases = [_build(package)]
    cases += [_executable(package, execution, verbose=verbose) for execution in package.runs]
    cases += _tests(package)
    seconds = sum(float(case.get("time", "0")) for case in cases)
    suite = junit.suite_of(package.name, cases, seconds)
    if package.worker:
        suite.set("hostname", package.worker)
    return suite


def _build(package: PackageResult) -> ET.Element:
    build = package.build
    outcome = "" if build.ok else "failure"
    errors = build.errors
    if build.interrupted:
        outcome, errors = "error", ("interrupted before the build",)
    case = junit.case_of(package.name, _BUILD, errors, outcome, package.manifest)
    case.set("time", f"{build.seconds:.3f}")
    if build.warnings:
        ET.SubElement(case, "system-out").text = "\n".join(build.warnings)
    return case


def _executable(package: PackageResult, executable: Executable, *, verbose: bool) -> ET.Element:
    problems = [str(problem) for problem in executable.problems]
    outcome = "failure" if problems else ""
    if executable.interrupted:
        outcome, problems = "error", [*problems, "interrupted"]
    name = f"smoke {executable.name}"
    case = junit.case_of(package.name, name, problems, outcome, executable.source)
    case.set("time", f"{executable.seconds:.3f}")
    ET.SubElement(case, "system-out").text = "\n".join(_output_lines(executable, verbose=verbose))
    return case


def _tests(package: PackageResult) -> Iterator[ET.Element]:
    if package.tests is None:
        return
    if package.tests.error:
        yield junit.case_of(package.name, "colcon test", [package.tests.error], "error")
    for item in package.tests.cases:
        outcome = "failure" if item.outcome == "failed" else ""
        case = junit.case_of(package.name, f"test {item.name}", item.message, outcome)
        if item.outcome == "skipped":
            ET.SubElement(case, "skipped")
        yield case


def _output_lines(executable: Executable, *, verbose: bool) -> Iterator[str]:
    for line in lines_of(executable, verbose=verbose):
        yield printable(line)
