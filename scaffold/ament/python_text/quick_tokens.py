"""A fast tokenizer with the output of Python's own before 3.12.

Python's tokenizer is written in Python and took a third of the time of a style check. Here, one
regular expression matches the whole text; unusual files are left to the original.
"""

from __future__ import annotations

import re
import tokenize
from collections.abc import Sequence
from tokenize import (
    COMMENT,
    DEDENT,
    ENDMARKER,
    ERRORTOKEN,
    INDENT,
    NAME,
    NEWLINE,
    NL,
    NUMBER,
    OP,
    STRING,
)

Token = tokenize.TokenInfo

_CONTINUATION = -1
QUOTED = (
    r'"""[^"\\]*(?:(?:\\.|"(?!""))[^"\\]*)*"""',
    r"'''[^'\\]*(?:(?:\\.|'(?!''))[^'\\]*)*'''",
    r'"(?!"")[^\n"\\]*(?:\\.[^\n"\\]*)*"',
    r"'(?!'')[^\n'\\]*(?:\\.[^\n'\\]*)*'",
)
_OPERATOR = r"\*\*=?|//=?|>>=?|<<=?|->|!=|:=|\.\.\.|\.(?![0-9])|[-+*/%&@|^=<>]=?|[()\[\]{},:;~]"
_PATTERNS = {
    NAME: r"""[^\W\d]\w*(?!["'\w])""",
    OP: _OPERATOR,
    NEWLINE: r"\n",
    STRING: f"(?:[bB][rR]?|[rR][bBfF]?|[fF][rR]?|[uU])?(?:{'|'.join(QUOTED)})",
    NUMBER: re.sub(r"(?<!\\)\((?!\?)", "(?:", tokenize.Number),
    COMMENT: r"#[^\n]*",
    _CONTINUATION: r"\\\n",
    ERRORTOKEN: ".",
}
_KINDS = (0, *_PATTERNS)
"""The token types by group number."""
# linear: the last group matches any character
_TOKEN = re.compile(
    rf"[ \f\t]*(?:{'|'.join(f'({pattern})' for pattern in _PATTERNS.values())})", re.DOTALL
)
_DEPTHS = dict.fromkeys("([{", 1) | dict.fromkeys(")]}", -1)
_SILENT = frozenset({NEWLINE, COMMENT})
"""Matches the start of lines without a statement."""


def read(  # noqa: C901  calls for each token would take the time that is to be saved
    text: str, lines: Sequence[str], row: int = 1
) -> list[Token] | None:
    r"""Return the tokens; ``None`` if Python's tokenizer is needed.

    Args:
        text: The text of some lines of a file, or all; each ends with ``\n``.
        lines: The lines of the file.
        row: The number of the first line of the text.
    """
    tokens: list[Token] = []
    add, new = tokens.append, tuple.__new__
    indents = [0]
    row_start = depth = at = 0
    line = lines[row - 1] if lines else ""
    is_ascii = text.isascii()
    is_first = True
    """Whether a statement may start here."""
    end_of_line = NEWLINE
    for match in _TOKEN.finditer(text):
        group = match.lastindex or 0
        kind = _KINDS[group]
        start, at = match.span(group)
        string = text[start:at]
        place, end = (row, start - row_start), (row, at - row_start)
        if is_first:
            is_first = False
            end_of_line = NL if kind in _SILENT else NEWLINE
            if end_of_line == NEWLINE and not _indent(tokens, indents, line, place):
                return None
        if kind == OP:
            depth += _DEPTHS.get(string, 0)
        elif kind == NAME:
            if not (is_ascii or string[0].isidentifier()):
                return None
        elif kind == ERRORTOKEN:
            return None
        elif "\n" in string:
            first = row
            row += string.count("\n")
            row_start = start + string.rindex("\n") + 1
            if kind == STRING:
                end = row, at - row_start
                whole = "".join(lines[first - 1 : row])
                add(new(Token, (kind, string, place, end, whole)))
            elif kind == NEWLINE:
                is_first = depth == 0
                kind = end_of_line if is_first else NL
                add(new(Token, (kind, string, place, end, line)))
            line = lines[row - 1] if row <= len(lines) else ""
            continue
        add(new(Token, (kind, string, place, end, line)))
    if at < len(text) or not is_first:
        return None
    place = row, 0
    tokens += (Token(DEDENT, "", place, place, "") for _ in indents[1:])
    tokens.append(Token(ENDMARKER, "", place, place, ""))
    return tokens


def _indent(tokens: list[Token], indents: list[int], line: str, place: tuple[int, int]) -> bool:
    """Add the tokens of an indentation; return whether they are certain."""
    row, width = place
    if width == indents[-1] and line.startswith(" " * width):
        return True
    if line[:width].strip(" "):
        return False  # tabs are special
    if width > indents[-1]:
        indents.append(width)
        tokens.append(Token(INDENT, line[:width], (row, 0), place, line))
    while width < indents[-1]:
        indents.pop()
        tokens.append(Token(DEDENT, "", place, place, line))
    return width == indents[-1]
