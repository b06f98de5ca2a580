"""CM002: ``ament_package()`` is called."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule
from scaffold.api.cmake import PACKAGE_COMMANDS, has_unknown_commands, uses_ament

_LISTS = (
    "cmake_minimum_required(VERSION 3.8)\nproject(talker)\nfind_package(ament_cmake REQUIRED)\n"
)
_CALL = "ament_package()\n"


class AmentPackageMissing(Rule):
    """CMakeLists.txt does not call ``ament_package()``.

    **Why.** The build passes, but the package is not in the ament index: ``ros2 run`` answers
    ``Package 'talker' not found``.

    **Fix.** Add ``ament_package()`` as the last call.

    **Source.** ROS 2 documentation, "ament_cmake user documentation".
    """

    code = "CM002"
    name = "ament-package-missing"
    examples = (
        Example("called", {"CMakeLists.txt": _LISTS + _CALL}),
        Example(
            "forgotten",
            {"CMakeLists.txt": _LISTS},
            Report(
                "CMakeLists.txt:3:1",
                "no ament_package() at the end: `ros2` does not find the package",
                fix="call ament_package()",
            ),
            fixed={"CMakeLists.txt": f"{_LISTS}\n{_CALL}"},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        if package.build_type == "cmake" or not uses_ament(package):
            return
        if cmake.find(*PACKAGE_COMMANDS) or has_unknown_commands(package):
            return
        last = cmake.commands[-1]
        end = len(cmake.source.text)
        text = f"{cmake.source.newline}ament_package(){cmake.source.newline}"
        lead = "" if cmake.source.text.endswith("\n") else cmake.source.newline
        fix = Fix("call ament_package()", (Edit("CMakeLists.txt", end, end, lead + text),))
        message = "no ament_package() at the end: `ros2` does not find the package"
        yield self.report(last.name_location, message, fix)
