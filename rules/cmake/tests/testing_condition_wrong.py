"""CM098: tests, and only tests, depend on ``BUILD_TESTING``."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule
from scaffold.api.cmake import CMakeLists, Command
from scaffold.api.launch import DATA_DIRECTORIES

_TESTS = ("ament_lint_auto_find_test_dependencies", "ament_add_pytest_test", "ament_add_gtest")
_LISTS = (
    "project(talker)\nif({})\n  find_package(ament_lint_auto REQUIRED)\n"
    "  ament_lint_auto_find_test_dependencies()\nendif()\n"
)
_LISTS_LOOP = (
    "project(talker)\ninclude(cmake/macros.cmake)\nif({})\n  foreach(name talk listen)\n"
    "    ament_add_pytest_test(${{name}} test/${{name}}.py)\n  endforeach()\nendif()\n"
)
_NODE = "#!/usr/bin/env python3\nimport rclpy\n\nif __name__ == '__main__':\n    rclpy.init()\n"
_INSTALL = "install(PROGRAMS talker/node.py DESTINATION lib/${PROJECT_NAME})\n"
_LISTS_NODES = "project(talker)\n{}ament_package()\n"
_LISTS_LAUNCH = (
    "project(talker)\n{}if(BUILD_TESTING)\n"
    "  install(DIRECTORY launch test DESTINATION share/${{PROJECT_NAME}})\nendif()\n"
)
_FOR_USERS = frozenset({"launch", *DATA_DIRECTORIES})
"""Directories whose files nodes and users need, not only tests."""


class TestingConditionWrong(Rule):
    """Tests depend on a variable that is never set, or a node is installed only with the tests.

    **Why.** The block is never executed: ``colcon test`` runs no tests and passes. Releases are
    built with ``BUILD_TESTING`` off: users get ``No executable found``.

    **Fix.** Write ``if(BUILD_TESTING)``, and move the ``install`` of nodes out of it.

    **Source.** CMake documentation, ``CTest``; ROS 2 documentation, "ament_cmake user
    documentation", testing, "Migrating from ROS 1".
    """

    code = "CM098"
    name = "testing-condition-wrong"
    examples = (
        Example(
            "tests under the variable of CTest", {"CMakeLists.txt": _LISTS.format("BUILD_TESTING")}
        ),
        Example(
            "tests under the variable of catkin",
            {"CMakeLists.txt": _LISTS.format("CATKIN_ENABLE_TESTING")},
            Report(
                "2:4",
                "CATKIN_ENABLE_TESTING is never set, so the tests below never run; did "
                "you mean BUILD_TESTING?",
                fix="Replace CATKIN_ENABLE_TESTING with BUILD_TESTING",
            ),
            fixed={"CMakeLists.txt": _LISTS.format("BUILD_TESTING")},
        ),
        Example(
            "tests in a loop, although an included file only defines macros",
            {
                "CMakeLists.txt": _LISTS_LOOP.format("BUILD_TESTS"),
                "cmake/macros.cmake": "macro(talk)\nendmacro()\n",
            },
            Report(
                "CMakeLists.txt:3:4",
                "BUILD_TESTS is never set, so the tests below never run; did you mean "
                "BUILD_TESTING?",
                fix="Replace BUILD_TESTS with BUILD_TESTING",
            ),
            fixed={"CMakeLists.txt": _LISTS_LOOP.format("BUILD_TESTING")},
        ),
        Example(
            "tests under a variable that an included file sets",
            {
                "CMakeLists.txt": "project(talker)\ninclude(cmake/tests.cmake)\nif(BUILD_TESTS)\n"
                "  ament_add_pytest_test(talk test/talk.py)\nendif()\n",
                "cmake/tests.cmake": "set(BUILD_TESTS ON)\n",
            },
        ),
        Example(
            "a node that is always installed",
            {"CMakeLists.txt": _LISTS_NODES.format(_INSTALL), "talker/node.py": _NODE},
        ),
        Example(
            "a node that is installed with the tests",
            {
                "CMakeLists.txt": _LISTS_NODES.format(f"if(BUILD_TESTING)\n{_INSTALL}endif()\n"),
                "talker/node.py": _NODE,
            },
            "CMakeLists.txt:3:18: talker/node.py is installed only if tests are built: releases "
            "do not contain it",
        ),
        Example(
            "a package that installs nothing without tests",
            {
                "package.xml": "<package><name>talker</name></package>\n",
                "CMakeLists.txt": _LISTS_LAUNCH.format(""),
                "launch/a.launch.py": "",
            },
        ),
        Example(
            "directories that releases lack, and one only for tests",
            {
                "package.xml": "<package><name>talker</name></package>\n",
                "CMakeLists.txt": _LISTS_LAUNCH.format(_INSTALL),
                "launch/a.launch.py": "",
                "talker/node.py": _NODE,
                "test/test_a.py": "",
            },
            "CMakeLists.txt:4:21: launch/ is installed only if tests are built: releases do not "
            "contain it",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_tests(package)
        yield from self._check_installed(package)

    def _check_tests(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        if cmake.includes_unknown:
            return
        conditions = {
            branch.start: branch for command in _tests(cmake) for branch in _outermost(command)
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
            edit = Edit(argument.path, argument.start, argument.end, "BUILD_TESTING")
            message = (
                f"{name} is never set, so the tests below never run; did you mean BUILD_TESTING?"
            )
            yield self.report(argument, message, Fix(f"Replace {name} with BUILD_TESTING", (edit,)))

    def _check_installed(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        with_tests = [x for x in cmake.installs if cmake.guarded_by_testing(x.command)]
        has_others = len(cmake.installs) > len(with_tests)
        for install in with_tests:
            for item in install.items:
                path = item.path or ""
                is_for_users = has_others and install.kind == "DIRECTORY" and path in _FOR_USERS
                if is_for_users and install.destination == f"share/{package.name}":
                    message = (
                        f"{path}/ is installed only if tests are built: releases do not contain it"
                    )
                    yield self.report(item, message)
                if install.kind != "PROGRAMS":
                    continue
                if path not in package.python_files or path.startswith("test"):
                    continue
                module = package.module(path)
                if "rclpy" in module.imports_by_root and not module.in_tests:
                    message = (
                        f"{path} is installed only if tests are built: releases do not contain it"
                    )
                    yield self.report(item, message)


def _tests(cmake: CMakeLists) -> list[Command]:
    """Return the commands that define tests, also those that call a function that does."""
    around = {block for command in cmake.find(*_TESTS) for block in command.blocks}
    functions = [block for block in around if block.name in {"function", "macro"} and block.values]
    return cmake.find(*_TESTS, *{block.values[0].lower() for block in functions})


def _outermost(command: Command) -> Iterator[Command]:
    """Yield the branch of the outermost block around a command, except in a function."""
    blocks = command.blocks
    if any(block.name in {"function", "macro"} for block in blocks):
        return
    for inner in (*blocks[1:2], command)[:1]:
        if inner.branch is not None:
            yield inner.branch
