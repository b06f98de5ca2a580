"""LY005: the changelog can be read by the release tools."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import pairwise

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity

_TITLE = "^^^^^^^^^^^^^^^^^^^^^^\nChangelog for talker\n^^^^^^^^^^^^^^^^^^^^^^\n\n"
_HEADING = r"(?:forthcoming|v?\d+\.\d+\.\d+(?:\s*\(.*\))?)"


class ChangelogMalformed(Rule):
    """CHANGELOG.rst has a section whose heading is not a version.

    **Why.** ``catkin_prepare_release`` and bloom read the sections by their headings,
    ``0.1.0 (2026-11-21)``; what does not fit is missing from the release.

    **Fix.** Write the heading as version and date, or ``Forthcoming``.

    **Source.** REP-132.
    """

    code = "LY005"
    name = "changelog-malformed"
    severity = Severity.WARNING
    release_refused = "bloom leaves the section out"
    examples = (
        Example(
            "versions",
            {
                "CHANGELOG.rst": f"{_TITLE}Forthcoming\n-----------\n* more\n\n"
                "0.1.0 (2026-11-21)\n------------------\n* first\n"
            },
        ),
        Example(
            "a word before the version",
            {"CHANGELOG.rst": f"{_TITLE}Release 0.1\n-----------\n* first\n"},
            Report("5:1", "the section 'Release 0.1' is not a version such as 1.2.3 (2026-11-21)"),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
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
                at, f"the section {text!r} is not a version such as 1.2.3 (2026-11-21)"
            )
