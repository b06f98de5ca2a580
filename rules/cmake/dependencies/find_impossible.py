"""CM023: ``find_package`` names packages that exist and provide CMake files."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import get_close_matches

from scaffold.api import Diagnostic, Edit, Effect, Example, Fix, Location, Package, Report, Rule
from scaffold.api.catalog import similar_package
from scaffold.api.cmake import Argument, uses_ament
from scaffold.api.manifest import is_fetched

from ._pure_packages import PURE_PACKAGES

_LISTS = "project(talker)\nfind_package({} REQUIRED)\n"
_KEYWORDS = ("CONFIG", "EXACT", "MODULE", "NO_MODULE", "QUIET", "REQUIRED")


class FindImpossible(Rule):
    """``find_package`` names a package that is misspelled, or that is pure Python.

    **Why.** CMake stops: ``By not providing "Findstd_msg.cmake"``; for
    ``ament_export_dependencies``, in every package that finds this one. Packages of build type
    ament_python, and libraries from PyPI, install no CMake files.

    **Fix.** Correct the spelling; for a Python package, remove the line: ``<exec_depend>`` in
    package.xml is enough.

    **Source.** CMake documentation, ``find_package``; the packages' ``setup.py``.
    """

    code = "CM023"
    name = "find-impossible"
    effect = Effect.STOPS_BUILD
    examples = (
        Example("spelled right", {"CMakeLists.txt": _LISTS.format("std_msgs")}),
        Example(
            "a letter is missing",
            {"CMakeLists.txt": _LISTS.format("std_msg")},
            Report(
                "2:14",
                "unknown package 'std_msg'; did you mean 'std_msgs'?",
                fix="Replace with std_msgs",
            ),
            fixed={"CMakeLists.txt": _LISTS.format("std_msgs")},
        ),
        Example(
            "in ament_export_dependencies",
            {
                "CMakeLists.txt": _LISTS.format("std_msgs")
                + "ament_export_dependencies(std_msgs std_msg)\n"
            },
            Report(
                "3:36",
                "unknown package 'std_msg'; did you mean 'std_msgs'?",
                fix="Replace with std_msgs",
            ),
            fixed={
                "CMakeLists.txt": _LISTS.format("std_msgs")
                + "ament_export_dependencies(std_msgs std_msgs)\n"
            },
        ),
        Example(
            "in ament_target_dependencies",
            {
                "CMakeLists.txt": _LISTS.format("std_msgs")
                + "add_executable(talk talk.cpp)\nament_target_dependencies(talk std_msg)\n"
            },
            Report(
                "4:32",
                "unknown package 'std_msg'; did you mean 'std_msgs'?",
                fix="Replace with std_msgs",
            ),
            fixed={
                "CMakeLists.txt": _LISTS.format("std_msgs")
                + "add_executable(talk talk.cpp)\nament_target_dependencies(talk std_msgs)\n"
            },
        ),
        Example(
            "a misspelled keyword, and a component like one",
            {
                "CMakeLists.txt": "project(talker)\nfind_package(std_msgs REQURED)\n"
                "find_package(Talk REQUIRED REQUIRE)\n"
            },
            Report(
                "2:23",
                "unknown keyword 'REQURED': CMake stops; did you mean REQUIRED?",
                fix="Replace with REQUIRED",
            ),
            fixed={
                "CMakeLists.txt": "project(talker)\nfind_package(std_msgs REQUIRED)\n"
                "find_package(Talk REQUIRED REQUIRE)\n"
            },
        ),
        Example("a module of CMake", {"CMakeLists.txt": _LISTS.format("rclpy")}),
        Example(
            "pure Python",
            {"CMakeLists.txt": _LISTS.format("launch_ros")},
            "2:14: 'launch_ros' is a pure Python package without CMake files: CMake stops",
        ),
        Example(
            "a key of rosdep",
            {"CMakeLists.txt": _LISTS.format("python3-numpy")},
            "2:14: 'python3-numpy' is a pure Python package without CMake files: CMake stops",
        ),
        Example(
            "a ROS 1 package",
            {"CMakeLists.txt": _LISTS.format("ament_cmake") + "find_package(catkin REQUIRED)\n"},
            "3:14: 'catkin' is a ROS 1 package: CMake stops; use ament_cmake",
        ),
        Example(
            "the CMakeLists.txt of ROS 1 for a package of ROS 2",
            {
                "CMakeLists.txt": "project(talker)\nfind_package(catkin REQUIRED)\n"
                "catkin_package()\n",
                "package.xml": '<package format="3"><name>talker</name>'
                "<export><build_type>ament_cmake</build_type></export></package>\n",
            },
            "CMakeLists.txt:2:14: 'catkin' is a ROS 1 package: CMake stops; use ament_cmake",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_spelling(package)
        yield from self._check_python(package)
        yield from self._check_keywords(package)

    def _check_spelling(self, package: Package) -> Iterator[Diagnostic]:
        for item in package.cmake.found_packages:
            yield from self._judge(package, item.name, item.command.arguments[0], item.location)
        found_names = {found_package.name for found_package in package.cmake.found_packages}
        naming = package.cmake.find("ament_export_dependencies", "ament_target_dependencies")
        for command in naming:
            for argument in command.arguments[command.name == "ament_target_dependencies" :]:
                name = argument.value
                if name not in found_names and "$" not in name:
                    yield from self._judge(package, name, argument, argument.location)

    def _judge(
        self, package: Package, name: str, argument: Argument, at: Location
    ) -> Iterator[Diagnostic]:
        closest = similar_package(name)
        if closest is None or (closest == name.lower() and not _is_of_ros(closest)):
            return
        if package.workspace.get(name) is not None or is_fetched(package, name):
            return
        fix = None
        if argument.value == name:
            edit = Edit(argument.path, argument.start, argument.end, closest)
            fix = Fix(f"Replace with {closest}", (edit,))
        yield self.report(at, f"unknown package {name!r}; did you mean {closest!r}?", fix)

    def _check_keywords(self, package: Package) -> Iterator[Diagnostic]:
        for command in package.cmake.find("find_package"):
            for argument in command.arguments[1:]:
                word = argument.value
                closest = get_close_matches(word, _KEYWORDS, 1, 0.8) if word.isupper() else []
                if word in {"COMPONENTS", "OPTIONAL_COMPONENTS"} or word in _KEYWORDS:
                    continue
                if closest and not command.has("COMPONENTS") and not command.has(closest[0]):
                    message = f"unknown keyword {word!r}: CMake stops; did you mean {closest[0]}?"
                    edit = Edit(argument.path, argument.start, argument.end, closest[0])
                    yield self.report(argument, message, Fix(f"Replace with {closest[0]}", (edit,)))

    def _check_python(self, package: Package) -> Iterator[Diagnostic]:
        for call in package.cmake.found_packages:
            if not call.required or package.workspace.get(call.name) is not None:
                continue
            if call.name.startswith(("python3-", "python-")) or call.name in PURE_PACKAGES:
                message = f"{call.name!r} is a pure Python package without CMake files: CMake stops"
                yield self.report(call, message)
            elif call.name == "catkin" and call.command.depth == 0 and _is_for_ament(package):
                yield self.report(call, "'catkin' is a ROS 1 package: CMake stops; use ament_cmake")


def _is_for_ament(package: Package) -> bool:
    """Return whether CMakeLists.txt or package.xml uses ament."""
    is_declared = package.has("package.xml") and package.manifest.build_type == "ament_cmake"
    return is_declared or uses_ament(package)


def _is_of_ros(name: str) -> bool:
    """Return whether a package is one of ROS; libraries may have capital letters in CMake."""
    return name.startswith(("ament_", "rcl", "rosidl_")) or name.endswith(("_msgs", "_srvs"))
