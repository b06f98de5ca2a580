"""The report of ``smoke`` on public packages, compared with the observations of a plain rclpy node.

SCAFFOLD_SMOKE_BASES names checkouts, such as those of ros2/demos and ros2/examples, separated by
colons. Their Python packages are run twice: once by ``smoke``, once by this test.
"""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from scaffold.model.discovery import targets
from scaffold.smoke import environment
from scaffold.smoke.embedded.interfaces import with_prefixes
from scaffold.smoke.isolation import domain
from tests.nightly import rclpy_witness
from tests.smoke.smoke_runs import NEEDS_ROS, command_line, processes_of, variables

BASES = [base for base in os.environ.get("SCAFFOLD_SMOKE_BASES", "").split(os.pathsep) if base]
SECONDS = 8.0
"""Of observation."""
TOLERANCE = 0.03
ENOUGH = 5
"""Messages that make a rate."""
UNSTEADY = 0.3
"""Of an interval, by which others differ from it."""
END = 20.0
_OF_EVERY_NODE = (
    "/describe_parameters", "/get_parameter_types", "/get_parameters", "/list_parameters",
    "/set_parameters", "/set_parameters_atomically", "/get_type_description",
)  # fmt: skip
_ACTION = "/_action/"
_MORE = "..."
"""What a long value ends in."""

pytestmark = [
    pytest.mark.nightly,
    NEEDS_ROS,
    pytest.mark.timeout(0),
    pytest.mark.skipif(not BASES, reason="SCAFFOLD_SMOKE_BASES names no checkout"),
]


@pytest.mark.parametrize("base", BASES)
def test_the_report_agrees_with_rclpy(base: str, tmp_path: Path) -> None:
    tmp = tmp_path / "tmp"
    tmp.mkdir()
    names = [
        target.package.name
        for target in targets.find([base])
        if target.package.build_type == "ament_python"
    ]
    workspace = tmp_path / "workspace"
    done = subprocess.run(
        command_line(
            base, "--packages-select", *names, "--workspace", workspace, "--jobs", "2",
            "--duration", f"{SECONDS:g}", "--format", "json",
        ),
        env=variables(tmp),
        capture_output=True,
        text=True,
        check=False,
    )  # fmt: skip
    print(done.stderr)  # noqa: T201  with -s: what was compared
    packages = [item for item in json.loads(done.stdout)["packages"] if item["executables"]]
    runs = [(package["name"], item) for package in packages for item in package["executables"]]
    sourced = _sourced(workspace / "install")

    def compared(run: tuple[str, Any]) -> list[str]:
        package, report = run
        name = report["name"]
        for finding in (*report["problems"], *report["notes"]):
            print(f"{package}/{name}: {finding}")  # noqa: T201  likewise
        path = workspace / "install" / package / "lib" / package / name
        seen = _seen(path, sourced, tmp / f"{package}-{name}")
        return [f"{package}/{name}: {line}" for line in disagreements(report, seen)]

    with ThreadPoolExecutor(2) as pool:
        result = [line for lines in pool.map(compared, runs) for line in lines]
    print(*result, sep="\n")  # noqa: T201  likewise
    print(f"{len(packages)} packages, {len(runs)} executables")  # noqa: T201  likewise
    assert runs
    assert result == []
    assert processes_of(tmp) == []


def _sourced(install: Path) -> dict[str, str]:
    """Return the variables of a shell in which the packages are sourced."""
    cached = (Path.home() / ".cache" / "ros2-scaffold" / "interfaces").glob("*/[!.]*")
    chosen = with_prefixes(environment.select(os.environ), [*cached])
    done = subprocess.run(
        ["bash", "-c", f"source {install}/local_setup.bash && env -0"],
        env=chosen.variables,
        capture_output=True,
        text=True,
        check=True,
    )
    result = dict(item.split("=", 1) for item in done.stdout.split("\0") if item)
    return {**result, "WITNESS_PYTHON": chosen.python}


def _seen(path: Path, sourced: Mapping[str, str], tmp: Path) -> dict[str, Any]:
    """Run an executable next to a witness; return the observations of the witness."""
    tmp.mkdir()
    with domain.reserved() as number:
        alone = {
            **sourced,
            "ROS_DOMAIN_ID": str(number),
            "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
            "TMPDIR": str(tmp),
            "ROS_LOG_DIR": str(tmp),
        }
        command = [sourced["WITNESS_PYTHON"], rclpy_witness.__file__]
        with subprocess.Popen(
            command, env=alone, text=True, stdin=subprocess.PIPE, stdout=subprocess.PIPE
        ) as witness:
            assert witness.stdin is not None
            assert witness.stdout is not None
            try:
                assert json.loads(witness.stdout.readline()) == "ready"
                with _running(path, alone, tmp):
                    time.sleep(SECONDS + 3)
                    witness.stdin.close()
                    seen: dict[str, Any] = json.loads(witness.stdout.readline())
            finally:
                witness.kill()
    return seen


@contextmanager
def _running(path: Path, alone: Mapping[str, str], tmp: Path) -> Iterator[None]:
    with (
        (tmp / "output.log").open("wb") as out,
        subprocess.Popen(
            [sys.executable, "-S", "-c", _WITH_SIGNALS, str(path)],
            env=alone,
            stdin=subprocess.DEVNULL,
            stdout=out,
            stderr=out,
            start_new_session=True,
        ) as process,
    ):
        try:
            yield
        finally:
            process.send_signal(signal.SIGINT)
            try:
                process.wait(END)
            except subprocess.TimeoutExpired:
                process.kill()


_WITH_SIGNALS = """
import os, signal, sys
signal.signal(signal.SIGINT, signal.SIG_DFL)
os.execv(sys.argv[1], sys.argv[1:])
"""
"""A shell may have started the tests with SIGINT ignored."""


def disagreements(report: Mapping[str, Any], seen: Mapping[str, Any]) -> Iterator[str]:
    """Yield the differences between both observations.

    If a program ends by itself, one may have observed more than the other.
    """
    is_short = report["stop"] is None or report["stop"]["signal"] is None
    services = {
        name: kind
        for name, kind in seen["services"].items()
        if not name.endswith(_OF_EVERY_NODE) and _ACTION not in name
    }
    topics = {name: item for name, item in seen["topics"].items() if _ACTION not in name}
    pairs: list[tuple[str, Any, Any]] = [
        ("nodes", set(report["nodes"]), set(seen["nodes"])),
        ("services", {item["name"]: item["type"] for item in report["services"]}, services),
        ("actions", {item["name"]: item["type"] for item in report["actions"]}, seen["actions"]),
        ("topics", {item["name"] for item in report["topics"]}, set(topics)),
        *_parameters(report["parameters"], seen["parameters"]),
    ]
    for what, ours, theirs in pairs:
        if ours != theirs and not is_short:
            yield f"{what}: {ours}, but rclpy says {theirs}"
    for topic in report["topics"]:
        other = topics.get(topic["name"])
        if other is not None:
            yield from _of_topic(topic, other, is_short=is_short)


def _parameters(
    ours: Mapping[str, Any], theirs: Mapping[str, Any]
) -> Iterator[tuple[str, object, object]]:
    answered = {node for node, values in ours.items() if values is not None}
    yield "nodes that answered about parameters", answered, {*theirs}
    for node in answered & {*theirs}:
        yield f"names of parameters of {node}", {*ours[node]}, {*theirs[node]}
        for name, value in ours[node].items():
            if _MORE not in str(value):
                yield f"{node} {name}", value, theirs[node].get(name)


def _of_topic(
    ours: Mapping[str, Any], theirs: Mapping[str, Any], *, is_short: bool
) -> Iterator[str]:
    name = ours["name"]
    if [ours["type"]] != theirs["types"]:
        yield f"{name} has the type {ours['type']}, but rclpy says {theirs['types']}"
    endpoints = [sorted(map(str, map(_flat, item["endpoints"]))) for item in (ours, theirs)]
    if endpoints[0] != endpoints[1] and not is_short:
        yield f"{name} has the endpoints {endpoints[0]}, but rclpy says {endpoints[1]}"
    for kind, count in (("publisher", "publishers"), ("subscription", "subscribers")):
        number = sum(item["kind"] == kind for item in theirs["endpoints"])
        if ours[count] != number and not is_short:
            yield f"{name} has {ours[count]} {count}, but rclpy says {number}"
    if min(ours["count"], theirs["count"]) >= ENOUGH and not is_short:
        differs = abs(ours["rate_hz"] / theirs["rate_hz"] - 1)
        if not _have_no_rate(ours, theirs) and differs > TOLERANCE + _chance(ours, theirs):
            yield f"{name} comes at {ours['rate_hz']} Hz, but rclpy says {theirs['rate_hz']}"
    elif bool(ours["count"]) != bool(theirs["count"]) and not is_short:
        yield f"{name} has {ours['count']} messages, but rclpy says {theirs['count']}"


def _have_no_rate(ours: Mapping[str, Any], theirs: Mapping[str, Any]) -> bool:
    """Return whether both saw bursts of messages: their mean rate depends on the start."""
    spreads = (
        ours["interval"]["deviation"] * ours["rate_hz"],
        theirs["interval"] * theirs["rate_hz"],
    )
    return bool(min(spreads) > UNSTEADY)


def _chance(ours: Mapping[str, Any], theirs: Mapping[str, Any]) -> float:
    """Return the tolerance of a rate: on a busy machine, it differs from run to run.

    The first and the last message decide a rate. They are as late as all others.
    """
    late = max(ours["interval"]["deviation"], theirs["interval"])
    return float(late * theirs["rate_hz"] / (theirs["count"] - 1))


def _flat(endpoint: Mapping[str, Any]) -> tuple[object, ...]:
    qos = sorted(endpoint["qos"].items())
    return (endpoint["kind"], endpoint["node"], endpoint["type"], tuple(qos))
