"""CM023: packages to find are spelt right."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Rule
from scaffold.model.known import similar_package

_LISTS = "project(talker)\nfind_package({} REQUIRED)\n"


class FindMisspelt(Rule):
    """``find_package`` looks for a name that is a well-known package with a letter wrong.

    **Why.** CMake stops: ``By not providing "Findstd_msg.cmake"``.

    **Fix.** Write the name as the package spells it.

    **Source.** CMake documentation, ``find_package``.
    """

    code = "CM023"
    name = "find-misspelt"
    examples = (
        Example("right", {"CMakeLists.txt": _LISTS.format("std_msgs")}),
        Example(
            "a letter is missing",
            {"CMakeLists.txt": _LISTS.format("std_msg")},
            at=("CMakeLists.txt:2",),
            fixed={"CMakeLists.txt": _LISTS.format("std_msgs")},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for found in package.cmake.found_packages:
            meant = similar_package(found.name)
            if meant is None or (meant == found.name.lower() and not _is_of_ros(meant)):
                continue
            if package.workspace.get(found.name) is not None:
                continue
            argument = found.command.arguments[0]
            fix = None
            if argument.value == found.name:
                edit = Edit("CMakeLists.txt", argument.start, argument.end, meant)
                fix = Fix(f"write {meant}", (edit,))
            message = f"no package {found.name!r} is known; {meant!r} is meant"
            yield self.report(found, message, fix)


def _is_of_ros(name: str) -> bool:
    """Tell a package of ROS from a library, which may well have capitals in CMake."""
    return name.startswith(("ament_", "rcl", "rosidl_")) or name.endswith(("_msgs", "_srvs"))
