"""PX025: a dependency or a group is declared once."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, Fix, Package, Report, Rule, Severity

COVERED = ("build_depend", "build_export_depend", "exec_depend")
_MANIFEST = (
    '<package format="3">\n  <group_depend>drivers</group_depend>\n'
    "  <member_of_group>{}</member_of_group>\n</package>\n"
)


class DependencyRedundant(Rule):
    """Two tags name the same package, or a package depends on a group that it is a member of.

    **Why.** catkin_pkg, and therefore colcon, rejects package.xml: ``The generic dependency on
    'std_msgs' is redundant with: exec_depend``. The same applies to two ``<depend>`` tags, and to a
    group, because the package would depend on itself. Any other repeated tag is redundant, which is
    a warning.

    **Fix.** Keep ``<depend>``, which covers build and run time, and remove the other tag; for a
    group, remove one of the two.

    **Source.** REP 149, ``<depend>``, ``<group_depend>``; ``catkin_pkg/package.py``.
    """

    code = "PX025"
    name = "dependency-redundant"
    effect = Effect.STOPS_BUILD
    other_severities = {Severity.WARNING: "colcon accepts the repetition"}
    examples = (
        Example(
            "two purposes, two tags",
            {
                "package.xml": '<package format="3">\n'
                "  <build_depend>std_msgs</build_depend>\n"
                "  <exec_depend>std_msgs</exec_depend>\n"
                "</package>\n"
            },
        ),
        Example(
            "depend and exec_depend",
            {
                "package.xml": '<package format="3">\n'
                "  <depend>std_msgs</depend>\n"
                "  <exec_depend>std_msgs</exec_depend>\n"
                "</package>\n"
            },
            Report(
                "3:16",
                "<exec_depend> 'std_msgs' is already covered by <depend> in line 2: "
                "colcon rejects package.xml; remove one",
                fix="Remove the dependency",
            ),
            fixed={
                "package.xml": '<package format="3">\n  <depend>std_msgs</depend>\n</package>\n'
            },
        ),
        Example(
            "exec_depend twice",
            {
                "package.xml": '<package format="3">\n'
                "  <exec_depend>std_msgs</exec_depend>\n"
                "  <exec_depend>std_msgs</exec_depend>\n"
                "</package>\n"
            },
            Report(
                "3:16",
                "<exec_depend> 'std_msgs' is already declared in line 2; remove one",
                fix="Remove the dependency",
                severity=Severity.WARNING,
            ),
            fixed={
                "package.xml": '<package format="3">\n'
                "  <exec_depend>std_msgs</exec_depend>\n</package>\n"
            },
        ),
        Example("a group of other packages", {"package.xml": _MANIFEST.format("tools")}),
        Example(
            "the group that it is a member of",
            {"package.xml": _MANIFEST.format("drivers")},
            "3:3: the package is a member of the group 'drivers', which line 2 depends on: colcon "
            "rejects package.xml",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_tags(package)
        yield from self._check_groups(package)

    def _check_tags(self, package: Package) -> Iterator[Diagnostic]:
        manifest = package.manifest
        generic = manifest.depends("depend")
        seen: dict[tuple[str, str, str | None], int] = {}
        for dependency in manifest.dependencies:
            name, kind = dependency.name, dependency.kind
            key = (name, kind, dependency.condition)
            first = seen.setdefault(key, dependency.location.line)
            other = generic.get(name)
            if other is not None and kind in COVERED and other.condition == dependency.condition:
                line = other.location.line
                message = (
                    f"<{kind}> {name!r} is already covered by <depend> in line {line}: colcon "
                    f"rejects package.xml; remove one"
                )
            elif dependency.element is not manifest.depends(kind)[name].element and name:
                if first == dependency.location.line:
                    continue
                message = f"<{kind}> {name!r} is already declared in line {first}; remove one"
            else:
                continue
            fix = Fix("Remove the dependency", (manifest.remove(dependency.element),))
            is_refused = kind == "depend" or other is not None
            severity = Severity.ERROR if is_refused else Severity.WARNING
            yield self.report(dependency, message, fix, severity=severity)

    def _check_groups(self, package: Package) -> Iterator[Diagnostic]:
        manifest = package.manifest
        needed = {element.text: element for element in manifest.all("group_depend")}
        for element in manifest.all("member_of_group"):
            other = needed.get(element.text)
            if other is not None:
                line = other.location.line
                message = (
                    f"the package is a member of the group {element.text!r}, which line "
                    f"{line} depends on: colcon rejects package.xml"
                )
                yield self.report(element, message)
