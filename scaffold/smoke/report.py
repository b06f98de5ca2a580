"""What a smoke run found out, as text for people and as JSON for programs."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping
from dataclasses import fields, is_dataclass, replace
from json import dumps
from typing import Any, TextIO, TypeVar, cast

from scaffold.printable import printable
from scaffold.smoke.result import Executable, PackageResult, Problem, Smoke, Stop, Topic
from scaffold.smoke.run import ending

FORMATS = ("text", "json")

_SHOWN_MESSAGES = 2
_SHOWN_NAMES = 6
_SHOWN_WIDTH = 100
_RED, _GREEN, _YELLOW, _BOLD, _DIM = "31", "32", "33", "1", "2"

Value = TypeVar("Value")

Paint = Callable[[str, str], str]


def report(result: Smoke, form: str, out: TextIO) -> None:
    """Write the result in one of ``FORMATS``."""
    (_report_json if form == "json" else _report_text)(result, out)


# -- JSON


def _report_json(result: Smoke, out: TextIO) -> None:
    out.write(dumps(as_data(result), indent=2) + "\n")


def as_data(result: Smoke) -> dict[str, Any]:
    """Return the result as nested dictionaries and lists."""
    return {
        "environment": dict(result.environment),
        "packages": [_package_data(package) for package in result.packages],
        "ok": result.ok,
    }


def _package_data(package: PackageResult) -> dict[str, Any]:
    build = package.build
    return {
        "name": package.name,
        "build": {
            "ok": build.ok,
            "seconds": round(build.seconds, 3),
            "errors": list(build.errors),
            "warnings": list(build.warnings),
        },
        "executables": [_executable_data(executable) for executable in package.executables],
    }


def _executable_data(executable: Executable) -> dict[str, Any]:
    seen = executable.observation
    stops = [_stop_data(stop) for stop in executable.stops or (Stop(None, None, 0.0),)]
    data = {
        "name": executable.name,
        "ok": executable.ok,
        "nodes": list(seen.nodes),
        "topics": [_topic_data(topic) for topic in seen.topics],
        "services": [{"name": name, "type": kind} for name, kind in seen.services],
        "actions": [{"name": name, "type": kind} for name, kind in seen.actions],
        "stop": stops[0],
        "problems": [str(problem) for problem in executable.problems],
        "notes": list(executable.notes),
    }
    if len(stops) > 1:
        data["stops"] = stops
    return data


def _topic_data(topic: Topic) -> dict[str, Any]:
    return {
        "name": topic.name,
        "type": topic.type,
        "publishers": topic.publishers,
        "subscribers": topic.subscribers,
        "rate_hz": topic.rate_hz,
        "count": topic.count,
        "messages": list(topic.messages),
    }


def _stop_data(stop: Stop) -> dict[str, Any]:
    return {
        "signal": stop.signal,
        "exit_code": stop.exit_code,
        "seconds": round(stop.seconds, 3),
        "traceback": stop.traceback,
    }


# -- text


def _report_text(result: Smoke, out: TextIO) -> None:
    paint = _painter(out)
    lines = _lines(_without_escapes(result), paint)
    out.writelines(line.rstrip() + "\n" for line in lines)


def _without_escapes(value: Value) -> Value:
    """Return a result in which no text can command the terminal that shows it."""
    cleaned: object = value
    if isinstance(value, str):
        cleaned = printable(value.expandtabs())
    elif isinstance(value, tuple):
        cleaned = tuple(map(_without_escapes, value))
    elif isinstance(value, Mapping):
        cleaned = {_without_escapes(key): _without_escapes(item) for key, item in value.items()}
    elif is_dataclass(value) and not isinstance(value, type):
        changes = {
            field.name: _without_escapes(getattr(value, field.name)) for field in fields(value)
        }
        cleaned = replace(value, **changes)
    return cast("Value", cleaned)


def _lines(result: Smoke, paint: Paint) -> Iterator[str]:
    found = result.environment
    yield f"ROS 2 ({found['kind']}): {found['prefix']}, {found['rmw']}"
    for note in result.notes:
        yield f"note: not used: {note}"
    for package in result.packages:
        yield ""
        yield from _package(package, paint)
    yield ""
    yield _summary(result, paint)


def _package(package: PackageResult, paint: Paint) -> Iterator[str]:
    name = paint(package.name, _BOLD)
    build = package.build
    if build.ok:
        yield f"{name}: built in {build.seconds:.1f} s"
        yield from _indented(_captioned("info: warnings of the build", build.warnings), 2)
    else:
        yield f"{name}: {paint('does not build', _RED)}"
        yield from _indented(build.errors, 2)
    if build.ok and not package.executables:
        yield "  no executables"
    for executable in package.executables:
        yield from _indented(_executable(executable, paint), 2)


def _captioned(caption: str, lines: tuple[str, ...]) -> Iterator[str]:
    if lines:
        yield f"{caption}:"
        yield from _indented(lines, 2)


def _executable(executable: Executable, paint: Paint) -> Iterator[str]:
    verdict = paint("ok", _GREEN) if executable.ok else paint("not ok", _RED)
    yield f"{paint(executable.name, _BOLD)}: {verdict}"
    yield from _indented(_details(executable, paint), 2)


def _details(executable: Executable, paint: Paint) -> Iterator[str]:
    seen = executable.observation
    if seen.nodes:
        yield f"{'node' if len(seen.nodes) == 1 else 'nodes'} {', '.join(seen.nodes)}"
    published = [topic for topic in seen.topics if topic.publishers]
    yield from _topics(published)
    for caption, pairs in (
        ("subscribes to", [(topic.name, topic.type) for topic in seen.topics if topic.subscribers]),
        ("service", seen.services),
        ("action", seen.actions),
    ):
        for name, kind in pairs:
            yield f"{caption} {name}  {kind}"
    for stop in executable.stops:
        if stop.signal is not None:
            yield f"stopped by {stop.signal} in {stop.seconds:.2f} s, {ending(stop.exit_code)}"
    for note in executable.notes:
        yield paint(f"note: {note}", _DIM)
    for problem in executable.problems:
        yield from _problem(problem, paint)


def _topics(topics: list[Topic]) -> Iterator[str]:
    """Yield a table with the first messages of every topic below its line."""
    rows = [
        (
            topic.name,
            topic.type,
            _count(topic.publishers, "publisher"),
            "" if topic.rate_hz is None else f"{topic.rate_hz:.2f} Hz",
            _count(topic.count, "message"),
        )
        for topic in topics
    ]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    for topic, (name, kind, publishers, rate, count) in zip(topics, rows, strict=True):
        yield (
            f"{name:{widths[0]}}  {kind:{widths[1]}}  {publishers:{widths[2]}}  "
            f"{rate:>{widths[3]}}  {count:>{widths[4]}}"
        )
        for message in topic.messages[:_SHOWN_MESSAGES]:
            yield "  " + printable(_shortened(_flow(message)))


def _flow(value: object) -> str:
    """Return a value in YAML's flow style, as short as it goes."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key}: {_flow(item)}" for key, item in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(_flow(item) for item in value) + "]"
    return dumps(value, ensure_ascii=False)


def _shortened(text: str) -> str:
    return text if len(text) <= _SHOWN_WIDTH else text[: _SHOWN_WIDTH - 3] + "..."


def _problem(problem: Problem, paint: Paint) -> Iterator[str]:
    yield f"{paint('problem:', _RED)} {problem.message}"
    yield from _indented(problem.output, 4)


def _indented(lines: Iterator[str] | tuple[str, ...], depth: int) -> Iterator[str]:
    for line in lines:
        yield " " * depth + line


def _summary(result: Smoke, paint: Paint) -> str:
    executables = [executable for package in result.packages for executable in package.executables]
    said = f"{_count(len(result.packages), 'package')}, {_count(len(executables), 'executable')}"
    seconds = f"in {result.seconds:.1f} s"
    if result.ok:
        return f"{said}: {paint('ok', _GREEN)} {seconds}"
    unbuilt = [package.name for package in result.packages if not package.build.ok]
    bad = [executable.name for executable in executables if not executable.ok]
    parts = [f"{_listed(unbuilt)} not built"] if unbuilt else []
    parts += [f"{_listed(bad)} not ok"] if bad else []
    return f"{said}: {paint('; '.join(parts), _RED)} {seconds}"


def _listed(names: list[str]) -> str:
    shown = ", ".join(names[:_SHOWN_NAMES])
    more = len(names) - _SHOWN_NAMES
    return f"{shown} and {more} more" if more > 0 else shown


def _count(number: int, noun: str) -> str:
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"


def _painter(out: TextIO) -> Paint:
    """Return a function that wraps text in a color when a terminal shows it."""
    if out.isatty() and not os.environ.get("NO_COLOR"):
        return lambda text, color: f"\033[{color}m{text}\033[0m"
    return lambda text, _: text
