"""PX014: one build type is active."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.manifest import ConditionError, holds

_MANIFEST = (
    '<package format="3">\n  <export>\n    <build_type>ament_cmake</build_type>\n'
    "    <build_type{}>ament_python</build_type>\n  </export>\n</package>\n"
)


class BuildTypeRepeated(Rule):
    """More than one ``<build_type>`` is active.

    **Why.** colcon warns ``more than one build type`` and ignores the package.

    **Fix.** Keep one, or tell them apart with ``condition``.

    **Source.** REP-149, ``<build_type>``; ``colcon_ros/package_identification/ros.py``.
    """

    code = "PX014"
    name = "build-type-repeated"
    examples = (
        Example(
            "one for ROS 1", {"package.xml": _MANIFEST.format(' condition="$ROS_VERSION == 1"')}
        ),
        Example(
            "two",
            {"package.xml": _MANIFEST.format("")},
            Report(
                "4:5", "a second build type, after the one in line 3: colcon ignores the package"
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        active = []
        for element in package.manifest.build_type_elements:
            condition = element.get("condition")
            try:
                if condition is None or holds(condition):
                    active.append(element)
            except ConditionError:
                return
        for element in active[1:]:
            line = active[0].location.line
            message = (
                f"a second build type, after the one in line {line}: colcon ignores the package"
            )
            yield self.report(element, message)
