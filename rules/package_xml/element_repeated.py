"""PX063: what package.xml may say once is said once."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Fix, Package, Report, Rule
from scaffold.api.manifest import structure

ONE = '<package format="3">\n  <name>talker</name>\n'


class ElementRepeated(Rule):
    """package.xml has a second name, version, description or export.

    **Why.** colcon refuses the manifest: the package is not built, or only as something else.

    **Fix.** Keep one; put everything that is exported into one ``<export>``.

    **Source.** REP-149; ``catkin_pkg/package.py``.
    """

    code = "PX063"
    name = "element-repeated"
    examples = (
        Example("one", {"package.xml": f"{ONE}</package>\n"}),
        Example(
            "the same again",
            {"package.xml": f"{ONE}  <name>talker</name>\n</package>\n"},
            reports=(
                Report(
                    "package.xml:3:4",
                    "a second <name>: the first is in line 2",
                    fix="remove the second one",
                ),
            ),
            fixed={"package.xml": f"{ONE}</package>\n"},
        ),
        Example(
            "another one",
            {"package.xml": f"{ONE}  <name>listener</name>\n</package>\n"},
            reports=(Report("package.xml:3:4", "a second <name>: the first is in line 2"),),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for again, first in structure(package).repeated:
            line = first.location.line
            fix = None
            if again.raw == first.raw:
                fix = Fix("remove the second one", (package.manifest.remove(again),))
            message = f"a second <{again.tag}>: the first is in line {line}"
            yield self.report(again.name_location, message, fix)
