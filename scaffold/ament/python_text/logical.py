"""Logical lines: statements and comment lines, split as flake8 passes them to pycodestyle."""

from __future__ import annotations

from bisect import bisect_left
from functools import cached_property

from scaffold.ament.python_text.tokens import (
    COMMENT,
    FSTRING_MIDDLE,
    LAYOUT,
    NEWLINE,
    NEWLINES,
    NL,
    OP,
    SILENT,
    STRING,
    Position,
    Token,
)


class LogicalLine:
    """The tokens of a statement, or of a comment on its own lines."""

    def __init__(
        self, tokens: list[Token], first: Token, lines: list[str], blank_before: int
    ) -> None:
        self.tokens = tokens
        self.lines = lines
        self.blank_lines = blank_before
        """Blank lines since the logical line (or comment) before."""
        self._first = first
        self.row = self._first.start[0]
        self.end_row = tokens[-1].start[0]

    @cached_property
    def first(self) -> str:
        """The text of the first token; empty for a comment."""
        return "" if self.is_comment else self._first.string

    @property
    def last(self) -> str:
        """The text of the last token that is not a comment; empty for a comment."""
        return next(
            (token.string for token in reversed(self.tokens) if token.type not in SILENT), ""
        )

    @cached_property
    def is_comment(self) -> bool:
        """Whether there is nothing but a comment."""
        return self._first.type == COMMENT and all(token.type in SILENT for token in self.tokens)

    @cached_property
    def indent(self) -> int:
        """Width of the indentation; a tab goes to the next multiple of 8."""
        row, column = self._first.start
        return expand_indent(self.lines[row - 1][:column])

    @property
    def text(self) -> str:
        """The statement on one line, without comments, the content of strings as ``xxx``."""
        return self._built[0]

    def position(self, offset: int) -> Position:
        """Return row (from 1) and column (from 0) of an offset of ``text``.

        As in flake8, an offset belongs to the first token that ends at or after it and is counted
        back from the token's end: within a string of several rows the last row is returned.
        """
        ends, places = self._built[1]
        at = bisect_left(ends, offset)
        if at == len(ends):
            return places[-1]
        row, column = places[at]
        return row, column + offset - ends[at]

    @cached_property
    def _built(self) -> tuple[str, tuple[list[int], list[Position]]]:
        parts: list[str] = []
        ends, places = [0], [self._first.start]
        length = 0
        before: Token | None = None
        for token in self.tokens:
            if token.type in SILENT:
                continue
            text = _visible(token)
            if before is not None and before.end != token.start:
                text = self._gap(before, token, text) + text
            parts.append(text)
            length += len(text)
            ends.append(length)
            places.append(token.end)
            before = token
        return "".join(parts), (ends, places)

    def _gap(self, before: Token, token: Token, text: str) -> str:
        """Return what is between two tokens when the line breaks are taken out."""
        if before.end[0] != token.start[0]:
            last = self.lines[before.end[0] - 1][before.end[1] - 1]
            if last == "," or (last not in "{[(" and text not in "}])"):
                return " "
            return ""
        return self.lines[token.start[0] - 1][before.end[1] : token.start[1]]


def split(tokens: list[Token], lines: list[str]) -> list[LogicalLine]:
    """Cut a file into logical lines."""
    logical_lines: list[LogicalLine] = []
    depth = blank_lines = start = 0
    first: Token | None = None
    for at, token in enumerate(tokens):
        kind = token.type
        if kind == OP:
            if token.string in "([{":
                depth += 1
            elif token.string in ")]}":
                depth -= 1
            first = first or token
        elif kind not in LAYOUT:
            first = first or token
        elif depth == 0 and kind in NEWLINES:
            if first is not None:
                logical_lines.append(LogicalLine(tokens[start : at + 1], first, lines, blank_lines))
                blank_lines, first, start = 0, None, at + 1
            elif kind == NL and at == start:
                blank_lines += 1
                start = at + 1
    if first is not None and first.string:
        logical_lines.append(LogicalLine(tokens[start:], first, lines, blank_lines))
    return logical_lines


def ends_statement(logical: LogicalLine) -> bool:
    """Tell whether a logical line ends with a statement's end, not with a comment's."""
    return logical.tokens[-1].type == NEWLINE


def expand_indent(line: str) -> int:
    """Return the width of a line's indentation; a tab goes to the next multiple of 8."""
    line = line.rstrip("\n\r")
    if "\t" not in line:
        return len(line) - len(line.lstrip())
    width = 0
    for character in line:
        if character == "\t":
            width = width // 8 * 8 + 8
        elif character == " ":
            width += 1
        else:
            break
    return width


def _visible(token: Token) -> str:
    if token.type == STRING:
        return _mute(token.string)
    if token.type == FSTRING_MIDDLE:
        return "x" * len(token.string)
    return token.string


def _mute(text: str) -> str:
    """Replace the content of a string literal by ``x``."""
    start = text.index(text[-1]) + 1
    end = len(text) - 1
    if text[-3:] in ('"""', "'''"):
        start += 2
        end -= 2
    return text[:start] + "x" * (end - start) + text[end:]
