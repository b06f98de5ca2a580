"""PX001: the licence is decided."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.manifest import is_placeholder


class LicensePlaceholder(Rule):
    """``<license>`` still waits for a licence.

    **Why.** Without a licence nobody may use the package, and rosdistro refuses its release.

    **Fix.** Write an SPDX identifier such as ``Apache-2.0``. No automatic fix: the choice is the
    author's.

    **Source.** REP-149, ``<license>``; rosdistro review guidelines.
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
                "package.xml:2:12",
                "the licence is a placeholder, 'TODO: License declaration': nobody "
                "may use the package",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for element in package.manifest.all("license"):
            if is_placeholder(element.text):
                message = (
                    f"the licence is a placeholder, {element.text!r}: nobody may use the package"
                )
                yield self.report(element.text_location, message)
