"""Findings grouped by cause, the most important first."""

from __future__ import annotations

import os
import re
from collections.abc import Sequence

from scaffold.ament.codes import STYLE
from scaffold.check.result import Result
from scaffold.diagnostic import Diagnostic, Severity
from scaffold.model.package import Package
from scaffold.record import NamedTuple
from scaffold.reporters.paths import shown

SEVERITIES = (Severity.ERROR, Severity.WARNING, Severity.INFO)
"""Worst first."""

_LAST = ("PX", "LY", "NM", "TS")
"""Areas whose findings stop no build and no program: the manifest, files, names, tests."""
_LATER = ("CM", "SC007", *_LAST)
"""Areas whose findings do not crash a running program, and packages that are for ROS 1 alone."""
_SET_ASIDE = re.compile(
    r"(?:.*[_ .-])?(?:archived?|archives|attic|backups?|bak|deprecated|junk|legacy|obsolete|old"
    r"|trash|unused)",
    re.IGNORECASE,
)
"""Matches the name of a directory with code that nobody works on anymore."""
DEPENDENCY = "dependency "
"""Begins the cause of what only happens on a machine that lacks a package."""


class Entry(NamedTuple):
    """Findings in one package that have one cause; one edit may end them all.

    Attributes:
        package: Where they are.
        places: The findings, the worst first, then in reading order; there is at least one.
    """

    package: Package
    places: tuple[Diagnostic, ...]

    @property
    def first(self) -> Diagnostic:
        """The finding whose message is shown."""
        return self.places[0]

    @property
    def severity(self) -> Severity:
        """That of the worst of them."""
        return self.first.severity


def by_cause(result: Result) -> list[Entry]:
    """Return the findings of a package as entries.

    Findings have one cause if their rules say so, or if they read the same.
    """
    causes: dict[tuple[str, ...], list[Diagnostic]] = {}
    for diagnostic in result.diagnostics:
        key = (
            (diagnostic.cause,)
            if diagnostic.cause
            else (diagnostic.code, diagnostic.message, diagnostic.severity.value)
        )
        causes.setdefault(key, []).append(diagnostic)
    return [
        Entry(
            result.package,
            tuple(sorted(places, key=lambda place: SEVERITIES.index(place.severity))),
        )
        for places in causes.values()
    ]


def in_order(entries: Sequence[Entry]) -> list[Entry]:
    """Return entries by severity; of one severity, what crashes or builds wrong comes first.

    What is in a directory such as ``archive`` or ``old`` comes after all others.
    """
    return sorted(entries, key=_rank)


def is_style(diagnostic: Diagnostic) -> bool:
    """Tell whether a finding is one of ament_flake8 or ament_pep257 that breaks nothing."""
    return diagnostic.code in STYLE and diagnostic.severity is not Severity.ERROR


def _is_set_aside(entry: Entry) -> bool:
    """Tell whether all places of an entry are in directories with code that is kept, not used."""
    return all(
        any(_SET_ASIDE.fullmatch(name) for name in shown(entry.package, path).split(os.sep)[:-1])
        for path in {item.location.path for item in entry.places}
    )


def _rank(entry: Entry) -> tuple[int, bool, bool, bool, bool]:
    first = entry.first
    is_last = first.code.startswith(_LAST) or first.cause.startswith(DEPENDENCY)
    is_later = first.code.startswith(_LATER)
    level = SEVERITIES.index(entry.severity)
    return level, is_style(first), _is_set_aside(entry), is_last, is_later
