"""Fixes for the sections of docstrings: names, underlines and blank lines."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import takewhile

from scaffold.ament.pep257.definitions import Definition, leading_space
from scaffold.ament.pep257.sections import NUMPY, Section, google_sections, sections

Splice = tuple[int, int, str]
"""Start and end offsets in the literal, and the replacement text."""


class _Place:
    """A section, and the offsets of its lines within the literal."""

    def __init__(self, section: Section, lines: Sequence[str], starts: Sequence[int]) -> None:
        self.section = section
        self.lines = lines
        self.starts = starts
        self.indent = leading_space(section.line)
        self.at = starts[section.row] + len(self.indent)
        self.end = starts[section.row] + len(section.line)
        self.blank_lines = sum(1 for _ in takewhile(lambda line: not line.strip(), section.after))
        """Blank lines right after the name."""
        self.is_empty = self.blank_lines == len(section.after)
        first = "" if self.is_empty else section.after[self.blank_lines].strip()
        self.dashes = first if set(first) == {"-"} else ""

    def start(self, behind: int) -> int:
        """Return the start of the line that is this many lines after the name."""
        return self.starts[self.section.row + behind]


def splices(code: str, definition: Definition) -> Iterator[Splice]:
    """Yield the splices that fix a code in all sections of a docstring."""
    if code not in _FIXES or (code in _TO_NUMPY and not _is_numpy_afterwards(definition)):
        return
    lines = definition.docstring.split("\n")
    starts = [0]
    for line in lines:
        starts.append(starts[-1] + len(line) + 1)
    for section in sections(definition):
        if section.row:
            yield from _FIXES[code][0](_Place(section, lines, starts))


def _is_numpy_afterwards(definition: Definition) -> bool:
    """Return whether no Google style is left once all names are alone above dashes.

    Sections that only Google has keep their colons, and descriptions below names stay indented:
    dashes next to those would mix two conventions, which no tool supports.
    """
    if any(section.title not in NUMPY for section in google_sections(definition)):
        return False
    return not any(_is_indented(section) for section in sections(definition))


def _is_indented(section: Section) -> bool:
    """Return whether the text below a name is indented more than the name."""
    rows = [row for row in section.after if row.strip() and set(row.strip()) != {"-"}]
    return bool(rows) and len(leading_space(rows[0])) > len(leading_space(section.line))


def _name(place: _Place) -> Iterator[Splice]:
    name, title = place.section.name, place.section.title
    if name != title:
        yield place.at, place.at + len(name), title


def _name_alone(place: _Place) -> Iterator[Splice]:
    name = place.section.name
    if place.section.is_numpy and place.section.line.strip() != name:
        yield place.at + len(name), place.end, ""


def _colon(place: _Place) -> Iterator[Splice]:
    name = place.section.name
    if place.dashes:
        return  # of NumPy's style
    if not place.section.is_numpy and place.section.line.strip() != f"{name}:":
        yield place.at + len(name), place.end, ":"


def _underline(place: _Place) -> Iterator[Splice]:
    section = place.section
    if not place.is_empty and not place.dashes:
        yield place.end, place.end, f"\n{place.indent}{'-' * len(section.title)}"


def _no_blanks_above_dashes(place: _Place) -> Iterator[Splice]:
    if place.dashes and place.blank_lines:
        yield place.start(1), place.start(1 + place.blank_lines), ""


def _length_of_dashes(place: _Place) -> Iterator[Splice]:
    wanted = "-" * len(place.section.title)
    if place.dashes and place.dashes != wanted:
        line = place.section.after[place.blank_lines]
        at = place.start(1 + place.blank_lines) + len(leading_space(line))
        yield at, at + len(place.dashes), wanted


def _indentation_of_dashes(place: _Place) -> Iterator[Splice]:
    if place.dashes:
        line = place.section.after[place.blank_lines]
        at = place.start(1 + place.blank_lines)
        yield at, at + len(leading_space(line)), place.indent


def _blank_after(place: _Place) -> Iterator[Splice]:
    after = place.section.after
    if not place.section.is_last and (not after or after[-1].strip()):
        at = place.start(1 + len(after))
        yield at, at, "\n"


def _blank_before(place: _Place) -> Iterator[Splice]:
    if place.section.before.strip():
        at = place.start(0)
        yield at, at, "\n"


def _no_blanks_above_content(place: _Place) -> Iterator[Splice]:
    after = place.section.after
    if place.is_empty:
        return
    if not place.dashes:
        first, blank_lines = 1, place.blank_lines
    else:
        first = 2 + place.blank_lines
        blank_lines = sum(1 for _ in takewhile(lambda line: not line.strip(), after[first - 1 :]))
        if blank_lines == len(after[first - 1 :]):
            return
    if blank_lines:
        yield place.start(first), place.start(first + blank_lines), ""


def _blank_at_end(place: _Place) -> Iterator[Splice]:
    after = place.section.after
    closes = place.lines[-1].strip() in ('"""', "'''")
    if place.section.is_last and closes and after and after[-1].strip():
        at = place.start(1 + len(after))
        yield at, at, "\n"


_FIXES: Mapping[str, tuple[Callable[[_Place], Iterator[Splice]], str]] = {
    "D215": (_indentation_of_dashes, "indent the dashes like the name"),
    "D405": (_name, "capitalize the name"),
    "D406": (_name_alone, "leave the name alone on its line"),
    "D407": (_underline, "underline the name of the section"),
    "D408": (_no_blanks_above_dashes, "remove the blank lines above the dashes"),
    "D409": (_length_of_dashes, "make the dashes as long as the name"),
    "D410": (_blank_after, "leave a blank line after the section"),
    "D411": (_blank_before, "leave a blank line before the section"),
    "D412": (_no_blanks_above_content, "remove the blank lines above the content"),
    "D413": (_blank_at_end, "leave a blank line after the last section"),
    "D416": (_colon, "end the name with a colon"),
}

_TO_NUMPY = frozenset({"D406", "D407"})
"""Codes whose fix converts a section to NumPy style."""

TITLES = {code: title for code, (_, title) in _FIXES.items()}
