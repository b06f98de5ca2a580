"""What a smoke run found out, for programs."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any, TextIO

from scaffold.printable import json_text
from scaffold.smoke.result import Executable, PackageResult, Smoke, Spread, Stop, Topic

SCHEMA_VERSION = 1
"""Raised when a field changes its meaning or goes; new fields come without that."""

_DIGITS = 6


def report(result: Smoke, out: TextIO, *, verbose: bool = False) -> None:  # noqa: ARG001  same shape as the others
    """Write the result as JSON."""
    out.write(json_text(as_data(result)) + "\n")


def as_data(result: Smoke) -> dict[str, Any]:
    """Return the result as nested dictionaries and lists."""
    return {
        "schema_version": SCHEMA_VERSION,
        "environment": dict(result.environment),
        "packages": [_package(package) for package in result.packages],
        "ok": result.ok,
        "seconds": round(result.seconds, 3),
    }


def _package(package: PackageResult) -> dict[str, Any]:
    build = package.build
    tests = package.tests
    return {
        "name": package.name,
        "dependency": package.is_dependency,
        "build": {
            "ok": build.ok,
            "seconds": round(build.seconds, 3),
            "errors": list(build.errors),
            "warnings": list(build.warnings),
        },
        "executables": [_executable(executable) for executable in package.executables],
        "together": None if package.together is None else _executable(package.together),
        "tests": None
        if tests is None
        else {
            "ok": tests.ok,
            "error": tests.error,
            "cases": [
                {"name": case.name, "outcome": case.outcome, "message": "\n".join(case.message)}
                for case in tests.cases
            ],
        },
    }


def _executable(executable: Executable) -> dict[str, Any]:
    seen = executable.observation
    stops = [_stop(stop) for stop in executable.stops or (Stop(None, None, 0.0),)]
    data = {
        "name": executable.name,
        "ok": executable.ok,
        "nodes": list(seen.nodes),
        "topics": [_topic(topic) for topic in seen.topics],
        "services": [{"name": name, "type": kind} for name, kind in seen.services],
        "actions": [{"name": name, "type": kind} for name, kind in seen.actions],
        "parameters": seen.parameters,
        "log": {"counts": seen.log.counts, "lines": [asdict(line) for line in seen.log.lines]},
        "usage": None if seen.usage is None else _rounded(asdict(seen.usage)),
        "stop": stops[0],
        "problems": [str(problem) for problem in executable.problems],
        "notes": list(executable.notes),
    }
    if len(stops) > 1:
        data["stops"] = stops
    return data


def _topic(topic: Topic) -> dict[str, Any]:
    return {
        "name": topic.name,
        "type": topic.type,
        "publishers": topic.publishers,
        "subscribers": topic.subscribers,
        "rate_hz": topic.rate_hz,
        "count": topic.count,
        "messages": list(topic.messages),
        "endpoints": [asdict(endpoint) for endpoint in topic.endpoints],
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


def _spread(spread: Spread | None) -> dict[str, Any] | None:
    return None if spread is None else _rounded(asdict(spread))


def _rounded(figures: dict[str, Any]) -> dict[str, Any]:
    return {
        name: _round(value) if isinstance(value, float) else value
        for name, value in figures.items()
    }


def _round(value: float | None) -> float | None:
    return None if value is None else round(value, _DIGITS)


def _stop(stop: Stop) -> dict[str, Any]:
    return {
        "signal": stop.signal,
        "exit_code": stop.exit_code,
        "seconds": round(stop.seconds, 3),
        "traceback": stop.traceback,
    }
