"""PX015: conditions can be evaluated."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.manifest import ConditionError, holds

_MANIFEST = '<package format="3">\n  <depend condition="{}">rclpy</depend>\n</package>\n'


class ConditionMalformed(Rule):
    """A ``condition`` does not follow the grammar.

    **Why.** catkin_pkg, and with it colcon, refuses the manifest.

    **Fix.** Write ``$VARIABLE == value``, with ``and``, ``or`` and parentheses.

    **Source.** REP-149, "condition"; ``catkin_pkg/condition.py``.
    """

    code = "PX015"
    name = "condition-malformed"
    examples = (
        Example("a comparison", {"package.xml": _MANIFEST.format("$ROS_DISTRO == jazzy")}),
        Example(
            "one sign",
            {"package.xml": _MANIFEST.format("$ROS_VERSION = 2")},
            Report("2:22", "condition '$ROS_VERSION = 2': '=' is not expected"),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        manifest = package.manifest
        for element in [*manifest.root.children, *manifest.exports]:
            condition = element.get("condition")
            if condition is None:
                continue
            try:
                holds(condition)
            except ConditionError as error:
                at = element.attributes["condition"]
                yield self.report(at, f"condition {condition!r}: {error.message}")
