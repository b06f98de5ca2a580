"""PX060: the elements of package.xml stand in the order of the schema."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Fix, Package, Report, Rule, Safety, Severity
from scaffold.api.manifest import Misplaced, structure

RIGHT = """\
<package format="3">
  <name>talker</name>
  <version>1.0.0</version>
  <description>Talks.</description>
  <maintainer email="a@b.org">A</maintainer>
  <license>Apache-2.0</license>
  <author>B</author>
  <depend>rclpy</depend>
  <export/>
</package>
"""
AUTHOR, LICENCE = "  <author>B</author>\n", "  <license>Apache-2.0</license>\n"
EARLY = RIGHT.replace(LICENCE + AUTHOR, AUTHOR + LICENCE)
LATE = RIGHT.replace("  <export/>\n", "  <export/>\n  <exec_depend>launch</exec_depend>\n")


class ElementMisplaced(Rule):
    """An element of package.xml stands where the schema does not allow it.

    **Why.** ``ament_xmllint`` fails under ``colcon test``, with a message that names the element
    behind the wrong one.

    **Fix.** Put the elements in the order name, version, description, maintainer, license, url,
    author, dependencies, group_depend, member_of_group, export. Comments go with the element that
    they stand in front of; where there are any, the author should look at the result.

    **Source.** The schemas ``package_format1.xsd`` to ``package_format3.xsd``; REP-149.
    """

    code = "PX060"
    name = "element-misplaced"
    severity = Severity.WARNING
    examples = (
        Example("in order", {"package.xml": RIGHT}),
        Example(
            "<author> before <license>",
            {"package.xml": EARLY},
            reports=(
                Report(
                    "package.xml:6:4",
                    "<author> must stand behind <license> in line 7 and before <depend> in line 8",
                    fix="put the elements in order",
                ),
            ),
            fixed={"package.xml": RIGHT},
        ),
        Example(
            "<export> before a dependency",
            {"package.xml": LATE},
            reports=(
                Report(
                    "package.xml:9:4",
                    "<export> must stand behind <exec_depend> in line 10",
                    fix="put the elements in order",
                ),
            ),
            fixed={
                "package.xml": RIGHT.replace(
                    "  <export/>\n", "  <exec_depend>launch</exec_depend>\n  <export/>\n"
                )
            },
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        found = structure(package).misplaced
        if not found:
            return
        fix = _fix(package)
        for misplaced in found:
            yield self.report(misplaced.elements[0].name_location, _message(misplaced), fix)


def _fix(package: Package) -> Fix | None:
    from scaffold.api.manifest import manifest_edit

    manifest = package.manifest
    edit = None if structure(package).unknown else manifest_edit.reorder(manifest)
    if edit is None:
        return None
    moved = range(edit.start, edit.end)
    has_comments = any(comment.start in moved for comment in manifest.comments)
    safety = Safety.UNSAFE if has_comments else Safety.SAFE
    return Fix("put the elements in order", (edit,), safety)


def _message(misplaced: Misplaced) -> str:
    tag = misplaced.elements[0].tag
    sides = [
        f"{word} <{element.tag}> in line {element.location.line}"
        for word, element in (("behind", misplaced.after), ("before", misplaced.before))
        if element is not None
    ]
    number = len(misplaced.elements)
    subject = f"<{tag}>" if number == 1 else f"<{tag}> and what follows it ({number} elements)"
    return f"{subject} must stand {' and '.join(sides)}"
