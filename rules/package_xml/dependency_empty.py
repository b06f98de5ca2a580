"""PX007: dependencies have a name."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Fix, Package, Report, Rule


class DependencyEmpty(Rule):
    """A dependency is empty.

    **Why.** rosdep and bloom look for a package without a name: the release stops.

    **Fix.** Remove it, or write the name.

    **Source.** REP-149, "Dependency tags".
    """

    code = "PX007"
    name = "dependency-empty"
    examples = (
        Example("named", {"package.xml": "<package><depend>rclpy</depend></package>\n"}),
        Example(
            "empty",
            {"package.xml": "<package>\n  <depend></depend>\n</package>\n"},
            Report("package.xml:2:3", "<depend> names no package", fix="remove it"),
            fixed={"package.xml": "<package>\n</package>\n"},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        manifest = package.manifest
        for dependency in manifest.dependencies:
            if not dependency.name and not dependency.element.children:
                fix = Fix("remove it", (manifest.remove(dependency.element),))
                message = f"<{dependency.kind}> names no package"
                yield self.report(dependency.element, message, fix)
