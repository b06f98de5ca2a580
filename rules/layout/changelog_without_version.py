"""LY060: the changelog has a section for the version of the package."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import pairwise

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity

_HEADING = r"v?(\d+\.\d+\.\d+)(?:\s*\(.*\))?"
_TITLE = "^^^^^^^^^^^^^^^^^^^^^^\nChangelog for talker\n^^^^^^^^^^^^^^^^^^^^^^\n\n"
_SECTION = "0.1.0 (2026-11-21)\n------------------\n* first\n"
_MANIFEST = "<package>\n  <version>{}</version>\n</package>\n"


class ChangelogWithoutVersion(Rule):
    """CHANGELOG.rst has sections for other versions, and none for the one of the package.

    **Why.** bloom looks for ``0.2.0 (2026-11-21)`` and releases the package without a word about
    what is new; ``catkin_prepare_release`` asks for ``Forthcoming`` when there is nothing newer.

    **Fix.** Add the section, or ``Forthcoming``, and let ``catkin_prepare_release`` raise the
    version in all places at once.

    **Source.** REP-132; ``catkin_pkg/changelog.py``; bloom, ``generators/debian``.
    """

    code = "LY060"
    name = "changelog-without-version"
    severity = Severity.INFO
    release_refused = "the release has no entry in the changelog"
    examples = (
        Example(
            "there", {"package.xml": _MANIFEST.format("0.1.0"), "CHANGELOG.rst": _TITLE + _SECTION}
        ),
        Example(
            "still to come",
            {
                "package.xml": _MANIFEST.format("0.2.0"),
                "CHANGELOG.rst": f"{_TITLE}Forthcoming\n-----------\n* more\n\n{_SECTION}",
            },
        ),
        Example(
            "raised by hand",
            {"package.xml": _MANIFEST.format("0.2.0"), "CHANGELOG.rst": _TITLE + _SECTION},
            Report(
                "CHANGELOG.rst:5:1",
                "no section for 0.2.0, the version in package.xml, line 2; the newest is 0.1.0",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        source = package.source("CHANGELOG.rst")
        elements = package.manifest.all("version")
        if not elements or re.search(r"(?im)^(forthcoming|upcoming|unreleased)", source.text):
            return
        version = elements[0].text.strip()
        sections: list[tuple[int, str]] = []
        for number, (line, below) in enumerate(pairwise(source.lines), 1):
            matched = re.fullmatch(_HEADING, line.strip(), re.IGNORECASE)
            if matched is not None and re.fullmatch(r"([-=~^\"'])\1{2,}\s*", below):
                sections.append((number, matched[1]))
        if sections and all(item != version for _, item in sections):
            message = (
                f"no section for {version}, the version in package.xml, line "
                f"{elements[0].location.line}; the newest is {sections[0][1]}"
            )
            yield self.report(source.line_location(sections[0][0]), message)
