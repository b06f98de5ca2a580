"""PX002: the package is described."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity
from scaffold.api.manifest import is_placeholder


class DescriptionPlaceholder(Rule):
    """``<description>`` is empty or a placeholder.

    **Why.** catkin_pkg, and with it colcon and bloom, refuses an empty description; a placeholder
    becomes the text of the Debian package.

    **Fix.** Say in a sentence what the package is for.

    **Source.** REP-149, ``<description>``; ``catkin_pkg.package.Package.validate``.
    """

    code = "PX002"
    name = "description-placeholder"
    severity = Severity.WARNING
    other_severities = {Severity.ERROR: "there is no description: the package is not built"}
    release_refused = "the placeholder becomes the text of the Debian package"
    examples = (
        Example(
            "a sentence", {"package.xml": "<package><description>Talks.</description></package>\n"}
        ),
        Example(
            "as written by ros2 pkg create",
            {
                "package.xml": "<package>\n"
                "  <description>TODO: Package description</description>\n"
                "</package>\n"
            },
            Report("2:3", "the description is a placeholder, 'TODO: Package description'"),
        ),
        Example(
            "nothing",
            {"package.xml": "<package>\n  <description> </description>\n</package>\n"},
            Report(
                "2:3",
                "the description is empty: colcon refuses the package",
                severity=Severity.ERROR,
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for element in package.manifest.all("description"):
            if is_placeholder(element.text):
                yield self.report(element, f"the description is a placeholder, {element.text!r}")
            elif not element.text:
                message = "the description is empty: colcon refuses the package"
                yield self.report(element, message, severity=Severity.ERROR)
