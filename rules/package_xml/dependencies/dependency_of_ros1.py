"""PX024: dependencies exist in ROS 2."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, Package, Rule
from scaffold.api.catalog import ROS1_PACKAGES
from scaffold.api.cmake import is_built_for_ros1


class DependencyOfRos1(Rule):
    """A dependency is a package of ROS 1.

    **Why.** The package does not exist in ROS 2: rosdep finds no rule, and a build that finds it
    stops.

    **Fix.** Depend on its replacement. No automatic fix: the code has to change as well.

    **Source.** ROS 2 documentation, "Migrating your package.xml to ROS 2".
    """

    code = "PX024"
    name = "dependency-of-ros1"
    effect = Effect.STOPS_ROSDEP
    examples = (
        Example("a ROS 2 package", {"package.xml": "<package><depend>rclpy</depend></package>\n"}),
        Example(
            "for ROS 1 only, by its condition",
            {
                "package.xml": '<package format="3">\n'
                '  <depend condition="$ROS_VERSION == 1">rospy</depend>\n</package>\n'
            },
        ),
        Example(
            "for ROS 1 only, by a condition in CMake",
            {
                "package.xml": "<package>\n"
                "  <buildtool_depend>catkin</buildtool_depend>\n"
                "  <depend>rospy</depend>\n"
                "</package>\n",
                "CMakeLists.txt": "project(talker)\nfind_package(catkin REQUIRED rospy)\n",
            },
        ),
        Example(
            "a ROS 1 package",
            {
                "package.xml": "<package>\n"
                "  <buildtool_depend>catkin</buildtool_depend>\n"
                "  <depend>rospy</depend>\n"
                "</package>\n"
            },
            "2:21: 'catkin' is a package of ROS 1: rosdep stops; use ament_cmake",
            "3:11: 'rospy' is a package of ROS 1: rosdep stops; use rclpy",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        manifest = package.manifest
        if manifest.build_type == "catkin" or is_built_for_ros1(package):
            return
        for dependency in manifest.dependencies:
            name = dependency.name
            heir = ROS1_PACKAGES.get(name)
            if heir and dependency.active and package.workspace.get(name) is None:
                message = f"{name!r} is a package of ROS 1: rosdep stops; use {heir}"
                yield self.report(dependency, message, cause="dependencies of ROS 1")
