"""CM098: tests are registered under a condition that is true when tests are built."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule

_TESTS = ("ament_lint_auto_find_test_dependencies", "ament_add_pytest_test", "ament_add_gtest")
_LISTS = (
    "project(talker)\nif({})\n  find_package(ament_lint_auto REQUIRED)\n"
    "  ament_lint_auto_find_test_dependencies()\nendif()\n"
)


class TestingConditionUnset(Rule):
    """Tests are registered under a variable that nothing sets.

    **Why.** The block is never entered: ``colcon test`` runs no test, and says nothing.

    **Fix.** Write ``if(BUILD_TESTING)``.

    **Source.** CMake documentation, ``CTest``; ROS 2 documentation, "Migrating from ROS 1".
    """

    code = "CM098"
    name = "testing-condition-unset"
    examples = (
        Example("the variable of CTest", {"CMakeLists.txt": _LISTS.format("BUILD_TESTING")}),
        Example(
            "that of catkin",
            {"CMakeLists.txt": _LISTS.format("CATKIN_ENABLE_TESTING")},
            Report(
                "2:4",
                "nothing sets CATKIN_ENABLE_TESTING, so the tests below never run; "
                "closest: BUILD_TESTING",
                fix="write BUILD_TESTING",
            ),
            fixed={"CMakeLists.txt": _LISTS.format("BUILD_TESTING")},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        if cmake.find("include"):
            return
        conditions = {
            command.branch.start: command.branch
            for command in cmake.find(*_TESTS)
            if command.branch is not None and command.depth == 1
        }
        for condition in conditions.values():
            if condition.name != "if" or len(condition.arguments) != 1:
                continue
            argument = condition.arguments[0]
            name = argument.value
            if "TEST" not in name.upper() or name == "BUILD_TESTING" or not name.isidentifier():
                continue
            if any(name in item.values for item in cmake.commands if item is not condition):
                continue
            edit = Edit("CMakeLists.txt", argument.start, argument.end, "BUILD_TESTING")
            message = f"nothing sets {name}, so the tests below never run; closest: BUILD_TESTING"
            yield self.report(argument, message, Fix("write BUILD_TESTING", (edit,)))
