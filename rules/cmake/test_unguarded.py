"""CM029: tests are registered for test builds only."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule

COMMANDS = (
    "ament_add_gmock",
    "ament_add_gtest",
    "ament_add_pytest_test",
    "ament_add_test",
    "ament_lint_auto_find_test_dependencies",
    "add_launch_test",
    "add_ros_test",
)
_TEST = "ament_add_pytest_test(talk test/test_talk.py)\n"


class TestUnguarded(Rule):
    """A test is registered outside of ``if(BUILD_TESTING)``.

    **Why.** A release build finds no test packages: CMake stops at an unknown command.

    **Fix.** Move it into ``if(BUILD_TESTING)``.

    **Source.** ROS 2 documentation, "ament_cmake user documentation", "Testing and linting".
    """

    code = "CM029"
    name = "test-unguarded"
    examples = (
        Example(
            "guarded", {"CMakeLists.txt": f"project(talker)\nif(BUILD_TESTING)\n  {_TEST}endif()\n"}
        ),
        Example(
            "not guarded",
            {"CMakeLists.txt": f"project(talker)\n{_TEST}"},
            Report(
                "CMakeLists.txt:2:1", "ament_add_pytest_test() stands outside of if(BUILD_TESTING)"
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for command in package.cmake.find(*COMMANDS):
            if command.blocks or package.cmake.guarded_by_testing(command):
                continue
            message = f"{command.name}() stands outside of if(BUILD_TESTING)"
            yield self.report(command.name_location, message)
