"""PX061: package.xml has only the elements of its format."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import get_close_matches

from scaffold.api import Diagnostic, Example, Fix, Package, Report, Rule, Safety
from scaffold.api.manifest import Structure, Unknown, structure

HEAD = '<package format="{}">\n  <name>talker</name>\n'
IN_EXPORT = frozenset({"architecture_independent", "build_type", "deprecated", "metapackage"})


class ElementUnknown(Rule):
    """package.xml has an element that its format does not know.

    **Why.** colcon refuses the manifest: the package is not built, or only as something else.

    **Fix.** Use the element of this format: ``<exec_depend>`` instead of ``<run_depend>`` since
    format 2, or declare the later format.

    **Source.** REP-127, REP-140, REP-149; ``catkin_pkg/package.py``.
    """

    code = "PX061"
    name = "element-unknown"
    examples = (
        Example(
            "of format 3",
            {"package.xml": HEAD.format(3) + "  <exec_depend>rclpy</exec_depend>\n</package>\n"},
        ),
        Example(
            "of format 1 in format 3",
            {"package.xml": HEAD.format(3) + "  <run_depend>rclpy</run_depend>\n</package>\n"},
            reports=(
                Report(
                    "package.xml:3:4",
                    "<run_depend> is of format 1: in format 3 it is <exec_depend>",
                    unsafe_fix="write <exec_depend>",
                ),
            ),
            fixed={
                "package.xml": HEAD.format(3) + "  <exec_depend>rclpy</exec_depend>\n</package>\n"
            },
        ),
        Example(
            "of format 3 in format 2",
            {"package.xml": HEAD.format(2) + "  <group_depend>a</group_depend>\n</package>\n"},
            reports=(
                Report(
                    "package.xml:3:4",
                    "<group_depend> needs format 3, but this manifest has format 2",
                ),
            ),
        ),
        Example(
            "misspelt",
            {"package.xml": HEAD.format(2) + "  <licence>MIT</licence>\n</package>\n"},
            reports=(
                Report(
                    "package.xml:3:4",
                    "<licence> is not known in format 2: <license> is",
                    unsafe_fix="write <license>",
                ),
            ),
            fixed={"package.xml": HEAD.format(2) + "  <license>MIT</license>\n</package>\n"},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for unknown in structure(package).unknown:
            said, tag = _explain(structure(package), unknown)
            message = f"<{unknown.element.tag}> {said}"
            fix = _rename(package, unknown, tag) if tag else None
            yield self.report(unknown.element.name_location, message, fix)


def _explain(found: Structure, unknown: Unknown) -> tuple[str, str | None]:
    """Return what is wrong, and the tag that it should be, if that is plain."""
    tag, number = unknown.element.tag, found.format
    if unknown.element is found.root:
        return "is not <package>, the root of every manifest", None
    if unknown.since is not None:
        return f"needs format {unknown.since}, but this manifest has format {number}", None
    if tag == "run_depend":
        return f"is of format 1: in format {number} it is <exec_depend>", "exec_depend"
    if tag in IN_EXPORT:
        return "belongs inside of <export>", None
    near = get_close_matches(tag, found.sections, n=1, cutoff=0.75)
    if near:
        return f"is not known in format {number}: <{near[0]}> is", near[0]
    return f"is not known in format {number}", None


def _rename(package: Package, unknown: Unknown, tag: str) -> Fix:
    from scaffold.api.manifest import manifest_edit

    edits = manifest_edit.rename(package.manifest, unknown.element, tag)
    return Fix(f"write <{tag}>", edits, Safety.UNSAFE)
