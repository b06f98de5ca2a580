"""PX031: used packages exist in the distribution."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, Location, Package, Rule, ViewError
from scaffold.api.cmake import CMakeLists, Command, is_built_for_ros1
from scaffold.api.distributions import removed_package
from scaffold.api.interfaces import interface_files
from scaffold.api.manifest import is_fetched, requirements

_NAMED = "<package>\n  <name>talker</name>\n{}</package>\n"


class PackageRemoved(Rule):
    """A package is used that the distribution has removed.

    Only packages of ROS 2 itself, which are those in the repositories of ``ros2.repos``, and of
    Gazebo are checked. A package with the same name in the workspace or in a ``.repos`` file is
    accepted, and so are dependencies, imports and ``find_package`` calls for other distributions.

    **Why.** ``rosdep install`` finds no rule, CMake stops at ``find_package``, and imports raise
    ``ModuleNotFoundError``.

    **Fix.** Use its replacement. No automatic fix: the code has to change as well.

    **Source.** ``distribution.yaml`` of each distribution in ros/rosdistro, and ``ros2.repos``.
    """

    code = "PX031"
    name = "package-removed"
    effect = Effect.STOPS_BUILD
    examples = (
        Example(
            "an existing package",
            {
                "package.xml": _NAMED.format("  <depend>actionlib_msgs</depend>\n"),
                "talker/__init__.py": "",
                "talker/node.py": "from actionlib_msgs.msg import GoalStatus\n",
            },
        ),
        Example(
            "for older distributions, or only if it is installed",
            {
                "package.xml": '<package format="3">\n  <name>talker</name>\n'
                '  <depend condition="$ROS_DISTRO == jazzy">actionlib_msgs</depend>\n'
                "</package>\n",
                "CMakeLists.txt": "project(talker)\nfind_package(actionlib_msgs QUIET)\n",
                "talker/__init__.py": "",
                "talker/node.py": "try:\n    from actionlib_msgs.msg import GoalID\n"
                "except ImportError:\n    GoalID = None\n",
            },
            distro="lyrical",
        ),
        Example(
            "a package of the workspace",
            {
                "package.xml": _NAMED.format("  <depend>actionlib_msgs</depend>\n"),
                "talker/__init__.py": "",
                "talker/node.py": "from actionlib_msgs.msg import GoalStatus\n",
            },
            neighbors={
                "actionlib_msgs": {
                    "package.xml": "<package><name>actionlib_msgs</name></package>\n",
                    "CMakeLists.txt": "project(actionlib_msgs)\n"
                    "rosidl_generate_interfaces(${PROJECT_NAME} msg/GoalStatus.msg)\n",
                    "msg/GoalStatus.msg": "int8 status\n",
                }
            },
            distro="lyrical",
        ),
        Example(
            "declared, found, imported, in an interface",
            {
                "package.xml": _NAMED.format("  <depend>actionlib_msgs</depend>\n"),
                "CMakeLists.txt": "project(talker)\nfind_package(actionlib_msgs REQUIRED)\n"
                "rosidl_generate_interfaces(${PROJECT_NAME} msg/Beat.msg)\n",
                "msg/Beat.msg": "int32 count\nactionlib_msgs/GoalStatus[] states\n",
                "talker/__init__.py": "",
                "talker/node.py": "from actionlib_msgs.msg import GoalStatus\n",
            },
            "CMakeLists.txt:2:14: actionlib_msgs was removed in Lyrical: CMake stops; use "
            "action_msgs, whose GoalStatus and GoalInfo have other fields (common_interfaces 280)",
            "msg/Beat.msg:2:1: actionlib_msgs was removed in Lyrical: the build stops; use "
            "action_msgs, whose GoalStatus and GoalInfo have other fields (common_interfaces 280)",
            "package.xml:3:11: actionlib_msgs was removed in Lyrical: rosdep finds no rule; use "
            "action_msgs, whose GoalStatus and GoalInfo have other fields (common_interfaces 280)",
            "talker/node.py:1:1: actionlib_msgs was removed in Lyrical: ModuleNotFoundError; use "
            "action_msgs, whose GoalStatus and GoalInfo have other fields (common_interfaces 280)",
            distro="lyrical",
        ),
        Example(
            "Gazebo Classic, which Jazzy lacks; found on Humble only",
            {
                "package.xml": _NAMED.format("  <depend>gazebo_ros</depend>\n"),
                "CMakeLists.txt": "project(talker)\nif($ENV{ROS_DISTRO} STREQUAL humble)\n"
                "  find_package(gazebo_ros REQUIRED)\nendif()\n",
            },
            "package.xml:3:11: gazebo_ros was removed in Jazzy: rosdep finds no rule; use ros_gz, "
            "as Gazebo Classic has ended (rosdistro)",
        ),
        Example(
            "Gazebo Classic, which Humble has",
            {"package.xml": _NAMED.format("  <exec_depend>gazebo_ros2_control</exec_depend>\n")},
            distro="humble",
        ),
        Example(
            "former names of packages",
            {
                "package.xml": _NAMED.format(
                    "  <exec_depend>ros_ign_bridge</exec_depend>\n"
                    "  <exec_depend>turtlebot4_ignition_bringup</exec_depend>\n"
                )
            },
            "3:16: ros_ign_bridge was removed in Jazzy: rosdep finds no rule; use ros_gz_bridge "
            "(rosdistro)",
            "4:16: turtlebot4_ignition_bringup was removed in Jazzy: rosdep finds no rule; use "
            "turtlebot4_gz_bringup (rosdistro)",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        if package.manifest.build_type == "catkin" or is_built_for_ros1(package):
            return
        for name, at, failure in _uses(package):
            change = removed_package(name)
            is_there = package.workspace.get(name) is not None or is_fetched(package, name)
            if change is not None and not is_there:
                message = f"{name} {change.state}: {failure}; {change.advice} ({change.source})"
                yield self.report(at, message, cause=f"removed package {change.names[0]}")


def _uses(package: Package) -> Iterator[tuple[str, Location, str]]:
    """Yield the packages used on the target, with the places and the effect of their absence."""
    for dependency in package.manifest.dependencies:
        if dependency.active and dependency.kind != "doc_depend":
            yield dependency.name, dependency.location, "rosdep finds no rule"
    for _, imports in requirements.shipped_imports(package):
        for item in imports:
            if not item.guarded:
                yield item.root, item.location, "ModuleNotFoundError"
    yield from _uses_of_build(package)


def _uses_of_build(package: Package) -> Iterator[tuple[str, Location, str]]:
    try:
        packages, files = package.cmake.found_packages, interface_files(package)
    except ViewError:
        return
    for package_found in packages:
        if package_found.required and _is_always_found(package.cmake, package_found.command):
            yield package_found.name, package_found.location, "CMake stops"
    for file in files:
        for field in file.definition.all_fields:
            if field.type.package:
                yield field.type.package, field.type_location, "the build stops"


def _is_always_found(cmake: CMakeLists, command: Command) -> bool:
    """Return whether no condition, except that on tests, decides whether a command runs."""
    return all({*condition} <= {"BUILD_TESTING"} for condition in cmake.conditions(command))
