"""The choice of entries for a screen that is too small for all of them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from itertools import product

from rich.text import Text

from scaffold.record import NamedTuple
from scaffold.reporters import ReportOptions
from scaffold.reporters.order import is_set_aside
from scaffold.reporters.terminal.entries import Entry
from scaffold.reporters.terminal.entry_text import brief, full, height

_FULL = 0
_LARGER = (2, 3, 4, 5, 6, _FULL)
"""The numbers of lines that entries get one after the other."""


class Shown(NamedTuple):
    """An entry on the screen."""

    entry: Entry
    lines: int
    """The number of lines for the finding, without its source line; 0 if it is shown in full."""

    def text(self, width: int, options: ReportOptions, link: str | None = None) -> Text:
        """Return the text, for a number of columns."""
        if self.lines == _FULL:
            return full(self.entry, options, width, link)
        return brief(self.entry, width, self.lines, link)

    def height(self, width: int, options: ReportOptions) -> int:
        """Return the number of lines that the text fills."""
        return height(self.text(width, options), width)


def choose(
    entries: Sequence[Entry], room: int, width: int, options: ReportOptions
) -> tuple[list[Shown], list[Entry]]:
    """Return the entries to show, and those that do not fit.

    If they do not fit in one line each, each code has its first entry before any has its second.
    If there is room, entries get two lines, then other places, and then source lines.

    Args:
        entries: In order.
        room: The number of lines.
        width: The number of columns.
        options: The display options.
    """
    chosen: dict[int, Shown] = {}
    for at in _by_turns(entries):
        if room <= 0:
            break
        shown = Shown(entries[at], 1)
        needed = shown.height(width, options)
        if needed <= room or not chosen:
            chosen[at] = shown
            room -= needed
    for lines, at in product(_LARGER, sorted(chosen)):
        larger = chosen[at]._replace(lines=lines)
        growth = larger.height(width, options) - chosen[at].height(width, options)
        if growth <= room:
            chosen[at] = larger
            room -= growth
    hidden = [entry for at, entry in enumerate(entries) if at not in chosen]
    return [chosen[at] for at in sorted(chosen)], hidden


def _by_turns(entries: Sequence[Entry]) -> Iterable[int]:
    """Return the indices of entries: the first of each code, then the second of each."""
    seen: Counter[str] = Counter()
    turns: list[tuple[bool, int, int]] = []
    for at, entry in enumerate(entries):
        seen[entry.first.code] += 1
        is_aside = is_set_aside(entry.package, entry.first)
        turns.append((is_aside, seen[entry.first.code], at))
    return [at for _, _, at in sorted(turns)]
