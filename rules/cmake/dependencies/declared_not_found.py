"""CM021: CMakeLists.txt finds the build dependencies of package.xml."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule, Severity
from scaffold.api.catalog import ROS_PACKAGES
from scaffold.api.cmake import has_unknown_commands

from ._pure_packages import PURE_PACKAGES

KINDS = ("build_depend", "buildtool_depend")
_NOT_FOUND_BY_NAME = (
    "ament_cmake_",
    "rosidl_",
    "ament_index",
    "ament_lint",
    "eigen",
    "ros_environment",  # provides variables such as ROS_DISTRO
)
_MANIFEST = (
    '<package format="3">\n  <name>talker</name>\n'
    "  <build_depend>std_msgs</build_depend>\n</package>\n"
)
_LISTS = "project(talker)\nfind_package(ament_cmake REQUIRED)\n{}ament_package()\n"


class DeclaredNotFound(Rule):
    """A ``<build_depend>`` is never found in CMakeLists.txt.

    **Why.** Either the build does not need it, or a ``find_package`` call is missing and the build
    only works because another package depends on it.

    **Fix.** Call ``find_package``, or declare ``<exec_depend>`` if it is only needed at run time.

    **Source.** ROS 2 documentation, "ament_cmake user documentation"; catkin_lint,
    "unconfigured build_depend".
    """

    code = "CM021"
    name = "declared-not-found"
    severity = Severity.WARNING
    examples = (
        Example(
            "found",
            {
                "package.xml": _MANIFEST,
                "CMakeLists.txt": _LISTS.format("find_package(std_msgs REQUIRED)\n"),
            },
        ),
        Example(
            "a list of dependencies in a variable",
            {
                "package.xml": _MANIFEST.replace("std_msgs", "ros_environment"),
                "CMakeLists.txt": _LISTS.format(""),
            },
        ),
        Example(
            "ament_cmake, found by another package; a package to run, without CMake files",
            {
                "package.xml": _MANIFEST.replace(
                    "<build_depend>std_msgs</build_depend>",
                    "<buildtool_depend>ament_cmake</buildtool_depend>\n"
                    "  <buildtool_depend>ros2run</buildtool_depend>",
                ),
                "CMakeLists.txt": "project(talker)\n"
                "find_package(rosidl_default_generators REQUIRED)\nament_package()\n",
            },
        ),
        Example(
            "a build tool of a file that finds nothing",
            {
                "package.xml": _MANIFEST.replace(
                    "<build_depend>std_msgs</build_depend>",
                    "<buildtool_depend>ament_cmake</buildtool_depend>",
                ),
                "CMakeLists.txt": "project(talker)\n",
            },
            "package.xml:3:21: <buildtool_depend> 'ament_cmake', but CMakeLists.txt does not call "
            "find_package(ament_cmake); add the call, or declare <exec_depend>",
        ),
        Example(
            "found in a loop",
            {
                "package.xml": _MANIFEST,
                "CMakeLists.txt": _LISTS.format(
                    "foreach(name rclcpp std_msgs)\n  find_package(${name})\nendforeach()\n"
                ),
            },
        ),
        Example(
            "not found, also not in a loop",
            {
                "package.xml": _MANIFEST,
                "CMakeLists.txt": _LISTS.format(
                    "foreach(name rclcpp)\n  find_package(${name})\nendforeach()\n"
                ),
            },
            "package.xml:3:17: <build_depend> 'std_msgs', but CMakeLists.txt does not call "
            "find_package(std_msgs); add the call, or declare <exec_depend>",
        ),
        Example(
            "not found",
            {"package.xml": _MANIFEST, "CMakeLists.txt": _LISTS.format("")},
            "package.xml:3:17: <build_depend> 'std_msgs', but CMakeLists.txt does not call "
            "find_package(std_msgs); add the call, or declare <exec_depend>",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        if package.build_type != "ament_cmake" or cmake.finds_automatically:
            return
        if has_unknown_commands(package) or cmake.has_unknown_packages:
            return
        for dependency in package.manifest.dependencies:
            name = dependency.name
            if dependency.kind not in KINDS or dependency.condition or cmake.finds(name):
                continue
            if name not in ROS_PACKAGES - PURE_PACKAGES or name.startswith(_NOT_FOUND_BY_NAME):
                continue
            if name == "ament_cmake" and any(cmake.found_packages):
                continue  # rosidl_default_generators and others find it as well
            if not any(name in argument for argument in self._arguments(package)):
                message = (
                    f"<{dependency.kind}> {name!r}, but CMakeLists.txt does not call "
                    f"find_package({name}); add the call, or declare <exec_depend>"
                )
                yield self.report(dependency, message)

    def _arguments(self, package: Package) -> Iterator[str]:
        for command in package.cmake.commands:
            yield from command.values
