"""LY001: colcon builds the package."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule, Severity

MARKERS = {
    "COLCON_IGNORE": "colcon",
    "AMENT_IGNORE": "colcon-ros and the ament tools",
    "CATKIN_IGNORE": "colcon-ros",
}


class IgnoredByColcon(Rule):
    """A marker file hides the package from the build.

    **Why.** ``colcon build`` says ``0 packages finished`` and nothing else; later ``ros2 run``
    answers ``Package not found``.

    **Fix.** Delete the marker. No automatic fix: it may be there on purpose.

    **Source.** colcon documentation, "Discovery arguments"; ``colcon_ros`` package identification.
    """

    code = "LY001"
    name = "ignored-by-colcon"
    severity = Severity.WARNING
    examples = (
        Example("a visible package", {"package.xml": "<package/>\n"}),
        Example(
            "a marker left over from an experiment",
            {"package.xml": "<package/>\n", "COLCON_IGNORE": ""},
            "COLCON_IGNORE:1:1: COLCON_IGNORE hides the package from colcon: it is never built",
        ),
        Example(
            "the markers of other tools",
            {"package.xml": "<package/>\n", "AMENT_IGNORE": "", "CATKIN_IGNORE": ""},
            "AMENT_IGNORE:1:1: AMENT_IGNORE hides the package from colcon-ros and the ament "
            "tools: it is never built",
            "CATKIN_IGNORE:1:1: CATKIN_IGNORE hides the package from colcon-ros: it is never built",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for marker, tool in MARKERS.items():
            if package.has(marker):
                at = package.start_of(marker)
                yield self.report(at, f"{marker} hides the package from {tool}: it is never built")
