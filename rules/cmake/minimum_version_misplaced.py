"""CM005: CMakeLists.txt begins with ``cmake_minimum_required``."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity

_MINIMUM = "cmake_minimum_required(VERSION 3.8)\n"


class MinimumVersionMisplaced(Rule):
    """``cmake_minimum_required`` does not come before ``project``.

    **Why.** CMake sets its policies by it: ``project`` runs with those of another version, and
    warns; without any the build stops on newer versions.

    **Fix.** Begin with ``cmake_minimum_required(VERSION 3.8)``.

    **Source.** CMake documentation, ``cmake_minimum_required``; ROS 2 documentation,
    "ament_cmake user documentation".
    """

    code = "CM005"
    name = "minimum-version-misplaced"
    severity = Severity.WARNING
    examples = (
        Example("first", {"CMakeLists.txt": f"{_MINIMUM}project(talker)\n"}),
        Example(
            "after project",
            {"CMakeLists.txt": f"project(talker)\n{_MINIMUM}"},
            Report(
                "CMakeLists.txt:1:1",
                "cmake_minimum_required() of line 2 belongs in front of project()",
            ),
        ),
        Example(
            "none",
            {"CMakeLists.txt": "project(talker)\n"},
            Report(
                "CMakeLists.txt:1:1", "no cmake_minimum_required(VERSION ...) in front of project()"
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        project = cmake.project
        minimum = cmake.find("cmake_minimum_required")
        if project is None or (cmake.find("include") and not minimum):
            return
        if not minimum:
            message = "no cmake_minimum_required(VERSION ...) in front of project()"
            yield self.report(project.name_location, message)
        elif minimum[0].index > project.index:
            line = minimum[0].location.line
            message = f"cmake_minimum_required() of line {line} belongs in front of project()"
            yield self.report(project.name_location, message)
