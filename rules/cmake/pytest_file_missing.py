"""CM025: registered tests exist."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, Package, Report, Rule, closest_name

COMMANDS = ("ament_add_pytest_test", "add_launch_test", "add_ros_test")
_LISTS = "project(talker)\nament_add_pytest_test(talk test/{})\n"


class PytestFileMissing(Rule):
    """A registered test file does not exist.

    **Why.** CMake or the test stops: ``file or directory not found``.

    **Fix.** Write the name of the file.

    **Source.** ``ament_cmake_pytest/cmake/ament_add_pytest_test.cmake``.
    """

    code = "CM025"
    name = "pytest-file-missing"
    effect = Effect.STOPS_BUILD
    examples = (
        Example(
            "there", {"CMakeLists.txt": _LISTS.format("test_talk.py"), "test/test_talk.py": ""}
        ),
        Example(
            "not there",
            {"CMakeLists.txt": _LISTS.format("test_talks.py"), "test/test_talk.py": ""},
            Report(
                "CMakeLists.txt:2:28",
                "there is no test file test/test_talks.py; closest: test/test_talk.py",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        for command in cmake.find(*COMMANDS):
            position = 1 if command.name == "ament_add_pytest_test" else 0
            if len(command.arguments) <= position:
                continue
            argument = command.arguments[position]
            value = cmake.expand(argument, command)
            if value is None or value.startswith(("/", "..", "$")) or "<" in value:
                continue
            path = cmake.path_of(value)
            if package.has(path) or package.has_directory(path):
                continue
            closest = closest_name(package, path, package.python_files, 0.7)
            hint = f"; closest: {closest}" if closest else ""
            yield self.report(argument, f"there is no test file {path}{hint}")
