"""Tokens as in the linters of the target, independent of the running Python."""

from __future__ import annotations

import tokenize

from scaffold.ament import linters
from scaffold.ament.python_text import fstrings
from scaffold.ament.python_text.tokens import (
    DEDENT,
    ENDMARKER,
    FSTRING_START,
    INDENT,
    OPEN_FSTRINGS,
    Token,
)


def read(lines: list[str], rows: tuple[int, int] | None = None) -> list[Token]:
    """Tokenize a file; return an empty list if that is impossible.

    Args:
        lines: Its lines.
        rows: The first and the last row to tokenize.
    """
    tokens = _read(lines, rows)
    are_open, are_wanted_open = FSTRING_START > 0, linters.of_target().python >= OPEN_FSTRINGS
    if are_open == are_wanted_open:
        return tokens
    return fstrings.open_up(tokens) if are_wanted_open else fstrings.close_up(tokens, lines)


def read_statement(lines: list[str], row: int, end_row: int, levels: int) -> list[Token]:
    """Tokenize a statement, or a comment.

    Args:
        lines: The lines of the file.
        row: The first row.
        end_row: The last row.
        levels: 1 for the first of a block; minus the number of blocks that end before it.
    """
    tokens = read(lines, (row, end_row))
    while tokens and tokens[-1].type in (DEDENT, ENDMARKER):
        tokens.pop()
    if levels < 1 and tokens and tokens[0].type == INDENT:
        del tokens[0]
    if levels < 0:
        first = tokens[0]
        tokens[:0] = [Token(DEDENT, "", first.start, first.start, first.line)] * -levels
    return tokens


def _read(lines: list[str], rows: tuple[int, int] | None) -> list[Token]:
    row, end_row = rows or (1, len(lines))
    some = lines if rows is None else lines[row - 1 : end_row]
    feed = iter([*some, ""]).__next__
    try:
        tokens = list(tokenize.generate_tokens(feed))
    except (tokenize.TokenError, SyntaxError, StopIteration):
        return []
    return tokens if row == 1 else [_moved(token, row - 1) for token in tokens]


def _moved(token: Token, rows: int) -> Token:
    (row, column), (end_row, end) = token.start, token.end
    return token._replace(start=(row + rows, column), end=(end_row + rows, end))
