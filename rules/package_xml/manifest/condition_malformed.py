"""PX015: conditions are valid and depend on the distribution."""

from __future__ import annotations

import re
from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Location, Package, Report, Rule, Severity
from scaffold.api.manifest import (
    ConditionError,
    Constant,
    constants,
    holds,
    is_never_true,
    misspelled,
)

_ALWAYS = {True: "always", False: "never"}
_MANIFEST = '<package format="3">\n  <depend condition="{}">rclpy</depend>\n</package>\n'


class ConditionMalformed(Rule):
    """A ``condition`` is not valid, or has the same value for all distributions.

    **Why.** catkin_pkg, and therefore colcon, rejects package.xml. A comparison with an unknown
    distribution, or of a variable without its ``$``, is never true: the dependency is not
    installed, without an error.

    **Fix.** Write ``$VARIABLE == value``, with ``and``, ``or`` and parentheses.

    **Source.** REP 149, "condition"; ``catkin_pkg/condition.py``.
    """

    code = "PX015"
    name = "condition-malformed"
    other_severities = {
        Severity.WARNING: "it contains a misspelled name, or is never or always true"
    }
    examples = (
        Example("a comparison", {"package.xml": _MANIFEST.format("$ROS_DISTRO == jazzy")}),
        Example(
            "a single equals sign",
            {"package.xml": _MANIFEST.format("$ROS_VERSION = 2")},
            "2:22: condition '$ROS_VERSION = 2': '=' is not expected",
        ),
        Example(
            "a distribution at its end of life, a custom variable",
            {"package.xml": _MANIFEST.format("$ROS_DISTRO == foxy or $WITH_ROBOT == 1")},
        ),
        Example(
            "a custom variable that ends like one of ROS",
            {"package.xml": _MANIFEST.format("$GZ_VERSION == '' or $GZ_VERSION == harmonic")},
        ),
        Example(
            "a misspelled name",
            {"package.xml": _MANIFEST.format("$ROS_DISTRO == lyrcal")},
            Report(
                "2:22",
                "condition '$ROS_DISTRO == lyrcal': unknown name 'lyrcal': never true; "
                "did you mean 'lyrical'?",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "true on some distributions, possibly on a later one, or with a custom variable",
            {
                "package.xml": _MANIFEST.format(
                    '$ROS_VERSION == 1 and $ROS_DISTRO == noetic">roscpp</depend>\n'
                    '  <depend condition="$ROS_VERSION == 2 and $ROS_DISTRO == mystic">a</depend>\n'
                    '  <depend condition="$ROS_VERSION == 3 or $ROS_NEXT == 1'
                )
            },
        ),
        Example(
            "a variable without $",
            {"package.xml": _MANIFEST.format("$ROS_VERSION == 2 and ROS_DISTRO == jazzy")},
            Report(
                "2:22",
                "condition '$ROS_VERSION == 2 and ROS_DISTRO == jazzy': 'ROS_DISTRO == "
                "jazzy' compares two strings and is never true; write $ROS_DISTRO",
                fix="Replace with $ROS_DISTRO",
                severity=Severity.WARNING,
            ),
            fixed={"package.xml": _MANIFEST.format("$ROS_VERSION == 2 and $ROS_DISTRO == jazzy")},
        ),
        Example(
            "two strings",
            {"package.xml": _MANIFEST.format("noetic != humble")},
            Report(
                "2:22",
                "condition 'noetic != humble': compares two strings and is always true",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "two distributions at once",
            {"package.xml": _MANIFEST.format("$ROS_DISTRO == jazzy and $ROS_DISTRO == kilted")},
            Report(
                "2:22",
                "condition '$ROS_DISTRO == jazzy and $ROS_DISTRO == kilted': true "
                "on no distribution: <depend> has no effect; did you mean 'or'?",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "a value that is not a version",
            {"package.xml": _MANIFEST.format("$ROS_VERSION == 3")},
            Report(
                "2:22",
                "condition '$ROS_VERSION == 3': true on no distribution: <depend> has no effect",
                severity=Severity.WARNING,
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        manifest = package.manifest
        for element in [*manifest.root.children, *manifest.exports]:
            condition = element.get("condition")
            if condition is None:
                continue
            at = element.attributes["condition"]
            try:
                holds(condition)
            except ConditionError as error:
                yield self.report(at, f"condition {condition!r}: {error.message}")
                continue
            yield from self._misleading(package, element.tag, condition, at.location)

    def _misleading(
        self, package: Package, tag: str, condition: str, at: Location
    ) -> Iterator[Diagnostic]:
        """Report a condition that is constant or refers to unknown values."""
        reported = [
            (_words(constant, condition), _with_sign(package, at, condition, constant))
            for constant in constants(condition)
        ]
        reported += [
            (f"unknown name {name!r}: never true; did you mean {suggestion!r}?", None)
            for name, suggestion in misspelled(condition)
        ]
        if not reported and is_never_true(condition):
            either = re.sub(r"\band\b", "or", condition)
            hint = "" if is_never_true(either) else "; did you mean 'or'?"
            reported = [(f"true on no distribution: <{tag}> has no effect{hint}", None)]
        for problem, fix in reported:
            message = f"condition {condition!r}: {problem}"
            yield self.report(at, message, fix, severity=Severity.WARNING)


def _words(constant: Constant, condition: str) -> str:
    which = f"{constant.text!r} " if constant.text != condition else ""
    hint = f"; write ${constant.variable}" if constant.variable else ""
    return f"{which}compares two strings and is {_ALWAYS[constant.value]} true{hint}"


def _with_sign(package: Package, at: Location, condition: str, constant: Constant) -> Fix | None:
    """Return the fix that turns a text into a variable, if it contains no references."""
    source = package.source(at.path)
    start = source.offset(at.line, at.column)
    if not constant.variable or not source.text.startswith(condition, start):
        return None
    place = start + constant.offset
    return Fix(f"Replace with ${constant.variable}", (Edit(at.path, place, place, "$"),))
