"""LY005: the changelog has a section for the current version, in the format of release tools."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import pairwise

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity

_TITLE = "^^^^^^^^^^^^^^^^^^^^^^\nChangelog for talker\n^^^^^^^^^^^^^^^^^^^^^^\n\n"
_HEADING = r"(?:forthcoming|v?\d+\.\d+\.\d+(?:\s*\(.*\))?)"
_HEADING_VERSION = r"v?(\d+\.\d+\.\d+)(?:\s*\(.*\))?"
_SECTION = "0.1.0 (2026-11-21)\n------------------\n* first\n"
_MANIFEST = "<package>\n  <version>{}</version>\n</package>\n"


class ChangelogMalformed(Rule):
    """CHANGELOG.rst has a heading that is not a version, or no section for the current version.

    **Why.** ``catkin_prepare_release`` and bloom read the sections by their headings, ``0.1.0
    (2026-11-21)``; sections with other headings are missing from the release, and a version without
    a section is released without release notes.

    **Fix.** Write the heading as version and date, or ``Forthcoming``, and let
    ``catkin_prepare_release`` update the version everywhere.

    **Source.** REP 132; ``catkin_pkg/changelog.py``; bloom, ``generators/debian``.
    """

    code = "LY005"
    name = "changelog-malformed"
    severity = Severity.WARNING
    other_severities = {Severity.INFO: "the version of the package has no section"}
    release_refused = "bloom skips the section, or finds none for the release"
    examples = (
        Example(
            "versions",
            {
                "CHANGELOG.rst": f"{_TITLE}Forthcoming\n-----------\n* more\n\n"
                "0.1.0 (2026-11-21)\n------------------\n* first\n"
            },
        ),
        Example(
            "text before the version",
            {"CHANGELOG.rst": f"{_TITLE}Release 0.1\n-----------\n* first\n"},
            "5:1: heading 'Release 0.1' is not a version, such as '1.2.3 (2026-11-21)': release "
            "tools skip the section",
        ),
        Example(
            "a section for the version",
            {"package.xml": _MANIFEST.format("0.1.0"), "CHANGELOG.rst": _TITLE + _SECTION},
        ),
        Example(
            "a version that is not released yet",
            {
                "package.xml": _MANIFEST.format("0.2.0"),
                "CHANGELOG.rst": f"{_TITLE}Forthcoming\n-----------\n* more\n\n{_SECTION}",
            },
        ),
        Example(
            "a version that was changed by hand",
            {"package.xml": _MANIFEST.format("0.2.0"), "CHANGELOG.rst": _TITLE + _SECTION},
            Report(
                "CHANGELOG.rst:5:1",
                "no section for 0.2.0, the version in package.xml, line 2: it is "
                "released without notes; the newest section is 0.1.0",
                severity=Severity.INFO,
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_headings(package)
        yield from self._check_version(package)

    def _check_headings(self, package: Package) -> Iterator[Diagnostic]:
        source = package.source("CHANGELOG.rst")
        lines = source.lines
        for number, (line, below) in enumerate(pairwise(lines), 1):
            text = line.strip()
            if not text or line[0].isspace() or not re.fullmatch(r"-{3,}\s*", below):
                continue
            if re.fullmatch(r"[-=^~\"]+", text) or re.fullmatch(_HEADING, text.lower()):
                continue
            at = source.line_location(number)
            yield self.report(
                at,
                f"heading {text!r} is not a version, such as '1.2.3 (2026-11-21)': release "
                f"tools skip the section",
            )

    def _check_version(self, package: Package) -> Iterator[Diagnostic]:
        source = package.source("CHANGELOG.rst")
        elements = package.manifest.all("version")
        if not elements or re.search(r"(?im)^(forthcoming|upcoming|unreleased)", source.text):
            return
        version = elements[0].text.strip()
        sections: list[tuple[int, str]] = []
        for number, (line, below) in enumerate(pairwise(source.lines), 1):
            matched = re.fullmatch(_HEADING_VERSION, line.strip(), re.IGNORECASE)
            if matched is not None and re.fullmatch(r"([-=~^\"'])\1{2,}\s*", below):
                sections.append((number, matched[1]))
        if sections and all(item != version for _, item in sections):
            message = (
                f"no section for {version}, the version in package.xml, line "
                f"{elements[0].location.line}: it is released without notes; the newest section "
                f"is {sections[0][1]}"
            )
            at = source.line_location(sections[0][0])
            yield self.report(at, message, severity=Severity.INFO)
