"""PX064: the elements of package.xml have only the attributes of their format."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import get_close_matches

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.formats import Attribute, Element
from scaffold.api.manifest import Structure, structure


class AttributeUnknown(Rule):
    """An element of package.xml has an attribute that its format does not know.

    **Why.** colcon refuses the manifest, or ``ament_xmllint`` fails under ``colcon test``.

    **Fix.** Correct the name or remove the attribute.

    **Source.** REP-127, REP-140, REP-149 and their schemas. ``<version compatibility>`` is in
    REP-149 but not in the schema of format 3, so the linter refuses it.
    """

    code = "PX064"
    name = "attribute-unknown"
    examples = (
        Example(
            "known",
            {
                "package.xml": '<package format="3">\n  <license file="LICENSE">MIT</license>\n'
                '  <depend version_gte="1.2">rclpy</depend>\n</package>\n'
            },
        ),
        Example(
            "misspelt, too early, unknown to the schema",
            {
                "package.xml": '<package format="2">\n'
                '  <version compatibility="1.0.0">1.2.0</version>\n'
                '  <license file="LICENSE">MIT</license>\n'
                '  <depend version_get="1.2">rclpy</depend>\n</package>\n'
            },
            reports=(
                Report(
                    "package.xml:2:12",
                    "<version compatibility> is in REP-149, but ament_xmllint's schema refuses it",
                ),
                Report(
                    "package.xml:3:12",
                    "<license file> needs format 3, but this manifest has format 2",
                ),
                Report(
                    "package.xml:4:11",
                    '<depend> has no attribute "version_get": it has "version_gt"',
                ),
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        found = structure(package)
        for element, attribute in found.unknown_attributes:
            if attribute.name != "condition":
                said = _explain(found, element, attribute)
                yield self.report(attribute.name_location, said)


def _explain(found: Structure, element: Element, attribute: Attribute) -> str:
    name, tag = attribute.name, element.tag
    if name == "xmlns":
        return f"<{tag}> gets a namespace: the elements of a manifest have none"
    if (tag, name) == ("license", "file"):
        return f"<license file> needs format 3, but this manifest has format {found.format}"
    if (tag, name) == ("version", "compatibility"):
        return "<version compatibility> is in REP-149, but ament_xmllint's schema refuses it"
    allowed = found.attributes(element)
    near = get_close_matches(name, allowed, n=1)
    if near:
        return f'<{tag}> has no attribute "{name}": it has "{near[0]}"'
    if allowed:
        return f'<{tag}> has no attribute "{name}", only {", ".join(allowed)}'
    return f'<{tag}> has no attributes in format {found.format}, so no "{name}"'
