"""Fixes as text edits with positions, for machine-readable reports."""

from __future__ import annotations

from scaffold.edits import CreateFile, Edit, Fix, MakeExecutable, Remove
from scaffold.model.package import Package
from scaffold.model.remembered import remembered
from scaffold.record import NamedTuple
from scaffold.source import Location, Source, ViewError

MOST_REPEATED_EDITS = 50
"""The size of a fix from which it is written only once, as thousands of findings may share it."""


class Replacement(NamedTuple):
    """A range of a file, and its replacement."""

    place: Location
    text: str


class PlacedFix(NamedTuple):
    """The changes of a fix; paths are relative to the package's root."""

    replacements: tuple[Replacement, ...]
    created: tuple[CreateFile, ...]
    executable: tuple[str, ...]
    removed: tuple[str, ...]


def placed(package: Package, fix: Fix) -> PlacedFix | None:
    """Return the changes of a fix; ``None`` if a file can no longer be read.

    Args:
        package: The package of the fix.
        fix: The fix.
    """
    try:
        replacements = tuple(
            Replacement(
                _source(package, change.path).location(change.start, change.end), change.text
            )
            for change in fix.changes
            if isinstance(change, Edit)
        )
    except ViewError:
        return None
    return PlacedFix(
        replacements,
        tuple(change for change in fix.changes if isinstance(change, CreateFile)),
        tuple(change.path for change in fix.changes if isinstance(change, MakeExecutable)),
        tuple(change.path for change in fix.changes if isinstance(change, Remove)),
    )


class Repetitions:
    """The large fixes of a package that have been written already, with their findings."""

    def __init__(self) -> None:
        self._written: dict[Fix, int] = {}

    def first(self, fix: Fix, number: int) -> int:
        """Return the number of the finding that the fix is written with, this one if it is new."""
        if len(fix.changes) <= MOST_REPEATED_EDITS:
            return number
        return self._written.setdefault(fix, number)


@remembered
def _source(package: Package, path: str) -> Source:
    """Return the text that the offsets of edits refer to; an ASCII file need not be parsed."""
    try:
        source = package.source(path)
    except ViewError:
        return package.editable(path)
    return source if source.text.isascii() else package.editable(path)
