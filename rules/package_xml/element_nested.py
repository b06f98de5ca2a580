"""PX074: the elements of package.xml that hold text hold text only."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.manifest import structure


class ElementNested(Rule):
    """An element stands inside of one that holds only text.

    **Why.** colcon refuses the manifest: the package is not built, or only as something else.

    **Fix.** Close the outer element first; only ``<description>`` and ``<export>`` hold others.

    **Source.** REP-149; ``catkin_pkg/package.py``; the schemas.
    """

    code = "PX074"
    name = "element-nested"
    examples = (
        Example(
            "in a description",
            {"package.xml": "<package><description>A <b>talker</b>.</description></package>\n"},
        ),
        Example(
            "in a licence",
            {
                "package.xml": "<package>\n  <license>\n"
                "    <url>http://a.org</url>\n  </license>\n</package>\n"
            },
            reports=(
                Report(
                    "package.xml:3:6", "<url> stands inside of <license>, which holds text only"
                ),
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for child, parent in structure(package).nested:
            message = f"<{child.tag}> stands inside of <{parent.tag}>, which holds text only"
            yield self.report(child.name_location, message)
