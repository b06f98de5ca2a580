"""LF005: packages that launch files use are declared."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity
from scaffold.api.catalog import OTHER_NAMES, ROS1_PACKAGES, is_released
from scaffold.api.distributions import removed_package, target
from scaffold.api.launch import Reference, exists, meant_package, package_uses
from scaffold.api.manifest import declared, declaring, is_installed_to_build

_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n"
    "    return LaunchDescription([\n"
    "        Node(package='talker', executable='talk'),\n"
    "        Node(package='rviz2', executable='rviz2'),\n    ])\n"
)
_MANIFEST = '<package format="3">\n  <name>talker</name>\n{}</package>\n'


class PackageUndeclared(Rule):
    """A launch file uses a package that package.xml does not declare.

    **Why.** On a clean machine rosdep does not install the package: ``package 'rviz2' not found``.
    Packages of Gazebo Classic and ROS 1 cannot be installed at all.

    **Fix.** Add an ``<exec_depend>``. If the condition of an existing dependency excludes the
    distribution, change the condition.

    **Source.** REP 149, ``<exec_depend>``; ROS 2 documentation, "Using ROS 2 launch for large
    projects".
    """

    code = "LF005"
    name = "package-undeclared"
    other_severities = {
        Severity.WARNING: "the package is in the workspace, provides a ros2 command, is installed "
        "to build the workspace, or may come with an unknown dependency"
    }
    examples = (
        Example(
            "declared",
            {
                "package.xml": _MANIFEST.format("  <exec_depend>rviz2</exec_depend>\n"),
                "launch/a.launch.py": _LAUNCH,
            },
        ),
        Example(
            "not declared",
            {
                "package.xml": _MANIFEST.format("  <exec_depend>launch_ros</exec_depend>\n"),
                "launch/a.launch.py": _LAUNCH,
            },
            Report(
                "launch/a.launch.py:8:22",
                "starts a node of 'rviz2', which package.xml does not declare; add "
                "<exec_depend>rviz2</exec_depend>",
                fix="Declare rviz2",
            ),
            fixed={
                "package.xml": _MANIFEST.format(
                    "  <exec_depend>launch_ros</exec_depend>\n  <exec_depend>rviz2</exec_depend>\n"
                )
            },
        ),
        Example(
            "a dependency outside of every distribution that may bring it",
            {
                "package.xml": _MANIFEST.format("  <exec_depend>arm_bringup</exec_depend>\n"),
                "launch/a.launch.py": _LAUNCH,
            },
            Report(
                "launch/a.launch.py:8:22",
                "starts a node of 'rviz2', which package.xml does not declare; add "
                "<exec_depend>rviz2</exec_depend>",
                fix="Declare rviz2",
                severity=Severity.WARNING,
            ),
            fixed={
                "package.xml": _MANIFEST.format(
                    "  <exec_depend>arm_bringup</exec_depend>\n  <exec_depend>rviz2</exec_depend>\n"
                )
            },
        ),
        Example(
            "a package that depends on this one",
            {
                "package.xml": _MANIFEST.format("  <exec_depend>launch_ros</exec_depend>\n"),
                "launch/a.launch.py": _LAUNCH.replace("rviz2", "listener"),
            },
            Report(
                "launch/a.launch.py:8:22",
                "starts a node of 'listener', which package.xml does not declare; "
                "declaring it would close a cycle, talker needs listener needs talker: "
                "move what both need into a third package",
                severity=Severity.WARNING,
            ),
            neighbors={
                "listener": {
                    "package.xml": '<package format="3">\n  <name>listener</name>\n'
                    "  <exec_depend>talker</exec_depend>\n</package>\n"
                }
            },
        ),
        Example(
            "declared for another distribution",
            {
                "package.xml": _MANIFEST.format(
                    "  <exec_depend>launch_ros</exec_depend>\n"
                    '  <exec_depend condition="$ROS_DISTRO == humble">rviz2</exec_depend>\n'
                ),
                "launch/a.launch.py": _LAUNCH,
            },
            "launch/a.launch.py:8:22: starts a node of 'rviz2', and line 4 of package.xml "
            "declares it only if $ROS_DISTRO == humble, which excludes Jazzy; change the "
            "condition",
        ),
        Example(
            "declared for this distribution, or under a condition on another variable",
            {
                "package.xml": _MANIFEST.format(
                    '  <exec_depend condition="$ROS_DISTRO == humble">rviz2</exec_depend>\n'
                    '  <exec_depend condition="$ROS_DISTRO != humble">rviz2</exec_depend>\n'
                    '  <exec_depend condition="$SIMULATION == yes">arm</exec_depend>\n'
                ),
                "launch/a.launch.py": _LAUNCH,
                "launch/b.launch.py": _LAUNCH.replace("rviz2", "arm"),
            },
            neighbors={
                "arm": {"package.xml": '<package format="3">\n  <name>arm</name>\n</package>\n'}
            },
        ),
        Example(
            "a package in the same workspace",
            {
                "package.xml": _MANIFEST.format("  <exec_depend>launch_ros</exec_depend>\n"),
                "launch/a.launch.py": _LAUNCH.replace("rviz2", "arm"),
            },
            Report(
                "launch/a.launch.py:8:22",
                "starts a node of 'arm', which package.xml does not declare; add "
                "<exec_depend>arm</exec_depend>",
                fix="Declare arm",
                severity=Severity.WARNING,
            ),
            neighbors={
                "arm": {"package.xml": '<package format="3">\n  <name>arm</name>\n</package>\n'}
            },
            fixed={
                "package.xml": _MANIFEST.format(
                    "  <exec_depend>arm</exec_depend>\n  <exec_depend>launch_ros</exec_depend>\n"
                )
            },
        ),
        Example(
            "a package that an unknown dependency of the same family may bring",
            {
                "package.xml": _MANIFEST.format(
                    "  <exec_depend>rviz2_arm_displays</exec_depend>\n"
                ),
                "launch/a.launch.py": _LAUNCH,
            },
            Report(
                "launch/a.launch.py:8:22",
                "starts a node of 'rviz2', which package.xml does not declare; add "
                "<exec_depend>rviz2</exec_depend>",
                fix="Declare rviz2",
                severity=Severity.WARNING,
            ),
            fixed={
                "package.xml": _MANIFEST.format(
                    "  <exec_depend>rviz2</exec_depend>\n"
                    "  <exec_depend>rviz2_arm_displays</exec_depend>\n"
                )
            },
        ),
        Example(
            "executables that are run by name",
            {
                "package.xml": _MANIFEST.format("  <exec_depend>launch_ros</exec_depend>\n"),
                "launch/a.launch.py": "from launch import LaunchDescription\n"
                "from launch.actions import ExecuteProcess\n"
                "from launch.substitutions import Command, FindExecutable\n"
                "from launch_ros.actions import Node\n\n\n"
                "def generate_launch_description():\n"
                "    urdf = Command([FindExecutable(name='xacro'), ' ', 'robot.xacro'])\n"
                "    again = Command('xacro robot.xacro')\n"
                "    return LaunchDescription([\n"
                "        ExecuteProcess(cmd=['ros2', 'bag', 'record', '-a']),\n    ])\n",
            },
            Report(
                "launch/a.launch.py:8:41",
                "runs 'xacro' of 'xacro', which package.xml does not declare; add "
                "<exec_depend>xacro</exec_depend>",
                fix="Declare xacro",
            ),
            Report(
                "launch/a.launch.py:11:29",
                "runs 'ros2 bag' of 'ros2bag', which package.xml does not declare; add "
                "<exec_depend>ros2bag</exec_depend>",
                fix="Declare ros2bag",
                severity=Severity.WARNING,
            ),
            fixed={
                "package.xml": _MANIFEST.format(
                    "  <exec_depend>launch_ros</exec_depend>\n"
                    "  <exec_depend>ros2bag</exec_depend>\n  <exec_depend>xacro</exec_depend>\n"
                )
            },
        ),
        Example(
            "after a return",
            {
                "package.xml": _MANIFEST.format("  <exec_depend>launch_ros</exec_depend>\n"),
                "launch/a.launch.py": _LAUNCH.replace(
                    "    return", "    return LaunchDescription([])\n    return"
                ),
            },
        ),
        Example(
            "a package of a driver",
            {
                "package.xml": _MANIFEST.format("  <exec_depend>launch_ros</exec_depend>\n"),
                "launch/a.launch.py": _LAUNCH.replace("rviz2", "velodyne_driver"),
            },
            Report(
                "launch/a.launch.py:8:22",
                "starts a node of 'velodyne_driver', which package.xml does not "
                "declare; add <exec_depend>velodyne_driver</exec_depend>",
                fix="Declare velodyne_driver",
            ),
            fixed={
                "package.xml": _MANIFEST.format(
                    "  <exec_depend>launch_ros</exec_depend>\n"
                    "  <exec_depend>velodyne_driver</exec_depend>\n"
                )
            },
        ),
        Example(
            "Gazebo Classic, which Jazzy does not have",
            {
                "package.xml": _MANIFEST.format("  <exec_depend>launch_ros</exec_depend>\n"),
                "launch/b.launch.py": _LAUNCH.replace("rviz2", "gazebo_ros"),
            },
            "launch/b.launch.py:8:22: starts a node of 'gazebo_ros', which Jazzy does not have; "
            "use ros_gz, as Gazebo Classic has ended",
        ),
        Example(
            "a package of ROS 1",
            {
                "package.xml": _MANIFEST.format("  <exec_depend>launch_ros</exec_depend>\n"),
                "launch/b.launch.py": _LAUNCH.replace("rviz2", "rosserial_python"),
            },
            "launch/b.launch.py:8:22: starts a node of 'rosserial_python', which Jazzy does not "
            "have; use micro-ROS",
        ),
        Example(
            "Gazebo Classic, which Humble has",
            {
                "package.xml": _MANIFEST.format("  <exec_depend>launch_ros</exec_depend>\n"),
                "launch/b.launch.py": _LAUNCH.replace("rviz2", "gazebo_ros"),
            },
            Report(
                "launch/b.launch.py:8:22",
                "starts a node of 'gazebo_ros', which package.xml does not declare; "
                "add <exec_depend>gazebo_ros</exec_depend>",
                fix="Declare gazebo_ros",
            ),
            fixed={
                "package.xml": _MANIFEST.format(
                    "  <exec_depend>gazebo_ros</exec_depend>\n"
                    "  <exec_depend>launch_ros</exec_depend>\n"
                )
            },
            distro="humble",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        manifest = package.manifest
        dependencies = declared(package, for_tests=False)
        active = {item.name for item in manifest.dependencies if item.may_be_active}
        seen = {package.name, *dependencies.direct, *dependencies.along, *active}
        tag = "exec_depend" if manifest.format > 1 else "run_depend"
        for use in package_uses(package):
            if use.name in seen or use.is_optional or meant_package(package, use):
                continue
            if not use.location.path.startswith("launch"):
                continue
            is_known = exists(package, use.name)
            replacement = "" if is_known else _replacement(use.name)
            if not (is_known or replacement or is_released(use.name)):
                continue
            seen.add(use.name)
            if replacement:
                message = f"{_usage(use)} {use.name!r}, which {target().title} does not have"
                yield self.report(use.location, f"{message}; {replacement}")
                continue
            is_near = package.workspace.get(use.name) is not None or use.name.startswith("ros2")
            is_near = is_near or dependencies.may_use(package, use.name)
            is_near = is_near or is_installed_to_build(package, [use.name])
            severity = Severity.WARNING if is_near else Severity.ERROR
            other = next((item for item in manifest.dependencies if item.name == use.name), None)
            if other is not None:
                message = (
                    f"{_usage(use)} {use.name!r}, and line {other.location.line} of package.xml "
                    f"declares it only if {other.condition}, which excludes "
                    f"{target().title}; change the condition"
                )
                yield self.report(use.location, message, severity=severity)
                continue
            needed = declaring(package, tag, use.name)
            yield self.report(
                use.location,
                f"{_usage(use)} {use.name!r}, which package.xml does not declare; {needed.advice}",
                needed.fix,
                severity=severity,
                cause=f"dependency {use.name}",
            )


def _replacement(name: str) -> str:
    """Return the advice for a package that the target does not have; empty for others."""
    change = removed_package(name)
    if change is not None:
        return change.advice
    other = ROS1_PACKAGES.get(name) or OTHER_NAMES.get(name)
    return f"use {other}" if other else ""


def _usage(use: Reference) -> str:
    """Return how a launch file uses a package."""
    if use.program:
        return f"runs {use.program!r} of"
    return "finds" if use.executable is None else "starts a node of"
