"""The JSON report of a smoke run."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any, Literal, TextIO, cast

from scaffold.printable import json_text
from scaffold.smoke.reports import shape
from scaffold.smoke.result import Executable, PackageResult, Smoke, Spread, Stop, Tests, Topic

SCHEMA_VERSION: Literal[1] = 1
"""Incremented when a field changes its meaning or is removed, but not for new fields."""

_DIGITS = 6
_Outcome = Literal["passed", "failed", "skipped"]


def report(result: Smoke, out: TextIO, *, verbose: bool = False) -> None:  # noqa: ARG001  same shape as the others
    """Write the result as JSON."""
    out.write(json_text(as_data(result)) + "\n")


def as_data(result: Smoke) -> shape.Report:
    """Return the result as nested dictionaries and lists."""
    return {
        "schema_version": SCHEMA_VERSION,
        "environment": cast("shape.Environment", dict(result.environment)),
        "packages": [_package(package) for package in result.packages],
        "ok": result.ok,
        "ended_early": result.ended_early or None,
        "seconds": round(result.seconds, 3),
    }


def _package(package: PackageResult) -> shape.Package:
    build = package.build
    return {
        "name": package.name,
        "dependency": package.is_dependency,
        "worker": package.worker or None,
        "build": {
            "ok": build.ok,
            "interrupted": build.interrupted,
            "seconds": round(build.seconds, 3),
            "errors": list(build.errors),
            "warnings": list(build.warnings),
        },
        "executables": [_executable(executable) for executable in package.executables],
        "together": None if package.together is None else _executable(package.together),
        "launches": [_executable(executable) for executable in package.launches],
        "tests": None if package.tests is None else _tests(package.tests),
    }


def _tests(tests: Tests) -> shape.Tests:
    return {
        "ok": tests.ok,
        "error": tests.error,
        "cases": [
            {
                "name": case.name,
                "outcome": cast("_Outcome", case.outcome),
                "message": "\n".join(case.message),
            }
            for case in tests.cases
        ],
    }


def _executable(executable: Executable) -> shape.Executable:
    seen = executable.observation
    stops = [_stop(stop) for stop in executable.stops or (Stop(None, None, 0.0),)]
    data: shape.Executable = {
        "name": executable.name,
        "ok": executable.ok,
        "interrupted": executable.interrupted,
        "nodes": list(seen.nodes),
        "topics": [_topic(topic) for topic in seen.topics],
        "services": [{"name": name, "type": kind} for name, kind in seen.services],
        "actions": [{"name": name, "type": kind} for name, kind in seen.actions],
        "parameters": {
            node: None if values is None else dict(values)
            for node, values in seen.parameters.items()
        },
        "transitions": [
            cast(
                "shape.Transition",
                {**_rounded(asdict(transition)), "error": transition.error or None},
            )
            for transition in seen.transitions
        ],
        "log": cast("shape.Log", asdict(seen.log)),
        "usage": None if seen.usage is None else cast("shape.Usage", _rounded(asdict(seen.usage))),
        "stop": stops[0],
        "problems": [str(problem) for problem in executable.problems],
        "notes": list(executable.notes),
    }
    if len(stops) > 1:
        data["stops"] = stops
    return data


def _topic(topic: Topic) -> shape.Topic:
    return {
        "name": topic.name,
        "type": topic.type,
        "publishers": topic.publishers,
        "subscribers": topic.subscribers,
        "rate_hz": topic.rate_hz,
        "count": topic.count,
        "messages": list(topic.messages),
        "endpoints": [cast("shape.Endpoint", asdict(endpoint)) for endpoint in topic.endpoints],
        "first_after": _round(topic.first_after),
        "lost": topic.lost,
        "interval": _spread(topic.interval),
        "bytes": topic.bytes,
        "size": _spread(topic.size),
        "bandwidth": _round(topic.bandwidth),
        "delay": _spread(topic.delay),
        "transport": _spread(topic.transport),
        "rates": [list(point) for point in topic.rates],
    }


def _spread(spread: Spread | None) -> shape.Spread | None:
    return None if spread is None else cast("shape.Spread", _rounded(asdict(spread)))


def _rounded(figures: dict[str, Any]) -> dict[str, Any]:
    return {
        name: _round(value) if isinstance(value, float) else value
        for name, value in figures.items()
    }


def _round(value: float | None) -> float | None:
    return None if value is None else round(value, _DIGITS)


def _stop(stop: Stop) -> shape.Stop:
    return {
        "signal": stop.signal,
        "exit_code": stop.exit_code,
        "seconds": round(stop.seconds, 3),
        "traceback": stop.traceback,
    }
