"""CM092: install says where to."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule

_KINDS = ("PROGRAMS", "FILES", "DIRECTORY")
_LISTS = "project(talker)\ninstall(DIRECTORY launch{})\nament_package()\n"
_FILES = {"launch/talk.launch.py": ""}


class InstallWithoutDestination(Rule):
    """Files are installed without a destination.

    **Why.** CMake stops: ``install DIRECTORY given no DESTINATION!``.

    **Fix.** Add ``DESTINATION share/${PROJECT_NAME}``, for programs ``lib/${PROJECT_NAME}``.

    **Source.** CMake documentation, ``install``.
    """

    code = "CM092"
    name = "install-without-destination"
    examples = (
        Example(
            "with one",
            {"CMakeLists.txt": _LISTS.format(" DESTINATION share/${PROJECT_NAME}"), **_FILES},
        ),
        Example(
            "without",
            {"CMakeLists.txt": _LISTS.format(""), **_FILES},
            Report("CMakeLists.txt:2:1", "install(DIRECTORY) has no DESTINATION: CMake stops"),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for command in package.cmake.find("install"):
            values = command.values
            if not values or values[0] not in _KINDS or {"DESTINATION", "TYPE"} & set(values):
                continue
            if any("$" in value and ";" not in value and "/" not in value for value in values[1:]):
                continue  # a variable may hold the keyword
            message = f"install({values[0]}) has no DESTINATION: CMake stops"
            yield self.report(command.name_location, message)
