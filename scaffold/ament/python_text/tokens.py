"""Tokens as the linters of the target see them, whatever Python is running."""

from __future__ import annotations

import tokenize

from scaffold.ament import linters

NAME = tokenize.NAME
NUMBER = tokenize.NUMBER
STRING = tokenize.STRING
OP = tokenize.OP
COMMENT = tokenize.COMMENT
NL = tokenize.NL
NEWLINE = tokenize.NEWLINE
INDENT = tokenize.INDENT
DEDENT = tokenize.DEDENT
ENDMARKER = tokenize.ENDMARKER
ERRORTOKEN = tokenize.ERRORTOKEN
FSTRING_START: int = getattr(tokenize, "FSTRING_START", -1)
FSTRING_MIDDLE: int = getattr(tokenize, "FSTRING_MIDDLE", -2)
FSTRING_END: int = getattr(tokenize, "FSTRING_END", -3)

NEWLINES = frozenset({NL, NEWLINE})
LAYOUT = frozenset({NL, NEWLINE, INDENT, DEDENT})
SILENT = LAYOUT | {COMMENT}

OPEN_FSTRINGS = (3, 12)
"""The first Python that has tokens for what is inside of an f-string."""

Token = tokenize.TokenInfo
Position = tuple[int, int]
"""Row from 1, column from 0."""


def read(lines: list[str]) -> list[Token]:
    """Tokenize a file; return an empty list when that is not possible."""
    tokens = _read(lines)
    are_open, are_wanted_open = FSTRING_START > 0, linters.of_target().python >= OPEN_FSTRINGS
    if are_open == are_wanted_open:
        return tokens
    from scaffold.ament.python_text import fstrings

    return fstrings.open_up(tokens) if are_wanted_open else fstrings.close_up(tokens, lines)


def _read(lines: list[str]) -> list[Token]:
    if FSTRING_START < 0:
        from scaffold.ament.python_text import quick_tokens

        tokens = quick_tokens.read("".join(lines), lines)
        if tokens is not None:
            return tokens
    feed = iter([*lines, ""]).__next__
    try:
        return list(tokenize.generate_tokens(feed))
    except (tokenize.TokenError, SyntaxError, StopIteration):
        return []
