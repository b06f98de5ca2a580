"""Runs the tests of packages with ``colcon test``, and reads the results."""

from __future__ import annotations

import glob
import os
import time
from collections.abc import Iterator, Sequence
from pathlib import Path

from lxml import etree

from scaffold.model.package import Package as Source
from scaffold.smoke.building.build import Layout, variables
from scaffold.smoke.environment import Environment
from scaffold.smoke.isolation import domain
from scaffold.smoke.isolation.station import isolated
from scaffold.smoke.processes import output, process
from scaffold.smoke.processes.process import Origin
from scaffold.smoke.result import TestCase, Tests

MOST_BYTES = 20_000_000
"""The size limit of a results file."""
MOST_CASES = 10_000
"""The maximum number of cases of a package."""
SHOWN_LINES = 12
"""The number of lines shown of a failure message."""

_FAILED = ("failure", "error")


async def run_tests(
    environment: Environment,
    packages: Sequence[Source],
    layout: Layout,
    scratch: Path,
    *,
    origin: Origin,
    timeout: float,
    done: dict[str, Tests],
) -> None:
    """Run the tests of built packages in a ROS domain of their own.

    Args:
        environment: The environment that they were built with.
        packages: The packages to test.
        layout: The directories that they were built in.
        scratch: A directory for the output of colcon.
        origin: The run that it belongs to.
        timeout: Seconds after which the tests are aborted.
        done: Receives the tests by package, also when interrupted.
    """
    begun = time.time()
    error = "interrupted"
    try:
        error = await _run(environment, packages, layout, scratch, origin=origin, timeout=timeout)
    finally:
        for package in packages:
            done[package.name] = _of_package(layout.build / package.name, begun, error)


async def _run(
    environment: Environment,
    packages: Sequence[Source],
    layout: Layout,
    scratch: Path,
    *,
    origin: Origin,
    timeout: float,
) -> str:
    """Run ``colcon test``; return why it failed, or an empty text."""
    with domain.reserved() as number:
        run = await process.start(
            command(environment, packages, layout),
            isolated(variables(environment, scratch), number, scratch),
            scratch / "colcon_test",
            origin,
        )
        try:
            in_time = await run.ended_within(timeout)
            if in_time:
                await run.finish()
        finally:
            await run.close()
    if not in_time:
        return f"the tests did not finish within {timeout:g} s"
    if not run.exit_code:
        return ""
    errors = output.errors(output.read(run.out) + output.read(run.err))
    return errors[-1] if errors else f"colcon test: exit code {run.exit_code}"


def command(environment: Environment, packages: Sequence[Source], layout: Layout) -> list[str]:
    """Return the command line of colcon."""
    return [
        environment.colcon,
        "--log-base",
        str(layout.log),
        "test",
        "--paths",
        *(glob.escape(os.path.realpath(package.directory)) for package in packages),
        "--build-base",
        str(layout.build),
        "--install-base",
        str(layout.install),
    ]


def _of_package(build: Path, begun: float, error: str) -> Tests:
    cases: list[TestCase] = []
    for path in sorted(build.rglob("*.xml")):
        if path.stat().st_mtime >= begun - 1 and path.stat().st_size <= MOST_BYTES:
            cases += read(path.read_bytes())
    return Tests(tuple(cases[:MOST_CASES]), error)


def read(data: bytes) -> Iterator[TestCase]:
    """Yield the cases in a JUnit file; nothing for other files."""
    parser = etree.XMLParser(resolve_entities=False, no_network=True, huge_tree=False)
    try:
        root = etree.fromstring(data, parser)
    except etree.XMLSyntaxError:
        return
    if root.tag not in {"testsuites", "testsuite"}:
        return
    for case in root.iter("testcase"):
        group, name = case.get("classname") or "", case.get("name") or ""
        failed = next((child for child in case if child.tag in _FAILED), None)
        if failed is None:
            outcome = "skipped" if case.find("skipped") is not None else "passed"
            yield TestCase(f"{group}.{name}".strip("."), outcome)
        else:
            text = "\n".join(filter(None, (failed.get("message"), failed.text)))
            lines = [line for line in text.splitlines() if line.strip()]
            yield TestCase(f"{group}.{name}".strip("."), "failed", tuple(lines[:SHOWN_LINES]))
