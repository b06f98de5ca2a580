"""Adds a part to a generated README.md: table rows, commands, sections."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from scaffold import lazy_re
from scaffold.edits import Edit
from scaffold.generate.edit.addition import Addition, Outcome, spliced
from scaffold.source import Source

_DELIMITER = lazy_re.compile(r"\s*(?:\|\s*)?:?-+:?\s*(?:\|\s*:?-+:?\s*)*(?:\|\s*)?")
_FRAME = ("Prerequisites", "Build", "Test", "Author", "License")
"""The sections not about parts; a README with all of them was generated."""
_FENCE = ("```", "~~~")
_HEADING = "## "
_BELOW = "### "
_OWNER = ("Node",)
"""The first column of our tables; older ones do not have it."""


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
    """The number of the line after the last of them, from 0."""


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
    return _split(source.lines, _HEADING, 0, len(source.lines))


def _split(lines: Sequence[str], mark: str, first: int, last: int) -> list[Section]:
    """Return what is below each heading of a level among some lines."""
    starts = [n for n in _outside(lines) if first <= n < last and lines[n].startswith(mark)]
    return [
        _section(lines, lines[start].removeprefix(mark).strip(), start, end)
        for start, end in zip(starts, [*starts[1:], last], strict=False)
    ]


def _section(lines: Sequence[str], title: str, start: int, end: int) -> Section:
    first = start + 1
    while first < end and not lines[first].strip():
        first += 1
    while end > first and not lines[end - 1].strip():
        end -= 1
    return Section(title, start, tuple(lines[first:end]), max(end, start + 1))


def _blocks(lines: Sequence[str], section: Section) -> list[Section]:
    """Return the blocks of a section: that above the third-level headings, then one for each."""
    below = _split(lines, _BELOW, section.start + 1, section.end)
    end = below[0].start if below else section.end
    return [_section(lines, "", section.start, end), *below]


def add_to_readme(source: Source, addition: Addition) -> Outcome:
    """Merge the README.md of a package with one part into another; leave foreign ones alone.

    A table of any other README gets rows only if it has exactly the same columns.
    """
    part = Source(source.path, addition.readme)
    if {section.title for section in sections(source)}.issuperset(_FRAME):
        for section in sections(part):
            if section.title not in _FRAME:
                source = _merge(source, part, section)
    for table in tables(part):
        for row in table.rows:
            source = _add_row(source, table.header, row)
    return Outcome(source)


def _merge(source: Source, part: Source, new: Section) -> Source:
    """Add a section, or merge its text without the tables into the section of that title."""
    order = sections(part)
    existing = {section.title: section for section in sections(source)}
    old = existing.get(new.title)
    if old is None:
        following = (section.title for section in order if section.start > new.start)
        behind = next(filter(None, map(existing.get, following)), None)
        at = source.offset(behind.start + 1) if behind else len(source.text)
        body = [f"{_HEADING}{new.title}", "", *new.lines, "", ""]
        return spliced(source, [Edit(source.path, at, at, source.newline.join(body))])
    if _contains(old.lines, new):
        return source
    for block in _blocks(part.lines, new):
        if block.title or block.lines:
            source = _join(source, new.title, block)
    return source


def _join(source: Source, title: str, new: Section) -> Source:
    """Add a block to a section: to the one of its title, or with its heading."""
    section = next(item for item in sections(source) if item.title == title)
    blocks = _blocks(source.lines, section)
    head = next(filter(_is_row, new.lines), None)
    block_of_title = next((block for block in blocks if block.title == new.title), None)
    if block_of_title is None and head in blocks[0].lines:
        block_of_title = blocks[0]
    if block_of_title is not None:
        return _extend(source, block_of_title, new)
    if _contains(source.lines, new):  # the README of a single node has it in several sections
        return source
    lines = [f"{_BELOW}{new.title}", "", *new.lines]
    behind = [block for block in blocks[1:] if any(map(_is_row, block.lines))]
    if head is None and behind and behind[-1] is blocks[-1]:
        # Programs have a table below that of the nodes.
        at = source.offset(behind[-1].start + 1)
        text = "".join(f"{line}{source.newline}" for line in [*lines, ""])
        return spliced(source, [Edit(source.path, at, at, text)])
    return _insert_below(source, section.end, lines)


def _extend(source: Source, old: Section, new: Section) -> Source:
    """Add text missing in a block, above its table."""
    if _contains(old.lines, new):
        return source
    # The common beginning applies to all parts, and rows of tables are added one by one.
    shared = 0
    for old_line, new_line in zip(old.lines, new.lines, strict=False):
        if old_line != new_line or old_line.startswith(_FENCE):
            break
        shared += 1
    has_rows = any(map(_is_row, old.lines))
    added = [line for line in new.lines[shared:] if not (has_rows and _is_row(line))]
    lines = "\n".join(added).strip("\n")
    if not lines:
        return source
    end = old.start + 1 + len(_above_table(source.lines[old.start + 1 : old.end]))
    return _insert_below(source, end, lines.split("\n"))


def _insert_below(source: Source, number: int, lines: Sequence[str]) -> Source:
    """Add a paragraph below a line, by its number from 1."""
    at = source.offset(number) + len(source.lines[number - 1])
    text = "".join(f"{source.newline}{line}" for line in ["", *lines])
    return spliced(source, [Edit(source.path, at, at, text)])


def _is_row(line: str) -> bool:
    return line.startswith("|") and line.rstrip().endswith("|")


def _above_table(lines: Sequence[str]) -> Sequence[str]:
    """Return the lines of a section without the table at its end and the blank lines above."""
    end = len(lines)
    while end and (_is_row(lines[end - 1]) or not lines[end - 1].strip()):
        end -= 1
    return lines[:end]


def _contains(old: Iterable[str], new: Section) -> bool:
    """Return whether some lines contain all commands of a block, or all of its text."""
    text = [line for line in new.lines if line.strip() and not _is_row(line)]
    wanted = [line for line in text if line.startswith("ros2 ")] or text
    return bool(wanted) and set(wanted) <= set(old)


def _add_row(source: Source, header: tuple[str, ...], row: tuple[str, ...]) -> Source:
    for table in tables(source):
        cells = row
        if header[:1] == _OWNER and table.header == header[1:]:
            cells = row[1:]
        elif table.header != header:
            continue
        if cells in table.rows:
            return source
        at = source.offset(table.end) + len(source.lines[table.end - 1])
        text = f"{source.newline}| {' | '.join(cells)} |"
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
