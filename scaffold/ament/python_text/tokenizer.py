"""Tokens as the linters of the target see them, whatever Python is running."""

from __future__ import annotations

import tokenize

from scaffold.ament import linters
from scaffold.ament.python_text import fstrings, quick_tokens
from scaffold.ament.python_text.tokens import FSTRING_START, OPEN_FSTRINGS, Token


def read(lines: list[str]) -> list[Token]:
    """Tokenize a file; return an empty list when that is not possible."""
    tokens = _read(lines)
    are_open, are_wanted_open = FSTRING_START > 0, linters.of_target().python >= OPEN_FSTRINGS
    if are_open == are_wanted_open:
        return tokens
    return fstrings.open_up(tokens) if are_wanted_open else fstrings.close_up(tokens, lines)


def _read(lines: list[str]) -> list[Token]:
    if FSTRING_START < 0:
        tokens = quick_tokens.read("".join(lines), lines)
        if tokens is not None:
            return tokens
    feed = iter([*lines, ""]).__next__
    try:
        return list(tokenize.generate_tokens(feed))
    except (tokenize.TokenError, SyntaxError, StopIteration):
        return []
