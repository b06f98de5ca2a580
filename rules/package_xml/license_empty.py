"""PX004: the licence is named."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule


class LicenseEmpty(Rule):
    """``<license>`` is empty.

    **Why.** catkin_pkg, and with it colcon, refuses the manifest: the package is not built.

    **Fix.** Write an SPDX identifier such as ``Apache-2.0``.

    **Source.** REP-149, ``<license>``; ``catkin_pkg.package.Package.validate``.
    """

    code = "PX004"
    name = "license-empty"
    examples = (
        Example("named", {"package.xml": "<package><license>MIT</license></package>\n"}),
        Example(
            "empty",
            {"package.xml": "<package>\n  <license> </license>\n</package>\n"},
            Report("package.xml:2:3", "the licence is empty: colcon refuses the package"),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for element in package.manifest.all("license"):
            if not element.text:
                yield self.report(element, "the licence is empty: colcon refuses the package")
