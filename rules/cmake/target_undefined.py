"""CM031: commands are given targets that exist."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import takewhile

from scaffold.api import Diagnostic, Example, Package, Rule
from scaffold.model.cmake import Argument, CMakeLists, Command
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
        Example(
            "Python scripts are no targets",
            {
                "CMakeLists.txt": "project(talker)\n"
                "install(TARGETS talk listen DESTINATION lib/${PROJECT_NAME})\n",
                "talker/talk.py": "",
            },
            at=("CMakeLists.txt:2", "CMakeLists.txt:2"),
        ),
        Example(
            "of a command that nobody here knows",
            {
                "CMakeLists.txt": "project(talker)\nfind_package(maker REQUIRED)\n"
                "make_some(talk)\ninstall(TARGETS talk DESTINATION lib/${PROJECT_NAME})\n"
            },
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
        never_named = _never_named(cmake)
        for name, argument in never_named:
            near = nearest(package, name, known, 0.75)
            hint = f"; {near!r} is near" if near else ": CMake stops"
            yield self.report(argument, f"nothing defines the target {name!r}{hint}")
        told = {name for name, _ in never_named}
        for command in cmake.find(*USING):
            name = cmake.expand(command.arguments[0], command) if command.arguments else None
            if name is None or name in defined | told or "::" in name or command.blocks:
                continue
            near = nearest(package, name, known, 0.75)
            if near:
                message = f"nothing defines the target {name!r}; {near!r} is near"
                yield self.report(command.arguments[0], message)


def _never_named(cmake: CMakeLists) -> list[tuple[str, Argument]]:
    """Return targets, and where, that only the commands name that take one."""
    used: list[tuple[str, Argument]] = []
    named: set[str] = set()
    for command in cmake.commands:
        taken: list[Argument] = []
        if command.name in USING:
            taken = command.arguments[:1]
        elif command.name == "install" and command.values[:1] == ["TARGETS"]:
            taken = _targets(command)
        named.update(_words(cmake, command, taken))
        if not command.blocks:
            used += [(cmake.expand(one, command) or "", one) for one in taken]
    return [
        (name, argument)
        for name, argument in used
        # Those of interfaces, such as my_msgs__rosidl_typesupport_cpp, are made by one command.
        if name and name not in named and "__" not in name and not set("$:<;") & set(name)
    ]


def _targets(command: Command) -> list[Argument]:
    """Return the targets that ``install(TARGETS ...)`` begins with."""
    taken = takewhile(lambda one: not one.value.isupper(), command.arguments[1:])
    return list(taken)


def _words(cmake: CMakeLists, command: Command, taken: list[Argument]) -> Iterator[str]:
    """Yield what a command names beside the targets that it takes: they may be made of it."""
    for argument in command.arguments:
        if argument not in taken:
            value = cmake.expand(argument, command) or argument.value
            yield value
            yield from value.split(";")
