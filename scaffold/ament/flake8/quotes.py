"""Q000 to Q003: single quotes for strings, double quotes for docstrings and long strings.

This is ament's configuration; that of a package may differ.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from scaffold.ament.finding import Finding, Replacement
from scaffold.ament.flake8.options import AMENT, Options
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
from scaffold.record import NamedTuple

_TRANSPARENT = (NEWLINE, INDENT, DEDENT, NL, COMMENT)

_HEADERS = frozenset({"class", "def", "async"})
_DEPTHS = dict.fromkeys("([{", 1) | dict.fromkeys(")]}", -1)

_Literal = tuple[str, Position, Position, bool]
"""The text, the start and the end of a literal, and whether it is a plain string."""

_NAMES = {"'": "single", '"': "double"}
_OTHER = {"'": '"', '"': "'"}


class _Quotes(NamedTuple):
    """The quotes that the configuration requires."""

    inline: str
    multiline: str
    docstring: str
    avoid_escape: bool

    def message(self, code: str) -> str:
        """Return the message for a code."""
        if code == "Q000":
            wanted, bad = _NAMES[self.inline], _NAMES[_OTHER[self.inline]]
            return f"{bad}-quoted string; use {wanted} quotes"
        if code == "Q003":
            return "escaped quotes inside of a string; use the other quotes around it"
        of_docstring = code == "Q002"
        bad = _NAMES[_OTHER[self.docstring if of_docstring else self.multiline]]
        return f"{bad}-quoted {'docstring' if of_docstring else 'multi-line string'}"


def check(text: PythonText, options: Options = AMENT) -> Iterator[Finding]:
    """Yield the strings with the wrong quotes."""
    quotes = _Quotes(
        options.inline_quotes,
        options.multiline_quotes,
        options.docstring_quotes,
        options.avoid_escape,
    )
    if quotes == _AMENT and not _may_fail(text.text):
        return
    docstrings = _docstrings(text)
    for literal, start, end, is_plain in _literals(text, opened=options.check_inside_f_strings):
        code = _judge(literal, quotes, is_docstring=start in docstrings)
        if code:
            fix = _fix(code, literal, start, end, is_plain=is_plain)
            row, column = start
            yield Finding(
                code,
                row,
                column + 1,
                quotes.message(code),
                end[0],
                end[1] + 1,
                fix,
                "change the quotes",
            )


_AMENT = _Quotes("'", '"', '"', avoid_escape=True)


def _may_fail(text: str) -> bool:
    rest = text.replace('"""', "")
    if '"' in rest or "\\'" in rest or "''" in rest:
        return True
    for piece in re.findall(r"[fF][rR]?'([^'\n]*)'", rest):
        if piece.rfind("{") > piece.rfind("}"):  # quotes inside of an f-string
            return True
    # Strings where a docstring is allowed.
    return re.search(r"^[ \t]*[rRuUbB]{0,2}'|:[ \t]*[rRuUbB]{0,2}'", rest, re.MULTILINE) is not None


def _literals(text: PythonText, *, opened: bool) -> Iterator[_Literal]:
    """Yield string literals; an f-string and its contents are one unless ``opened``."""
    if text.outline is None or opened:
        yield from _literal_tokens(text.tokens, opened=opened)
        return
    line, starts = text.text, text.line_starts
    for start, quotes, end in text.outline.literals:
        row, last = text.line_of(start), text.line_of(end - 1)
        is_plain = not text.are_fstrings_opened or "f" not in line[start:quotes].lower()
        at, behind = (row, start - starts[row - 1]), (last, end - starts[last - 1])
        yield line[start:end], at, behind, is_plain


def _literal_tokens(tokens: Iterable[Token], *, opened: bool) -> Iterator[_Literal]:
    depth = 0
    parts: list[str] = []
    start = (0, 0)
    for token in tokens:
        if opened:
            if token.type in (STRING, FSTRING_START):
                yield token.string, token.start, token.end, token.type == STRING
            continue
        if token.type == FSTRING_START:
            if not depth:
                start = token.start
            depth += 1
        if depth:
            parts.append(token.string)
            if token.type == FSTRING_END:
                depth -= 1
                if not depth:
                    yield "".join(parts), start, token.end, False
                    parts = []
        elif token.type == STRING:
            yield token.string, token.start, token.end, True


def _judge(literal: str, quotes: _Quotes, *, is_docstring: bool) -> str:
    quote = literal[-1]
    prefix, _, _ = literal.partition(quote)
    body = literal[len(prefix) :]
    if is_docstring:
        return "" if quotes.docstring * 3 in body else "Q002"
    if body[:3] == quote * 3:
        good = quotes.multiline
        ending = good + _OTHER[good] * 3
        return "" if good * 3 in body or body.endswith(ending) else "Q001"
    inside = body[1:-1]
    good = quotes.inline
    if quote == good:
        escapes = good in inside and _OTHER[good] not in inside and quotes.avoid_escape
        return "Q003" if escapes and "r" not in prefix.lower() else ""
    return "Q000" if good not in inside else ""


def _fix(
    code: str, literal: str, start: Position, end: Position, *, is_plain: bool
) -> tuple[Replacement, ...]:
    """Swap the quotes if nothing else has to change."""
    if code != "Q000" or not is_plain or "\\" in literal or "\n" in literal:
        return ()
    quote = literal[-1]
    opening = start[1] + literal.index(quote)
    row, other = start[0], _OTHER[quote]
    return (
        (row, opening + 1, row, opening + 2, other),
        (row, end[1], row, end[1] + 1, other),
    )


def _docstrings(text: PythonText) -> set[Position]:
    """Return the starts of the strings where a docstring is allowed."""
    places = _Places()
    for logical in text.logical_lines:
        if logical.is_comment:
            continue
        if logical.first in _HEADERS:
            if logical.last == ":" and not logical.is_opaque and "lambda" not in logical.code:
                places.is_awaited = True
            else:
                places.read(logical.tokens)
        elif places.is_awaited and logical.first[-1] in "\"'":
            places.read(logical.tokens)
        else:
            places.is_awaited = False
    return places.found


class _Places:
    """The places of docstrings: first in the file, or after the colon of a header."""

    def __init__(self) -> None:
        self.found: set[Position] = set()
        self.is_awaited = True

    def read(self, tokens: Iterable[Token]) -> None:
        """Process a logical line."""
        keyword = False
        depth = 0
        for token in tokens:
            if token.type in _TRANSPARENT:
                continue
            if token.type == STRING:
                if self.is_awaited:
                    self.found.add(token.start)
                self.is_awaited = False
            elif token.type == NAME and token.string in ("class", "def"):
                keyword, self.is_awaited, depth = True, False, 0
            elif token.type == OP and token.string == ":":
                if depth == 0 and keyword:
                    keyword, self.is_awaited = False, True
            else:
                depth += token.type == OP and _DEPTHS.get(token.string, 0)
                self.is_awaited = False
