"""PX009: packages do not depend on each other in a cycle."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, Fix, Package, Report, Rule
from scaffold.api.manifest import way_back

_TALKER = '<package format="3">\n  <name>talker</name>\n  <depend>listener</depend>\n</package>\n'
_ITSELF = '<package format="3">\n  <name>talker</name>\n{}</package>\n'
_LISTENER = '<package format="3">\n  <name>listener</name>\n{}</package>\n'


class DependencyCycle(Rule):
    """A package depends on itself, directly or through other packages in the workspace.

    **Why.** colcon cannot order the packages: ``Unable to order packages topologically``. It
    rejects a package that depends on itself.

    **Fix.** Move the common code to a third package; remove a dependency on the package itself.

    **Source.** REP 149, "Dependency tags"; ``colcon_core/topological_order.py``;
    ``catkin_pkg.package.Package.validate``.
    """

    code = "PX009"
    name = "dependency-cycle"
    effect = Effect.STOPS_BUILD
    examples = (
        Example(
            "one direction",
            {"package.xml": _TALKER},
            neighbors={"listener": {"package.xml": _LISTENER.format("")}},
        ),
        Example(
            "both directions",
            {"package.xml": _TALKER},
            "3:11: dependency cycle: talker needs listener needs talker",
            neighbors={
                "listener": {"package.xml": _LISTENER.format("  <depend>talker</depend>\n")}
            },
        ),
        Example(
            "a dependency on itself",
            {"package.xml": _ITSELF.format("  <exec_depend>talker</exec_depend>\n")},
            Report(
                "3:16",
                "<exec_depend> 'talker': a package cannot depend on itself; colcon rejects it",
                fix="Remove the dependency",
            ),
            fixed={"package.xml": _ITSELF.format("")},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        manifest = package.manifest
        for dependency in manifest.dependencies:
            if dependency.name and dependency.name == manifest.name:
                fix = Fix("Remove the dependency", (manifest.remove(dependency.element),))
                message = (
                    f"<{dependency.kind}> {dependency.name!r}: a package cannot depend on itself; "
                    f"colcon rejects it"
                )
                yield self.report(dependency, message, fix)
                continue
            if dependency.kind == "test_depend" or not dependency.active:
                continue
            way = way_back(package, dependency.name)
            if way:
                message = f"dependency cycle: {' needs '.join([package.name, *way])}"
                yield self.report(dependency, message)
