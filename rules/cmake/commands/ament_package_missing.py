"""CM002: CMakeLists.txt calls ``ament_package()``."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Effect, Example, Fix, Package, Report, Rule
from scaffold.api.cmake import PACKAGE_COMMANDS, has_unknown_commands, uses_ament

_LISTS = (
    "cmake_minimum_required(VERSION 3.8)\nproject(talker)\nfind_package(ament_cmake REQUIRED)\n"
)
_RETURN = "project(talker)\nfind_package(ament_cmake REQUIRED)\n{}install(FILES a DESTINATION b)\n"
_CALL = "ament_package()\n"


class AmentPackageMissing(Rule):
    """CMakeLists.txt does not call ``ament_package()``, or returns before it.

    **Why.** The build succeeds, but the package is not in the ament index: ``ros2 run`` fails with
    ``Package 'talker' not found``. Nothing after ``return()`` is built or installed.

    **Fix.** Add ``ament_package()`` as the last call; move ``return()`` into the ``if()`` that it
    belongs to.

    **Source.** ROS 2 documentation, "ament_cmake user documentation"; CMake documentation,
    ``return``.
    """

    code = "CM002"
    name = "ament-package-missing"
    effect = Effect.STOPS_PACKAGE
    examples = (
        Example("called", {"CMakeLists.txt": _LISTS + _CALL}),
        Example(
            "called by a macro of an included file",
            {
                "CMakeLists.txt": f"{_LISTS}include(cmake/finish.cmake)\nfinish()\n",
                "cmake/finish.cmake": f"macro(finish)\n  {_CALL}endmacro()\n",
            },
        ),
        Example(
            "not called, also not by a macro of an included file",
            {
                "CMakeLists.txt": f"{_LISTS}include(cmake/scripts.cmake)\nscripts(a.py)\n",
                "cmake/scripts.cmake": "macro(scripts)\n"
                "  install(PROGRAMS ${ARGN} DESTINATION lib/${PROJECT_NAME})\nendmacro()\n",
            },
            Report(
                "CMakeLists.txt:5:1",
                "no ament_package() at the end: `ros2 run` and `ros2 launch` do not "
                "find the package; add it",
                fix="Add ament_package()",
            ),
            fixed={
                "CMakeLists.txt": f"{_LISTS}include(cmake/scripts.cmake)\nscripts(a.py)\n\n{_CALL}"
            },
        ),
        Example(
            "not called",
            {"CMakeLists.txt": _LISTS},
            Report(
                "3:1",
                "no ament_package() at the end: `ros2 run` and `ros2 launch` do not find the "
                "package; add it",
                fix="Add ament_package()",
            ),
            fixed={"CMakeLists.txt": f"{_LISTS}\n{_CALL}"},
        ),
        Example(
            "a conditional return(), and one in a function",
            {
                "CMakeLists.txt": _RETURN.format(
                    "if(WIN32)\n  return()\nendif()\nfunction(stop)\n  return()\nendfunction()\n"
                )
                + "ament_package()\n"
            },
        ),
        Example(
            "return() at the end",
            {"CMakeLists.txt": f"{_RETURN.format('')}ament_package()\nreturn()\n"},
        ),
        Example(
            "return() before ament_package()",
            {"CMakeLists.txt": _RETURN.format("return()\n") + "ament_package()\n"},
            "3:1: return() ends the file here, so ament_package() in line 5 is never called; move "
            "it into a condition",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_return(package)
        cmake = package.cmake
        if package.build_type == "cmake" or not uses_ament(package):
            return
        if cmake.find(*PACKAGE_COMMANDS) or has_unknown_commands(package):
            return
        last = cmake.own_commands[-1]
        end = len(cmake.source.text)
        text = f"{cmake.source.newline}ament_package(){cmake.source.newline}"
        lead = "" if cmake.source.text.endswith("\n") else cmake.source.newline
        fix = Fix("Add ament_package()", (Edit("CMakeLists.txt", end, end, lead + text),))
        message = (
            "no ament_package() at the end: `ros2 run` and `ros2 launch` do not find the "
            "package; add it"
        )
        yield self.report(last.name_location, message, fix)

    def _check_return(self, package: Package) -> Iterator[Diagnostic]:
        calls = package.cmake.find("ament_package")
        certain = [call for call in calls if not call.blocks]
        returns = [command for command in package.cmake.find("return") if not command.blocks]
        if certain and returns and returns[0].index < calls[0].index:
            line = certain[0].location.line
            message = (
                f"return() ends the file here, so ament_package() in line {line} is never "
                f"called; move it into a condition"
            )
            yield self.report(returns[0].name_location, message)
