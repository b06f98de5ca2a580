"""Jinja filters that escape text for the language of a file."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterable, Iterator

MAX_COLUMNS = 99
"""The longest line that ament_flake8 accepts."""


def literal(text: str, column: int = 0, indent: int = 0) -> str:
    """Return a Python string literal with the quotes that ament_flake8 requires.

    Args:
        text: The value.
        column: The column of the literal, from 0. A literal that would not fit is split into
            several lines.
        indent: The indentation of these lines; parentheses are added if ``column`` differs.
    """
    whole = _quoted(text)
    if column + len(whole) + len(",") <= MAX_COLUMNS:
        return whole
    parts = list(_split(text, MAX_COLUMNS - indent))
    margin = " " * indent
    if column == indent:
        return f"\n{margin}".join(parts)
    lines = "".join(f"\n{margin}{part}" for part in parts)
    return f"({lines}\n{margin[4:]})"


def _quoted(text: str) -> str:
    quote = '"' if "'" in text and '"' not in text else "'"
    written = "".join(
        character if character.isprintable() else _escape(character)
        for character in text.replace("\\", "\\\\").replace(quote, f"\\{quote}")
    )
    return f"{quote}{written}{quote}"


def _escape(character: str) -> str:
    return character.encode("unicode_escape").decode()


def _split(text: str, width: int) -> Iterator[str]:
    """Yield the literals of a split text, broken after spaces where possible."""
    start = 0
    while start < len(text):
        end = start + 1
        last_blank = None
        while end <= len(text) and len(_quoted(text[start:end])) < width:
            if text[end - 1] == " ":
                last_blank = end
            end += 1
        end -= 1
        if end < len(text) and last_blank is not None:
            end = last_blank
        yield _quoted(text[start:end])
        start = end


def xml(text: object) -> str:
    """Escape text for XML, as content or as the value of an attribute."""
    escaped = str(text).replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    return escaped.replace('"', "&quot;")


def markdown(text: str) -> str:
    """Escape text for Markdown."""
    escaped = re.sub(r"([\\`*<\[\]|])", r"\\\1", text)
    escaped = re.sub(r"(?<!\w)_|_(?!\w)", r"\\_", escaped)
    escaped = re.sub(r"&(?=#?\w+;)", r"\\&", escaped)
    escaped = re.sub(r"^(\d+)([.)])(?=\s|$)", r"\1\\\2", escaped)
    return re.sub(r"^([-+#>=~])", r"\\\1", escaped)


def comment(text: str, mark: str = "#") -> str:
    """Return a text as comment lines."""
    return "\n".join(f"{mark} {line}".rstrip() for line in text.rstrip("\n").split("\n"))


def slashes(text: str) -> str:
    """Convert Python comment lines to C++."""
    return re.sub(r"(?m)^#", "//", text)


def import_block(lines: Iterable[str]) -> str:
    """Return import statements in the order of ament_flake8: by module, not by kind.

    Args:
        lines: Statements, with or without a comment, possibly duplicate.
    """
    groups: tuple[list[str], list[str]] = ([], [])
    for line in _merged(lines):
        root = _module(line).partition(".")[0]
        groups[root not in sys.stdlib_module_names].append(line)
    blocks = ["\n".join(sorted(group, key=_import_key)) for group in groups if group]
    return "\n\n".join(blocks)


def _merged(lines: Iterable[str]) -> list[str]:
    """Merge the imports from one module into one line, if they fit."""
    names: dict[str, set[str]] = {}
    others: dict[str, None] = {}
    for line in lines:
        match = re.fullmatch(r"from (\S+) import ([\w, ]+)", line)
        if match:
            names.setdefault(match[1], set()).update(match[2].split(", "))
        else:
            others[line] = None
    for module, imported in names.items():
        whole = f"from {module} import {', '.join(sorted(imported, key=str.lower))}"
        fits = len(whole) <= MAX_COLUMNS
        separate = [f"from {module} import {name}" for name in sorted(imported)]
        others.update(dict.fromkeys([whole] if fits else separate))
    return list(others)


def _module(line: str) -> str:
    return line.split()[1]


def _import_key(line: str) -> tuple[str, str]:
    return _module(line).lower(), line.lower()
