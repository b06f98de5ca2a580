"""The token types, with the same names on every Python version."""

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

OPEN_FSTRINGS = (3, 12)
"""The first Python with tokens for the parts of f-strings."""

QUOTED = (
    r'"""[^"\\]*(?:(?:\\.|"(?!""))[^"\\]*)*"""',
    r"'''[^'\\]*(?:(?:\\.|'(?!''))[^'\\]*)*'''",
    r'"(?!"")[^\n"\\]*(?:\\.[^\n"\\]*)*"',
    r"'(?!'')[^\n'\\]*(?:\\.[^\n'\\]*)*'",
)
"""Patterns of string literals, without their prefixes."""

Token = tokenize.TokenInfo
Position = tuple[int, int]
"""Row from 1, column from 0."""
