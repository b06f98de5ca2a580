"""CM031: commands are given targets that exist."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule
from scaffold.model.cmake_facts import has_unknown_commands
from scaffold.model.near import nearest

DEFINING = (
    "add_executable",
    "add_library",
    "add_custom_target",
    "ament_add_gtest",
    "ament_add_gmock",
    "ament_add_gtest_executable",
    "ament_auto_add_executable",
    "ament_auto_add_library",
    "ament_add_google_benchmark",
    "ament_auto_add_gtest",
    "rosidl_generate_interfaces",
    "generate_parameter_library",
    "pybind11_add_module",
    "qt5_add_executable",
)
USING = ("ament_target_dependencies", "target_link_libraries", "target_include_directories")
_LISTS = (
    "project(talker)\nadd_executable(talk src/talk.cpp)\nament_target_dependencies({} rclcpp)\n"
)


class TargetUndefined(Rule):
    """A command is given a target that nothing defines.

    **Why.** CMake stops: the first argument must be a valid target name.

    **Fix.** Write the name of the target.

    **Source.** ``ament_cmake_target_dependencies/cmake/ament_target_dependencies.cmake``.
    """

    code = "CM031"
    name = "target-undefined"
    examples = (
        Example("defined", {"CMakeLists.txt": _LISTS.format("talk")}),
        Example(
            "not defined", {"CMakeLists.txt": _LISTS.format("talks")}, at=("CMakeLists.txt:3",)
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        if has_unknown_commands(package) or cmake.find("function", "macro", "foreach"):
            return
        defined: set[str] = set()
        for command in cmake.commands:
            if command.name not in DEFINING or not command.arguments:
                continue
            name = cmake.expand(command.arguments[0], command)
            if name is None:
                return
            defined.add(name)
        known = sorted(defined)
        for command in cmake.find(*USING):
            name = cmake.expand(command.arguments[0], command) if command.arguments else None
            if name is None or name in defined or "::" in name or command.blocks:
                continue
            near = nearest(package, name, known, 0.75)
            if near:
                message = f"nothing defines the target {name!r}; {near!r} is near"
                yield self.report(command.arguments[0], message)
