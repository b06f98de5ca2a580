"""The display width of text on a terminal, and wrapping and truncation to a width."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from typing import TextIO

_CONTROL = re.compile(r"\x1b\[[0-9;]*m")  # linear: no repetition follows another
"""What sets a color."""
_HANGING = 4
"""Columns by which the rest of a line is set in."""
_LEAST = 20
"""Columns of a terminal that are worth an attempt."""
MORE = "..."
USUAL = 80
"""Columns of a terminal that does not say how many it has."""


def of_terminal(out: TextIO) -> int | None:
    """Return the columns of the terminal that shows a stream; ``None`` if there is none."""
    try:
        width = os.get_terminal_size(out.fileno()).columns if out.isatty() else 0
    except (OSError, ValueError):
        return None
    return width if width >= _LEAST else None


def columns(text: str) -> int:
    """Return the columns that a text takes; colors take none."""
    plain = _CONTROL.sub("", text)
    if plain.isascii():
        return len(plain)
    from rich.cells import cell_len

    return cell_len(plain)


def cut(text: str, width: int) -> str:
    """Return the beginning of a text without colors that fits, with dots where there is more."""
    if columns(text) <= width:
        return text
    while columns(text) > width - len(MORE):
        text = text[:-1]
    return text + MORE


def wrapped(line: str, width: int) -> Iterator[str]:
    """Yield a line in parts that fit.

    It is broken between the columns of a table, else at spaces; a word that is wider stays whole.
    """
    if columns(line) <= width:
        yield line
        return
    words = line.lstrip(" ")
    indent = " " * (len(line) - len(words))
    current, taken = indent, False
    for piece in _pieces(words, width - len(indent) - _HANGING):
        if taken and piece.strip() and columns(current + piece) > width:
            yield current.rstrip()
            current = indent + " " * _HANGING
        current += piece
        taken = True
    yield current


def _pieces(words: str, width: int) -> list[str]:
    """Return what stays together and the spaces between, in turn."""
    cells = re.split(r"( {2,})", words)  # linear: one kind of character
    if all(columns(cell) <= width for cell in cells):
        return cells
    return re.split(r"( +)", words)  # linear: likewise
