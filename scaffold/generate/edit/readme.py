"""Adds rows to the tables of README.md that have the columns of ours."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple

from scaffold.check.diagnostic import Edit
from scaffold.generate.edit.addition import Addition, Outcome, Row, spliced
from scaffold.model.source import Source

_DELIMITER = re.compile(r"\s*\|?\s*:?-+:?\s*(\|\s*:?-+:?\s*)*\|?\s*")


class Table(NamedTuple):
    """A table of a Markdown file."""

    header: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    end: int
    """The number of its last line, from 1."""


def tables(source: Source) -> Iterator[Table]:
    """Yield the tables outside of fenced code."""
    lines = source.lines
    fence = ""
    for number, line in enumerate(lines):
        mark = line.lstrip()[:3]
        if mark in {"```", "~~~"} and (not fence or fence == mark):
            fence = "" if fence else mark
        below = lines[number + 1] if number + 1 < len(lines) else ""
        if fence or "|" not in line or "|" not in below or not _DELIMITER.fullmatch(below):
            continue
        end = number + 2
        while end < len(lines) and "|" in lines[end]:
            end += 1
        yield Table(_cells(line), tuple(map(_cells, lines[number + 2 : end])), end)


def add_to_readme(source: Source, addition: Addition) -> Outcome:
    """Add rows to the tables with their columns; a README without such tables is left alone."""
    for row in addition.rows:
        source = _add(source, row)
    return Outcome(source)


def _add(source: Source, row: Row) -> Source:
    for table in tables(source):
        if table.header != row.header:
            continue
        if row.cells in table.rows:
            return source
        at = source.offset(table.end) + len(source.lines[table.end - 1])
        text = f"{source.newline}| {' | '.join(row.cells)} |"
        return spliced(source, [Edit(source.path, at, at, text)])
    return source


def _cells(line: str) -> tuple[str, ...]:
    r"""Return the cells of a row; ``\|`` does not end one."""
    inner = line.strip().removeprefix("|")
    inner = inner[:-1] if inner.endswith("|") and not inner.endswith("\\|") else inner
    return tuple(cell.strip() for cell in re.split(r"(?<!\\)\|", inner))
