"""CM022: the package that defines a command is found."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule

PROVIDERS = {
    "ament_add_gmock": ("ament_cmake_gmock", "ament_cmake_auto", "ament_cmake_ros"),
    "ament_add_gtest": ("ament_cmake_gtest", "ament_cmake_auto", "ament_cmake_ros"),
    "ament_add_pytest_test": (
        "ament_cmake_pytest",
        "ament_cmake_ros",
        "launch_testing_ament_cmake",
    ),
    "ament_auto_add_executable": ("ament_cmake_auto",),
    "ament_auto_add_library": ("ament_cmake_auto",),
    "ament_auto_find_build_dependencies": ("ament_cmake_auto",),
    "ament_auto_package": ("ament_cmake_auto",),
    "ament_copyright": ("ament_cmake_copyright",),
    "ament_flake8": ("ament_cmake_flake8",),
    "ament_lint_auto_find_test_dependencies": ("ament_lint_auto",),
    "ament_lint_cmake": ("ament_cmake_lint_cmake",),
    "ament_package": ("ament_cmake", "ament_cmake_ros", "ament_cmake_auto", "ament_cmake_core"),
    "ament_pep257": ("ament_cmake_pep257",),
    "ament_python_install_package": ("ament_cmake_python", "ament_cmake", "ament_cmake_auto"),
    "ament_xmllint": ("ament_cmake_xmllint",),
    "rclcpp_components_register_node": ("rclcpp_components",),
    "rclcpp_components_register_nodes": ("rclcpp_components",),
    "rosidl_generate_interfaces": ("rosidl_default_generators", "rosidl_core_generators"),
}
"""The packages that bring a command."""

_BRING_NOTHING = (
    "ament_cmake",
    "ament_cmake_python",
    "ament_cmake_pytest",
    "ament_index_cpp",
    "ament_index_python",
    "ament_lint_auto",
    "launch",
    "launch_ros",
    "rclcpp",
    "rclpy",
    "std_srvs",
    "tf2",
    "tf2_ros",
)
"""Packages that bring none of these commands but their own, nor do message packages."""

_LISTS = "project(talker)\n{}ament_add_pytest_test(talk test/test_talk.py)\n"


class CommandUndefined(Rule):
    """A command is called, but no package that defines it is found.

    **Why.** CMake stops: ``Unknown CMake command``.

    **Fix.** Call ``find_package`` for the package first.

    **Source.** ``ament_cmake``, ``ament_lint``, ``rosidl`` and ``rclcpp``: the files that define
    the commands.
    """

    code = "CM022"
    name = "command-undefined"
    examples = (
        Example(
            "found",
            {"CMakeLists.txt": _LISTS.format("find_package(ament_cmake_pytest REQUIRED)\n")},
        ),
        Example(
            "not found",
            {"CMakeLists.txt": _LISTS.format("")},
            Report(
                "CMakeLists.txt:2:1",
                "ament_add_pytest_test() is not known without "
                "find_package(ament_cmake_pytest REQUIRED)",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        found = {one.name for one in cmake.found_packages}
        if cmake.finds_automatically or cmake.finds_tests_automatically or cmake.find("include"):
            return
        if any("$" in call.values[0] for call in cmake.find("find_package") if call.values):
            return
        own = {call.values[0].lower() for call in cmake.find("macro", "function") if call.values}
        if not all(name in _BRING_NOTHING or name.endswith("_msgs") for name in found):
            return
        for name, providers in PROVIDERS.items():
            if name in own or not found.isdisjoint(providers):
                continue
            for command in cmake.find(name):
                message = f"{name}() is not known without find_package({providers[0]} REQUIRED)"
                yield self.report(command.name_location, message)
