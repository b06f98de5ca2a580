"""CM003: ``ament_package()`` comes last."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, Package, Report, Rule, Severity
from scaffold.api.cmake import Command

_LINTERS = "ament_lint_auto_find_test_dependencies"
FATAL = (
    "ament_export_definitions",
    "ament_export_dependencies",
    "ament_export_include_directories",
    "ament_export_interfaces",
    "ament_export_libraries",
    "ament_export_library_names",
    "ament_export_link_flags",
    "ament_export_targets",
    "ament_environment_hooks",
    _LINTERS,
    "ament_python_install_package",
    "ament_python_install_module",
    "pluginlib_export_plugin_description_file",
    "rclcpp_components_register_node",
    "rclcpp_components_register_nodes",
    "rosidl_generate_interfaces",
)
_INSTALL = "install(DIRECTORY launch DESTINATION share/${PROJECT_NAME})\n"
_LISTS = "project(talker)\nfind_package(ament_cmake REQUIRED)\n"


class AmentPackageNotLast(Rule):
    """A call that has to come before ``ament_package()`` comes after it.

    **Why.** CMake stops at exports, interfaces and ``find_package(ament_lint_auto)`` that come
    later. A Python package, plugin or linter is never registered, because ``ament_package()``
    registers it. ``install()`` still works there.

    **Fix.** Move ``ament_package()`` to the end. No automatic fix: comments would be separated from
    their code.

    **Source.** ROS 2 documentation, "ament_cmake user documentation"; ``ament_cmake_export_*``.
    """

    code = "CM003"
    name = "ament-package-not-last"
    effect = Effect.STOPS_BUILD
    other_severities = {
        Severity.WARNING: "linters are registered too late to run",
        Severity.INFO: "the call is ``install()``",
    }
    examples = (
        Example(
            "last", {"CMakeLists.txt": f"{_LISTS}ament_export_libraries(talker)\nament_package()\n"}
        ),
        Example(
            "an export after it",
            {"CMakeLists.txt": f"{_LISTS}ament_package()\nament_export_libraries(talker)\n"},
            "4:1: ament_export_libraries() comes after ament_package() in line 3",
        ),
        Example(
            "interfaces after it",
            {
                "CMakeLists.txt": f"{_LISTS}ament_package()\n"
                "rosidl_generate_interfaces(talker msg/A.msg)\n"
            },
            "4:1: rosidl_generate_interfaces() comes after ament_package() in line 3",
        ),
        Example(
            "linters after it",
            {
                "CMakeLists.txt": f"{_LISTS}ament_package()\nif(BUILD_TESTING)\n"
                "  find_package(ament_lint_auto REQUIRED)\n"
                "  ament_lint_auto_find_test_dependencies()\nendif()\n"
            },
            "6:3: ament_lint_auto_find_test_dependencies() comes after ament_package() in line 3",
        ),
        Example(
            "linters that are found before it and registered after it",
            {
                "CMakeLists.txt": f"{_LISTS}find_package(ament_lint_auto REQUIRED)\n"
                "ament_package()\nif(BUILD_TESTING)\n"
                "  ament_lint_auto_find_test_dependencies()\nendif()\n"
            },
            Report(
                "6:3",
                "ament_lint_auto_find_test_dependencies() comes after ament_package() in line 4: "
                "no linter runs",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "install() before it",
            {"CMakeLists.txt": f"project(talker)\n{_INSTALL}ament_package()\n"},
        ),
        Example(
            "install() after it",
            {"CMakeLists.txt": f"project(talker)\nament_package()\n{_INSTALL}{_INSTALL}"},
            Report(
                "3:1",
                "install() comes after ament_package() in line 2, and 1 more",
                severity=Severity.INFO,
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        calls = [call for call in package.cmake.find("ament_package") if not call.blocks]
        if not calls:
            return
        line = calls[0].location.line
        for command in package.cmake.find(*FATAL):
            if command.index > calls[0].index:
                message = f"{command.name}() comes after ament_package() in line {line}"
                severity = Severity.ERROR
                if command.name == _LINTERS and not _finds_linters(package, calls[0]):
                    severity, message = Severity.WARNING, f"{message}: no linter runs"
                yield self.report(command.name_location, message, severity=severity)
        later = [call for call in package.cmake.find("install") if call.index > calls[0].index]
        if later:
            more = f", and {len(later) - 1} more" if len(later) > 1 else ""
            message = f"install() comes after ament_package() in line {line}{more}"
            yield self.report(later[0].name_location, message, severity=Severity.INFO)


def _finds_linters(package: Package, last: Command) -> bool:
    """Return whether linters are searched for after ``ament_package()``, where CMake fails."""
    return any(
        command.index > last.index and command.values[:1] == ["ament_lint_auto"]
        for command in package.cmake.find("find_package")
    )
