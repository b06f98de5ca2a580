"""LY002: no package lies inside another one."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule, Severity, ViewError
from scaffold.api.cmake import installs_directory

_COPIES = frozenset({"third_party", "thirdparty", "3rdparty", "external", "vendor"})
"""Directories of code of others."""


class NestedPackage(Rule):
    """A package is inside another package.

    **Why.** colcon does not search inside packages: the inner one is silently never built.

    **Fix.** Move the inner package next to the outer one, below ``src/``.

    **Source.** ROS 2 documentation, "Creating a package": "You can also not have nested packages".
    """

    code = "LY002"
    name = "nested-package"
    severity = Severity.WARNING
    examples = (
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
            "a package of messages inside the package that uses them",
            {"package.xml": "<package/>\n", "robot_msgs/package.xml": "<package/>\n"},
            "robot_msgs/package.xml:1:1: is inside the package 'the package above it': colcon "
            "never builds it",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        outer = package.name or "the package above it"
        for directory in package.tree.nested:
            if _is_built(package, directory):
                continue
            at = package.start_of(f"{directory}/package.xml")
            yield self.report(at, f"is inside the package {outer!r}: colcon never builds it")


def _is_built(package: Package, directory: str) -> bool:
    """Tell whether the outer package builds or installs a directory, or it is a copy."""
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
