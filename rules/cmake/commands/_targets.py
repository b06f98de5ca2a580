"""The targets of a CMakeLists.txt."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import takewhile
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from scaffold.api.cmake import Argument, CMakeLists, Command


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
"""Commands whose first argument is the name of a new target."""
TAKING_TARGETS = (
    "ament_target_dependencies",
    "target_link_libraries",
    "target_include_directories",
)
"""Commands whose first argument is an existing target."""


def defined_targets(cmake: CMakeLists) -> set[str] | None:
    """Return the defined targets; ``None`` if the name of one is unknown."""
    defined: set[str] = set()
    for command in cmake.commands:
        if command.name in DEFINING and command.arguments:
            name = cmake.expand(command.arguments[0], command)
            if name is None:
                return None
            defined.add(name)
    return defined


def targets_named_once(cmake: CMakeLists) -> list[tuple[str, Argument]]:
    """Return the arguments with targets that are only used once."""
    used: list[tuple[str, Argument]] = []
    named: set[str] = set()
    for command in cmake.commands:
        taken: list[Argument] = []
        if command.name in TAKING_TARGETS:
            taken = command.arguments[:1]
        elif command.name == "install" and command.values[:1] == ["TARGETS"]:
            taken = _targets(command)
        named.update(_words(cmake, command, taken))
        if not command.blocks:
            used += [(cmake.expand(item, command) or "", item) for item in taken]
    return [
        (name, argument)
        for name, argument in used
        # Those of interfaces, such as my_msgs__rosidl_typesupport_cpp, are defined by one command.
        if name and name not in named and "__" not in name and not set("$:<;") & set(name)
    ]


def _targets(command: Command) -> list[Argument]:
    """Return the targets of ``install(TARGETS ...)``."""
    taken = takewhile(lambda item: not item.value.isupper(), command.arguments[1:])
    return list(taken)


def _words(cmake: CMakeLists, command: Command, taken: list[Argument]) -> Iterator[str]:
    """Yield the words of a command other than its targets, which may be parts of target names."""
    for argument in command.arguments:
        if argument not in taken:
            value = cmake.expand(argument, command) or argument.value
            yield value
            yield from value.split(";")
