"""PX071: conditions stand where the format has them, in characters that are allowed."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.manifest import (
    CONDITION,
    FORMATS,
    GROUP_CONDITION,
    GROUPS,
    collapse,
    fits,
    structure,
)

DEPEND = '<package format="{}">\n  <depend condition="{}">rclpy</depend>\n</package>\n'


class ConditionMisplaced(Rule):
    """A ``condition`` stands where its format has none, or has characters that are not allowed.

    **Why.** colcon refuses the manifest, or ``ament_xmllint`` fails under ``colcon test``.

    **Fix.** Declare format 3; only dependencies and groups have conditions. Those of groups take
    no quotes in the schema: write the bare word.

    **Source.** REP-149, "Conditions"; ``package_format3.xsd``.
    """

    code = "PX071"
    name = "condition-misplaced"
    examples = (
        Example("format 3", {"package.xml": DEPEND.format(3, "$ROS_VERSION == 2")}),
        Example(
            "format 2",
            {"package.xml": DEPEND.format(2, "$ROS_VERSION == 2")},
            reports=(
                Report(
                    "package.xml:2:11", "conditions need format 3, but this manifest has format 2"
                ),
            ),
        ),
        Example(
            "a character that no condition has",
            {"package.xml": DEPEND.format(3, "$ROS_VERSION == 2 | 1")},
            reports=(
                Report(
                    "package.xml:2:22",
                    "'$ROS_VERSION == 2 | 1': the schema does not allow all of these "
                    "characters for dependencies",
                ),
            ),
        ),
        Example(
            "quotes in the condition of a group",
            {
                "package.xml": '<package format="3">\n'
                "  <member_of_group condition=\"$A == 'b'\">g</member_of_group>\n</package>\n"
            },
            reports=(
                Report(
                    "package.xml:2:31",
                    "\"$A == 'b'\": the schema does not allow all of these characters for groups",
                ),
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        found = structure(package)
        for element, attribute in found.unknown_attributes:
            if attribute.name == "condition":
                if found.format < FORMATS[-1]:
                    said = f"conditions need format 3, but this manifest has format {found.format}"
                else:
                    said = f"<{element.tag}> has no condition: only dependencies and groups have"
                yield self.report(attribute.name_location, said)
        for element in found.known:
            if "condition" not in found.attributes(element) or element.get("condition") is None:
                continue
            attribute = element.attributes["condition"]
            is_group = element.tag in GROUPS
            if not fits(GROUP_CONDITION if is_group else CONDITION, collapse(attribute.value)):
                what = "groups" if is_group else "dependencies"
                said = f"the schema does not allow all of these characters for {what}"
                yield self.report(attribute.location, f"{attribute.value!r}: {said}")
