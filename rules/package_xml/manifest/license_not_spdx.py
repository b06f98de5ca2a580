"""PX005: licenses are SPDX identifiers."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule, Severity
from scaffold.api.manifest import similar_license, spdx_of


class LicenseNotSpdx(Rule):
    """``<license>`` is not an SPDX identifier.

    **Why.** The release guide requires the short identifier, which tools compare; ``BSD`` alone is
    ambiguous.

    **Fix.** Write the identifier.

    **Source.** ROS 2 documentation, "Indexing your packages"; https://spdx.org/licenses.
    """

    code = "PX005"
    name = "license-not-spdx"
    severity = Severity.INFO
    other_severities = {Severity.WARNING: "the identifier is misspelled"}
    examples = (
        Example("SPDX", {"package.xml": "<package><license>MIT</license></package>\n"}),
        Example(
            "a common spelling in ROS packages",
            {"package.xml": "<package><license>Apache License 2.0</license></package>\n"},
        ),
        Example(
            "another spelling",
            {"package.xml": "<package>\n  <license>MIT License</license>\n</package>\n"},
            Report("2:12", "the SPDX identifier of 'MIT License' is MIT", fix="Replace with MIT"),
            fixed={"package.xml": "<package>\n  <license>MIT</license>\n</package>\n"},
        ),
        Example(
            "a misspelled identifier",
            {"package.xml": "<package>\n  <license>BBSD-3-Clause</license>\n</package>\n"},
            Report(
                "2:12",
                "unknown license 'BBSD-3-Clause'; did you mean 'BSD-3-Clause'?",
                fix="Replace with BSD-3-Clause",
                severity=Severity.WARNING,
            ),
            fixed={"package.xml": "<package>\n  <license>BSD-3-Clause</license>\n</package>\n"},
        ),
        Example(
            "ambiguous: this version only, or later versions",
            {"package.xml": "<package>\n  <license>GPLv3</license>\n</package>\n"},
            "2:12: 'GPLv3' is ambiguous; choose from GPL-3.0-only, GPL-3.0-or-later",
        ),
        Example(
            "ambiguous: BSD",
            {"package.xml": "<package>\n  <license>BSD</license>\n</package>\n"},
            "2:12: 'BSD' is ambiguous; choose from BSD-2-Clause, BSD-3-Clause",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for element in package.manifest.all("license"):
            identifiers = spdx_of(element.text)
            closest = similar_license(element.text)
            if closest:
                message = f"unknown license {element.text!r}; did you mean {closest!r}?"
                edit = Edit("package.xml", *element.text_span, closest)
                fix = Fix(f"Replace with {closest}", (edit,))
                at = element.text_location
                yield self.report(at, message, fix, severity=Severity.WARNING)
            if not identifiers or element.text in identifiers or identifiers == ("Apache-2.0",):
                continue
            if len(identifiers) > 1:
                message = f"{element.text!r} is ambiguous; choose from {', '.join(identifiers)}"
                yield self.report(element.text_location, message)
                continue
            edit = Edit("package.xml", *element.text_span, identifiers[0])
            fix = Fix(f"Replace with {identifiers[0]}", (edit,))
            message = f"the SPDX identifier of {element.text!r} is {identifiers[0]}"
            yield self.report(element.text_location, message, fix)
