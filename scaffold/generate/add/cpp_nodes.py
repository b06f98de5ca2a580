"""Finds the C++ nodes of a package: CMake executables that use rclcpp."""

from __future__ import annotations

import re
from collections.abc import Mapping

from scaffold.model.package import Package

_MADE = ("add_executable", "ament_auto_add_executable")
_LINKED = ("ament_target_dependencies", "target_link_libraries")
_COMPONENT = "rclcpp_components_register_node"
_RCLCPP = r"rclcpp(_lifecycle|_components)?(::|$)"


def executables(package: Package) -> Mapping[str, bool]:
    """Return the executables of an ament_cmake package, and whether each uses rclcpp."""
    if package.build_type != "ament_cmake":
        return {}
    using = _using(package)
    result: dict[str, bool] = {}
    for command in package.cmake.find(*_MADE):
        name = next(iter(package.cmake.expand_list(command.arguments[:1], command) or ()), "")
        result[name] = name in using
    for command in package.cmake.find(_COMPONENT):
        words = command.keyword("EXECUTABLE", {"PLUGIN", "EXECUTOR"})
        result |= dict.fromkeys(package.cmake.expand_list(words, command) or (), True)
    return result


def _using(package: Package) -> set[str]:
    """Return the targets that use rclcpp, directly or through the libraries they link to."""
    cmake = package.cmake
    linked: dict[str, set[str]] = {}
    for command in cmake.find(*_LINKED):
        target, *names = cmake.expand_list(command.arguments, command) or [""]
        linked.setdefault(target, set()).update(names)
    if "rclcpp" in package.manifest.names_for("build"):
        for command in cmake.find("ament_auto_add_executable"):
            target = next(iter(cmake.expand_list(command.arguments[:1], command) or ()), "")
            linked.setdefault(target, set()).add("rclcpp")
    result: set[str] = set()
    while True:
        more = {
            target
            for target, names in linked.items()
            if any(name in result or re.match(_RCLCPP, name) for name in names)
        }
        if more == result:
            return result
        result = more
