"""CM093: every command is known."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import get_close_matches

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.cmake import BUILT_IN, OF_AMENT, uses_ament

_OF_ROS1 = {
    "add_action_files": "rosidl_generate_interfaces",
    "add_message_files": "rosidl_generate_interfaces",
    "add_rostest": "add_launch_test",
    "add_service_files": "rosidl_generate_interfaces",
    "catkin_add_gtest": "ament_add_gtest",
    "catkin_add_nosetests": "ament_add_pytest_test",
    "catkin_install_python": "install(PROGRAMS ... DESTINATION lib/${PROJECT_NAME})",
    "catkin_metapackage": "ament_package",
    "catkin_package": "ament_package",
    "catkin_python_setup": "ament_python_install_package",
    "generate_messages": "rosidl_generate_interfaces",
    "roslaunch_add_file_check": "add_launch_test",
}
_MOST = 3
"""Letters more or less that are no slip any more."""
_LISTS = "project(talker)\nfind_package(ament_cmake REQUIRED)\n{}()\n"


class CommandMisspelt(Rule):
    """A command is called that neither CMake nor ament has.

    **Why.** CMake stops: ``Unknown CMake command "ament_pakage"``.

    **Fix.** Write the name of the command; those of catkin have successors in ament.

    **Source.** CMake documentation, "cmake-commands"; ``ament_cmake``; ROS 2 documentation,
    "Migrating from ROS 1".
    """

    code = "CM093"
    name = "command-misspelt"
    examples = (
        Example("known", {"CMakeLists.txt": _LISTS.format("ament_package")}),
        Example(
            "misspelt",
            {"CMakeLists.txt": _LISTS.format("ament_pakage")},
            Report(
                "CMakeLists.txt:3:1",
                "CMake knows no command ament_pakage(); closest: ament_package()",
            ),
        ),
        Example(
            "of catkin",
            {"CMakeLists.txt": _LISTS.format("catkin_package")},
            Report("CMakeLists.txt:3:1", "catkin_package() is of ROS 1; ament has ament_package"),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        own = {call.values[0].lower() for call in cmake.find("macro", "function") if call.values}
        if cmake.find("include") or not uses_ament(package):
            return
        for command in cmake.commands:
            name = command.name
            if name in BUILT_IN or name in OF_AMENT or name in own:
                continue
            meant = _OF_ROS1.get(name)
            if meant and command.parent is None:
                message = f"{name}() is of ROS 1; ament has {meant}"
                yield self.report(command.name_location, message)
            elif not meant:
                for one in _near(name):
                    message = f"CMake knows no command {name}(); closest: {one}()"
                    yield self.report(command.name_location, message)


def _near(name: str) -> list[str]:
    """Return the command that a name is a slip of, if there is one."""
    if any(character.isdigit() for character in name):
        return []
    words = sorted(name.split("_"))
    swapped = [one for one in OF_AMENT if sorted(one.split("_")) == words]
    near = get_close_matches(name, BUILT_IN | OF_AMENT, 1, 0.9)
    return swapped[:1] or [one for one in near if abs(len(one) - len(name)) < _MOST]
