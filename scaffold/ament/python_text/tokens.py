"""Tokens as in Python 3.12, whatever Python is running."""

from __future__ import annotations

import tokenize

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

Token = tokenize.TokenInfo
Position = tuple[int, int]
"""Row from 1, column from 0."""


def read(lines: list[str]) -> list[Token]:
    """Tokenize a file; return an empty list when that is not possible."""
    feed = iter([*lines, ""]).__next__
    try:
        tokens = list(tokenize.generate_tokens(feed))
    except (tokenize.TokenError, SyntaxError, StopIteration):
        return []
    if FSTRING_START < 0:
        from scaffold.ament.python_text.fstrings import open_up

        return open_up(tokens)
    return tokens
