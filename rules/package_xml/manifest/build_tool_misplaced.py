"""PX026: build tools are declared with ``<buildtool_depend>``."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule, Severity
from scaffold.api.catalog import BUILD_TOOLS

KINDS = ("depend", "exec_depend", "build_export_depend")
_MANIFEST = '<package format="3">\n  <{0}>ament_cmake</{0}>\n</package>\n'


class BuildToolMisplaced(Rule):
    """A build tool is declared as a run dependency.

    **Why.** Every robot that installs the package also installs the build system, and a cross-build
    uses the build system of the target.

    **Fix.** Write ``<buildtool_depend>``.

    **Source.** REP 149, ``<buildtool_depend>``.
    """

    code = "PX026"
    name = "build-tool-misplaced"
    severity = Severity.WARNING
    examples = (
        Example("a build tool", {"package.xml": _MANIFEST.format("buildtool_depend")}),
        Example(
            "a run dependency",
            {"package.xml": _MANIFEST.format("depend")},
            "2:11: 'ament_cmake' is a build tool; write <buildtool_depend>",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        manifest = package.manifest
        if manifest.name.startswith(("ament_", "rosidl_")) or manifest.format == 1:
            return
        for dependency in manifest.dependencies:
            if dependency.name in BUILD_TOOLS and dependency.kind in KINDS:
                message = f"{dependency.name!r} is a build tool; write <buildtool_depend>"
                yield self.report(dependency, message)
