"""CM094: CMakeLists.txt names its project."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, Package, Report, Rule
from scaffold.api.cmake import uses_ament

_LISTS = (
    "cmake_minimum_required(VERSION 3.8)\n{}find_package(ament_cmake REQUIRED)\nament_package()\n"
)


class ProjectMissing(Rule):
    """There is no ``project(...)``.

    **Why.** CMake stops at ``ament_package()``, as the name of the project is not that of the
    package: it invents ``Project``.

    **Fix.** Write ``project(<name of the package>)`` after ``cmake_minimum_required``.

    **Source.** ``ament_cmake_core/cmake/core/ament_package.cmake``.
    """

    code = "CM094"
    name = "project-missing"
    effect = Effect.STOPS_BUILD
    examples = (
        Example("named", {"CMakeLists.txt": _LISTS.format("project(talker)\n")}),
        Example(
            "missing",
            {"CMakeLists.txt": _LISTS.format("")},
            Report("1:1", "no project(): CMake stops at ament_package()"),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        if cmake.project is None and cmake.commands and not cmake.find("include"):
            if not uses_ament(package):
                return
            message = f"no project({package.name}): CMake stops at ament_package()"
            yield self.report(cmake.commands[0].name_location, message)
