"""PX009: packages do not need each other in a circle."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, ViewError

_TALKER = '<package format="3">\n  <name>talker</name>\n  <depend>listener</depend>\n</package>\n'
_LISTENER = '<package format="3">\n  <name>listener</name>\n{}</package>\n'


class DependencyCycle(Rule):
    """Packages of a workspace need each other in a circle.

    **Why.** colcon cannot order them: ``Unable to order packages topologically``.

    **Fix.** Move what both need into a third package.

    **Source.** REP-149, "Dependency tags"; ``colcon_core/topological_order.py``.
    """

    code = "PX009"
    name = "dependency-cycle"
    examples = (
        Example(
            "one way",
            {"package.xml": _TALKER},
            neighbours={"listener": {"package.xml": _LISTENER.format("")}},
        ),
        Example(
            "both ways",
            {"package.xml": _TALKER},
            Report("package.xml:3:11", "a circle: talker needs listener needs talker"),
            neighbours={
                "listener": {"package.xml": _LISTENER.format("  <depend>talker</depend>\n")}
            },
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for dependency in package.manifest.dependencies:
            if dependency.kind == "test_depend" or not dependency.active:
                continue
            way = self._way_back(package, dependency.name)
            if way:
                message = f"a circle: {' needs '.join([package.name, *way])}"
                yield self.report(dependency, message)

    def _way_back(self, package: Package, start: str) -> list[str]:
        """Return the packages from ``start`` back to the package, if there is a way."""
        ways = {start: [start]}
        pending = [start]
        while pending:
            name = pending.pop(0)
            neighbour = package.workspace.get(name)
            if neighbour is None or neighbour is package:
                continue
            try:
                manifest = neighbour.manifest
            except ViewError:
                continue
            for needed in sorted(manifest.build_names | manifest.run_names):
                if needed == package.name:
                    return [*ways[name], needed]
                if needed not in ways:
                    ways[needed] = [*ways[name], needed]
                    pending.append(needed)
        return []
