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

_FIRST = (
    *("E9", "SC001", "CM001", "CM003", "CM005", "CM011", "CM016", "CM022", "CM023", "CM024"),
    *("CM025", "CM031", "CM063", "CM064", "CM065", "CM092", "CM094", "CM102", "CM104", "CM107"),
    *("CM108", "CM111", "LY004", "PX013"),
)
"""Codes of what keeps a file from being read, or a package from being built."""
_WITHOUT_EFFECT = ("LF016", "LF065", "LF084", "MS003", "PF003", "PF004")
"""Codes of what is ignored while the program goes on."""
_LAST = ("PX", "LY", "NM", "TS")
"""Areas whose findings stop no build and no program: the manifest, files, names, tests."""
_LATER = ("CM", "SC007", *_LAST)
"""Areas whose findings do not crash a running program, and packages that are for ROS 1 alone."""
_SET_ASIDE = re.compile(
    r"(?:.*[_ .-])?(?:archived?|archives|attic|backups?|bak|deprecated|junk|legacy|obsolete|old"
    r"|trash|unused)|[(\[](?:old|unused|deprecated)[)\]].*",
    re.IGNORECASE,
)
"""Matches the name of a directory with code that nobody works on anymore."""
_TESTS = re.compile(r"(?:^|/)(?:tests?/|test_[^/]*$|[^/]*_test\.py$)")
"""Matches the paths of tests, which no robot runs."""
DEPENDENCY = "dependency "
"""Begins the cause of what only happens on a machine that lacks a package."""


class Place(NamedTuple):
    """A finding, and where it is."""

    package: Package
    finding: Diagnostic


class Entry(NamedTuple):
    """Findings that have one cause; one edit may end them all, or one edit in each package.

    Attributes:
        places: The findings, the worst first, then in reading order; there is at least one.
    """

    places: tuple[Place, ...]

    @property
    def package(self) -> Package:
        """The package of the first finding."""
        return self.places[0].package

    @property
    def first(self) -> Diagnostic:
        """The finding whose message is shown."""
        return self.places[0].finding

    @property
    def severity(self) -> Severity:
        """That of the worst of them."""
        return self.first.severity


def by_cause(result: Result) -> list[Entry]:
    """Return the findings of a package as entries.

    Findings have one cause if their rules say so, or if they read the same.
    """
    causes: dict[tuple[str, ...], list[Place]] = {}
    for diagnostic in result.diagnostics:
        key = (
            (diagnostic.cause,)
            if diagnostic.cause
            else (diagnostic.code, diagnostic.message, diagnostic.severity.value)
        )
        causes.setdefault(key, []).append(Place(result.package, diagnostic))
    return [
        Entry(tuple(sorted(places, key=lambda place: SEVERITIES.index(place.finding.severity))))
        for places in causes.values()
    ]


def merged(entries: Sequence[Entry]) -> list[Entry]:
    """Return entries with one for all packages in which the same is wrong, at the first of them.

    Whoever copies a package copies its mistakes; two entries are the same if they say the same.
    """
    same: dict[frozenset[tuple[str, str, Severity]], list[Place]] = {}
    for entry in entries:
        found = [item.finding for item in entry.places]
        key = frozenset((item.code, item.message, item.severity) for item in found)
        same.setdefault(key, []).extend(entry.places)
    return [Entry(tuple(places)) for places in same.values()]


def in_order(entries: Sequence[Entry]) -> list[Entry]:
    """Return entries by severity; of one severity, what is not read or built comes first.

    Then come crashes, what has no effect, what is built wrong, and declarations.

    What is in a directory such as ``archive`` or ``old`` comes after all others.
    """
    return sorted(entries, key=_rank)


def is_style(diagnostic: Diagnostic) -> bool:
    """Tell whether a finding is one of ament_flake8 or ament_pep257 that breaks nothing."""
    return diagnostic.code in STYLE and diagnostic.severity is not Severity.ERROR


def _is_set_aside(entry: Entry) -> bool:
    """Tell whether all places of an entry are in directories with code that is kept, not used."""
    return all(
        any(_SET_ASIDE.fullmatch(name) for name in shown(package, path).split(os.sep)[:-1])
        for package, path in {(item.package, item.finding.location.path) for item in entry.places}
    )


def _rank(entry: Entry) -> tuple[int, bool, bool, int]:
    level = SEVERITIES.index(entry.severity)
    return level, is_style(entry.first), _is_set_aside(entry), _weight(entry.first)


def _weight(first: Diagnostic) -> int:
    """Return how late a finding comes among those of its severity."""
    is_later = first.code.startswith(_LATER)
    if first.cause.startswith(DEPENDENCY):
        return 5 if is_later else 4
    if first.code.startswith(_FIRST):
        return 0
    if first.code.startswith(_LAST):
        return 5
    if _TESTS.search(first.location.path):
        return 3
    if first.code in _WITHOUT_EFFECT:
        return 2
    return 3 if is_later else 1
