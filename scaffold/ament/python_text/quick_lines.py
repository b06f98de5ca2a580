"""Logical lines of a file that parses, found without the tokenizer.

Tokenizing takes a fifth of the time of a style check, and few lines need tokens. Here, one regular
expression finds strings and comments, and brackets are counted in the rest of each row; unusual
files are left to the tokenizer.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from scaffold import lazy_re
from scaffold.ament.python_text.logical import LogicalLine, expand_indent, gap
from scaffold.ament.python_text.tokens import FSTRING_START, QUOTED
from scaffold.record import NamedTuple

_MUTED = lazy_re.compile(rf"#[^\n]*|{'|'.join(QUOTED)}|['\"]", re.DOTALL)
"""Comments and string literals, the latter without their prefixes. From Python 3.12 on, fields of
an f-string may have line breaks: then only one of its quotes is matched."""
_PREFIX = lazy_re.compile(r"(?:^|\W)([rRbBuUfF]{1,2})\Z")
"""The prefix of a string, at the end of three characters."""
_FIELD = lazy_re.compile(
    r"\{(?P<value>(?:[^{}:!#\"'\\\n]|\"[^\"{}:!#\\\n]*\"|'[^'{}:!#\\\n]*')*)"
    r"(?P<conversion>![rsa])?(?::(?P<format>[^{}\n]*))?\}"
)
_STRING = lazy_re.compile(r"\"([^\"]*)\"|'([^']*)'")
_LONE_BACKSLASH = lazy_re.compile(r"^[ \t]*\\\n", re.MULTILINE)
_BREAK = "\0"
"""Replaces a line break in a string; no valid file has this character."""
_OPAQUE = "\1"
"""Marks an f-string whose fields are not parsed here."""


class Outline(NamedTuple):
    """The logical lines and the string literals of a file."""

    lines: list[LogicalLine]
    literals: list[tuple[int, int, int]]
    """The start, the start of the quotes, and the end of each; an f-string is one literal."""


class _UnsureError(Exception):
    """The end of a string is uncertain."""


def read(text: str, lines: list[str], *, is_opened: bool) -> Outline | None:
    r"""Return the outline of a valid file; ``None`` if tokens are needed.

    Args:
        text: The text.
        lines: Its lines, with their ``\n``.
        is_opened: Whether the linters check the fields of f-strings.
    """
    if "\f" in text or ("\\\n" in text and _LONE_BACKSLASH.search(text)):
        return None
    mute = _Mute(is_opened=is_opened)
    try:
        code = _MUTED.sub(mute, text)
    except _UnsureError:
        return None
    return Outline([*_split(code.removesuffix("\n").split("\n"), lines)], mute.literals)


class _Mute:
    """Replaces the content of strings, keeping lengths, and of comments."""

    def __init__(self, *, is_opened: bool) -> None:
        self._is_opened = is_opened
        self.literals: list[tuple[int, int, int]] = []

    def __call__(self, match: re.Match[str]) -> str:
        literal = match[0]
        if literal[0] == "#":
            return "#"
        if len(literal) == 1:
            raise _UnsureError
        start, end = match.span()
        prefix = ""
        if match.string[start - 1 : start].isalpha():
            prefix_match = _PREFIX.search(match.string, max(start - 3, 0), start)
            prefix = prefix_match[1] if prefix_match else ""
        self.literals.append((start - len(prefix), start, end))
        quotes = literal[:3] if literal[:3] in {'"""', "'''"} else literal[0]
        content = literal[len(quotes) : -len(quotes)]
        shown = _crossed_out(content)
        if "{" in content and "f" in prefix.lower():
            opened = _opened(content)
            shown = opened if self._is_opened else shown
        return f"{quotes}{shown}{quotes}"


def _crossed_out(content: str) -> str:
    if "\n" in content:
        return _BREAK.join("x" * len(row) for row in content.split("\n"))
    return "x" * len(content)


def _opened(content: str) -> str:
    """Return the content of an f-string with its fields as code.

    Raises:
        _UnsureError: a field may continue after the end.
    """
    parts: list[str] = []
    at = 0
    is_plain = "{{" not in content and "}}" not in content and "\\N" not in content
    flat = content if is_plain else content.replace("{{", "xx").replace("}}", "xx")
    for field in _FIELD.finditer(flat):
        value = _STRING.sub(lambda item: _quoted(item[0]), field["value"])
        if field["format"] is not None:
            is_plain = is_plain and _is_balanced(value)
        parts.append(flat[at : field.start()])
        at = field.end()
        parts.append(f"{{{value}{field['conversion'] or ''}")
        parts.append("}" if field["format"] is None else f":{'x' * len(field['format'])}}}")
    rest = [*parts[::3], flat[at:]]
    if any("{" in text or "}" in text for text in rest):
        if FSTRING_START > 0:
            raise _UnsureError
        is_plain = False
    if not is_plain:
        return _crossed_out(content).replace("x", _OPAQUE, 1)
    parts[::3] = [_crossed_out(text) for text in parts[::3]]
    return "".join((*parts, _crossed_out(flat[at:])))


def _quoted(literal: str) -> str:
    return f"{literal[0]}{'x' * (len(literal) - 2)}{literal[0]}"


def _is_balanced(value: str) -> bool:
    """Return whether a colon after a value starts its format, and is not inside of it."""
    return (
        value.count("(") == value.count(")")
        and value.count("[") == value.count("]")
        and "lambda" not in value
    )


def _split(rows: Sequence[str], lines: list[str]) -> Iterator[LogicalLine]:
    """Yield the logical lines of rows without strings and comments."""
    number = depth = blank_lines = first = column = indent = 0
    levels = [0]
    pieces: list[str] = []
    for row in rows:
        number += 1
        start = number
        number += row.count(_BREAK)
        code, mark, _ = row.partition("#")
        piece = code.strip()
        if not first:
            if not piece and not mark:
                blank_lines += 1
                continue
            column = len(code) - len(code.lstrip())
            indent = expand_indent(code[:column]) if "\t" in code else column
            if not piece:
                yield LogicalLine(lines, (number, number), column, indent, blank_lines, "")
                blank_lines = 0
                continue
            first = start
        depth += piece.count("(") + piece.count("[") + piece.count("{")
        depth -= piece.count(")") + piece.count("]") + piece.count("}")
        goes_on = piece.endswith("\\")
        pieces.append(piece[:-1].rstrip() if goes_on else piece)
        if depth or goes_on:
            continue
        joined = pieces[0] if len(pieces) == 1 else _joined_rows(pieces)
        yield LogicalLine(
            lines,
            (first, number),
            column,
            indent,
            blank_lines,
            joined.replace(_BREAK, "x"),
            is_opaque=_OPAQUE in joined,
            levels=_change(levels, indent),
        )
        pieces = []
        first = blank_lines = 0


def _joined_rows(pieces: Sequence[str]) -> str:
    """Join the rows of a statement like pycodestyle."""
    text = ""
    for piece in pieces:
        if not piece:
            continue
        text += gap(text[-1], piece[0]) + piece if text else piece
    return text


def _change(levels: list[int], width: int) -> int:
    """Update the indentation; return 1 for a deeper one, else minus the number of ended levels."""
    if width > levels[-1]:
        levels.append(width)
        return 1
    count = 0
    while width < levels[-1]:
        levels.pop()
        count -= 1
    return count
