"""PX050: every XML file of the package can be read."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule

MANIFEST = "package.xml"


class XmlNotWellFormed(Rule):
    """An XML file other than package.xml cannot be read.

    **Why.** Whoever loads it (launch, a plugin loader, robot_state_publisher) stops there, and
    ``ament_xmllint`` fails under ``colcon test``. For package.xml itself SC001 says so.

    **Fix.** Mend the markup at the place shown; a reader stops at the first mistake.

    **Source.** ``ament_xmllint/main.py``; libxml2's limits on depth and length of text.
    """

    code = "PX050"
    name = "xml-not-well-formed"
    examples = (
        Example(
            "well-formed",
            {"package.xml": "<package/>\n", "launch/talker.launch.xml": "<launch>\n</launch>\n"},
        ),
        Example(
            "an element is not closed",
            {"launch/talker.launch.xml": "<launch>\n  <node>\n</launch>\n"},
            reports=(
                Report(
                    "launch/talker.launch.xml:3:1",
                    "</node> expected, <node> opened at line 2 is not closed",
                ),
            ),
        ),
        Example(
            "empty", {"plugins.xml": ""}, reports=(Report("plugins.xml:1:1", "the file is empty"),)
        ),
        Example("not linted", {"AMENT_IGNORE": "", "broken.xml": "<a>"}),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        from scaffold.api.ament import xmllint

        for path in xmllint.of_package(package):
            if path != MANIFEST:
                mistake = xmllint.mistake(package, path)
                if mistake is not None:
                    at, message = mistake
                    yield self.report(at, message)
