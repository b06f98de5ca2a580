"""PX015: conditions can be evaluated."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity
from scaffold.api.manifest import ConditionError, holds, misspelled

_MANIFEST = '<package format="3">\n  <depend condition="{}">rclpy</depend>\n</package>\n'


class ConditionMalformed(Rule):
    """A ``condition`` does not follow the grammar, or asks for a name that is misspelled.

    **Why.** catkin_pkg, and with it colcon, refuses the manifest. A comparison with a name that no
    distribution has is never true: the dependency is missing, without a message.

    **Fix.** Write ``$VARIABLE == value``, with ``and``, ``or`` and parentheses.

    **Source.** REP-149, "condition"; ``catkin_pkg/condition.py``.
    """

    code = "PX015"
    name = "condition-malformed"
    other_severities = {Severity.WARNING: "a name that is misspelled"}
    examples = (
        Example("a comparison", {"package.xml": _MANIFEST.format("$ROS_DISTRO == jazzy")}),
        Example(
            "one sign",
            {"package.xml": _MANIFEST.format("$ROS_VERSION = 2")},
            Report("2:22", "condition '$ROS_VERSION = 2': '=' is not expected"),
        ),
        Example(
            "a distribution that ended, a variable of whoever builds",
            {"package.xml": _MANIFEST.format("$ROS_DISTRO == foxy or $WITH_ROBOT == 1")},
        ),
        Example(
            "a name misspelled",
            {"package.xml": _MANIFEST.format("$ROS_DISTRO == lyrcal")},
            Report(
                "2:22",
                "condition '$ROS_DISTRO == lyrcal': nothing is called 'lyrcal'; "
                "did you mean 'lyrical'?",
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
            for name, known in misspelled(condition):
                message = (
                    f"condition {condition!r}: nothing is called {name!r}; did you mean {known!r}?"
                )
                yield self.report(at, message, severity=Severity.WARNING)
