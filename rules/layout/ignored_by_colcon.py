"""LY001: colcon builds the package."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule, Severity, ViewError
from scaffold.api.cmake import installs_directory

MARKERS = {
    "COLCON_IGNORE": "colcon",
    "AMENT_IGNORE": "colcon-ros and the ament tools",
    "CATKIN_IGNORE": "colcon-ros",
}
_COPIES = frozenset({"third_party", "thirdparty", "3rdparty", "external", "vendor"})
"""Directories of third-party code."""


class IgnoredByColcon(Rule):
    """A package is hidden from the build: by a marker file, or inside another package.

    **Why.** ``colcon build`` prints ``0 packages finished``, without an error; later, ``ros2 run``
    fails with ``Package not found``. colcon does not search inside packages.

    **Fix.** Delete the marker; move the inner package next to the outer one, in ``src/``. No
    automatic fix: both may be intentional.

    **Source.** colcon documentation, "Discovery arguments"; ``colcon_ros`` package identification;
    ROS 2 documentation, "Creating a package": "You can also not have nested packages".
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
            "markers of other tools",
            {"package.xml": "<package/>\n", "AMENT_IGNORE": "", "CATKIN_IGNORE": ""},
            "AMENT_IGNORE:1:1: AMENT_IGNORE hides the package from colcon-ros and the ament "
            "tools: it is never built",
            "CATKIN_IGNORE:1:1: CATKIN_IGNORE hides the package from colcon-ros: it is never built",
        ),
        Example("one package", {"package.xml": "<package/>\n", "msgs/readme.txt": ""}),
        Example(
            "a library that the outer package builds",
            {
                "package.xml": "<package/>\n",
                "CMakeLists.txt": "project(robot)\nadd_subdirectory(lib/karto)\n",
                "lib/karto/package.xml": "<package/>\n",
            },
        ),
        Example(
            "a template that the outer package installs",
            {
                "package.xml": "<package/>\n",
                "CMakeLists.txt": "project(robot)\n"
                "install(DIRECTORY templates DESTINATION share/robot)\n",
                "templates/talker/package.xml": "<package/>\n",
            },
        ),
        Example(
            "a message package inside the package that uses it",
            {"package.xml": "<package/>\n", "robot_msgs/package.xml": "<package/>\n"},
            "robot_msgs/package.xml:1:1: inside the package 'the parent directory': colcon never "
            "builds it; move it next to that package",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        outer = package.name or "the parent directory"
        for directory in package.tree.nested:
            if not _is_built(package, directory):
                at = package.start_of(f"{directory}/package.xml")
                yield self.report(
                    at,
                    f"inside the package {outer!r}: colcon never builds it; "
                    f"move it next to that package",
                )
        for marker, tool in MARKERS.items():
            if package.has(marker):
                at = package.start_of(marker)
                yield self.report(at, f"{marker} hides the package from {tool}: it is never built")


def _is_built(package: Package, directory: str) -> bool:
    """Return whether the outer package builds or installs a directory, or it is a copy."""
    if not _COPIES.isdisjoint(directory.split("/")):
        return True
    try:
        if installs_directory(package, directory):
            return True
        commands = package.cmake.find("add_subdirectory", "set", "include", "include_directories")
    except ViewError:
        return False
    values = {
        value.rpartition("}/")[2].strip("/") for command in commands for value in command.values
    }
    return any(f"{directory}/".startswith(f"{value}/") for value in values - {"", "."})
