"""Logical lines: statements and comment lines, as flake8 passes them to pycodestyle."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Sequence
from functools import cached_property

from scaffold import lazy_re
from scaffold.ament.python_text.tokenizer import read_statement
from scaffold.ament.python_text.tokens import (
    FSTRING_MIDDLE,
    LAYOUT,
    NEWLINES,
    NL,
    OP,
    SILENT,
    STRING,
    Position,
    Token,
)

_Built = tuple[str, tuple[list[int], list[Position]]]
_FIRST = lazy_re.compile(r"(?i:[rbfu]{0,2})[\"']|\w+|.")


class LogicalLine:
    """A statement, or a comment on its own lines, with lazily read tokens.

    Args:
        lines: The lines of the file.
        rows: The first and the last row.
        column: The start column in the first row, from 0.
        indent: Width of the indentation; a tab goes to the next multiple of 8.
        blank_lines: Blank lines since the logical line (or comment) before.
        code: The statement as in ``text``; empty for a comment.
        levels: 1 for the first of a block; minus the number of blocks that end before it.
    """

    def __init__(
        self,
        lines: list[str],
        rows: tuple[int, int],
        column: int,
        indent: int,
        blank_lines: int,
        code: str,
        *,
        is_opaque: bool = False,
        levels: int = 0,
    ) -> None:
        self.lines = lines
        self.row, self.end_row = rows
        self.column = column
        self.indent = indent
        self.blank_lines = blank_lines
        """Blank lines since the logical line (or comment) before."""
        self.code = code
        """Like ``text``, but an f-string may be a single string in it."""
        self.is_opaque = is_opaque
        """Whether ``code`` differs from ``text``."""
        self.is_comment = not code
        """Whether it is only a comment."""
        matched = _FIRST.match(code)
        self.first = matched[0] if matched else ""
        """The first word; for a string only its start; empty for a comment."""
        self.last = code[-1:]
        """The last character; empty for a comment."""
        self._levels = levels

    @classmethod
    def of_tokens(
        cls, tokens: list[Token], first: Token, lines: list[str], blank_lines: int
    ) -> LogicalLine:
        """Return the logical line of some tokens.

        Args:
            tokens: The tokens.
            first: The first of them other than whitespace.
            lines: The lines of the file.
            blank_lines: Blank lines since the logical line before.
        """
        (row, column), (end_row, _) = first.start, tokens[-1].start
        text, _ = _built(tokens, first.start, lines)
        indent = expand_indent(lines[row - 1][:column])
        line = cls(lines, (row, end_row), column, indent, blank_lines, text)
        line.tokens = tokens
        return line

    @cached_property
    def tokens(self) -> list[Token]:
        """The tokens, preceded by changes of the indentation."""
        return read_statement(self.lines, self.row, self.end_row, self._levels)

    @cached_property
    def text(self) -> str:
        """The statement on one line, without comments, the content of strings as ``xxx``."""
        return self._built[0] if self.is_opaque else self.code

    def position(self, offset: int) -> Position:
        """Return row (from 1) and column (from 0) of an offset of ``text``.

        As in flake8, an offset belongs to the first token that ends at or after it and is counted
        back from the token's end: within a string of several rows the last row is returned.
        """
        if self.row == self.end_row or not offset:
            return self.row, self.column + min(offset, len(self.text))
        ends, places = self._built[1]
        at = bisect_left(ends, offset)
        if at == len(ends):
            return places[-1]
        row, column = places[at]
        return row, column + offset - ends[at]

    @cached_property
    def _built(self) -> _Built:
        return _built(self.tokens, (self.row, self.column), self.lines)


def _built(tokens: Sequence[Token], start: Position, lines: Sequence[str]) -> _Built:
    """Return the text of a logical line, and the offsets and positions of token ends."""
    parts: list[str] = []
    ends, places = [0], [start]
    length = 0
    before: Token | None = None
    for token in tokens:
        if token.type in SILENT:
            continue
        text = _visible(token)
        if before is not None and before.end != token.start:
            text = _between(before, token, text, lines) + text
        parts.append(text)
        length += len(text)
        ends.append(length)
        places.append(token.end)
        before = token
    return "".join(parts), (ends, places)


def _between(before: Token, token: Token, text: str, lines: Sequence[str]) -> str:
    """Return the text between two tokens without line breaks."""
    (row, column), (next_row, next_column) = before.end, token.start
    if row != next_row:
        return gap(lines[row - 1][column - 1], text)
    return lines[row - 1][column:next_column]


def gap(last: str, following: str) -> str:
    """Return the replacement for a line break between a character and a token."""
    return " " if last == "," or (last not in "{[(" and following not in "}])") else ""


def split(tokens: list[Token], lines: list[str]) -> list[LogicalLine]:
    """Split a file into logical lines."""
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
                logical_lines.append(
                    LogicalLine.of_tokens(tokens[start : at + 1], first, lines, blank_lines)
                )
                blank_lines, first, start = 0, None, at + 1
            elif kind == NL and at == start:
                blank_lines += 1
                start = at + 1
    if first is not None and first.string:
        logical_lines.append(LogicalLine.of_tokens(tokens[start:], first, lines, blank_lines))
    return logical_lines


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
        return _masked(token.string)
    if token.type == FSTRING_MIDDLE:
        return "x" * len(token.string)
    return token.string


def _masked(text: str) -> str:
    """Replace the content of a string literal by ``x``."""
    start = text.index(text[-1]) + 1
    end = len(text) - 1
    if text[-3:] in ('"""', "'''"):
        start += 2
        end -= 2
    return text[:start] + "x" * (end - start) + text[end:]
