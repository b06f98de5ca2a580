"""PX001: the license is decided."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.manifest import is_placeholder


class LicensePlaceholder(Rule):
    """``<license>`` is empty or a placeholder.

    **Why.** Without a license no one may use the package, and rosdistro refuses its release. colcon
    does not build a package whose license is empty.

    **Fix.** Write an SPDX identifier such as ``Apache-2.0``. No automatic fix: the choice is the
    author's.

    **Source.** REP-149, ``<license>``; ``catkin_pkg.package.Package.validate``; rosdistro review
    guidelines.
    """

    code = "PX001"
    name = "license-placeholder"
    examples = (
        Example("SPDX", {"package.xml": "<package><license>Apache-2.0</license></package>\n"}),
        Example(
            "as written by ros2 pkg create",
            {
                "package.xml": "<package>\n"
                "  <license>TODO: License declaration</license>\n"
                "</package>\n"
            },
            Report(
                "2:12",
                "the license is a placeholder, 'TODO: License declaration': nobody "
                "may use the package",
            ),
        ),
        Example(
            "empty",
            {"package.xml": "<package>\n  <license> </license>\n</package>\n"},
            Report("2:3", "the license is empty: colcon refuses the package"),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for element in package.manifest.all("license"):
            if not element.text:
                yield self.report(element, "the license is empty: colcon refuses the package")
            elif is_placeholder(element.text):
                message = (
                    f"the license is a placeholder, {element.text!r}: nobody may use the package"
                )
                yield self.report(element.text_location, message)
