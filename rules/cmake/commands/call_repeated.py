"""CM095: names of tests and targets are unique, and no call is repeated."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from itertools import dropwhile

from scaffold.api import Diagnostic, Edit, Effect, Example, Fix, Package, Report, Rule, Severity
from scaffold.api.cmake import Command, generations, is_interface_package
from scaffold.api.distributions import target

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
_FIND = "find_package(rclcpp REQUIRED)\n"
_LISTS_INTERFACES = (
    "project(my_robot)\nrosidl_generate_interfaces(${PROJECT_NAME} msg/Beat.msg)\n"
    "ament_python_install_package(%s)\n"
)
_FILES_INTERFACES = {"msg/Beat.msg": "int32 count\n", "my_robot/__init__.py": ""}


class CallRepeated(Rule):
    """A test, target or Python package has the name of another, or a call is repeated.

    **Why.** CMake stops: ``add_test given test NAME "talk" which already exists in this
    directory``. Up to Kilted, it also stops at a Python package with the same name as the generated
    interfaces: the target ``ament_cmake_python_copy_my_robot`` already exists. A second
    ``ament_package()`` writes the index entry and the configuration files again. A second
    ``find_package`` does nothing, and is easily missed when the dependency is removed.

    **Fix.** Give each a unique name, or remove the second call; keep the last ``ament_package()``.
    Move interfaces to a separate package, such as ``my_robot_msgs``.

    **Source.** CMake documentation, ``add_test``; ``ament_python_install_package.cmake``; ROS 2
    documentation, "ament_cmake user documentation": "exactly once"; catkin_lint, "duplicate
    find_package"; https://github.com/ros2/rosidl_python/issues/141.
    """

    code = "CM095"
    name = "call-repeated"
    effect = Effect.STOPS_BUILD
    other_severities = {Severity.WARNING: "the call is ``find_package``"}
    examples = (
        Example(
            "a name with and without the variable of the loop",
            {
                "CMakeLists.txt": "project(talker)\nforeach(name talk listen)\n"
                "  ament_add_pytest_test(${name} test/${name}.py)\n"
                "  ament_add_pytest_test(all test/${name}.py)\nendforeach()\n"
            },
            "4:25: ament_add_pytest_test(all) is called in every iteration of the loop: CMake "
            "stops",
        ),
        Example("two names", {"CMakeLists.txt": _LISTS.format("more"), **_FILES}),
        Example(
            "two tests with the same name",
            {"CMakeLists.txt": _LISTS.format("talk"), **_FILES},
            "CMakeLists.txt:3:23: ament_add_pytest_test(talk) is already called in line 2: CMake "
            "stops",
        ),
        Example(
            "ament_package() in two branches",
            {
                "CMakeLists.txt": "project(talker)\n"
                "if(WIN32)\n  ament_package()\n  return()\nendif()\nament_package()\n"
            },
        ),
        Example(
            "ament_package() twice",
            {"CMakeLists.txt": "project(talker)\nament_package()\nament_package()\n"},
            "3:1: ament_package() is already called in line 2",
        ),
        Example(
            "a package found twice",
            {"CMakeLists.txt": f"project(talker)\n{_FIND}{_FIND}"},
            Report(
                "3:1",
                "'rclcpp' is already found in line 2",
                fix="Remove the second call",
                severity=Severity.WARNING,
            ),
            fixed={"CMakeLists.txt": f"project(talker)\n{_FIND}"},
        ),
        Example(
            "another name",
            {"CMakeLists.txt": _LISTS_INTERFACES % "my_robot_tools", **_FILES_INTERFACES},
        ),
        Example(
            "the same name on a distribution that merges both",
            {"CMakeLists.txt": _LISTS_INTERFACES % "${PROJECT_NAME}", **_FILES_INTERFACES},
            distro="lyrical",
        ),
        Example(
            "the same name",
            {"CMakeLists.txt": _LISTS_INTERFACES % "${PROJECT_NAME}", **_FILES_INTERFACES},
            "CMakeLists.txt:3:1: the Python package 'my_robot' has the name of the interfaces "
            "generated in line 2: CMake stops; move the interfaces to a separate package",
        ),
        Example(
            "two files of one name in a loop over tests",
            {
                "CMakeLists.txt": "project(talker)\nif(BUILD_TESTING)\n"
                "  foreach(path test/test_a.py test/test_b.py test/slow/test_a.py)\n"
                "    get_filename_component(name ${path} NAME_WE)\n"
                "    ament_add_pytest_test(${name} ${path})\n  endforeach()\nendif()\n"
            },
            "5:27: ament_add_pytest_test(test_a) is called in 2 iterations of the loop: CMake "
            "stops",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_interfaces(package)
        yield from self._check_names(package)
        yield from self._check_loops(package)
        yield from self._check_exports(package)
        yield from self._check_finds(package)

    def _check_names(self, package: Package) -> Iterator[Diagnostic]:
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
            if first is not command and first.path == command.path:
                line = first.location.line
                message = f"{command.name}({name}) is already called in line {line}: CMake stops"
                yield self.report(command.arguments[0], message)

    def _check_loops(self, package: Package) -> Iterator[Diagnostic]:
        """Report names of tests and targets that are the same in iterations of a loop."""
        cmake = package.cmake
        for command in cmake.find(*_NAMING):
            inner = [*dropwhile(lambda block: block.name == "if", command.blocks)]
            if not command.arguments or {block.name for block in inner} != {"foreach"}:
                continue
            first, turns = command.arguments[0], cmake.turns(command)
            names = [cmake.expand(first, command, turn) for turn in turns]
            name, times = Counter(names).most_common(1)[0] if names else (None, 0)
            if times > 1 and None not in names and command.name != _LAUNCH_TEST:
                how = "every iteration" if times == len(names) else f"{times} iterations"
                message = f"{command.name}({name}) is called in {how} of the loop: CMake stops"
                yield self.report(first, message)

    def _may_skip(self, command: Command) -> bool:
        """Return whether a command is in one of several branches, or in a loop or function."""
        return any(
            block.name != "if" or "BUILD_TESTING" not in block.values for block in command.blocks
        )

    def _check_exports(self, package: Package) -> Iterator[Diagnostic]:
        calls = [call for call in package.cmake.find("ament_package") if not call.blocks]
        for call in calls[1:]:
            line = calls[0].location.line
            yield self.report(
                call.name_location, f"ament_package() is already called in line {line}"
            )

    def _check_finds(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        first: dict[tuple[str, ...], int] = {}
        for command in cmake.find_own("find_package"):
            values = tuple(command.values)
            if not values or command.blocks or "$" in values[0]:
                continue
            line = command.location.line
            if values not in first:
                first[values] = line
                continue
            start = cmake.source.offset(line)
            end = cmake.source.offset(command.location.end_line + 1)
            text = cmake.source.text[start:end]
            alone = text.strip() == cmake.source.text[command.start : command.end]
            fix = (
                Fix("Remove the second call", (Edit("CMakeLists.txt", start, end, ""),))
                if alone
                else None
            )
            message = f"{values[0]!r} is already found in line {first[values]}"
            yield self.report(command.name_location, message, fix, severity=Severity.WARNING)

    def _check_interfaces(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        may_be = target().fact("build.package_may_be_installed_twice")
        if not is_interface_package(package) or may_be:
            return
        line = generations(package)[0].command.location.line
        for command in cmake.find("ament_python_install_package"):
            name = cmake.expand(command.arguments[0], command) if command.arguments else None
            if name is not None and name == cmake.project_name:
                message = (
                    f"the Python package {name!r} has the name of the interfaces generated in "
                    f"line {line}: CMake stops; move the interfaces to a separate package"
                )
                yield self.report(command.name_location, message)
