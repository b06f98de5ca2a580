"""UR002: the packages that URDF and xacro files name exist."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity
from scaffold.api.launch import Reference, exists, meant_package
from scaffold.api.manifest import declared, declaring
from scaffold.api.robot import named_files

_MANIFEST = (
    '<package format="3">\n  <name>rover</name>\n'
    "  <exec_depend>turret_description</exec_depend>\n</package>\n"
)
_ROBOT = (
    '<robot name="robot" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
    '  <xacro:include filename="$(find {})/urdf/wheel.xacro"/>\n  <link name="base_link"/>\n'
    "</robot>\n"
)


class PackageNotThere(Rule):
    """A URDF or xacro file names a package that does not exist, or that nobody declares.

    **Why.** xacro stops, ``package 'robopy' not found``; for a mesh, RViz shows nothing.

    **Fix.** Write the name that is in package.xml; declare the package.

    **Source.** xacro, ``substitution_args.py``; resource_retriever.
    """

    code = "UR002"
    name = "package-not-there"
    other_severities = {Severity.WARNING: "the package exists, but is not declared"}
    examples = (
        Example(
            "declared; not known",
            {
                "package.xml": _MANIFEST,
                "a.xacro": _ROBOT.format("turret_description"),
                "b.xacro": _ROBOT.format("my_arm"),
            },
        ),
        Example(
            "one that is not declared",
            {"package.xml": _MANIFEST, "a.xacro": _ROBOT.format("realsense2_description")},
            Report(
                "a.xacro:2:28",
                "needs 'realsense2_description', which no dependency in package.xml "
                "provides; add <exec_depend>realsense2_description</exec_depend>",
                fix="declare realsense2_description",
                severity=Severity.WARNING,
            ),
            fixed={
                "package.xml": _MANIFEST.replace(
                    "  <exec", "  <exec_depend>realsense2_description</exec_depend>\n  <exec", 1
                )
            },
        ),
        Example(
            "nearly one that is declared",
            {"package.xml": _MANIFEST, "a.xacro": _ROBOT.format("turet_description")},
            Report(
                "a.xacro:2:28",
                "unknown package 'turet_description'; did you mean "
                "'turret_description' (which package.xml declares)?",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        manifest = package.manifest
        there = declared(package, for_tests=False)
        seen = {package.name, *there.direct, *there.along, *manifest.declared_names}
        for named in named_files(package):
            if not named.package or not package.has("package.xml"):
                continue
            use = Reference(named.package, named.location, None, named.location)
            meant = meant_package(package, use)
            if meant is not None:
                message = (
                    f"unknown package {named.package!r}; did you mean {meant.name!r} "
                    f"({meant.reason})?"
                )
                yield self.report(named, message)
            elif named.package not in seen and exists(package, named.package):
                seen.add(named.package)
                tag = "exec_depend" if manifest.format > 1 else "run_depend"
                needed = declaring(package, tag, named.package)
                yield self.report(
                    named,
                    f"needs {named.package!r}, which no dependency in package.xml provides; "
                    f"{needed.advice}",
                    needed.fix,
                    severity=Severity.WARNING,
                    cause=f"dependency {named.package}",
                )
