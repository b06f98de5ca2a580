"""The text report of a smoke run."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping
from dataclasses import fields, is_dataclass, replace
from typing import TextIO, TypeVar, cast

from scaffold import columns
from scaffold.printable import printable
from scaffold.smoke.reports import details
from scaffold.smoke.reports.details import count
from scaffold.smoke.result import Executable, PackageResult, Problem, Smoke, Tests, Topic
from scaffold.smoke.run import ending

_SHOWN_MESSAGES = 2
_SHOWN_NAMES = 6
_RED, _GREEN, _YELLOW, _BOLD, _DIM = "31", "32", "33", "1", "2"

Value = TypeVar("Value")

Paint = Callable[[str, str], str]


def report(result: Smoke, out: TextIO, *, verbose: bool = False) -> None:
    """Write the result as text.

    Args:
        result: The result of the run.
        out: The stream.
        verbose: Whether measurements, quality of service, parameters and logs are shown.
    """
    paint = _colorizer(out)
    lines = _lines(without_escapes(result), paint, verbose=verbose)
    width = columns.of_terminal(out)
    for line in lines:
        parts = [line] if width is None else columns.wrapped(line, width)
        out.writelines(part.rstrip() + "\n" for part in parts)


def without_escapes(value: Value) -> Value:
    """Return a result with control characters escaped."""
    cleaned: object = value
    if isinstance(value, str):
        cleaned = printable(value.expandtabs())
    elif isinstance(value, tuple):
        cleaned = tuple(map(without_escapes, value))
    elif isinstance(value, list):
        cleaned = [*map(without_escapes, value)]
    elif isinstance(value, Mapping):
        cleaned = {without_escapes(key): without_escapes(item) for key, item in value.items()}
    elif is_dataclass(value) and not isinstance(value, type):
        changes = {
            field.name: without_escapes(getattr(value, field.name)) for field in fields(value)
        }
        cleaned = replace(value, **changes)
    return cast("Value", cleaned)


def _uncolored(text: str, color: str) -> str:  # noqa: ARG001  as if it had one
    return text


def lines_of(executable: Executable, *, verbose: bool) -> list[str]:
    """Return the lines about an executable."""
    return list(_details(executable, _uncolored, verbose=verbose))


def _lines(result: Smoke, paint: Paint, *, verbose: bool) -> Iterator[str]:
    environment = result.environment
    title = " ".join(["ROS 2", *environment.get("distribution", "").capitalize().split()])
    yield f"{title} ({environment['kind']}): {environment['prefix']}, {environment['rmw']}"
    for note in result.notes:
        yield f"note: not used: {note}"
    for package in result.packages:
        yield ""
        yield from _package(package, paint, verbose=verbose)
    yield ""
    if result.ended_early:
        yield paint(f"ended early: {result.ended_early}", _RED)
    yield summary(result, paint)


def _package(package: PackageResult, paint: Paint, *, verbose: bool) -> Iterator[str]:
    name = paint(package.name, _BOLD)
    build = package.build
    if build.interrupted:
        yield f"{name}: not built yet"
    elif build.ok:
        why = ", as a dependency" if package.is_dependency else ""
        where = f" on {package.worker}" if package.worker else ""
        yield f"{name}: built in {build.seconds:.1f} s{where}{why}"
        yield from _indented(_captioned("info: warnings of the build", build.warnings), 2)
    else:
        where = f" on {package.worker}" if package.worker else ""
        yield f"{name}: {paint('does not build', _RED)}{where}"
        yield from _indented(build.errors, 2)
    if build.ok and package.ran and not package.executables:
        yield "  no executables"
    for executable in package.runs:
        yield from _indented(_executable(executable, paint, verbose=verbose), 2)
    if package.tests is not None:
        yield from _indented(_tests(package.tests, paint), 2)


def _tests(tests: Tests, paint: Paint) -> Iterator[str]:
    failed = len(tests.failed)
    verdict = paint(f"{failed} failed", _RED) if failed else paint("ok", _GREEN)
    if tests.error and not failed:
        verdict = paint("not ok", _RED)
    if not tests.cases and not tests.error:
        verdict = "none ran"
    yield f"{count(len(tests.cases), 'test')}: {verdict}"
    if tests.error:
        yield f"  {paint('problem:', _RED)} {tests.error}"
    for case in tests.failed:
        yield f"  {paint('failed:', _RED)} {case.name}"
        yield from _indented(case.message, 6)


def _captioned(caption: str, lines: tuple[str, ...]) -> Iterator[str]:
    if lines:
        yield f"{caption}:"
        yield from _indented(lines, 2)


def _executable(executable: Executable, paint: Paint, *, verbose: bool) -> Iterator[str]:
    verdict = paint("ok", _GREEN) if executable.ok else paint("not ok", _RED)
    if executable.interrupted:
        verdict = paint("interrupted", _YELLOW)
    yield f"{paint(executable.name, _BOLD)}: {verdict}"
    yield from _indented(_details(executable, paint, verbose=verbose), 2)


def _details(executable: Executable, paint: Paint, *, verbose: bool) -> Iterator[str]:
    seen = executable.observation
    if seen.nodes:
        yield f"{'node' if len(seen.nodes) == 1 else 'nodes'} {', '.join(seen.nodes)}"
    published = [topic for topic in seen.topics if topic.publishers]
    yield from _topics(published, verbose=verbose)
    for caption, pairs in (
        ("subscribes to", [(topic.name, topic.type) for topic in seen.topics if topic.subscribers]),
        ("service", seen.services),
        ("action", seen.actions),
    ):
        for name, kind in pairs:
            yield f"{caption} {name}  {kind}"
    yield from details.of_transitions(seen.transitions)
    if verbose:
        yield from details.of_executable(seen)
    else:
        yield from details.warnings(seen.log)
    for stop in executable.stops:
        if stop.signal is not None:
            yield f"stopped by {stop.signal} in {stop.seconds:.2f} s, {ending(stop.exit_code)}"
    for note in executable.notes:
        yield paint(f"note: {note}", _DIM)
    for problem in executable.problems:
        yield from _problem(problem, paint)


def _topics(topics: list[Topic], *, verbose: bool) -> Iterator[str]:
    """Yield a table with the first messages of every topic below its line."""
    rows = [
        (
            topic.name,
            topic.type,
            count(topic.publishers, "publisher"),
            "" if topic.rate_hz is None else f"{topic.rate_hz:.2f} Hz",
            count(topic.count, "message"),
        )
        for topic in topics
    ]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    for topic, (name, kind, publishers, rate, messages) in zip(topics, rows, strict=True):
        yield (
            f"{name:{widths[0]}}  {kind:{widths[1]}}  {publishers:{widths[2]}}  "
            f"{rate:>{widths[3]}}  {messages:>{widths[4]}}"
        )
        for message in topic.messages[:_SHOWN_MESSAGES]:
            yield "  " + printable(details.shortened(details.flow(message)))
        if verbose:
            yield from _indented(tuple(details.of_topic(topic)), 2)


def _problem(problem: Problem, paint: Paint) -> Iterator[str]:
    yield f"{paint('problem:', _RED)} {problem.message}"
    yield from _indented(problem.output, 4)


def _indented(lines: Iterator[str] | tuple[str, ...], depth: int) -> Iterator[str]:
    for line in lines:
        yield " " * depth + line


def summary(result: Smoke, paint: Paint = _uncolored) -> str:
    """Return one line with counts of runs and failures."""
    executables = [executable for package in result.packages for executable in package.executables]
    is_one = sum(bool(package.runs) for package in result.packages) == 1
    named = [
        (run.name if is_one else f"{package.name}/{run.name}", run)
        for package in result.packages
        for run in package.runs
    ]
    counts = f"{count(len(result.packages), 'package')}, {count(len(executables), 'executable')}"
    seconds = f"in {result.seconds:.1f} s"
    if result.ok:
        return f"{counts}: {paint('ok', _GREEN)} {seconds}"
    unbuilt = [package.name for package in result.packages if not package.build.ok]
    bad = [name for name, run in named if run.problems]
    unfinished = [name for name, run in named if run.interrupted and not run.problems]
    parts = [f"{_listed(unbuilt)} not built"] if unbuilt else []
    parts += [f"{_listed(bad)} not ok"] if bad else []
    parts += [f"{_listed(unfinished)} interrupted"] if unfinished else []
    failed = [item.name for item in result.packages if item.tests and not item.tests.ok]
    parts += [f"tests of {_listed(failed)} failed"] if failed else []
    verdict = "; ".join(parts) or "ended early"
    return f"{counts}: {paint(verdict, _RED)} {seconds}"


def _listed(names: list[str]) -> str:
    shown = ", ".join(names[:_SHOWN_NAMES])
    more = len(names) - _SHOWN_NAMES
    return f"{shown} and {more} more" if more > 0 else shown


def _colorizer(out: TextIO) -> Paint:
    """Return a function that wraps text in a color when a terminal shows it."""
    if out.isatty() and not os.environ.get("NO_COLOR"):
        return lambda text, color: f"\033[{color}m{text}\033[0m"
    return _uncolored
