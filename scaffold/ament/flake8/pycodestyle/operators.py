"""E221 to E228, E231, E271 to E274: spaces around operators and keywords, and after punctuation.

ruff finds the lines, and this module determines the code: to pycodestyle, a space on one side only
is E225 for every operator, and spaces before a line break do not count.
"""

from __future__ import annotations

import keyword
import re
from collections.abc import Iterator

from scaffold.ament import linters
from scaffold.ament.finding import Finding
from scaffold.ament.python_text.logical import LogicalLine
from scaffold.ament.python_text.tokens import (
    ERRORTOKEN,
    FSTRING_END,
    FSTRING_START,
    NAME,
    OP,
    SILENT,
    Position,
    Token,
)

_KEYWORDS = frozenset(keyword.kwlist) - {"False", "None", "True"} | {"print"}
_SOFT_KEYWORDS = frozenset({"_", "case", "match", "type"})
_UNARY = frozenset({">>", "**", "*", "+", "-"})
_ARITHMETIC = frozenset({"**", "*", "/", "//", "+", "-", "@"})
_OPTIONAL = _ARITHMETIC | {"^", "&", "|", "<<", ">>", "%"}
_SPACED = """
    **= *= /= //= += -= != < > %= ^= &= |= == <= >= <<= >>= = and in is or -> :=
"""

_NEEDED = frozenset(_SPACED.split())

_CODES = "E221 E222 E223 E224 E225 E226 E227 E228 E231 E271 E272 E273 E274"
CODES = frozenset(_CODES.split())
"""Codes of ruff that select candidate lines."""

CANDIDATES = (
    r",\]|\{[^{}\n]*:[^{}\n]*\{"
    r"|  [ \t]*[-+*/|!<=>%&^:]|\t[ \t]*[-+*/|!<=>%&^:]"
    r"|[-+*/|!<=>%&^](?:  | ?\t)"
)
"""Candidates that ruff misses: a comma before a bracket, nested formats, spaces at ``->``."""

CONTINUED = r"[,;:]\\\n"
"""Likewise, in the text of the file: a comma before a backslash."""

ARITHMETIC_CANDIDATES = r"|[-+*/@]"
"""Likewise for E226, which the configuration of ament disables."""

_OPERATOR = r"[^,\s](\s*)(?:[-+*/|!<=>%&^]+|:=)(\s*)"
_KEYWORD = rf"(\s*)\b(?:{'|'.join(sorted(_KEYWORDS))})\b(\s*)"

_ONE_SIDED = "missing whitespace around operator"


def check(logical: LogicalLine) -> Iterator[Finding]:
    """Yield the places of a logical line where spaces are missing."""
    is_by_token = linters.of_target().since("pycodestyle", 2, 11)
    for (row, column), code, message in _Scan(logical).faults():
        if code != "E231" or is_by_token:
            yield Finding(code, row, column + 1, message)
    if not is_by_token:
        yield from _tight_punctuation(logical)
    for pattern, codes, description in (
        (_OPERATOR, ("E221", "E222", "E223", "E224"), "operator"),
        (_KEYWORD, ("E272", "E271", "E274", "E273"), "keyword"),
    ):
        for item in re.finditer(pattern, logical.text):
            for group, side in ((1, "before"), (2, "after")):
                if "\t" in item[group]:
                    code, whitespace = codes[group + 1], "a tab"
                elif len(item[group]) > 1:
                    code, whitespace = codes[group - 1], "several spaces"
                else:
                    continue
                row, column = logical.position(item.start(group))
                yield Finding(code, row, column + 1, f"{whitespace} {side} the {description}")


def _tight_punctuation(logical: LogicalLine) -> Iterator[Finding]:
    """Yield E231 like pycodestyle before 2.11: only from the text of the line."""
    line = logical.text
    for item in re.finditer(r"[,;:](?=[^ \t])", line):
        at, before = item.start(), line[: item.start()]
        following = line[at + 1]
        is_slice = before.count("[") > before.count("]") and before.rfind("{") < before.rfind("[")
        if (item[0] == ":" and (is_slice or following == "=")) or item[0] + following == ",)":
            continue
        row, column = logical.position(at)
        yield Finding("E231", row, column + 1, f"missing whitespace after '{item[0]}'")


class _Scan:
    """One pass over the tokens of a logical line."""

    def __init__(self, logical: LogicalLine) -> None:
        self.logical = logical
        self.braces: list[str] = []
        """Open brackets, ``f`` for an f-string, ``l`` for the arguments of a lambda."""
        self.wanted: bool | tuple[Position, bool] = False
        """Whether a space must follow; or the offset and whether a space preceded the operator."""
        self.before: Token | None = None

    def faults(self) -> Iterator[tuple[Position, str, str]]:
        for token in self.logical.tokens:
            self._track(token)
            if token.type in SILENT or token.type == ERRORTOKEN:
                continue
            if token.type == OP and token.string in (",", ";", ":") and self._is_tight(token):
                yield token.start, "E231", f"missing whitespace after '{token.string}'"
            if self.wanted:
                yield from self._check_after_operator(token)
            elif token.type in (OP, NAME) and self.before is not None:
                yield from self._in_front(token, self.before)
            self.before = token

    def _track(self, token: Token) -> None:
        text, braces = token.string, self.braces
        if token.type == OP and text in ("[", "(", "{"):
            braces.append(text)
        elif token.type == FSTRING_START:
            braces.append("f")
        elif token.type == NAME and text == "lambda":
            braces.append("l")
        elif braces and (
            (token.type == OP and text in ("]", ")", "}"))
            or token.type == FSTRING_END
            or (braces[-1] == "l" and token.type == OP and text == ":")
        ):
            braces.pop()

    def _is_tight(self, token: Token) -> bool:
        """Return whether a token follows a comma, semicolon or colon without a space."""
        row, column = token.end
        following = self.logical.lines[row - 1][column : column + 1]
        if following in (" ", "\t", "\xa0") or following in "\r\n":
            return False
        if token.string == ":":
            return self.braces[-1:] != ["["] and self.braces[-2:] != ["f", "{"]
        return not (token.string == "," and following in ")]")

    def _check_after_operator(self, token: Token) -> Iterator[tuple[Position, str, str]]:
        """Check the token after an operator."""
        before, wanted = self.before, self.wanted
        if before is None:
            return
        if token.start != before.end:
            if not isinstance(wanted, bool) and not wanted[1]:
                yield wanted[0], "E225", _ONE_SIDED
            self.wanted = False
            return
        if (before.string == "/" and token.string in (",", ")", ":")) or (
            before.string == ")" and token.string == ":"
        ):
            # The end of positional-only parameters; the state is unchanged.
            return
        if isinstance(wanted, bool) or wanted[1]:
            yield before.end, "E225", _ONE_SIDED
        elif before.string == "%":
            yield wanted[0], "E228", "missing whitespace around '%'"
        elif before.string != "**":
            code = "E226" if before.string in _ARITHMETIC else "E227"
            yield wanted[0], code, f"missing whitespace around '{before.string}'"
        self.wanted = False

    def _in_front(self, token: Token, before: Token) -> Iterator[tuple[Position, str, str]]:
        """Check an operator and the space before it."""
        wanted: bool | None = False
        if token.string == "=" and self._is_keyword_argument():
            pass
        elif token.string in _NEEDED:
            wanted = True
        elif token.string in _UNARY:
            wanted = None if _is_operand(before) else False
        elif token.string in _OPTIONAL:
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
    """Return whether the token is the left operand of an operator after it."""
    if token.type == OP:
        return token.string in "}])"
    return token.string not in _KEYWORDS and token.string not in _SOFT_KEYWORDS
