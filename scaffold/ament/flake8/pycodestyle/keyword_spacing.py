"""E251, E252, E275: spaces around the ``=`` of arguments, and after keywords.

On Python 3.12, the ``=`` of ``f'{value = }'`` inside a call also counts as that of an argument.
"""

from __future__ import annotations

import keyword
import re
from collections.abc import Iterator
from itertools import pairwise

from scaffold.ament import linters
from scaffold.ament.finding import Finding
from scaffold.ament.python_text.logical import LogicalLine
from scaffold.ament.python_text.tokens import NAME, NL, OP, Position

CODES = frozenset({"E251", "E252", "E275"})
"""Codes of ruff that select candidate lines."""

CANDIDATES = r"=(?:(?<=\s=)\s*|\s+)[}!:]"
"""Candidates that ruff misses."""


def check(logical: LogicalLine) -> Iterator[Finding]:
    """Yield the places of a logical line with missing or surplus spaces."""
    for (row, column), code in _around_equals(logical):
        if code == "E251":
            message = "whitespace around the '=' of a keyword argument or default"
        else:
            message = "missing whitespace around the '=' of an annotated argument"
        yield Finding(code, row, column + 1, message)
    is_for_all = linters.of_target().since("pycodestyle", 2, 9)
    for token, following in pairwise(logical.tokens):
        if (
            token.end == following.start
            and token.type == NAME
            and (
                _needs_blank(token.string, following.string)
                if is_for_all
                else (logical.first, token.string, following.string) == ("from", "import", "(")
            )
        ):
            row, column = token.end
            message = f"missing whitespace after '{token.string}'"
            yield Finding("E275", row, column + 1, message)


def _needs_blank(word: str, following: str) -> bool:
    if not keyword.iskeyword(word) or word in ("True", "False", "None"):
        return False
    if (word, following) in (("except", "*"), ("yield", ")")):
        return False
    return following not in ":\n"


def _has_type_parameters(logical: LogicalLine) -> bool:
    """Return whether defaults in square brackets are those of type parameters (PEP 696)."""
    return (
        linters.of_target().since("pycodestyle", 2, 12, 1)
        and re.match(r"(async\s+def|def|class|type)\s+\w+\[", logical.text) is not None
    )


def _around_equals(logical: LogicalLine) -> Iterator[tuple[Position, str]]:
    depth = 0
    end: Position = logical.tokens[0].start
    code = ""
    annotated = False
    in_def = re.match(r"(async\s+def|def)\b", logical.text) is not None
    generic = "[" if _has_type_parameters(logical) else ""
    brackets: list[str] = []
    for token in logical.tokens:
        if token.type == NL:
            continue
        if code and (token.start == end) == (code == "E252"):
            yield end, code
        code = ""
        text = token.string if token.type == OP else ""
        depth += (text in ("(", "[")) - (text in (")", "]"))
        if text in ("(", "["):
            brackets.append(text)
        elif text in (")", "]") and brackets:
            brackets.pop()
        if text == "=" and depth:
            is_default = depth == 1 and (annotated or brackets == [generic])
            code = "E252" if is_default else "E251"
            if (token.start == end) == (code == "E252"):
                yield end, code
        elif text == ":" and in_def and depth == 1:
            annotated = True
        elif text == "," and depth == 1:
            annotated = False
        annotated = annotated and depth > 0
        end = token.end
