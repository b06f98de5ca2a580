"""PX016: a package is not a member of a group that it depends on."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule

_MANIFEST = (
    '<package format="3">\n  <group_depend>drivers</group_depend>\n'
    "  <member_of_group>{}</member_of_group>\n</package>\n"
)


class GroupRepeated(Rule):
    """A package depends on a group and is a member of it.

    **Why.** It would need itself: catkin_pkg, and with it colcon, refuses the manifest.

    **Fix.** Remove one of the two.

    **Source.** REP-149, ``<group_depend>``; ``catkin_pkg.package.Package.validate``.
    """

    code = "PX016"
    name = "group-repeated"
    examples = (
        Example("two groups", {"package.xml": _MANIFEST.format("tools")}),
        Example(
            "one group",
            {"package.xml": _MANIFEST.format("drivers")},
            Report("3:3", "member of the group 'drivers', which line 2 depends on"),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        manifest = package.manifest
        needed = {element.text: element for element in manifest.all("group_depend")}
        for element in manifest.all("member_of_group"):
            other = needed.get(element.text)
            if other is not None:
                line = other.location.line
                message = f"member of the group {element.text!r}, which line {line} depends on"
                yield self.report(element, message)
