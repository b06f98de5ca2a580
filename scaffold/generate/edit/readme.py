"""Adds a part to a README.md like ours: rows of tables, commands, sections."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from scaffold.check.diagnostic import Edit
from scaffold.generate.edit.addition import Addition, Outcome, spliced
from scaffold.model.source import Source

_DELIMITER = re.compile(r"\s*\|?\s*:?-+:?\s*(\|\s*:?-+:?\s*)*\|?\s*")
_FRAME = ("Prerequisites", "Build", "Test", "Author", "License")
"""The sections that say nothing of the parts of a package; a README with all is like ours."""
_FENCE = ("```", "~~~")
_HEADING = "## "


class Table(NamedTuple):
    """A table of a Markdown file."""

    header: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    end: int
    """The number of its last line, from 1."""


class Section(NamedTuple):
    """A heading of the second level and what follows it."""

    title: str
    start: int
    """The number of the heading's line, from 0."""
    lines: tuple[str, ...]
    """The lines below it, without blank ones at the start and the end."""
    end: int
    """The number of the line behind the last of them, from 0."""


def tables(source: Source) -> Iterator[Table]:
    """Yield the tables outside of fenced code."""
    lines = source.lines
    for number in _outside(lines):
        below = lines[number + 1] if number + 1 < len(lines) else ""
        if "|" not in lines[number] or "|" not in below or not _DELIMITER.fullmatch(below):
            continue
        end = number + 2
        while end < len(lines) and "|" in lines[end]:
            end += 1
        rows = tuple(map(_cells, lines[number + 2 : end]))
        yield Table(_cells(lines[number]), rows, end)


def sections(source: Source) -> list[Section]:
    """Return the sections of the second level."""
    lines = source.lines
    starts = [number for number in _outside(lines) if lines[number].startswith(_HEADING)]
    found: list[Section] = []
    for number, start in enumerate(starts):
        end = starts[number + 1] if number + 1 < len(starts) else len(lines)
        first = start + 1
        while first < end and not lines[first].strip():
            first += 1
        while end > first and not lines[end - 1].strip():
            end -= 1
        title = lines[start].removeprefix(_HEADING).strip()
        found.append(Section(title, start, tuple(lines[first:end]), max(end, start + 1)))
    return found


def add_to_readme(source: Source, addition: Addition) -> Outcome:
    """Merge what README.md would say of a part alone; one that is not like ours is left alone.

    A table of somebody else's README gets its rows where it has the very same columns.
    """
    part = Source(source.path, addition.readme)
    if {section.title for section in sections(source)}.issuperset(_FRAME):
        for section in sections(part):
            if section.title not in _FRAME:
                source = _merge(source, section, sections(part))
    for table in tables(part):
        for row in table.rows:
            source = _add_row(source, table.header, row)
    return Outcome(source)


def _merge(source: Source, new: Section, order: Sequence[Section]) -> Source:
    """Add a section, or to the section of that title what is not in a table."""
    there = {section.title: section for section in sections(source)}
    old = there.get(new.title)
    if old is None:
        following = (section.title for section in order if section.start > new.start)
        behind = next(filter(None, map(there.get, following)), None)
        at = source.offset(behind.start + 1) if behind else len(source.text)
        body = [f"{_HEADING}{new.title}", "", *new.lines, "", ""]
        return spliced(source, [Edit(source.path, at, at, source.newline.join(body))])
    if _says(old, new):
        return source
    # What both begin with is said of all parts, and rows of tables are added one by one.
    shared = 0
    for one, two in zip(old.lines, new.lines, strict=False):
        if one != two or one.startswith(_FENCE):
            break
        shared += 1
    has_rows = any(map(_is_row, old.lines))
    added = [line for line in new.lines[shared:] if not (has_rows and _is_row(line))]
    lines = "\n".join(added).strip("\n")
    if not lines:
        return source
    end = old.start + 1 + len(_above_table(source.lines[old.start + 1 : old.end]))
    at = source.offset(end) + len(source.lines[end - 1])
    text = "".join(f"{source.newline}{line}" for line in ["", *lines.split("\n")])
    return spliced(source, [Edit(source.path, at, at, text)])


def _is_row(line: str) -> bool:
    return line.startswith("|") and line.rstrip().endswith("|")


def _above_table(lines: Sequence[str]) -> Sequence[str]:
    """Return the lines of a section without the table at its end and the blank lines above."""
    end = len(lines)
    while end and (_is_row(lines[end - 1]) or not lines[end - 1].strip()):
        end -= 1
    return lines[:end]


def _says(old: Section, new: Section) -> bool:
    """Tell whether all commands of a section are in another one."""
    commands = [line for line in new.lines if line.startswith("ros2 ")]
    return bool(commands) and set(commands) <= set(old.lines)


def _add_row(source: Source, header: tuple[str, ...], row: tuple[str, ...]) -> Source:
    for table in tables(source):
        if table.header != header:
            continue
        if row in table.rows:
            return source
        at = source.offset(table.end) + len(source.lines[table.end - 1])
        text = f"{source.newline}| {' | '.join(row)} |"
        return spliced(source, [Edit(source.path, at, at, text)])
    return source


def _outside(lines: Sequence[str]) -> Iterator[int]:
    """Yield the numbers of the lines outside of fenced code, from 0."""
    fence = ""
    for number, line in enumerate(lines):
        mark = line.lstrip()[:3]
        if mark in _FENCE and (not fence or fence == mark):
            fence = "" if fence else mark
        elif not fence:
            yield number


def _cells(line: str) -> tuple[str, ...]:
    r"""Return the cells of a row; ``\|`` does not end one."""
    inner = line.strip().removeprefix("|")
    inner = inner[:-1] if inner.endswith("|") and not inner.endswith("\\|") else inner
    return tuple(cell.strip() for cell in re.split(r"(?<!\\)\|", inner))
