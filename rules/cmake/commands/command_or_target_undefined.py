"""CM022: every command is defined."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import get_close_matches

from scaffold.api import Diagnostic, Effect, Example, Package, Rule, closest_name
from scaffold.api.catalog import is_near, is_released
from scaffold.api.cmake import BUILT_IN, OF_AMENT, CMakeLists, has_unknown_commands, uses_ament

from ._packages_found import packages_found
from ._targets import TAKING_TARGETS, defined_targets, targets_named_once

_OF_ROS1 = {
    "add_action_files": "rosidl_generate_interfaces",
    "add_message_files": "rosidl_generate_interfaces",
    "add_rostest": "add_launch_test",
    "add_service_files": "rosidl_generate_interfaces",
    "catkin_add_gtest": "ament_add_gtest",
    "catkin_add_nosetests": "ament_add_pytest_test",
    "catkin_install_python": "install(PROGRAMS ... DESTINATION lib/${PROJECT_NAME})",
    "catkin_metapackage": "ament_package",
    "catkin_package": "ament_package",
    "catkin_python_setup": "ament_python_install_package",
    "generate_messages": "rosidl_generate_interfaces",
    "roslaunch_add_file_check": "add_launch_test",
}
_MAX_LENGTH_DIFFERENCE = 2
"""A larger difference in length is not a typo."""
PROVIDERS = {
    "add_launch_test": ("launch_testing_ament_cmake", "ros_testing"),
    "add_ros_test": ("ros_testing",),
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
    "ament_package": ("ament_cmake",),
    "ament_pep257": ("ament_cmake_pep257",),
    "ament_python_install_package": ("ament_cmake_python", "ament_cmake", "ament_cmake_auto"),
    "ament_xmllint": ("ament_cmake_xmllint",),
    "generate_parameter_library": ("generate_parameter_library",),
    "pluginlib_export_plugin_description_file": ("pluginlib",),
    "rclcpp_components_register_node": ("rclcpp_components",),
    "rclcpp_components_register_nodes": ("rclcpp_components",),
    "rosidl_generate_interfaces": ("rosidl_default_generators", "rosidl_core_generators"),
}
"""The packages that provide a command."""

_WITHOUT_CORE = ("ament_index_cpp", "ament_index_python", "launch", "launch_ros", "rclpy")
"""Packages that do not find ament_cmake_core, as message packages and most others may."""

_CALL = "project(talker)\nfind_package(ament_cmake REQUIRED)\n{}()\n"
_LISTS = "project(talker)\n{}ament_add_pytest_test(talk test/test_talk.py)\n"
_LISTS_TARGETS = (
    "project(talker)\nadd_executable(talk src/talk.cpp)\nament_target_dependencies({} rclcpp)\n"
)


class CommandOrTargetUndefined(Rule):
    """A command or target is defined neither by CMake nor by a package that was found before.

    **Why.** CMake stops: ``Unknown CMake command "ament_pakage"``, or ``the first argument must be
    a valid target name``.

    **Fix.** Correct the name, or first call ``find_package`` for the package that provides the
    command. Replace commands of catkin by those of ament.

    **Source.** CMake documentation, "cmake-commands"; ``ament_cmake``, ``ament_lint``, ``rosidl``
    and ``rclcpp``: the files that define the commands; ROS 2 documentation, "Migrating from ROS 1";
    ``ament_cmake_target_dependencies/cmake/ament_target_dependencies.cmake``.
    """

    code = "CM022"
    name = "command-or-target-undefined"
    effect = Effect.STOPS_BUILD
    examples = (
        Example(
            "found as a test dependency",
            {
                "package.xml": '<package format="3">\n  <name>talker</name>\n'
                "  <test_depend>ament_cmake_pytest</test_depend>\n</package>\n",
                "CMakeLists.txt": "project(talker)\nfind_package(ament_cmake REQUIRED)\n"
                "find_package(ament_lint_auto REQUIRED)\n"
                "ament_lint_auto_find_test_dependencies()\n"
                "ament_add_pytest_test(talk test/test_talk.py)\nament_package()\n",
                "test/test_talk.py": "",
            },
        ),
        Example(
            "not found, in a package that declares linters",
            {
                "package.xml": '<package format="3">\n  <name>talker</name>\n'
                "  <test_depend>ament_lint_common</test_depend>\n</package>\n",
                "CMakeLists.txt": "project(talker)\nfind_package(ament_cmake REQUIRED)\n"
                "rosidl_generate_interfaces(talker msg/Talk.msg)\n"
                "find_package(ament_lint_auto REQUIRED)\n"
                "ament_lint_auto_find_test_dependencies()\nament_package()\n",
                "msg/Talk.msg": "int8 x\n",
            },
            "CMakeLists.txt:3:1: rosidl_generate_interfaces() is undefined without "
            "find_package(rosidl_default_generators REQUIRED)",
        ),
        Example(
            "found",
            {"CMakeLists.txt": _LISTS.format("find_package(ament_cmake_pytest REQUIRED)\n")},
        ),
        Example(
            "not found",
            {"CMakeLists.txt": _LISTS.format("")},
            "2:1: ament_add_pytest_test() is undefined without find_package(ament_cmake_pytest "
            "REQUIRED)",
        ),
        Example(
            "a tool of a package that is found, and one that an unknown package may find",
            {
                "CMakeLists.txt": "project(talker)\nfind_package(ament_cmake_ros REQUIRED)\n"
                "ament_add_gtest(walk walk.cpp)\n",
                "walk.cpp": "",
            },
        ),
        Example(
            "not found, next to other tools and libraries",
            {
                "CMakeLists.txt": "project(talker)\nfind_package(ament_cmake REQUIRED)\n"
                "find_package(Eigen3 REQUIRED)\nfind_package(rclcpp_action REQUIRED)\n"
                "find_package(ament_cmake_gtest REQUIRED)\n"
                "ament_add_pytest_test(talk test/test_talk.py)\n"
                "rclcpp_components_register_node(talk PLUGIN Talk EXECUTABLE talker)\n"
                "pluginlib_export_plugin_description_file(nav2_core plugins.xml)\n",
                "plugins.xml": "<library path='talk'/>\n",
            },
            "CMakeLists.txt:6:1: ament_add_pytest_test() is undefined without "
            "find_package(ament_cmake_pytest REQUIRED)",
            "CMakeLists.txt:7:1: rclcpp_components_register_node() is undefined without "
            "find_package(rclcpp_components REQUIRED)",
            "CMakeLists.txt:8:1: pluginlib_export_plugin_description_file() is undefined without "
            "find_package(pluginlib REQUIRED)",
        ),
        Example(
            "perhaps found by an unknown package",
            {"CMakeLists.txt": _LISTS.format("find_package(talk_common REQUIRED)\n")},
        ),
        Example(
            "launch tests",
            {
                "CMakeLists.txt": "project(talker)\nfind_package(ament_cmake_pytest REQUIRED)\n"
                "add_launch_test(test/test_talk.py)\n"
            },
            "3:1: add_launch_test() is undefined without find_package(launch_testing_ament_cmake "
            "REQUIRED)",
        ),
        Example("a command of ament", {"CMakeLists.txt": _CALL.format("ament_package")}),
        Example(
            "misspelled",
            {"CMakeLists.txt": _CALL.format("ament_pakage")},
            "3:1: unknown command ament_pakage(): CMake stops; did you mean ament_package()?",
        ),
        Example(
            "a command of catkin",
            {"CMakeLists.txt": _CALL.format("catkin_package")},
            "3:1: catkin_package() is a ROS 1 command: CMake stops; use ament_package",
        ),
        Example(
            "defined in an included file, which may find packages",
            {
                "CMakeLists.txt": _LISTS.format("include(cmake/tests.cmake)\nlook()\n"),
                "cmake/tests.cmake": "macro(look)\n  find_package(ament_cmake_pytest REQUIRED)\n"
                "endmacro()\n",
            },
        ),
        Example(
            "undefined, also in an included file",
            {
                "CMakeLists.txt": "project(talker)\nfind_package(ament_cmake REQUIRED)\n"
                "include(cmake/scripts.cmake)\nadd_script(talk.py)\n"
                "ament_add_pytest_test(talk test/test_talk.py)\n",
                "cmake/scripts.cmake": "macro(add_scripts)\n"
                "  install(PROGRAMS ${ARGN} DESTINATION lib/${PROJECT_NAME})\nendmacro()\n",
            },
            "CMakeLists.txt:4:1: unknown command add_script(): CMake stops; did you mean "
            "add_scripts()?",
            "CMakeLists.txt:5:1: ament_add_pytest_test() is undefined without "
            "find_package(ament_cmake_pytest REQUIRED)",
        ),
        Example("defined", {"CMakeLists.txt": _LISTS_TARGETS.format("talk")}),
        Example(
            "not defined",
            {"CMakeLists.txt": _LISTS_TARGETS.format("talks")},
            "3:27: undefined target 'talks'; did you mean 'talk'?",
        ),
        Example(
            "a Python script instead of a target",
            {
                "CMakeLists.txt": "project(talker)\n"
                "install(TARGETS talk listen DESTINATION lib/${PROJECT_NAME})\n",
                "talker/talk.py": "",
            },
            "CMakeLists.txt:2:17: undefined target 'talk': CMake stops",
            "CMakeLists.txt:2:22: undefined target 'listen': CMake stops",
        ),
        Example(
            "a target of an unknown command",
            {
                "CMakeLists.txt": "project(talker)\nfind_package(maker REQUIRED)\n"
                "make_some(talk)\ninstall(TARGETS talk DESTINATION lib/${PROJECT_NAME})\n"
            },
        ),
        Example(
            "a target of a package",
            {
                "CMakeLists.txt": _LISTS.format("find_package(rclcpp REQUIRED)\n").partition(
                    "ament"
                )[0]
                + "add_executable(talk talk.cpp)\n"
                "target_link_libraries(talk rclcpp::rclcpp rclcpp::rclcp)\n"
            },
            "4:43: rclcpp has no target 'rclcp'; did you mean 'rclcpp::rclcpp'?",
        ),
        Example(
            "not defined, but mentioned elsewhere",
            {"CMakeLists.txt": _LISTS_TARGETS.format("talks") + "message(STATUS talks)\n"},
            "3:27: undefined target 'talks'; did you mean 'talk'?",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_targets(package)
        cmake = package.cmake
        if cmake.includes_unknown:
            return
        yield from self._check_providers(package)
        if uses_ament(package):
            yield from self._check_names(cmake)

    def _check_providers(self, package: Package) -> Iterator[Diagnostic]:
        """Report the commands of packages that are not found."""
        cmake = package.cmake
        packages = {found_package.name for found_package in cmake.found_packages}
        tests: set[str] = set()
        if cmake.find("ament_lint_auto_find_test_dependencies") and package.has("package.xml"):
            tests = package.manifest.test_names
        if cmake.finds_automatically or cmake.finds_tests_automatically:
            return
        if cmake.has_unknown_packages:
            return
        brought = packages_found(package)
        if brought is None:
            return
        for name, providers in PROVIDERS.items():
            if name in cmake.defined or not (brought | tests).isdisjoint(providers):
                continue
            if name == "ament_package" and not packages.issubset(_WITHOUT_CORE):
                continue
            for command in filter(cmake.is_called, cmake.find(name)):
                message = f"{name}() is undefined without find_package({providers[0]} REQUIRED)"
                yield self.report(command.name_location, message)

    def _check_names(self, cmake: CMakeLists) -> Iterator[Diagnostic]:
        """Report misspelled commands, and those of catkin."""
        for command in cmake.commands:
            name = command.name
            if name in BUILT_IN or name in OF_AMENT or name in cmake.defined:
                continue
            if not cmake.is_called(command):
                continue
            successor = _OF_ROS1.get(name)
            if successor and command.parent is None:
                message = f"{name}() is a ROS 1 command: CMake stops; use {successor}"
                yield self.report(command.name_location, message)
            elif not successor:
                for closest in _closest(name, cmake.defined):
                    message = f"unknown command {name}(): CMake stops; did you mean {closest}()?"
                    yield self.report(command.name_location, message)

    def _check_targets(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        if has_unknown_commands(package) or cmake.find("function", "macro", "foreach"):
            return
        yield from self._check_imported(package)
        defined = defined_targets(cmake)
        if defined is None:
            return
        targets = sorted(defined)
        never_named = targets_named_once(cmake)
        for target, argument in never_named:
            closest = closest_name(package, target, targets, 0.75)
            hint = f"; did you mean {closest!r}?" if closest else ": CMake stops"
            yield self.report(argument, f"undefined target {target!r}{hint}")
        reported = {target for target, _ in never_named}
        for command in cmake.find(*TAKING_TARGETS):
            name = cmake.expand(command.arguments[0], command) if command.arguments else None
            if name is None or name in defined | reported or "::" in name or command.blocks:
                continue
            closest = closest_name(package, name, targets, 0.75)
            if closest:
                message = f"undefined target {name!r}; did you mean {closest!r}?"
                yield self.report(command.arguments[0], message)

    def _check_imported(self, package: Package) -> Iterator[Diagnostic]:
        """Report misspelled targets of packages, such as ``rclcpp::rclcp``."""
        for command in package.cmake.find("target_link_libraries"):
            for argument in command.arguments[1:]:
                owner, separator, name = argument.value.partition("::")
                if not separator or owner == name or not package.cmake.finds(owner):
                    continue
                if is_near(name, owner) and is_released(owner):
                    message = f"{owner} has no target {name!r}; did you mean '{owner}::{owner}'?"
                    yield self.report(argument, message)


def _closest(name: str, own: frozenset[str]) -> list[str]:
    """Return the command of which a name is a typo, if any."""
    if any(character.isdigit() for character in name):
        return []
    words = sorted(name.split("_"))
    swapped = [command for command in OF_AMENT if sorted(command.split("_")) == words]
    similar = get_close_matches(name, BUILT_IN | OF_AMENT | own, 1, 0.9)
    return swapped[:1] or [
        command for command in similar if abs(len(command) - len(name)) <= _MAX_LENGTH_DIFFERENCE
    ]
