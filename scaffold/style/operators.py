"""E225, E227, E228, E231: blanks around operators and behind punctuation.

ruff finds the lines, this decides which code they get: a blank on one side only is E225 for
pycodestyle whatever the operator.
"""

from __future__ import annotations

import keyword
from collections.abc import Iterator

from scaffold.style.finding import Finding
from scaffold.style.logical import LogicalLine
from scaffold.style.tokens import (
    COMMENT,
    ERRORTOKEN,
    FSTRING_END,
    FSTRING_START,
    LAYOUT,
    NAME,
    OP,
    Position,
    Token,
)

_KEYWORDS = frozenset(keyword.kwlist) - {"False", "None", "True"} | {"print"}
_SOFT_KEYWORDS = frozenset({"_", "case", "match", "type"})
_UNARY = frozenset({">>", "**", "*", "+", "-"})
_ARITHMETIC = frozenset({"**", "*", "/", "//", "+", "-", "@"})
_OPTIONAL = _ARITHMETIC | {"^", "&", "|", "<<", ">>", "%"}
_NEEDED = frozenset(
    "**= *= /= //= += -= != < > %= ^= &= |= == <= >= <<= >>= = and in is or -> :=".split()
)

CODES = frozenset({"E225", "E227", "E228", "E231"})

_ONE_SIDED = "whitespace is missing on a side of an operator"


def check(logical: LogicalLine) -> Iterator[Finding]:
    """Yield the places of a logical line where blanks are missing."""
    for (row, column), code, message in _Scan(logical).faults():
        yield Finding(code, row, column + 1, message)


class _Scan:
    """One pass over the tokens of a logical line."""

    def __init__(self, logical: LogicalLine) -> None:
        self.logical = logical
        self.braces: list[str] = []
        """Open brackets, ``f`` for an f-string, ``l`` for the arguments of a lambda."""
        self.wanted: bool | tuple[Position, bool] = False
        """A blank must follow; or a place and whether one stood in front of the operator."""
        self.before: Token | None = None

    def faults(self) -> Iterator[tuple[Position, str, str]]:
        for token in self.logical.tokens:
            self._track(token)
            if token.kind in LAYOUT or token.kind in (COMMENT, ERRORTOKEN):
                continue
            if token.kind == OP and token.text in (",", ";", ":") and self._is_tight(token):
                yield token.start, "E231", f"whitespace is missing after '{token.text}'"
            if self.wanted:
                yield from self._behind(token)
            elif token.kind in (OP, NAME) and self.before is not None:
                yield from self._in_front(token, self.before)
            self.before = token

    def _track(self, token: Token) -> None:
        text, braces = token.text, self.braces
        if token.kind == OP and text in ("[", "(", "{"):
            braces.append(text)
        elif token.kind == FSTRING_START:
            braces.append("f")
        elif token.kind == NAME and text == "lambda":
            braces.append("l")
        elif braces and (
            (token.kind == OP and text in ("]", ")", "}"))
            or token.kind == FSTRING_END
            or (braces[-1] == "l" and token.kind == OP and text == ":")
        ):
            braces.pop()

    def _is_tight(self, token: Token) -> bool:
        """Tell whether something stands right behind a comma, semicolon or colon."""
        row, column = token.end
        following = self.logical.lines[row - 1][column : column + 1]
        if following in (" ", "\t", "\xa0") or following in "\r\n":
            return False
        if token.text == ":":
            return self.braces[-1:] != ["["] and self.braces[-2:] != ["f", "{"]
        return not (token.text == "," and following in ")]")

    def _behind(self, token: Token) -> Iterator[tuple[Position, str, str]]:
        """Judge the token behind an operator."""
        before, wanted = self.before, self.wanted
        if before is None:
            return
        if token.start != before.end:
            if not isinstance(wanted, bool) and not wanted[1]:
                yield wanted[0], "E225", _ONE_SIDED
            self.wanted = False
            return
        if (before.text == "/" and token.text in (",", ")", ":")) or (
            before.text == ")" and token.text == ":"
        ):
            # The end of positional-only parameters; the state stays as it is.
            return
        if isinstance(wanted, bool) or wanted[1]:
            yield before.end, "E225", _ONE_SIDED
        elif before.text == "%":
            yield wanted[0], "E228", "whitespace is missing around '%'"
        elif before.text not in _ARITHMETIC:
            yield wanted[0], "E227", f"whitespace is missing around '{before.text}'"
        self.wanted = False

    def _in_front(self, token: Token, before: Token) -> Iterator[tuple[Position, str, str]]:
        """Judge an operator and what stands in front of it."""
        wanted: bool | None = False
        if token.text == "=" and self._is_keyword_argument():
            pass
        elif token.text in _NEEDED:
            wanted = True
        elif token.text in _UNARY:
            wanted = None if _is_operand(before) else False
        elif token.text in _OPTIONAL:
            wanted = None
        if wanted is None:
            self.wanted = (before.end, token.start != before.end)
        elif wanted and token.start == before.end:
            yield before.end, "E225", _ONE_SIDED
        else:
            self.wanted = wanted

    def _is_keyword_argument(self) -> bool:
        return self.braces[-1:] in (["l"], ["("]) or self.braces[-2:] == ["f", "{"]


def _is_operand(token: Token) -> bool:
    """Tell whether an operator behind the token has it as its left side."""
    if token.kind == OP:
        return token.text in "}])"
    return token.text not in _KEYWORDS and token.text not in _SOFT_KEYWORDS
