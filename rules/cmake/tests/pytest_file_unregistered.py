"""CM026: every test file is registered."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule, Severity, ViewError

_REGISTER = "ament_add_pytest_test({0} test/{0}.py)\n"
_LISTS = "project(talker)\nfind_package(ament_cmake REQUIRED)\n{}ament_package()\n"
_TEST = "def test_talk():\n    pass\n"

_REGISTERING = ("ament_add_pytest_test", "ament_add_test", "add_test", "add_launch_test")


class PytestFileUnregistered(Rule):
    """A test file is not registered in CMakeLists.txt.

    **Why.** An ament_cmake package runs only registered tests: ``colcon test`` passes, but this
    test never runs.

    **Fix.** Add ``ament_add_pytest_test`` for the file.

    **Source.** ROS 2 documentation, "ament_cmake_python user documentation", "Testing".
    """

    code = "CM026"
    name = "pytest-file-unregistered"
    severity = Severity.WARNING
    examples = (
        Example(
            "registered",
            {
                "CMakeLists.txt": _LISTS.format(_REGISTER.format("test_talk")),
                "test/test_talk.py": _TEST,
            },
        ),
        Example(
            "registered with the whole directory",
            {
                "CMakeLists.txt": _LISTS.format(
                    "ament_add_pytest_test(pytest ${CMAKE_CURRENT_SOURCE_DIR}/test)\n"
                ),
                "test/test_talk.py": _TEST,
            },
        ),
        Example(
            "not registered",
            {"CMakeLists.txt": _LISTS.format(""), "test/test_talk.py": _TEST},
            "CMakeLists.txt:3:1: test/test_talk.py is not registered, so it never runs; add "
            "ament_add_pytest_test()",
        ),
        Example(
            "registered in a loop",
            {
                "CMakeLists.txt": "project(talker)\nfile(GLOB tests test/*.py)\n"
                "foreach(path ${tests})\n  get_filename_component(name ${path} NAME_WE)\n"
                "  ament_add_pytest_test(${name} ${path})\nendforeach()\nament_package()\n",
                "test/test_talk.py": "def test_talk():\n    pass\n",
            },
        ),
        Example(
            "left out of a loop",
            {
                "CMakeLists.txt": "project(talker)\nset(tests test_talk test_hear)\n"
                "foreach(name test_hear)\n"
                "  ament_add_pytest_test(${name} test/${name}.py)\nendforeach()\nament_package()\n",
                "test/test_hear.py": "def test_hear():\n    pass\n",
                "test/test_talks.py": "def test_talks():\n    pass\n",
            },
            "CMakeLists.txt:6:1: test/test_talks.py is not registered, so it never runs; add "
            "ament_add_pytest_test()",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        calls = cmake.find("ament_package")
        if not calls or cmake.find("add_subdirectory", "include", "function", "macro"):
            return
        arguments = [value for command in cmake.commands for value in command.values]
        for command in cmake.find(*_REGISTERING) if cmake.find("foreach") else ():
            for turn in cmake.turns(command):
                values = cmake.expand_list(command.arguments[:2], command, turn)
                if values is None:
                    return
                arguments += values
        for path in package.glob("test/test_*.py") + package.glob("tests/test_*.py"):
            directory, _, name = path.rpartition("/")
            if any(name in value or _names(value, directory) for value in arguments):
                continue
            stem = name.removesuffix(".py")
            if any(stem in value for value in arguments) or not self._has_tests(package, path):
                continue
            message = f"{path} is not registered, so it never runs; add ament_add_pytest_test()"
            yield self.report(calls[-1].name_location, message)

    def _has_tests(self, package: Package, path: str) -> bool:
        try:
            module = package.module(path)
        except ViewError:
            return False
        names = [*module.functions, *module.classes]
        return any(name.startswith(("test_", "Test")) for name in names)


def _names(value: str, directory: str) -> bool:
    """Return whether an argument is a directory: ``test``, ``${CMAKE_CURRENT_SOURCE_DIR}/test``."""
    return f"/{value.strip('/')}".endswith(f"/{directory}")
