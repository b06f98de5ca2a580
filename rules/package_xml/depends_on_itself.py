"""PX008: a package does not depend on itself."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Fix, Package, Report, Rule

_MANIFEST = '<package format="3">\n  <name>talker</name>\n{}</package>\n'


class DependsOnItself(Rule):
    """A package depends on itself.

    **Why.** catkin_pkg, and with it colcon, refuses the manifest.

    **Fix.** Remove the dependency.

    **Source.** REP-149, "Dependency tags"; ``catkin_pkg.package.Package.validate``.
    """

    code = "PX008"
    name = "depends-on-itself"
    examples = (
        Example("on another", {"package.xml": _MANIFEST.format("  <depend>rclpy</depend>\n")}),
        Example(
            "on itself",
            {"package.xml": _MANIFEST.format("  <exec_depend>talker</exec_depend>\n")},
            Report(
                "package.xml:3:16",
                "<exec_depend> 'talker': a package cannot need itself",
                fix="remove it",
            ),
            fixed={"package.xml": _MANIFEST.format("")},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        manifest = package.manifest
        for dependency in manifest.dependencies:
            if dependency.name and dependency.name == manifest.name:
                fix = Fix("remove it", (manifest.remove(dependency.element),))
                message = f"<{dependency.kind}> {dependency.name!r}: a package cannot need itself"
                yield self.report(dependency, message, fix)
