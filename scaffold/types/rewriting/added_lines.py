"""Inserts lines into files for the type checker, and maps line numbers back."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable, Mapping, Sequence

from scaffold.record import NamedTuple
from scaffold.types.rewriting.passed import Passed


class Extended(NamedTuple):
    """A file with added lines."""

    data: bytes
    added: Sequence[int]
    """The numbers of these lines, in order."""
    passed: Sequence[Passed] = ()
    """The arguments that it passes to functions of other modules."""

    def original_line(self, line: int) -> int:
        """Return the number of a line in the user's file; 0 for an added line."""
        place = bisect_left(self.added, line)
        is_added = place < len(self.added) and self.added[place] == line
        return 0 if is_added else line - place


def with_lines(
    text: str, lines: Mapping[int, Sequence[str]], stretches: Iterable[tuple[int, int, str]] = ()
) -> Extended:
    """Return a text with inserted lines.

    Args:
        text: The text.
        lines: The text to insert before the line that starts at a position.
        stretches: The replacements within lines, by position.
    """
    parts: list[str] = []
    added: list[int] = []
    at, number = 0, 1
    edits = [(place, place, "".join(f"{line}\n" for line in lines[place])) for place in lines]
    for start, end, new in sorted([*edits, *stretches]):
        parts += text[at:start], new
        number += text.count("\n", at, start)
        if start == end:
            count = new.count("\n")
            added += range(number, number + count)
            number += count
        else:
            number += text.count("\n", start, end)
        at = end
    return Extended("".join([*parts, text[at:]]).encode(), added)
