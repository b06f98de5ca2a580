"""PX027: the build system is declared."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Fix, Package, Report, Rule

_MANIFEST = (
    '<package format="3">\n  <name>talker</name>\n{}'
    "  <export>\n    <build_type>ament_cmake</build_type>\n  </export>\n</package>\n"
)
_DEPEND = "  <buildtool_depend>ament_cmake</buildtool_depend>\n"
_LISTS = "project(talker)\nfind_package(ament_cmake REQUIRED)\nament_package()\n"


class BuildToolMissing(Rule):
    """An ament_cmake package declares no dependency that provides ament_cmake.

    **Why.** On a clean machine, and on the build farm, CMake stops: ``Could not find a package
    configuration file provided by "ament_cmake"``.

    **Fix.** Add ``<buildtool_depend>ament_cmake</buildtool_depend>``.

    **Source.** REP-149, ``<buildtool_depend>``; ROS 2 documentation, "ament_cmake user
    documentation".
    """

    code = "PX027"
    name = "build-tool-missing"
    examples = (
        Example("declared", {"package.xml": _MANIFEST.format(_DEPEND), "CMakeLists.txt": _LISTS}),
        Example(
            "forgotten",
            {"package.xml": _MANIFEST.format(""), "CMakeLists.txt": _LISTS},
            Report(
                "package.xml:1:2",
                "nothing declares ament_cmake, which CMakeLists.txt finds",
                fix="declare it",
            ),
            fixed={"package.xml": _MANIFEST.format(_DEPEND)},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        manifest = package.manifest
        if manifest.build_type != "ament_cmake" or not package.cmake.finds("ament_cmake"):
            return
        # Whatever builds something may bring ament_cmake along.
        if any("ament" in name or name.endswith("_cmake") for name in manifest.build_names):
            return
        if any(dependency.kind == "buildtool_depend" for dependency in manifest.dependencies):
            return
        fix = Fix("declare it", (manifest.insert("buildtool_depend", "ament_cmake"),))
        message = "nothing declares ament_cmake, which CMakeLists.txt finds"
        at = manifest.root.name_location
        yield self.report(at, message, fix, cause="dependency ament_cmake")
