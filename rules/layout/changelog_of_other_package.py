"""LY041: the changelog names its own package."""

from __future__ import annotations

import re
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule, Severity

_TITLE = r"^Changelog for package\s+(\S+)"
_TEXT = (
    "^^^^^^^^^^^^^^^^^^^^^^^^^^^^\nChangelog for package {}\n^^^^^^^^^^^^^^^^^^^^^^^^^^^^\n\n"
    "1.2.0 (2024-11-04)\n------------------\n* First\n"
)
_MANIFEST = "<package><name>talker</name><version>1.2.0</version></package>\n"


class ChangelogOfOtherPackage(Rule):
    """The title of CHANGELOG.rst names another package.

    **Why.** The changelog is shown on the page of the package in the ROS Index; often, the file was
    copied from the other package.

    **Fix.** Write the name of the package.

    **Source.** REP 132.
    """

    code = "LY041"
    name = "changelog-of-other-package"
    severity = Severity.WARNING
    examples = (
        Example(
            "this package", {"package.xml": _MANIFEST, "CHANGELOG.rst": _TEXT.format("talker")}
        ),
        Example(
            "another package",
            {"package.xml": _MANIFEST, "CHANGELOG.rst": _TEXT.format("other")},
            "CHANGELOG.rst:2:23: the title names 'other', but the package is 'talker'",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        source = package.source("CHANGELOG.rst")
        title = re.search(_TITLE, source.text, re.MULTILINE)
        if title is None or not package.manifest.name:
            return
        at = source.location(title.start(1), title.end(1))
        if title[1] != package.manifest.name:
            message = f"the title names {title[1]!r}, but the package is {package.manifest.name!r}"
            yield self.report(at, message)
