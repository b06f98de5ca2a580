"""CM005: CMakeLists.txt starts with a ``cmake_minimum_required`` that CMake supports."""

from __future__ import annotations

import re
from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Effect, Example, Fix, Package, Report, Rule, Severity
from scaffold.api.cmake import CMakeLists, Command, nested
from scaffold.api.distributions import target

_PATH = "CMakeLists.txt"
_OLDEST = (3, 5)
_WANTED = "3.8"
_LISTS = "cmake_minimum_required(VERSION {})\nproject(talker)\n"
_MINIMUM = "cmake_minimum_required(VERSION 3.8)\n"


class MinimumVersionUnfit(Rule):
    """``cmake_minimum_required`` comes after ``project``, or has an unsupported version.

    **Why.** The call sets the policies of CMake; without it, ``project`` uses the policies of
    another version and warns. CMake 4 stops without it, and at versions before 3.5: ``Compatibility
    with CMake < 3.5 has been removed from CMake``. Packages migrated from ROS 1 often have 2.8.3 or
    3.0.2.

    **Fix.** Start with ``cmake_minimum_required(VERSION 3.8)``, the version that ROS 2 recommends.

    **Source.** CMake documentation, ``cmake_minimum_required``, "Compatibility"; ROS 2
    documentation, "ament_cmake user documentation".
    """

    code = "CM005"
    name = "minimum-version-unfit"
    severity = Severity.WARNING
    effect = Effect.STOPS_BUILD
    is_fixed_for_all = True
    is_deprecation = True
    other_severities = {
        Severity.ERROR: "the CMake of the distribution stops",
        Severity.INFO: "the CMake of the distribution warns",
    }
    examples = (
        Example("first", {"CMakeLists.txt": f"{_MINIMUM}project(talker)\n"}),
        Example(
            "after project",
            {"CMakeLists.txt": f"project(talker)\n{_MINIMUM}"},
            "1:1: cmake_minimum_required() in line 2 must come before project()",
        ),
        Example(
            "none",
            {"CMakeLists.txt": "project(talker)\n"},
            "1:1: no cmake_minimum_required(VERSION ...) before project(): CMake uses old policies",
        ),
        Example("the version that ROS 2 recommends", {"CMakeLists.txt": _LISTS.format("3.8")}),
        Example(
            "old, with a range up to a newer version",
            {"CMakeLists.txt": _LISTS.format("3.1...3.28")},
        ),
        Example(
            "too old for CMake 4",
            {"CMakeLists.txt": _LISTS.format("3.4")},
            Report(
                "1:32",
                "version 3.4 is too old: CMake 4.2 of Lyrical stops, as it requires 3.5 or newer",
                fix="Replace with 3.10",
                severity=Severity.ERROR,
            ),
            fixed={"CMakeLists.txt": _LISTS.format("3.10")},
            distro="lyrical",
        ),
        Example(
            "deprecated by CMake 4",
            {"CMakeLists.txt": _LISTS.format("3.8")},
            Report(
                "1:32",
                "version 3.8 is deprecated: CMake 4.2 of Lyrical warns, and a later one will stop",
                fix="Replace with 3.10",
                severity=Severity.INFO,
            ),
            fixed={"CMakeLists.txt": _LISTS.format("3.10")},
            distro="lyrical",
        ),
        Example(
            "in a separate directory",
            {
                "CMakeLists.txt": _LISTS.format("3.10") + "add_subdirectory(sim)\n",
                "sim/CMakeLists.txt": _LISTS.format("3.4"),
            },
            Report(
                "sim/CMakeLists.txt:1:32",
                "version 3.4 is too old: CMake 4.2 of Lyrical stops, as it requires 3.5 or newer",
                fix="Replace with 3.10",
                severity=Severity.ERROR,
            ),
            fixed={"sim/CMakeLists.txt": _LISTS.format("3.10")},
            distro="lyrical",
        ),
        Example(
            "newer than the CMake of the distribution",
            {"CMakeLists.txt": _LISTS.format("3.25")},
            Report(
                "1:32",
                "CMake 3.22 of Humble is older than 3.25: CMake stops",
                severity=Severity.ERROR,
            ),
            distro="humble",
        ),
        Example(
            "a version from ROS 1",
            {"CMakeLists.txt": _LISTS.format("2.8.3")},
            Report(
                "1:32",
                "version 2.8.3 is too old: CMake 4 stops, as it requires 3.5 or newer; "
                "ROS 2 recommends 3.8",
                fix="Replace with 3.8",
            ),
            fixed={"CMakeLists.txt": _LISTS.format("3.8")},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        project = cmake.project
        minimum = cmake.find_own("cmake_minimum_required")
        for command in minimum:
            yield from self._check_version(cmake, command)
        for below in nested(package):
            for command in below.find("cmake_minimum_required"):
                yield from self._check_version(below, command)
        if project is None or (cmake.find("include") and not minimum):
            return
        if not minimum:
            message = (
                "no cmake_minimum_required(VERSION ...) before project(): CMake uses old policies"
            )
            yield self.report(project.name_location, message)
        elif minimum[0].index > project.index:
            line = minimum[0].location.line
            message = f"cmake_minimum_required() in line {line} must come before project()"
            yield self.report(project.name_location, message)

    def _check_version(self, cmake: CMakeLists, command: Command) -> Iterator[Diagnostic]:
        match command.arguments:
            case [word, version, *_] if word.value == "VERSION":
                numbers = _parsed_version(version.value)
                if numbers is None:
                    return
                message, wanted, severity = _problem_and_fix(version.value, numbers)
                own = _parsed_version(target().fact("cmake"))
                if own is not None and numbers > own:
                    message = f"{_cmake()} is older than {version.value}: CMake stops"
                    yield self.report(version, message, severity=Severity.ERROR)
                elif message and (severity is not None or cmake.source.path == _PATH):
                    edit = Edit(cmake.source.path, version.start, version.end, wanted)
                    fix = Fix(f"Replace with {wanted}", (edit,))
                    yield self.report(version, message, fix, severity=severity)


def _problem_and_fix(version: str, numbers: tuple[int, int]) -> tuple[str, str, Severity | None]:
    """Return a message, the version to write and the severity; no message if it is valid."""
    stops = target().fact("build.cmake_minimum_error_below")
    warns = target().fact("build.cmake_minimum_warning_below")
    cmake = _cmake()
    if stops and numbers < (_parsed_version(stops) or _OLDEST):
        message = f"version {version} is too old: {cmake} stops, as it requires {stops} or newer"
        return message, warns, Severity.ERROR
    if warns and numbers < (_parsed_version(warns) or _OLDEST):
        message = f"version {version} is deprecated: {cmake} warns, and a later one will stop"
        return message, warns, Severity.INFO
    if numbers < _OLDEST:
        message = (
            f"version {version} is too old: CMake 4 stops, as it requires 3.5 or newer; ROS "
            f"2 recommends {_WANTED}"
        )
        return message, _WANTED, None
    return "", "", None


def _cmake() -> str:
    return f"CMake {target().fact('cmake').rpartition('.')[0]} of {target().title}"


def _parsed_version(version: str) -> tuple[int, int] | None:
    """Return a version as numbers; ranges are not supported."""
    matched = re.fullmatch(r"(\d{1,9})\.(\d{1,9})(?:\.[\d.]*)?", version)
    if matched is None or ".." in version:
        return None
    return int(matched[1]), int(matched[2])
