"""CM023: packages to find are spelled correctly."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Effect, Example, Fix, Location, Package, Report, Rule
from scaffold.api.catalog import similar_package
from scaffold.api.cmake import Argument

_LISTS = "project(talker)\nfind_package({} REQUIRED)\n"


class FindMisspelled(Rule):
    """``find_package`` looks for a package whose name is misspelled.

    **Why.** CMake stops: ``By not providing "Findstd_msg.cmake"``; after
    ``ament_export_dependencies``, in every package that finds this one.

    **Fix.** Write the name as the package spells it.

    **Source.** CMake documentation, ``find_package``.
    """

    code = "CM023"
    name = "find-misspelled"
    effect = Effect.STOPS_BUILD
    examples = (
        Example("right", {"CMakeLists.txt": _LISTS.format("std_msgs")}),
        Example(
            "a letter is missing",
            {"CMakeLists.txt": _LISTS.format("std_msg")},
            Report(
                "2:14", "no package 'std_msg' is known; closest: 'std_msgs'", fix="write std_msgs"
            ),
            fixed={"CMakeLists.txt": _LISTS.format("std_msgs")},
        ),
        Example(
            "in what others find because of this package",
            {
                "CMakeLists.txt": _LISTS.format("std_msgs")
                + "ament_export_dependencies(std_msgs std_msg)\n"
            },
            Report(
                "3:36", "no package 'std_msg' is known; closest: 'std_msgs'", fix="write std_msgs"
            ),
            fixed={
                "CMakeLists.txt": _LISTS.format("std_msgs")
                + "ament_export_dependencies(std_msgs std_msgs)\n"
            },
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for item in package.cmake.found_packages:
            yield from self._judge(package, item.name, item.command.arguments[0], item.location)
        found_names = {found_package.name for found_package in package.cmake.found_packages}
        for command in package.cmake.find("ament_export_dependencies"):
            for argument in command.arguments:
                name = argument.value
                if name not in found_names and "$" not in name:
                    yield from self._judge(package, name, argument, argument.location)

    def _judge(
        self, package: Package, name: str, argument: Argument, at: Location
    ) -> Iterator[Diagnostic]:
        closest = similar_package(name)
        if closest is None or (closest == name.lower() and not _is_of_ros(closest)):
            return
        if package.workspace.get(name) is not None:
            return
        fix = None
        if argument.value == name:
            edit = Edit("CMakeLists.txt", argument.start, argument.end, closest)
            fix = Fix(f"write {closest}", (edit,))
        yield self.report(at, f"no package {name!r} is known; closest: {closest!r}", fix)


def _is_of_ros(name: str) -> bool:
    """Tell a package of ROS from a library, which may well have capitals in CMake."""
    return name.startswith(("ament_", "rcl", "rosidl_")) or name.endswith(("_msgs", "_srvs"))
