"""PX066: no text stands between the elements of package.xml."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity
from scaffold.api.manifest import structure


class TextBetweenElements(Rule):
    """Text stands between the elements of package.xml, or directly in ``<export>``.

    **Why.** ``ament_xmllint`` fails under ``colcon test``; everybody else ignores the text, which
    is mostly the rest of an element or of a comment.

    **Fix.** Remove the text, or make a comment of it.

    **Source.** The schemas ``package_format1.xsd`` to ``package_format3.xsd``.
    """

    code = "PX066"
    name = "text-between-elements"
    severity = Severity.WARNING
    examples = (
        Example(
            "a comment",
            {"package.xml": "<package>\n  <!-- more -->\n  <name>talker</name>\n</package>\n"},
        ),
        Example(
            "text",
            {
                "package.xml": "<package>\n  <name>talker</name>>\n  <export>\n"
                "    ament_python\n  </export>\n</package>\n"
            },
            reports=(
                Report("package.xml:2:22", "text stands between the elements: only comments may"),
                Report("package.xml:4:5", "text stands between the elements: only comments may"),
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for at in structure(package).stray_texts:
            yield self.report(at, "text stands between the elements: only comments may")
