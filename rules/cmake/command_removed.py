"""CM110: the commands of CMakeLists.txt are there on the distribution."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import (
    Diagnostic,
    Edit,
    Example,
    Fix,
    Package,
    Report,
    Rule,
    Safety,
    Severity,
)
from scaffold.api.cmake import Command
from scaffold.api.distributions import of_kind

_LISTS = (
    "find_package(rclcpp REQUIRED)\nfind_package(std_msgs REQUIRED)\n"
    "add_executable(talker talker.cpp)\n{}\n"
)
_OLD = "ament_target_dependencies"
_COMMENTED = f"{_OLD}(talker PUBLIC\n  rclcpp  # the node\n  std_msgs)"
_KEYWORDS = frozenset({"PUBLIC", "INTERFACE"})
_EXPORTING = frozenset(
    {"rclcpp", "rclcpp_action", "rclcpp_components", "rclcpp_lifecycle", "rcutils", "rcpputils"}
    | {"tf2", "tf2_ros", "tf2_geometry_msgs", "tf2_eigen", "message_filters", "image_transport"}
    | {"pluginlib", "class_loader", "ament_index_cpp", "rosbag2_cpp", "cv_bridge"}
)
"""Packages that export targets on every distribution."""


class CommandRemoved(Rule):
    """CMakeLists.txt calls a command of ament that the distribution has no more.

    **Why.** CMake stops: ``Unknown CMake command "ament_target_dependencies"``. Where the command
    is deprecated only, it warns.

    **Fix.** ``target_link_libraries`` with the targets that packages export, which exists on all
    distributions: ``${std_msgs_TARGETS}``. The fix is safe where all of the packages are known to
    export targets.

    **Source.** ament_cmake pull requests 572 and 614; the template of ``ros2 pkg create``.
    """

    code = "CM110"
    name = "command-removed"
    is_fixed_for_all = True
    other_severities = {Severity.INFO: "the distribution still has it, and warns"}
    examples = (
        Example(
            "still there",
            {"CMakeLists.txt": _LISTS.format(f"{_OLD}(talker rclcpp std_msgs)")},
        ),
        Example(
            "a command of all distributions",
            {"CMakeLists.txt": _LISTS.format("target_link_libraries(talker ${rclcpp_TARGETS})")},
            distro="lyrical",
        ),
        Example(
            "gone",
            {"CMakeLists.txt": _LISTS.format(_COMMENTED)},
            Report(
                "4:1",
                "ament_target_dependencies was removed in Lyrical: CMake stops; "
                "use target_link_libraries (ament_cmake 572, 614)",
                fix="write target_link_libraries",
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
            "deprecated",
            {"CMakeLists.txt": _LISTS.format(f"{_OLD}(talker rclcpp)")},
            Report(
                "4:1",
                "ament_target_dependencies is deprecated since Kilted, and "
                "Lyrical removes it: CMake warns; use target_link_libraries (ament_cmake 572, 614)",
                fix="write target_link_libraries",
                severity=Severity.INFO,
            ),
            fixed={
                "CMakeLists.txt": _LISTS.format("target_link_libraries(talker ${rclcpp_TARGETS})")
            },
            distro="kilted",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        changes = [one for one in of_kind("command") if one.is_removed or one.is_deprecated]
        if not changes:
            return
        cmake = package.cmake
        for change in changes:
            for command in cmake.find(change.names[0]):
                failure = "CMake stops" if change.is_removed else "CMake warns"
                message = f"{change.names[0]} {change.state}: {failure}; {change.advice} "
                message += f"({change.source})"
                fix = self._fix(package, command) if command.name == _OLD else None
                severity = None if change.is_removed else Severity.INFO
                yield self.report(command.name_location, message, fix, severity=severity)

    def _fix(self, package: Package, command: Command) -> Fix | None:
        """Link the targets of the packages, in the place of each name."""
        _, *rest = command.arguments
        names = [item for item in rest if item.value not in _KEYWORDS]
        if not names or any(not item.value.replace("_", "").isalnum() for item in names):
            return None
        if any(item.value == "SYSTEM" for item in names):
            return None
        is_sure = all(_exports(package, item.value) for item in names)
        edits = [
            Edit("CMakeLists.txt", item.start, item.end, f"${{{item.value}_TARGETS}}")
            for item in names
        ]
        start = command.start
        end = start + len(command.written_name)
        edits.append(Edit("CMakeLists.txt", start, end, "target_link_libraries"))
        safety = Safety.SAFE if is_sure else Safety.UNSAFE
        return Fix("write target_link_libraries", tuple(edits), safety)


def _exports(package: Package, name: str) -> bool:
    """Tell whether a package is known to export targets: libraries of ROS, and interfaces."""
    if name in _EXPORTING:
        return True
    return name.endswith(("_msgs", "_interfaces", "_srvs")) and name != package.name
