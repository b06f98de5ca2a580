"""ND108: periods are given in seconds."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Mapping

from scaffold.api import Diagnostic, Effect, Example, RclpyRule, Report, Severity
from scaffold.api.python import argument_of, last_name
from scaffold.api.rclpy import RclpyFile

_RATES = frozenset({"rate", "frequency", "freq", "hz", "fps"})
_CLEAR = _RATES - {"rate"}
_PERIODS = frozenset({"period", "interval"})
_MILLISECONDS = frozenset({"ms", "msec", "msecs", "millis", "milliseconds", "millisec"})
_LONG = 100
"""Seconds; longer integer periods are implausible and in milliseconds."""
_FEWEST = 1000
"""Nanoseconds; shorter durations are meant in seconds, except for the smallest step of time."""
_SECONDS: Mapping[str, tuple[int, str]] = {
    "create_timer": (0, "timer_period_sec"),
    "Duration": (9, "seconds"),
    "sleep": (0, "secs"),
    "wait_for_service": (0, "timeout_sec"),
    "wait_for_server": (0, "timeout_sec"),
    "spin_once": (9, "timeout_sec"),
    "spin_until_future_complete": (9, "timeout_sec"),
}
"""The parameters in seconds: position and name, by function."""
_NODE = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        rate = self.declare_parameter('rate', 20.0).value\n"
    "        self.timer_ms = 50\n"
    "        self.timer = self.create_timer({}, self.tick)\n\n"
    "    def tick(self):\n"
    "        pass\n"
)


class RateAsPeriod(RclpyRule):
    """A rate or a number of milliseconds is passed as a period in seconds.

    **Why.** A timer with a rate of 20 Hz as its period fires every 20 seconds, one with 100
    milliseconds every 100 seconds.

    **Fix.** ``self.create_timer(1.0 / rate, ...)``; ``self.create_timer(0.1, ...)``.

    **Source.** ``rclpy/node.py``, ``create_timer(timer_period_sec, ...)``.
    """

    code = "ND108"
    name = "rate-as-period"
    other_severities = {Severity.WARNING: "the name may refer to a period"}
    effect = Effect.WRONG_BEHAVIOR
    examples = (
        Example("a period", {"talker.py": _NODE.format("1.0 / rate")}),
        Example(
            "nanoseconds for seconds; the smallest step of time",
            {
                "wait.py": "from rclpy.duration import Duration\nfrom rclpy.node import Node\n\n\n"
                "class Wait(Node):\n"
                "    def wait(self):\n"
                "        limit = Duration(nanoseconds=5)\n"
                "        before = self.get_clock().now() - Duration(nanoseconds=1)\n"
                "        return limit, before\n"
            },
            "7:38: 5 ns are no time at all; write seconds=5",
        ),
        Example("a thousand per minute", {"talker.py": _NODE.format("1000 / 60000")}),
        Example(
            "milliseconds of a rate",
            {"talker.py": _NODE.format("1000.0 / rate")},
            "9:40: 1000 / rate is in milliseconds, but the period is in seconds; write 1.0 / rate",
        ),
        Example(
            "a rate",
            {"talker.py": _NODE.format("rate")},
            Report(
                "9:40",
                "a rate of 20 Hz is passed as the period: one call every 20 s; write 1.0 / rate",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "a rate in calls per second",
            {"talker.py": _NODE.format("rate").replace(".value\n", ".value  # per second\n")},
            Report(
                "9:40",
                "a rate of 20 Hz is passed as the period: one call every 20 s; write 1.0 / rate",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "a period in seconds that is named rate",
            {"talker.py": _NODE.format("rate").replace(".value\n", ".value  # rate in seconds\n")},
        ),
        Example(
            "milliseconds",
            {"talker.py": _NODE.format("self.timer_ms")},
            "9:40: the value is in milliseconds, but the period is in seconds; divide by 1000",
        ),
        Example("in seconds", {"talker.py": _NODE.format("self.timer_ms / 1000")}),
        Example(
            "a number of milliseconds",
            {"talker.py": _NODE.format("500")},
            Report(
                "9:40",
                "the period is 500 seconds; write 0.5 for 500 milliseconds",
                severity=Severity.WARNING,
            ),
        ),
        Example("one call every 500 seconds", {"talker.py": _NODE.format("1.0 / 0.002")}),
        Example(
            "a period for a Rate",
            {
                "talker.py": "from rclpy.node import Node\n\n\n"
                "class Talker(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('talker')\n"
                "        period = 0.1\n"
                "        self.rate = self.create_rate(period)\n"
            },
            "8:38: a period is passed as the rate; write 1.0 / period",
        ),
        Example(
            "a period that is named rate",
            {"talker.py": _NODE.format("rate").replace("'rate', 20.0", "'rate', 0.05")},
        ),
        Example(
            "a rate without a known value",
            {
                "talker.py": _NODE.replace("self.declare_parameter('rate', 20.0).value", "read()")
                .replace("rate =", "frequency =")
                .format("frequency")
            },
            Report(
                "9:40",
                "a rate is passed as the period: one call every that many seconds; "
                "write 1.0 / rate",
                severity=Severity.WARNING,
            ),
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for call in file.module.walk(ast.Call):
            name = last_name(call.func)
            if name in {"create_rate", "Duration"}:
                yield from self._check_other_units(file, call, name)
            given = _seconds(file, call, name) if name in _SECONDS else None
            if given is None:
                continue
            if name == "create_timer" and _is_of_thousand(file, given):
                message = (
                    "1000 / rate is in milliseconds, but the period is in seconds; write 1.0 / rate"
                )
                yield self.report(file.module.location(given), message)
                continue
            at = file.module.location(given)
            words = _words(file, given)
            value = file.evaluator.evaluate(given)
            number = (
                value if type(value) in {int, float} and isinstance(value, int | float) else None
            )
            if words & _MILLISECONDS:
                message = (
                    "the value is in milliseconds, but the period is in seconds; divide by 1000"
                )
                if number is None or number >= 1:
                    yield self.report(at, message)
            elif words & _RATES and name == "create_timer" and not words & _PERIODS:
                yield from self._check_period(file, given, words, number)
            elif isinstance(given, ast.BinOp) and isinstance(given.op, ast.Div):
                continue  # a period computed from a rate may be this long
            elif name == "create_timer" and number is not None and _is_milliseconds(number):
                message = (
                    f"the period is {number} seconds; write {number / 1000:g} for "
                    f"{number} milliseconds"
                )
                yield self.report(at, message, severity=Severity.WARNING)

    def _check_period(
        self, file: RclpyFile, given: ast.expr, words: frozenset[str], number: float | None
    ) -> Iterator[Diagnostic]:
        is_clear = not words.isdisjoint(_CLEAR)
        if (number is None and not is_clear) or _is_in_seconds(file, given):
            return
        if number is not None and (number <= 1 or (not is_clear and number < _MIN_RATE)):
            return
        rate = "a rate" if number is None else f"a rate of {number:g} Hz"
        happens = (
            "one call every that many seconds" if number is None else f"one call every {number:g} s"
        )
        message = f"{rate} is passed as the period: {happens}; write 1.0 / rate"
        severity = None if is_clear and number is not None else Severity.WARNING
        yield self.report(file.module.location(given), message, severity=severity)

    def _check_other_units(
        self, file: RclpyFile, call: ast.Call, name: str
    ) -> Iterator[Diagnostic]:
        """Check a rate, and a duration in nanoseconds."""
        if name == "Duration":
            given = argument_of(call, "nanoseconds")
            value = file.evaluator.evaluate(given) if given is not None else None
            if given is not None and isinstance(value, int | float) and 1 < value < _FEWEST:
                message = f"{value:g} ns are no time at all; write seconds={value:g}"
                yield self.report(file.module.location(given), message)
            return
        given = argument_of(call, "frequency", 0)
        if given is not None and _words(file, given) & _PERIODS:
            message = "a period is passed as the rate; write 1.0 / period"
            yield self.report(file.module.location(given), message)


_MIN_RATE = 1.5
"""The minimum value of a rate; lower ones may be seconds."""


def _is_of_thousand(file: RclpyFile, given: ast.expr) -> bool:
    """Return whether 1000 is divided by a value that is not of that magnitude."""
    match given:
        case ast.BinOp(left=left, op=ast.Div(), right=right):
            divisor = file.evaluator.evaluate(right)
            is_large = isinstance(divisor, int | float) and divisor >= _THOUSAND
            return file.evaluator.evaluate(left) == _THOUSAND and not is_large
    return False


_THOUSAND = 1000


def _is_in_seconds(file: RclpyFile, given: ast.expr) -> bool:
    """Return whether the file mentions anywhere that the value is in seconds."""
    name = last_name(given)
    pattern = rf"\b{re.escape(name)}\b[^\n]*(?:(?<!per )\bsec|\}} ?s\b)"
    return bool(name) and re.search(pattern, file.module.source.text) is not None


def _is_milliseconds(number: float) -> bool:
    """Return whether a number is typical for milliseconds, not for minutes."""
    return number >= _LONG and number % 10 == 0 and number % 60 != 0


def _seconds(file: RclpyFile, call: ast.Call, name: str) -> ast.expr | None:
    """Return the argument in seconds of a function."""
    place, word = _SECONDS[name]
    if name == "sleep" and file.module.qualified_name(call.func) != "time.sleep":
        return None
    if name == "Duration" and file.module.qualified_name(call.func) != "rclpy.duration.Duration":
        return None
    return argument_of(call, word, place)


def _words(file: RclpyFile, node: ast.expr) -> frozenset[str]:
    """Return the words in the names of a value, up to the computation."""
    words: set[str] = set()
    for _ in range(10):
        match node:
            case ast.Name(id=name) | ast.Attribute(attr=name) if name != "value":
                words.update(re.split(r"[_\d]+", re.sub(r"([a-z])([A-Z])", r"\1_\2", name).lower()))
            case ast.Attribute(value=ast.Call() as call):
                node = call
                continue
            case ast.Call(func=ast.Name(id="float" | "int"), args=[inner]):
                node = inner
                continue
            case ast.Call(func=ast.Attribute(attr=method, value=inner), args=args):
                if method == "get_parameter_value":
                    node = inner
                    continue
                text = file.evaluator.text(args[0]) if args else ""
                if method in {"get_parameter", "declare_parameter"} and isinstance(text, str):
                    words.update(re.split(r"[^a-z]+", text.lower()))
                return frozenset(words)
            case ast.BinOp() | ast.IfExp() | ast.BoolOp():
                return frozenset()
            case _:
                return frozenset(words)
        value = file.evaluator.single_value(node)
        if value is node:
            return frozenset(words)
        node = value
    return frozenset(words)
