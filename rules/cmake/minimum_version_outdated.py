"""CM106: the oldest CMake that is asked for is one that CMake still knows."""

from __future__ import annotations

import re
from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule, Severity

_OLDEST = (3, 5)
_WANTED = "3.8"
_LISTS = "cmake_minimum_required(VERSION {})\nproject(talker)\n"


class MinimumVersionOutdated(Rule):
    """``cmake_minimum_required`` asks for a version that CMake 4 no longer supports.

    **Why.** CMake 4 stops: ``Compatibility with CMake < 3.5 has been removed from CMake``. The
    one of Jazzy (3.28) builds the package, with a warning. Packages that come from ROS 1 begin
    with 2.8.3 or 3.0.2.

    **Fix.** Write ``VERSION 3.8``, the version that ROS 2 asks for.

    **Source.** CMake documentation, ``cmake_minimum_required``, "Compatibility"; ROS 2
    documentation, "ament_cmake user documentation".
    """

    code = "CM106"
    name = "minimum-version-outdated"
    severity = Severity.WARNING
    examples = (
        Example("of ROS 2", {"CMakeLists.txt": _LISTS.format("3.8")}),
        Example(
            "old, but known to work with newer", {"CMakeLists.txt": _LISTS.format("3.1...3.28")}
        ),
        Example(
            "of ROS 1",
            {"CMakeLists.txt": _LISTS.format("2.8.3")},
            Report(
                "CMakeLists.txt:1:32",
                "CMake 4 stops at 2.8.3: it supports 3.5 and newer; ROS 2 asks for 3.8",
                fix="write 3.8",
            ),
            fixed={"CMakeLists.txt": _LISTS.format("3.8")},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for command in package.cmake.find("cmake_minimum_required"):
            match command.arguments:
                case [word, version, *_] if word.value == "VERSION":
                    numbers = re.fullmatch(r"(\d{1,9})\.(\d{1,9})(?:\.[\d.]*)?", version.value)
                    if (
                        numbers is None
                        or ".." in version.value
                        or (int(numbers[1]), int(numbers[2])) >= _OLDEST
                    ):
                        continue
                    edit = Edit("CMakeLists.txt", version.start, version.end, _WANTED)
                    message = (
                        f"CMake 4 stops at {version.value}: it supports 3.5 and newer; ROS 2 asks "
                        f"for {_WANTED}"
                    )
                    yield self.report(version, message, Fix(f"write {_WANTED}", (edit,)))
