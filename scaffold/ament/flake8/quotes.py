"""Q000 to Q003: single quotes for strings, double quotes for docstrings and long strings."""

from __future__ import annotations

import re
from collections.abc import Iterator

from scaffold.ament.finding import Finding, Replacement
from scaffold.ament.python_text.text import PythonText
from scaffold.ament.python_text.tokens import (
    COMMENT,
    DEDENT,
    FSTRING_END,
    FSTRING_START,
    INDENT,
    NAME,
    NEWLINE,
    NL,
    OP,
    STRING,
    Position,
    Token,
)

_TRANSPARENT = (NEWLINE, INDENT, DEDENT, NL, COMMENT)

_MESSAGES = {
    "Q000": "double quotes around a string that single quotes would do for",
    "Q001": "single quotes around a multi-line string",
    "Q002": "single quotes around a docstring",
    "Q003": "escaped quotes that other quotes around the string would save",
}


def check(text: PythonText) -> Iterator[Finding]:
    """Yield the strings with the wrong quotes."""
    if not _may_fail(text.text):
        return
    docstrings = _docstrings(text.tokens)
    for literal, start, end, token in _literals(text.tokens):
        code = _judge(literal, is_docstring=start in docstrings)
        if code:
            fix = _fix(code, literal, start, end, is_plain=token.type == STRING)
            row, column = start
            yield Finding(
                code, row, column + 1, _MESSAGES[code], end[0], end[1] + 1, fix, "change the quotes"
            )


def _may_fail(text: str) -> bool:
    rest = text.replace('"""', "")
    if '"' in rest or "\\'" in rest or "''" in rest:
        return True
    for piece in re.findall(r"[fF][rR]?'([^'\n]*)'", rest):
        if piece.rfind("{") > piece.rfind("}"):  # its own quotes inside of an f-string
            return True
    # Strings where a docstring is allowed.
    return re.search(r"^[ \t]*[rRuUbB]{0,2}'|:[ \t]*[rRuUbB]{0,2}'", rest, re.MULTILINE) is not None


def _literals(tokens: list[Token]) -> Iterator[tuple[str, Position, Position, Token]]:
    """Yield string literals; an f-string with all that is in it counts as one."""
    depth = 0
    parts: list[str] = []
    start = (0, 0)
    for token in tokens:
        if token.type == FSTRING_START:
            if not depth:
                start = token.start
            depth += 1
        if depth:
            parts.append(token.string)
            if token.type == FSTRING_END:
                depth -= 1
                if not depth:
                    yield "".join(parts), start, token.end, token
                    parts = []
        elif token.type == STRING:
            yield token.string, token.start, token.end, token


def _judge(literal: str, *, is_docstring: bool) -> str:
    quote = literal[-1]
    prefix, _, _ = literal.partition(quote)
    body = literal[len(prefix) :]
    if is_docstring:
        return "" if '"""' in body else "Q002"
    if body[:3] == quote * 3:
        return "" if '"""' in body or body.endswith("\"'''") else "Q001"
    inside = body[1:-1]
    if quote == "'":
        escapes = "'" in inside and '"' not in inside
        return "Q003" if escapes and "r" not in prefix.lower() else ""
    return "Q000" if "'" not in inside else ""


def _fix(
    code: str, literal: str, start: Position, end: Position, *, is_plain: bool
) -> tuple[Replacement, ...]:
    """Swap the quotes where nothing else has to change."""
    if code != "Q000" or not is_plain or "\\" in literal or "\n" in literal:
        return ()
    opening = start[1] + literal.index('"')
    row = start[0]
    return (
        (row, opening + 1, row, opening + 2, "'"),
        (row, end[1], row, end[1] + 1, "'"),
    )


def _docstrings(tokens: list[Token]) -> set[Position]:
    """Return the starts of the string tokens where a docstring is allowed."""
    positions: set[Position] = set()
    awaited = True
    keyword = False
    depth = 0
    for token in tokens:
        if token.type in _TRANSPARENT:
            continue
        if token.type == STRING:
            if awaited:
                positions.add(token.start)
            awaited = False
        elif token.type == NAME and token.string in ("class", "def"):
            keyword, awaited, depth = True, False, 0
        elif token.type == OP and token.string == ":":
            if depth == 0 and keyword:
                keyword, awaited = False, True
        elif token.type == OP and token.string in "([{":
            depth += 1
            awaited = False
        elif token.type == OP and token.string in ")]}":
            depth -= 1
            awaited = False
        else:
            awaited = False
    return positions
