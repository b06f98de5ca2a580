"""PX025: a dependency is declared once."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Fix, Package, Report, Rule, Severity

COVERED = ("build_depend", "build_export_depend", "exec_depend")


class DependencyRedundant(Rule):
    """``<depend>`` and a narrower tag name the same package, or a tag names it twice.

    **Why.** catkin_pkg, and with it colcon, refuses the manifest: ``The generic dependency on
    'std_msgs' is redundant with: exec_depend``. So it is with two ``<depend>``; another tag twice
    is a line too many and nothing worse: a warning.

    **Fix.** Keep ``<depend>``, which covers building and running, and drop the other.

    **Source.** REP-149, ``<depend>``; ``catkin_pkg/package.py``.
    """

    code = "PX025"
    name = "dependency-redundant"
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
                "<exec_depend> 'std_msgs' is covered by <depend> in line 2: colcon refuses both",
                fix="remove it",
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
                "<exec_depend> 'std_msgs' is already declared in line 2",
                fix="remove it",
                severity=Severity.WARNING,
            ),
            fixed={
                "package.xml": '<package format="3">\n'
                "  <exec_depend>std_msgs</exec_depend>\n</package>\n"
            },
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
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
                    f"<{kind}> {name!r} is covered by <depend> in line {line}: colcon refuses both"
                )
            elif dependency.element is not manifest.depends(kind)[name].element and name:
                if first == dependency.location.line:
                    continue
                message = f"<{kind}> {name!r} is already declared in line {first}"
            else:
                continue
            fix = Fix("remove it", (manifest.remove(dependency.element),))
            is_refused = kind == "depend" or other is not None
            severity = Severity.ERROR if is_refused else Severity.WARNING
            yield self.report(dependency, message, fix, severity=severity)
