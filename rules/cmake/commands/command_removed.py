"""CM110: the distribution has the commands that CMakeLists.txt calls."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product

from scaffold.api import (
    Diagnostic,
    Edit,
    Effect,
    Example,
    Fix,
    Package,
    Report,
    Rule,
    Safety,
    Severity,
)
from scaffold.api.cmake import Argument, CMakeLists, Command, nested
from scaffold.api.distributions import of_kind

_LISTS = (
    "find_package(rclcpp REQUIRED)\nfind_package(std_msgs REQUIRED)\n"
    "add_executable(talker talker.cpp)\n{}\n"
)
_NAMED = (
    "set(DEPENDS rclcpp std_msgs)\nfind_package(rclcpp REQUIRED)\nfind_package(std_msgs REQUIRED)\n"
    "add_executable(talker talker.cpp)\n{}\n"
)
_MESSAGES = ("geometry", "nav", "sensor", "shape", "std", "trajectory", "visualization")
_MANY = (
    f"set(DEPENDS {' '.join(f'{name}_msgs' for name in _MESSAGES)})\n"
    "add_executable(talker talker.cpp)\nif(TRUE)\n{}\nendif()\n"
)
_OLD = "ament_target_dependencies"
_COMMENTED = f"{_OLD}(talker PUBLIC\n  rclcpp  # the node\n  std_msgs)"
_KEYWORDS = frozenset({"PUBLIC", "INTERFACE"})
_EXPORTING = frozenset(
    {"rclcpp", "rclcpp_action", "rclcpp_components", "rclcpp_lifecycle", "rcutils", "rcpputils"}
    | {"tf2", "tf2_ros", "tf2_geometry_msgs", "tf2_eigen", "tf2_kdl", "tf2_bullet"}
    | {"message_filters", "image_transport", "image_geometry", "cv_bridge", "interactive_markers"}
    | {"pluginlib", "class_loader", "ament_index_cpp", "diagnostic_updater"}
    | {"rosbag2_cpp", "rosbag2_storage", "rosbag2_transport", "rosbag2_compression"}
    | {"controller_interface", "controller_manager", "hardware_interface", "joint_limits"}
    | {"transmission_interface", "ros2_control_test_assets", "realtime_tools"}
    | {"angles", "geometric_shapes", "kdl_parser", "laser_geometry", "resource_retriever", "urdf"}
    | {"rviz_common", "rviz_default_plugins", "rviz_rendering"}
)
"""Packages that export targets on every distribution."""
_LINKED = {
    "Boost": "${Boost_LIBRARIES}",
    "Eigen3": "Eigen3::Eigen",
    "OpenCV": "${OpenCV_LIBS}",
    "console_bridge": "console_bridge::console_bridge",
}
"""The targets of non-ROS packages that exist on every distribution."""
_WIDTH = 100
"""The maximum width in characters; longer calls get one target per line."""
_LATER = frozenset({"tf2_sensor_msgs"})
"""Packages that look like interfaces but do not export targets on Humble."""


class CommandRemoved(Rule):
    """CMakeLists.txt calls an ament command that the distribution has removed.

    **Why.** CMake stops: ``Unknown CMake command "ament_target_dependencies"``. If the command is
    only deprecated, it warns.

    **Fix.** ``target_link_libraries`` with the targets that packages export, which exists on all
    distributions: ``${std_msgs_TARGETS}``. The fix is safe where all of the packages are known to
    export targets.

    **Source.** ament_cmake pull requests 572 and 614; the template of ``ros2 pkg create``.
    """

    code = "CM110"
    name = "command-removed"
    effect = Effect.STOPS_BUILD
    is_fixed_for_all = True
    is_deprecation = True
    other_severities = {Severity.INFO: "the distribution still has it, but warns"}
    examples = (
        Example(
            "a command that still exists",
            {"CMakeLists.txt": _LISTS.format(f"{_OLD}(talker rclcpp std_msgs)")},
        ),
        Example(
            "in a separate directory",
            {
                "CMakeLists.txt": "project(talker)\nadd_subdirectory(src)\n",
                "src/CMakeLists.txt": f"{_OLD}(talker rclcpp)\n",
                "example/CMakeLists.txt": f"{_OLD}(talker rclcpp)\n",
            },
            Report(
                "src/CMakeLists.txt:1:1",
                "ament_target_dependencies was removed in Lyrical: CMake stops; "
                "use target_link_libraries (ament_cmake 572, 614)",
                fix="Replace ament_target_dependencies with target_link_libraries",
            ),
            fixed={"src/CMakeLists.txt": "target_link_libraries(talker ${rclcpp_TARGETS})\n"},
            distro="lyrical",
        ),
        Example(
            "in included files, also from the module path",
            {
                "CMakeLists.txt": "project(talker)\n"
                "list(APPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_SOURCE_DIR}/cmake)\n"
                "include(cmake/Talk.cmake)\ninclude(Listen)\ninclude(CTest)\n",
                "cmake/Talk.cmake": f"{_OLD}(talker rclcpp)\n"
                "include(${CMAKE_CURRENT_LIST_DIR}/Link.cmake OPTIONAL)\n",
                "cmake/Listen.cmake": f"{_OLD}(listener rclcpp)\n",
                "cmake/Link.cmake": f"{_OLD}(linker rclcpp)\n",
                "cmake/Other.cmake": f"{_OLD}(other rclcpp)\n",
            },
            Report(
                "cmake/Link.cmake:1:1",
                "ament_target_dependencies was removed in Lyrical: CMake stops; use "
                "target_link_libraries (ament_cmake 572, 614)",
                fix="Replace ament_target_dependencies with target_link_libraries",
            ),
            Report(
                "cmake/Listen.cmake:1:1",
                "ament_target_dependencies was removed in Lyrical: CMake stops; use "
                "target_link_libraries (ament_cmake 572, 614)",
                fix="Replace ament_target_dependencies with target_link_libraries",
            ),
            Report(
                "cmake/Talk.cmake:1:1",
                "ament_target_dependencies was removed in Lyrical: CMake stops; use "
                "target_link_libraries (ament_cmake 572, 614)",
                fix="Replace ament_target_dependencies with target_link_libraries",
            ),
            fixed={
                "cmake/Talk.cmake": "target_link_libraries(talker ${rclcpp_TARGETS})\n"
                "include(${CMAKE_CURRENT_LIST_DIR}/Link.cmake OPTIONAL)\n",
                "cmake/Link.cmake": "target_link_libraries(linker ${rclcpp_TARGETS})\n",
                "cmake/Listen.cmake": "target_link_libraries(listener ${rclcpp_TARGETS})\n",
            },
            distro="lyrical",
        ),
        Example(
            "in a file that is included for an older distribution",
            {
                "CMakeLists.txt": "project(talker)\nif($ENV{ROS_DISTRO} STREQUAL jazzy)\n"
                "  include(cmake/old.cmake)\nendif()\nif(rclcpp_VERSION VERSION_LESS 29)\n"
                "  include(cmake/older.cmake)\nendif()\n",
                "cmake/old.cmake": f"{_OLD}(talker rclcpp)\n",
                "cmake/older.cmake": f"{_OLD}(talker rclcpp)\n",
            },
            distro="lyrical",
        ),
        Example(
            "a package that defines the command itself",
            {
                "CMakeLists.txt": f"include(cmake/old.cmake)\n{_OLD}(talker rclcpp)\n",
                "cmake/old.cmake": f"macro({_OLD} TARGET)\nendmacro()\n",
            },
            distro="lyrical",
        ),
        Example(
            "under a condition that tests for the command",
            {
                "CMakeLists.txt": _LISTS.format(
                    f"if(COMMAND {_OLD})\n  {_OLD}(talker rclcpp)\n"
                    "elseif(rclcpp_VERSION VERSION_LESS 29)\n"
                    f"  {_OLD}(talker rclcpp)\nendif()\n"
                    'string(REGEX MATCH "^[0-9]+" MAJOR_VERSION "${rclcpp_VERSION}")\n'
                    "if(MAJOR_VERSION GREATER_EQUAL 29)\nelse()\n"
                    f"  {_OLD}(talker rclcpp)\nendif()"
                )
            },
            distro="lyrical",
        ),
        Example(
            "a command that all distributions have",
            {"CMakeLists.txt": _LISTS.format("target_link_libraries(talker ${rclcpp_TARGETS})")},
            distro="lyrical",
        ),
        Example(
            "removed",
            {"CMakeLists.txt": _LISTS.format(_COMMENTED)},
            Report(
                "4:1",
                "ament_target_dependencies was removed in Lyrical: CMake stops; "
                "use target_link_libraries (ament_cmake 572, 614)",
                fix="Replace ament_target_dependencies with target_link_libraries",
            ),
            fixed={
                "CMakeLists.txt": _LISTS.format(
                    "target_link_libraries(talker PUBLIC\n"
                    "  ${rclcpp_TARGETS}  # the node\n  ${std_msgs_TARGETS})"
                )
            },
            distro="lyrical",
        ),
        Example(
            "a list of packages",
            {"CMakeLists.txt": _NAMED.format(f"{_OLD}(talker\n  ${{DEPENDS}}\n)")},
            Report(
                "5:1",
                "ament_target_dependencies was removed in Lyrical: CMake stops; use "
                "target_link_libraries (ament_cmake 572, 614)",
                fix="Replace ament_target_dependencies with target_link_libraries",
            ),
            fixed={
                "CMakeLists.txt": _NAMED.format(
                    "target_link_libraries(talker\n  ${rclcpp_TARGETS}\n  ${std_msgs_TARGETS}\n)"
                )
            },
            distro="lyrical",
        ),
        Example(
            "a list of packages on one line",
            {"CMakeLists.txt": _MANY.format(f"  {_OLD}(talker PUBLIC ${{DEPENDS}})")},
            Report(
                "4:3",
                "ament_target_dependencies was removed in Lyrical: CMake stops; use "
                "target_link_libraries (ament_cmake 572, 614)",
                fix="Replace ament_target_dependencies with target_link_libraries",
            ),
            fixed={
                "CMakeLists.txt": _MANY.format(
                    "  target_link_libraries(talker PUBLIC"
                    + "".join(f"\n    ${{{name}_msgs_TARGETS}}" for name in _MESSAGES)
                    + ")"
                )
            },
            distro="lyrical",
        ),
        Example(
            "non-ROS packages",
            {"CMakeLists.txt": _LISTS.format(f"{_OLD}(talker Eigen3 urdf Boost)")},
            Report(
                "4:1",
                "ament_target_dependencies was removed in Lyrical: CMake stops; use "
                "target_link_libraries (ament_cmake 572, 614)",
                fix="Replace ament_target_dependencies with target_link_libraries",
            ),
            fixed={
                "CMakeLists.txt": _LISTS.format(
                    "target_link_libraries(talker Eigen3::Eigen ${urdf_TARGETS} ${Boost_LIBRARIES})"
                )
            },
            distro="lyrical",
        ),
        Example(
            "a package of the workspace that exports no targets",
            {"CMakeLists.txt": _LISTS.format(f"{_OLD}(talker shapes)")},
            Report(
                "4:1",
                "ament_target_dependencies was removed in Lyrical: CMake stops; use "
                "target_link_libraries (ament_cmake 572, 614)",
                unsafe_fix="Replace ament_target_dependencies with target_link_libraries",
            ),
            fixed={
                "CMakeLists.txt": _LISTS.format("target_link_libraries(talker ${shapes_TARGETS})")
            },
            neighbors={
                "shapes": {
                    "package.xml": "<package><name>shapes</name></package>\n",
                    "CMakeLists.txt": "project(shapes)\n",
                }
            },
            distro="lyrical",
        ),
        Example(
            "deprecated",
            {"CMakeLists.txt": _LISTS.format(f"{_OLD}(talker rclcpp)")},
            Report(
                "4:1",
                "ament_target_dependencies is deprecated since Kilted, and "
                "Lyrical removes it: CMake warns; use target_link_libraries (ament_cmake 572, 614)",
                fix="Replace ament_target_dependencies with target_link_libraries",
                severity=Severity.INFO,
            ),
            fixed={
                "CMakeLists.txt": _LISTS.format("target_link_libraries(talker ${rclcpp_TARGETS})")
            },
            distro="kilted",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        changes = [item for item in of_kind("command") if item.is_removed or item.is_deprecated]
        if not changes:
            return
        lists = [package.cmake, *nested(package, _is_asked_for)]
        own = {
            command.values[0].lower()
            for cmake in lists
            for command in cmake.find("macro", "function")
            if command.values
        }
        missed = [change for change in changes if change.names[0] not in own]
        for change, cmake in product(missed, lists):
            for command in cmake.find_own(change.names[0]):
                if _is_asked_for(cmake, command):
                    continue
                failure = "CMake stops" if change.is_removed else "CMake warns"
                message = f"{change.names[0]} {change.state}: {failure}; {change.advice} "
                message += f"({change.source})"
                fix = self._fix(package, cmake, command) if command.name == _OLD else None
                severity = None if change.is_removed else Severity.INFO
                yield self.report(command.name_location, message, fix, severity=severity)

    def _fix(self, package: Package, cmake: CMakeLists, command: Command) -> Fix | None:
        """Replace each name by the targets of the package."""
        _, *rest = command.arguments
        items = [item for item in rest if item.value not in _KEYWORDS]
        linked = [_packages(cmake, command, item) for item in items]
        if not items or not all(linked):
            return None
        text, path = cmake.source.text, cmake.source.path
        start = command.start
        added = sum(len(_target(name)) for names in linked for name in names)
        is_wide = text.find("\n", start) >= items[-1].end and added > _WIDTH - len(_OLD)
        edits = []
        for item, names in zip(items, linked, strict=True):
            targets = [_target(name) for name in names]
            line = text[text.rfind("\n", 0, item.start) + 1 : item.start]
            indent = line[: len(line) - len(line.lstrip())]
            if is_wide:
                begin = item.start - (len(line) - len(line.rstrip()))
                written = "".join(f"\n{indent}  {target}" for target in targets)
                edits.append(Edit(path, begin, item.end, written))
                continue
            between = " " if line.strip() else f"\n{line}"
            edits.append(Edit(path, item.start, item.end, between.join(targets)))
        end = start + len(command.written_name)
        edits.append(Edit(path, start, end, "target_link_libraries"))
        is_sure = all(_exports(package, name) for names in linked for name in names)
        safety = Safety.SAFE if is_sure else Safety.UNSAFE
        return Fix(
            "Replace ament_target_dependencies with target_link_libraries", tuple(edits), safety
        )


def _is_asked_for(cmake: CMakeLists, command: Command) -> bool:
    """Return whether a condition around a call asks for the command, or for the version of one."""
    return any(
        "COMMAND" in words or any("VERSION" in word for word in words)
        for words in cmake.conditions(command)
    )


def _packages(cmake: CMakeLists, command: Command, argument: Argument) -> list[str]:
    """Return the packages in an argument, a name or a list; empty if unclear."""
    names = cmake.expand_list([argument], command) or []
    is_clear = all(name.replace("_", "").isalnum() and name != "SYSTEM" for name in names)
    return names if is_clear else []


def _target(name: str) -> str:
    return _LINKED.get(name, f"${{{name}_TARGETS}}")


def _exports(package: Package, name: str) -> bool:
    """Return whether a package is known to export targets: libraries of ROS, and interfaces."""
    if name in _EXPORTING or name in _LINKED:
        return True
    neighbor = package.workspace.get(name)
    if neighbor is not None and neighbor.name != package.name and neighbor.has("CMakeLists.txt"):
        return bool(neighbor.cmake.find("ament_export_targets", "rosidl_generate_interfaces"))
    is_interface = name.endswith(("_msgs", "_interfaces", "_srvs")) and name not in _LATER
    return is_interface and name != package.name
