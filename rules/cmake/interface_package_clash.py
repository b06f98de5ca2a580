"""CM063: a package of interfaces installs no Python package of the same name."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, Package, Rule
from scaffold.api.cmake import generations, is_interface_package
from scaffold.api.distributions import target

_LISTS = (
    "project(my_robot)\nrosidl_generate_interfaces(${PROJECT_NAME} msg/Beat.msg)\n"
    "ament_python_install_package(%s)\n"
)
_FILES = {"msg/Beat.msg": "int32 count\n", "my_robot/__init__.py": ""}


class InterfacePackageClash(Rule):
    """A package generates interfaces and installs a Python package of the same name.

    **Why.** Both are the Python package ``my_robot``: CMake stops because the target
    ``ament_cmake_python_copy_my_robot`` exists already. From Lyrical on both are merged.

    **Fix.** Move the interfaces to a separate package, such as ``my_robot_msgs``.

    **Source.** ROS 2 documentation, "ament_cmake_python user documentation";
    https://github.com/ros2/rosidl_python/issues/141.
    """

    code = "CM063"
    name = "interface-package-clash"
    effect = Effect.STOPS_BUILD
    examples = (
        Example("another name", {"CMakeLists.txt": _LISTS % "my_robot_tools", **_FILES}),
        Example(
            "the same name where both are merged",
            {"CMakeLists.txt": _LISTS % "${PROJECT_NAME}", **_FILES},
            distro="lyrical",
        ),
        Example(
            "the same name",
            {"CMakeLists.txt": _LISTS % "${PROJECT_NAME}", **_FILES},
            "CMakeLists.txt:3:1: the Python package 'my_robot' and the interfaces generated in "
            "line 2 have the same name, so CMake stops: move the interfaces to a separate package",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        may_be = target().fact("build.package_may_be_installed_twice")
        if not is_interface_package(package) or may_be:
            return
        line = generations(package)[0].command.location.line
        for command in cmake.find("ament_python_install_package"):
            name = cmake.expand(command.arguments[0], command) if command.arguments else None
            if name is not None and name == cmake.project_name:
                message = (
                    f"the Python package {name!r} and the interfaces generated in line {line} "
                    "have the same name, so CMake stops: move the interfaces to a separate package"
                )
                yield self.report(command.name_location, message)
