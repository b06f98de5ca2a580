"""Conditions of dependencies, ``condition="$ROS_VERSION == 2"``, as REP 149 defines them."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import NoReturn

from scaffold import distributions
from scaffold.record import NamedTuple

VARIABLES = frozenset({"ROS_VERSION", "ROS_DISTRO", "ROS_PYTHON_VERSION"})
"""What conditions may ask for."""

_SYNTAX = r"""\s*(?:(?P<op>==|!=|<=|>=|<|>)|(?P<paren>[()])|(?P<text>"[^"]*"|'[^']*')"""
_SYNTAX += r"""|(?P<variable>\$[A-Za-z0-9_]+)|(?P<word>[A-Za-z0-9_-]+))"""


class ConditionError(ValueError):
    """The condition does not follow the grammar; ``offset`` counts from its start."""

    def __init__(self, message: str, offset: int) -> None:
        super().__init__(message)
        self.message = message
        self.offset = offset


class _Token(NamedTuple):
    kind: str
    text: str
    offset: int


def environment() -> Mapping[str, str]:
    """Return the environment that packages are checked for."""
    name = distributions.target().name
    return {"ROS_VERSION": "2", "ROS_DISTRO": name, "ROS_PYTHON_VERSION": "3"}


def holds(condition: str, variables: Mapping[str, str] | None = None) -> bool:
    """Evaluate a condition; a variable that is not set is empty text.

    Args:
        condition: The condition.
        variables: The environment; ``None`` for that of the target distribution.

    Raises:
        ConditionError: it does not follow the grammar of REP 149.
    """
    variables = environment() if variables is None else variables
    return _Evaluation(_tokens(condition), len(condition), variables).run()


def names_unknown(condition: str) -> bool:
    """Tell whether a condition asks for a variable that is not of ROS, but of who builds it."""
    return any(name not in VARIABLES for name in re.findall(r"\$([A-Za-z0-9_]+)", condition))


def misspelled(condition: str) -> Iterator[tuple[str, str]]:
    """Yield the variables and distributions that nobody knows, with the known ones that are near.

    Args:
        condition: A condition that follows the grammar.
    """
    from difflib import get_close_matches

    tokens = [token for token in _tokens(condition) if token.kind != "paren"]
    variables = {f"${name}" for name in VARIABLES}
    for token in tokens:
        if token.kind == "variable" and token.text not in variables:
            yield from ((token.text, near) for near in get_close_matches(token.text, variables, 1))
    compared = [*zip(tokens, tokens[2:], strict=False)]
    for one, other in [*compared, *((other, one) for one, other in compared)]:
        name = other.text.strip("\"'")
        is_asked = one.text == f"${distributions.VARIABLE}" and other.kind in {"word", "text"}
        if is_asked and name not in {*distributions.NAMES, *distributions.ENDED}:
            near = get_close_matches(name.lower(), distributions.NAMES, 1, 0.75)
            yield from ((name, known) for known in near)


def _tokens(condition: str) -> list[_Token]:
    tokens: list[_Token] = []
    at, end = 0, len(condition.rstrip())
    while at < end:
        match = re.compile(_SYNTAX).match(condition, at)
        if match is None or match.lastgroup is None:
            at += len(condition[at:]) - len(condition[at:].lstrip())
            raise ConditionError(f"{condition[at]!r} is not expected", at)
        kind = match.lastgroup
        tokens.append(_Token(kind, match[kind], match.start(kind)))
        at = match.end()
    return tokens


class _Evaluation:
    """Evaluates with two stacks: ``and`` binds tighter than ``or``, both from the left."""

    def __init__(self, tokens: list[_Token], end: int, environment: Mapping[str, str]) -> None:
        self.tokens = tokens
        self.end = end
        self.environment = environment
        self.at = 0

    def run(self) -> bool:
        # Of every open parenthesis: is one of the finished terms true, is the current term true.
        levels: list[tuple[bool, bool]] = []
        any_term, term = False, True
        while True:
            if self._is("paren", "("):
                self.at += 1
                levels.append((any_term, term))
                any_term, term = False, True
                continue
            term = self._comparison() and term
            while self._is("paren", ")") and levels:
                self.at += 1
                value = any_term or term
                any_term, term = levels.pop()
                term = value and term
            if self.at == len(self.tokens):
                break
            word = self._next("'and' or 'or'").text
            if word == "or":
                any_term, term = any_term or term, True
            elif word != "and":
                self.at -= 1
                self._fail("'and' or 'or'")
        if levels:
            self._fail("')'")
        return any_term or term

    def _comparison(self) -> bool:
        left = self._value()
        operator = self._next("a comparison")
        if operator.kind != "op":
            self.at -= 1
            self._fail("a comparison such as ==")
        right = self._value()
        return {
            "==": left == right,
            "!=": left != right,
            "<": left < right,
            "<=": left <= right,
            ">": left > right,
            ">=": left >= right,
        }[operator.text]

    def _value(self) -> str:
        token = self._next("a value")
        if token.kind == "variable":
            return self.environment.get(token.text[1:], "")
        if token.kind == "text":
            return token.text[1:-1]
        if token.kind != "word":
            self.at -= 1
            self._fail("a value")
        return token.text

    def _is(self, kind: str, text: str) -> bool:
        return self.at < len(self.tokens) and self.tokens[self.at][:2] == (kind, text)

    def _next(self, expected: str) -> _Token:
        if self.at == len(self.tokens):
            self._fail(expected)
        self.at += 1
        return self.tokens[self.at - 1]

    def _fail(self, expected: str) -> NoReturn:
        if self.at == len(self.tokens):
            raise ConditionError(f"{expected} expected at the end", self.end)
        token = self.tokens[self.at]
        raise ConditionError(f"{expected} expected before {token.text!r}", token.offset)
