"""E121 to E133: the indentation of continuation lines.

E121, E123, E126 and E133 are only reported with a configuration other than ament's.
"""

from __future__ import annotations

from bisect import bisect_left, insort
from collections.abc import Iterator

from scaffold.ament.finding import Finding
from scaffold.ament.flake8.options import AMENT, Options
from scaffold.ament.python_text.logical import LogicalLine, expand_indent
from scaffold.ament.python_text.text import PythonText
from scaffold.ament.python_text.tokens import (
    COMMENT,
    FSTRING_START,
    NEWLINES,
    NL,
    OP,
    STRING,
    Position,
    Token,
)

MOST_ROWS = 100
"""The maximum number of earlier lines that a line may be indented against."""

_MESSAGES = {
    "E121": "continuation line is indented less than a hanging indentation requires",
    "E123": "closing bracket is indented, not aligned with the line of the opening bracket",
    "E126": "continuation line is indented more than a hanging indentation requires",
    "E133": "closing bracket is not indented",
    "E122": "continuation line is not indented",
    "E124": "closing bracket does not match the visual indentation",
    "E127": "continuation line is indented more than the opening bracket requires",
    "E128": "continuation line is indented less than the opening bracket requires",
    "E131": "continuation line is not aligned with the hanging indentation above it",
    "E125": "continuation line is indented like the block that follows",
    "E129": "visually indented line is indented like the block that follows",
}

Fault = tuple[Position, str]


def check(text: PythonText, options: Options = AMENT) -> Iterator[Finding]:
    """Yield the continuation lines that start in the wrong column."""
    is_tabbed = text.indent_char == "\t"
    for logical in text.logical_lines:
        # After a comment in the last line, the end of the file is a row without a line.
        if logical.row != logical.end_row <= len(logical.lines):
            for (row, column), code in _Walk(logical, options, is_tabbed=is_tabbed).faults():
                yield Finding(code, row, column + 1, _MESSAGES[code])


class _Bracket:
    """One level of brackets; level 0 is the statement itself."""

    def __init__(self, indent: int, rows: list[int]) -> None:
        self.indent = indent
        """The column that its lines align with; 0 until a token follows the bracket."""
        self.hang: int | None = None
        """The hanging indentation of its lines."""
        self.rows = rows
        """Rows that its lines may be indented against."""


class _Walk:
    """One pass over the tokens of a statement; rows count from its first one."""

    def __init__(self, logical: LogicalLine, options: Options, *, is_tabbed: bool) -> None:
        self.logical = logical
        self.tokens = logical.tokens
        self.step = step = options.indent_size
        self.valid_hangs = (step, 2 * step) if is_tabbed else (step,)
        self.hang_closing = options.hang_closing
        self.first_row = self.tokens[0].start[0]
        count = 1 + self.tokens[-1].start[0] - self.first_row
        self.level = logical.indent
        # A block follows, whose indentation must differ from that of these lines.
        self.opens_block = logical.text.endswith(":")
        self.relative = [0] * count
        self.opened = [0] * count
        start = self.tokens[0].start
        self.stack = [_Bracket(start[1], [0])]
        # Rows of closed levels, which may be opened again in the same statement.
        self.spare: list[list[int]] = [self.stack[0].rows]
        self.chances: dict[int, object] = {}
        self.columns: list[int] = []
        """The sorted columns that lines may align with."""
        self.last_start = start
        self.visual: object = None
        self.row = 0

    def faults(self) -> Iterator[Fault]:
        after_rows = False
        last = self.tokens[0]
        for token in self.tokens:
            row = token.start[0] - self.first_row
            is_new = row > self.row
            if is_new:
                self.row = row
                is_new = not after_rows and token.type not in NEWLINES
            if is_new:
                yield from self._line_start(token)
            self._note_columns(token)
            if token.type == OP:
                self._note_brackets(token)
            after_rows = token.start[0] != token.end[0]
            if after_rows:
                self.relative[token.end[0] - self.first_row] = self.relative[self.row]
            last = token
        yield from self._block_start(last)

    def _line_start(self, token: Token) -> Iterator[Fault]:  # noqa: C901, PLR0912  PEP 8's cases
        """Check the first token of a continuation line."""
        bracket = self.stack[-1]
        column = token.start[1]
        self.last_start = token.start
        line = self.logical.lines[token.start[0] - 1]
        self.relative[self.row] = expand_indent(line) - self.level
        closes = token.type == OP and token.string in "]})"
        hang, hanging = self._hang(bracket)
        chance = self.chances.get(column)
        self.visual = not closes and hang > 0 and chance
        if closes and bracket.indent:
            if column != bracket.indent:
                yield token.start, "E124"
        elif closes and not hang:
            if self.hang_closing:
                yield token.start, "E133"
        elif bracket.indent and column < bracket.indent:
            if self.visual is not True:
                yield token.start, "E128"
        elif hanging or (self.opens_block and self.relative[self.row] == 2 * self.step):
            if closes and not self.hang_closing:
                yield token.start, "E123"
            bracket.hang = hang
        elif self.visual is True:
            bracket.indent = column
        elif self.visual is str or (self.visual and self.visual == token.string):
            pass
        elif hang <= 0:
            yield token.start, "E122"
        elif bracket.indent:
            yield token.start, "E127"
        elif not closes and bracket.hang:
            yield token.start, "E131"
        else:
            bracket.hang = hang
            yield token.start, "E126" if hang > self.step else "E121"

    def _hang(self, bracket: _Bracket) -> tuple[int, bool]:
        """Return the indentation relative to the opening line, and whether it is valid."""
        hang, good = 0, False
        rows = bracket.rows
        if len(rows) > MOST_ROWS:
            rows = [rows[0], *rows[-MOST_ROWS:]]
        for row in reversed(rows):
            hang = self.relative[self.row] - self.relative[row]
            good = hang in self.valid_hangs
            if good:
                break
        if bracket.hang:
            good = hang == bracket.hang
        return hang, good

    def _note_columns(self, token: Token) -> None:
        """Record the columns that later lines may align with."""
        bracket = self.stack[-1]
        at_start = not self.row and len(self.stack) == 1
        column = token.start[1]
        if self.opened[self.row] and token.type not in (NL, COMMENT) and not bracket.indent:
            bracket.indent = column
            self._allow(column, True)  # noqa: FBT003  a value, not a switch
        elif token.type in (STRING, COMMENT, FSTRING_START):
            self._allow(column, str)
        elif at_start and (
            token.string in ("assert", "raise", "with")
            or (token.string == "if" and not self.chances)
        ):
            self._allow(token.end[1] + 1, True)  # noqa: FBT003  a value, not a switch
        elif token.string == ":" and self._rest_of_line(token).isspace():
            bracket.rows.append(self.row)

    def _rest_of_line(self, token: Token) -> str:
        return self.logical.lines[token.end[0] - 1][token.end[1] :]

    def _note_brackets(self, token: Token) -> None:
        if token.string in "([{":
            depth = len(self.stack)
            if len(self.spare) == depth:
                self.spare.append([])
            rows = self.spare[depth]
            rows.append(self.row)
            self.stack.append(_Bracket(0, rows))
            self.opened[self.row] += 1
        elif token.string in ")]}" and len(self.stack) > 1:
            self._close()
        if token.start[1] not in self.chances:
            self._allow(token.start[1], token.string)

    def _allow(self, column: int, chance: object) -> None:
        if column not in self.chances:
            insort(self.columns, column)
        self.chances[column] = chance

    def _close(self) -> None:
        limit = self.stack.pop().indent or self.last_start[1]
        depth = len(self.stack)
        for outer in self.stack:
            if outer.indent > limit:
                outer.indent = 0
        kept = bisect_left(self.columns, limit)
        for column in self.columns[kept:]:
            del self.chances[column]
        del self.columns[kept:]
        del self.spare[depth + 1 :]
        if depth > 1:
            self._allow(self.stack[-1].indent, True)  # noqa: FBT003  a value, not a switch
        for row in range(self.row, -1, -1):
            if self.opened[row]:
                self.opened[row] -= 1
                break

    def _block_start(self, last: Token) -> Iterator[Fault]:
        """Check the last line of a statement before a block."""
        line = self.logical.lines[last.start[0] - 1]
        if self.opens_block and expand_indent(line) == self.level + self.step:
            at = (last.start[0], self.stack[0].indent + self.step)
            yield at, "E129" if self.visual else "E125"
