"""CM095: tests and Python packages are registered once."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.cmake import Command

_NAMING = (
    "add_executable",
    "add_launch_test",
    "add_library",
    "ament_add_gmock",
    "ament_add_gtest",
    "ament_add_pytest_test",
    "ament_add_test",
    "ament_python_install_package",
)
_LAUNCH_TEST = "add_launch_test"
_LISTS = (
    "project(talker)\nament_add_pytest_test(talk test/test_talk.py)\n"
    "ament_add_pytest_test({} test/test_more.py)\n"
)
_FILES = {"test/test_talk.py": "", "test/test_more.py": ""}


class NameRegisteredTwice(Rule):
    """Two tests, targets or Python packages have one name.

    **Why.** CMake stops: ``add_test given test NAME "talk" which already exists in this
    directory``.

    **Fix.** Give each its own name, or remove the second call.

    **Source.** CMake documentation, ``add_test``; ``ament_cmake_python``,
    ``ament_python_install_package.cmake``.
    """

    code = "CM095"
    name = "name-registered-twice"
    examples = (
        Example("two names", {"CMakeLists.txt": _LISTS.format("more"), **_FILES}),
        Example(
            "one name",
            {"CMakeLists.txt": _LISTS.format("talk"), **_FILES},
            Report(
                "CMakeLists.txt:3:23",
                "ament_add_pytest_test(talk) is already called in line 2: CMake stops",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        seen: dict[tuple[str, str], Command] = {}
        for command in cmake.find(*_NAMING):
            if not command.arguments or command.name == _LAUNCH_TEST or self._may_skip(command):
                continue
            if "ALIAS" in command.values:
                continue
            name = cmake.expand(command.arguments[0], command)
            group = "target" if command.name.startswith("add_") else command.name
            group = "test" if "test" in command.name else group
            if name is None:
                continue
            first = seen.setdefault((group, name), command)
            if first is not command:
                line = first.location.line
                message = f"{command.name}({name}) is already called in line {line}: CMake stops"
                yield self.report(command.arguments[0], message)

    def _may_skip(self, command: Command) -> bool:
        """Tell whether a command is in one of several branches, or in a loop or function."""
        return any(
            block.name != "if" or "BUILD_TESTING" not in block.values for block in command.blocks
        )
