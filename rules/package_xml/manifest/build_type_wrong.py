"""PX011: package.xml has one build type that exists, fits the files and is declared."""

from __future__ import annotations

import re
from collections.abc import Iterator
from difflib import get_close_matches

from scaffold.api import (
    Diagnostic,
    Edit,
    Effect,
    Example,
    Fix,
    Package,
    Report,
    Rule,
    Severity,
    ViewError,
)
from scaffold.api.catalog import transitive_dependencies
from scaffold.api.cmake import uses_ament
from scaffold.api.manifest import ConditionError, declared, holds

KNOWN = ("ament_cmake", "ament_python", "cmake", "catkin", "ament_cargo", "python")
_MANIFEST = (
    '<package format="3">\n  <export>\n    <build_type>ament_cmake</build_type>\n'
    "    <build_type{}>ament_python</build_type>\n  </export>\n</package>\n"
)
_CMAKE_PACKAGE = "find_package(ament_cmake REQUIRED)\nament_package()\n"
_MANIFEST_FILES = (
    '<package format="3">\n  <name>talker</name>\n'
    "  <export>\n    <build_type>{}</build_type>\n  </export>\n</package>\n"
)
_FILES = {"setup.py": "from setuptools import setup\n\nsetup(name='talker')\n"}
FILES = {"ament_cmake": "CMakeLists.txt", "cmake": "CMakeLists.txt", "ament_python": "setup.py"}
_MANIFEST_TOOL = (
    '<package format="3">\n  <name>talker</name>\n{}'
    "  <export>\n    <build_type>ament_cmake</build_type>\n  </export>\n</package>\n"
)
_DEPEND = "  <buildtool_depend>ament_cmake</buildtool_depend>\n"
_RCLCPP = "  <depend>rclcpp</depend>\n"
_LISTS = "project(talker)\nfind_package(ament_cmake REQUIRED)\nament_package()\n"
_NOTHING = re.compile(
    r"(?:^|/)(?:package\.xml|CMakeLists\.txt|LICENSE[^/]*|\.[^/]*|[^/]*\.(?:md|rst))$"
)
"""Matches the paths of files that are neither built nor installed."""
_FETCHING = ("external", "fetch", "vendor", "process")
"""Parts of the names of commands that fetch what is built."""


class BuildTypeWrong(Rule):
    """``<build_type>`` is missing, repeated, unknown or wrong, or ament_cmake is undeclared.

    **Why.** Without a build type, colcon assumes a ROS 1 package with the build type catkin: it is
    built without the hooks of ament, and ``ros2 run`` fails with ``Package 'talker' not found``.
    colcon cannot build an unknown type, and ignores a package with two. If the files do not match,
    the build stops: ``does not appear to contain CMakeLists.txt``. The build farm installs
    ament_cmake only if it is declared, or exported by a dependency.

    **Fix.** Write one ``<build_type>`` that matches the files, ``ament_cmake``, ``ament_python`` or
    ``cmake``, and ``<buildtool_depend>ament_cmake</buildtool_depend>``.

    **Source.** REP 149, ``<build_type>``: the default is catkin; ``<buildtool_depend>``;
    ``colcon_ros/package_identification/ros.py``; ``colcon_ros/task``.
    """

    code = "PX011"
    name = "build-type-wrong"
    effect = Effect.STOPS_BUILD
    other_severities = {
        Severity.WARNING: "ament_cmake is undeclared, but a dependency depends on it, or a package "
        "without a build type has no files besides those that build it, and texts"
    }
    examples = (
        Example(
            "a misspelled build type",
            {
                "package.xml": "<package><export>\n"
                "  <build_type>ament_pyton</build_type>\n"
                "</export></package>\n",
                "setup.py": "",
            },
            Report(
                "package.xml:2:15",
                "unknown build type 'ament_pyton': colcon skips the package; did you "
                "mean 'ament_python'?",
                fix="Replace with ament_python",
            ),
            fixed={
                "package.xml": "<package><export>\n"
                "  <build_type>ament_python</build_type>\n"
                "</export></package>\n"
            },
        ),
        Example(
            "two, one of them for ROS 1",
            {
                "package.xml": _MANIFEST.format(' condition="$ROS_VERSION == 1"'),
                "setup.py": "",
                "CMakeLists.txt": "project(talker)\n",
            },
        ),
        Example(
            "two build types",
            {
                "package.xml": _MANIFEST.format(""),
                "setup.py": "",
                "CMakeLists.txt": "project(talker)\n",
            },
            "package.xml:4:5: a second build type, after the one in line 3: colcon ignores the "
            "package",
        ),
        Example(
            "a setup.py and ament_python",
            {
                "package.xml": "<package><export><build_type>ament_python</build_type></export>"
                "</package>\n",
                "setup.py": "",
            },
        ),
        Example(
            "a build type outside of <export>, which PX061 reports",
            {
                "package.xml": "<package><build_type>ament_python</build_type></package>\n",
                "setup.py": "",
            },
        ),
        Example(
            "a setup.py, and no build type",
            {"package.xml": "<package>\n  <name>talker</name>\n</package>\n", "setup.py": ""},
            Report(
                "package.xml:1:2",
                "no <build_type>: colcon treats the package as catkin; write "
                "<build_type>ament_python</build_type> in <export>",
                fix="Declare ament_python",
            ),
            fixed={
                "package.xml": "<package>\n"
                "  <name>talker</name>\n"
                "  <export>\n"
                "    <build_type>ament_python</build_type>\n"
                "  </export>\n"
                "</package>\n"
            },
        ),
        Example(
            "no build type, and nothing to build or install",
            {
                "package.xml": "<package>\n  <buildtool_depend>ament_cmake</buildtool_depend>\n"
                "</package>\n",
                "CMakeLists.txt": _CMAKE_PACKAGE,
                "README.md": "# Talker\n",
            },
            Report(
                "package.xml:1:2",
                "no <build_type>: colcon treats the package as catkin; write "
                "<build_type>ament_cmake</build_type> in <export>",
                fix="Declare ament_cmake",
                severity=Severity.WARNING,
            ),
            fixed={
                "package.xml": "<package>\n  <buildtool_depend>ament_cmake</buildtool_depend>\n"
                "  <export>\n    <build_type>ament_cmake</build_type>\n  </export>\n</package>\n"
            },
        ),
        Example(
            "an export with another element",
            {
                "package.xml": "<package>\n  <buildtool_depend>ament_cmake</buildtool_depend>\n"
                "  <export>\n    <other/>\n  </export>\n</package>\n",
                "CMakeLists.txt": _CMAKE_PACKAGE,
                "config/talker.yaml": "",
            },
            Report(
                "package.xml:3:4",
                "no <build_type>: colcon treats the package as catkin; write "
                "<build_type>ament_cmake</build_type> in <export>",
                fix="Declare ament_cmake",
            ),
            fixed={
                "package.xml": "<package>\n"
                "  <buildtool_depend>ament_cmake</buildtool_depend>\n  <export>\n"
                "    <build_type>ament_cmake</build_type>\n    <other/>\n  </export>\n</package>\n"
            },
        ),
        Example(
            "a setup.py and ament_cmake",
            {
                "package.xml": "<package><export>\n"
                "  <build_type>ament_cmake</build_type>\n"
                "</export></package>\n",
                "setup.py": "",
            },
            Report(
                "package.xml:2:15",
                "build type ament_cmake needs a CMakeLists.txt, which the package does "
                "not have; its setup.py belongs to ament_python",
                fix="Replace with ament_python",
            ),
            fixed={
                "package.xml": "<package><export>\n"
                "  <build_type>ament_python</build_type>\n"
                "</export></package>\n"
            },
        ),
        Example(
            "ament_python, with its files",
            {"package.xml": _MANIFEST_FILES.format("ament_python"), **_FILES},
        ),
        Example(
            "catkin, for files of ament_python",
            {"package.xml": _MANIFEST_FILES.format("catkin"), **_FILES},
            Report(
                "package.xml:4:5",
                "build type catkin, but the files are those of ament_python: the build fails",
                fix="Replace with ament_python",
            ),
            fixed={"package.xml": _MANIFEST_FILES.format("ament_python")},
        ),
        Example(
            "ament_cmake undeclared, which found-undeclared reports",
            {"package.xml": _MANIFEST_TOOL.format(""), "CMakeLists.txt": _LISTS},
        ),
        Example(
            "ament_cmake undeclared, as a dependency of rclcpp",
            {"package.xml": _MANIFEST_TOOL.format(_RCLCPP), "CMakeLists.txt": _LISTS},
            Report(
                "package.xml:1:2",
                "CMakeLists.txt finds ament_cmake, which is not declared; add "
                "<buildtool_depend>ament_cmake</buildtool_depend>",
                fix="Declare ament_cmake",
                severity=Severity.WARNING,
            ),
            fixed={"package.xml": _MANIFEST_TOOL.format(_DEPEND + _RCLCPP)},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_spelling(package)
        yield from self._check_number(package)
        yield from self._check_missing(package)
        yield from self._check_files(package)
        yield from self._check_tool(package)

    def _check_spelling(self, package: Package) -> Iterator[Diagnostic]:
        for element in package.manifest.build_type_elements:
            closest = get_close_matches(element.text, KNOWN, n=1, cutoff=0.75)
            if element.text in KNOWN or not closest:
                continue
            message = (
                f"unknown build type {element.text!r}: colcon skips the package; did you "
                f"mean {closest[0]!r}?"
            )
            edit = Edit("package.xml", *element.text_span, closest[0])
            yield self.report(
                element.text_location, message, Fix(f"Replace with {closest[0]}", (edit,))
            )

    def _check_number(self, package: Package) -> Iterator[Diagnostic]:
        active = []
        for element in package.manifest.build_type_elements:
            condition = element.get("condition")
            try:
                if condition is None or holds(condition):
                    active.append(element)
            except ConditionError:
                return
        for element in active[1:]:
            line = active[0].location.line
            message = (
                f"a second build type, after the one in line {line}: colcon ignores the package"
            )
            yield self.report(element, message)

    def _check_missing(self, package: Package) -> Iterator[Diagnostic]:
        manifest = package.manifest
        is_misplaced = manifest.one("build_type") is not None  # reported as unknown element
        if manifest.build_type_elements or is_misplaced or "catkin" in manifest.declared_names:
            return
        if package.has("CMakeLists.txt"):
            uses_ament = any(name.startswith("ament_") for name in manifest.declared_names) or any(
                command.name.startswith("ament_") for command in package.cmake.commands
            )
            if not uses_ament:
                return
            build_type = "ament_cmake"
        elif package.has("setup.py"):
            build_type = "ament_python"
        else:
            return
        export = manifest.one("export")
        line = f"<build_type>{build_type}</build_type>"
        newline = manifest.source.newline
        if export is None:
            close = manifest.root.close_start
            text = f"  <export>{newline}    {line}{newline}  </export>{newline}"
            at, edit = manifest.root.name_location, Edit("package.xml", close, close, text)
        else:
            inside = export.open_end
            at = export.name_location
            edit = Edit("package.xml", inside, inside, f"{newline}    {line}")
        message = f"no <build_type>: colcon treats the package as catkin; write {line} in <export>"
        fix = Fix(f"Declare {build_type}", (edit,)) if export is None or export.children else None
        severity = Severity.WARNING if _is_empty(package) else None
        # Without the hooks of ament, but built.
        yield self.report(at, message, fix, severity=severity, effect=Effect.SPOILS_INSTALL)

    def _check_files(self, package: Package) -> Iterator[Diagnostic]:
        for diagnostic in self._check_ros1(package):
            yield diagnostic
            return
        for element in package.manifest.build_type_elements:
            wanted = FILES.get(element.text)
            if wanted is None or package.has(wanted) or element.get("condition"):
                continue
            message = f"build type {element.text} needs a {wanted}, which the package does not have"
            other = "ament_cmake" if wanted == "setup.py" else "ament_python"
            if not package.has(FILES[other]):
                yield self.report(element.text_location, message)
                continue
            edit = Edit("package.xml", *element.text_span, other)
            message += f"; its {FILES[other]} belongs to {other}"
            yield self.report(element.text_location, message, Fix(f"Replace with {other}", (edit,)))

    def _check_ros1(self, package: Package) -> Iterator[Diagnostic]:
        """Report ``catkin`` and ``cmake`` where the files are those of ament."""
        manifest = package.manifest
        elements = [x for x in manifest.root.descendants() if x.tag == "build_type"]
        given = manifest.build_type or ""
        if given not in {"catkin", "cmake"} or len(elements) != 1 or elements[0].get("condition"):
            return
        wanted = _ament_type(package)
        if wanted:
            element = elements[0]
            start = manifest.source.text.find(given, element.start)
            edit = Edit("package.xml", start, start + len(given), wanted)
            message = f"build type {given}, but the files are those of {wanted}: the build fails"
            yield self.report(element, message, Fix(f"Replace with {wanted}", (edit,)))

    def _check_tool(self, package: Package) -> Iterator[Diagnostic]:
        manifest = package.manifest
        if manifest.build_type != "ament_cmake" or not package.cmake.finds("ament_cmake"):
            return
        # Any build dependency may depend on ament_cmake.
        if any("ament" in name or name.endswith("_cmake") for name in manifest.build_names):
            return
        if any(dependency.kind == "buildtool_depend" for dependency in manifest.dependencies):
            return
        fix = Fix("Declare ament_cmake", (manifest.insert("buildtool_depend", "ament_cmake"),))
        message = (
            "CMakeLists.txt finds ament_cmake, which is not declared; add "
            "<buildtool_depend>ament_cmake</buildtool_depend>"
        )
        at = manifest.root.name_location
        brought = transitive_dependencies(manifest.build_names)
        if "ament_cmake" in brought | declared(package, for_tests=True).along:
            yield self.report(at, message, fix, severity=Severity.WARNING)
        # Otherwise found-undeclared reports it.


def _is_empty(package: Package) -> bool:
    """Return whether CMake builds a package without any files to build or install."""
    if not package.has("CMakeLists.txt"):
        return False
    if not all(map(_NOTHING.search, package.files)):
        return False
    return not any(word in command.name for command in package.cmake.commands for word in _FETCHING)


def _ament_type(package: Package) -> str:
    """Return the build type that the files belong to; empty if they are not of ament."""
    if package.has("CMakeLists.txt"):
        try:
            is_ament = uses_ament(package) and "catkin" not in package.cmake.source.text
        except ViewError:
            return ""
        return "ament_cmake" if is_ament else ""
    return "ament_python" if package.has("setup.py") else ""
