"""The display width of text on a terminal, and wrapping and truncation to a width."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from typing import TextIO

from scaffold import lazy_re

_CONTROL = lazy_re.compile(r"\x1b\[[0-9;]*m")  # linear: no repetition follows another
"""Matches escape sequences of colors."""
_HANGING = 4
"""The indentation of continuation lines."""
_MIN_WIDTH = 20
"""The minimum number of columns for wrapping."""
MORE = "..."
USUAL = 80
"""The number of columns of a terminal of unknown size."""


def of_terminal(out: TextIO) -> int | None:
    """Return the width of the terminal of a stream; ``None`` if it is no terminal."""
    try:
        width = os.get_terminal_size(out.fileno()).columns if out.isatty() else 0
    except (OSError, ValueError):
        return None
    return width if width >= _MIN_WIDTH else None


def columns(text: str) -> int:
    """Return the width of a text in columns, ignoring colors."""
    plain = _CONTROL.sub("", text)
    if plain.isascii():
        return len(plain)
    from rich.cells import cell_len

    return cell_len(plain)


def cut(text: str, width: int) -> str:
    """Truncate a text without colors to a width, with dots at the end."""
    if columns(text) <= width:
        return text
    while columns(text) > width - len(MORE):
        text = text[:-1]
    return text + MORE


def wrapped(line: str, width: int) -> Iterator[str]:
    """Yield a line wrapped to a width.

    It is broken between the columns of a table, else at spaces; longer words are not split.
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
    """Return unbreakable parts and the spaces between, in turn."""
    cells = re.split(r"( {2,})", words)  # linear: one kind of character
    if all(columns(cell) <= width for cell in cells):
        return cells
    return re.split(r"( +)", words)  # linear: likewise
