"""CM109: nothing returns before ``ament_package()``."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule

_LISTS = "project(talker)\nfind_package(ament_cmake REQUIRED)\n{}install(FILES a DESTINATION b)\n"


class ReturnBeforeAmentPackage(Rule):
    """``return()`` stands before ``ament_package()``, and no condition around it.

    **Why.** CMake reads no further: nothing after it is built or installed, and the package is
    in no index. ``colcon build`` says that all is well; ``Package 'talker' not found``.

    **Fix.** Remove the call, or write the condition that it is for around it.

    **Source.** CMake documentation, ``return``.
    """

    code = "CM109"
    name = "return-before-ament-package"
    examples = (
        Example(
            "under a condition, in a function",
            {
                "CMakeLists.txt": _LISTS.format(
                    "if(WIN32)\n  return()\nendif()\nfunction(stop)\n  return()\nendfunction()\n"
                )
                + "ament_package()\n"
            },
        ),
        Example(
            "at the end", {"CMakeLists.txt": f"{_LISTS.format('')}ament_package()\nreturn()\n"}
        ),
        Example(
            "in between",
            {"CMakeLists.txt": _LISTS.format("return()\n") + "ament_package()\n"},
            Report(
                "CMakeLists.txt:3:1",
                "CMake reads no further than here: ament_package() of line 5 is not called",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        calls = cmake.find("ament_package")
        before = [call for call in calls if not call.blocks]
        for command in cmake.find("return"):
            if command.blocks or not before or command.index > before[0].index:
                continue
            if calls[0].index > command.index:
                line = before[0].location.line
                message = f"CMake reads no further than here: ament_package() of line {line} is not"
                yield self.report(command.name_location, f"{message} called")
            return
