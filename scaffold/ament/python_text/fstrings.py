"""Tokens of f-strings: split into parts as on Python 3.12, or one string as before.

The linters see the tokens of the Python of their distribution: since 3.12, spaces, operators and
line breaks inside the braces count.
"""

from __future__ import annotations

import io
import tokenize
from bisect import bisect_left
from collections.abc import Generator, Iterator, Sequence
from tokenize import TokenInfo

from scaffold.ament.python_text.tokens import FSTRING_END, FSTRING_MIDDLE, FSTRING_START, Position

Cut = Generator[TokenInfo, None, int]
"""A generator of tokens that returns the offset after them."""

_CLOSING = {"(": ")", "[": "]", "{": "}"}
_NOISE = (tokenize.NEWLINE, tokenize.INDENT, tokenize.DEDENT, tokenize.ENDMARKER)


def open_up(tokens: list[TokenInfo]) -> list[TokenInfo]:
    """Return the tokens with every f-string split into its parts."""
    result: list[TokenInfo] = []
    for token in tokens:
        if token.type == tokenize.STRING and _is_f_string(token):
            result.extend(_Opened(token).tokens())
        else:
            result.append(token)
    return result


def _is_f_string(token: TokenInfo) -> bool:
    """Return whether a string is an f-string that the tokenizer did not split."""
    return "f" in _prefix(token.string).lower()


def _prefix(literal: str) -> str:
    return literal[: min(at for at in map(literal.find, "'\"") if at >= 0)]


class _Opened:
    """One f-string, read from left to right."""

    def __init__(self, token: TokenInfo) -> None:
        self._text = text = token.string
        prefix = _prefix(text)
        width = 3 if text[len(prefix) :][:3] in ('"""', "'''") else 1
        self._start = token.start
        self._line = token.line
        self._first = len(prefix) + width
        self._last = len(text) - width
        self._breaks = [at for at, item in enumerate(text) if item == "\n"] if "\n" in text else []

    def tokens(self) -> Iterator[TokenInfo]:
        """Yield the tokens of the string."""
        yield self._token(FSTRING_START, 0, self._first)
        at = yield from self._literal(self._first, self._last, in_spec=False)
        yield self._token(FSTRING_END, at, len(self._text))

    def _place(self, at: int) -> Position:
        row, column = self._start
        breaks = bisect_left(self._breaks, at)
        if breaks:
            return row + breaks, at - self._breaks[breaks - 1] - 1
        return row, column + at

    def _token(self, kind: int, start: int, end: int, text: str | None = None) -> TokenInfo:
        shown = self._text[start:end] if text is None else text
        return TokenInfo(kind, shown, self._place(start), self._place(end), self._line)

    def _literal(self, at: int, end: int, *, in_spec: bool) -> Cut:
        """Yield text and fields up to ``end`` or a closing brace; return the offset."""
        text = self._text
        start = at
        while at < end:
            character = text[at]
            if character in "{}" and text[at + 1 : at + 2] == character and not in_spec:
                # A doubled brace ends a part of text with one brace.
                yield self._token(FSTRING_MIDDLE, start, at + 1)
                at = start = at + 2
            elif character == "{":
                if at > start:
                    yield self._token(FSTRING_MIDDLE, start, at)
                at = start = yield from self._field(at, end)
                if in_spec and text[at : at + 1] == "}":
                    yield self._token(FSTRING_MIDDLE, at, at)
            elif character == "}" and in_spec:
                break
            else:
                at += 1
        if at > start:
            yield self._token(FSTRING_MIDDLE, start, at)
        return at

    def _field(self, at: int, end: int) -> Cut:
        """Yield the tokens of a replacement field; return the offset after it."""
        yield self._token(tokenize.OP, at, at + 1)
        stop = self._end_of_expression(at + 1, end)
        yield from self._expression(at + 1, stop)
        at = stop
        if self._text[at : at + 1] == "!":
            yield self._token(tokenize.OP, at, at + 1)
            yield self._token(tokenize.NAME, at + 1, at + 2)
            at += 2
            while at < end and self._text[at].isspace():
                at += 1
        if self._text[at : at + 1] == ":":
            yield self._token(tokenize.OP, at, at + 1)
            at = yield from self._literal(at + 1, end, in_spec=True)
        if self._text[at : at + 1] == "}":
            yield self._token(tokenize.OP, at, at + 1)
            at += 1
        return at

    def _end_of_expression(self, at: int, end: int) -> int:
        """Return the end of an expression: at ``!r``, ``:`` or the closing brace."""
        text = self._text
        open_brackets: list[str] = []
        quote = ""
        while at < end:
            character = text[at]
            if quote:
                if text.startswith(quote, at):
                    at += len(quote) - 1
                    quote = ""
            elif character in "'\"":
                quote = text[at : at + 3] if text[at : at + 3] == character * 3 else character
                at += len(quote) - 1
            elif character in _CLOSING:
                open_brackets.append(_CLOSING[character])
            elif open_brackets:
                if character == open_brackets[-1]:
                    open_brackets.pop()
            elif character in "}:" or (character == "!" and text[at + 1 : at + 2] != "="):
                return at
            at += 1
        return at

    def _expression(self, start: int, end: int) -> Iterator[TokenInfo]:
        """Yield the tokens of an expression, read in parentheses so that it may span lines."""
        if self._text[start:end].isidentifier():
            yield self._token(tokenize.NAME, start, end)
            return
        feed = io.StringIO(f"({self._text[start:end]})").readline
        row, column = self._place(start)
        try:
            inner = [token for token in tokenize.generate_tokens(feed) if token.type not in _NOISE]
        except (tokenize.TokenError, SyntaxError):
            return
        moved = [
            TokenInfo(
                item.type,
                item.string,
                _moved(item.start, row, column),
                _moved(item.end, row, column),
                self._line,
            )
            for item in inner[1:-1]
        ]
        yield from open_up(moved)


def _moved(place: Position, row: int, column: int) -> Position:
    """Translate a position within ``(expression)`` to one in the file."""
    return row + place[0] - 1, place[1] + (column - 1 if place[0] == 1 else 0)


def close_up(tokens: Sequence[TokenInfo], lines: Sequence[str]) -> list[TokenInfo]:
    """Return the tokens of some lines with every f-string as one string."""
    result: list[TokenInfo] = []
    depth = 0
    first: TokenInfo | None = None
    for token in tokens:
        if token.type == FSTRING_START:
            first = first or token
            depth += 1
        elif token.type == FSTRING_END and first is not None:
            depth -= 1
            if depth == 0:
                result.append(_joined_token(first, token, lines))
                first = None
        elif first is None:
            result.append(token)
    return result


def _joined_token(first: TokenInfo, last: TokenInfo, lines: Sequence[str]) -> TokenInfo:
    (row, column), (end_row, end) = first.start, last.end
    *whole, rest = lines[row - 1 : end_row]
    text = "".join((*whole, rest[:end]))[column:]
    return TokenInfo(tokenize.STRING, text, first.start, last.end, "".join((*whole, rest)))
