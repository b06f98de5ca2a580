"""Conditions of dependencies, ``condition="$ROS_VERSION == 2"``, as REP 149 defines them."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import NoReturn

from scaffold import distributions
from scaffold.record import NamedTuple

VARIABLES = frozenset({"ROS_VERSION", "ROS_DISTRO", "ROS_PYTHON_VERSION"})
"""The variables allowed in conditions."""

_NEAR = 0.75
"""The similarity from which a name is a misspelling."""
_DISTRIBUTIONS = (*distributions.NAMES, *sorted(distributions.ENDED))
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

    @property
    def content(self) -> str:
        """The text without quotes around it."""
        return self.text.strip("\"'")


def environment() -> Mapping[str, str]:
    """Return the variables of conditions on the target."""
    name = distributions.target().name
    return {"ROS_VERSION": "2", "ROS_DISTRO": name, "ROS_PYTHON_VERSION": "3"}


def holds(condition: str, variables: Mapping[str, str] | None = None) -> bool:
    """Evaluate a condition; an unset variable is an empty string.

    Args:
        condition: The condition.
        variables: The environment; ``None`` for that of the target distribution.

    Raises:
        ConditionError: it does not follow the grammar of REP 149.
    """
    variables = environment() if variables is None else variables
    return _Evaluation(_tokens(condition), len(condition), variables).run()


def names_unknown(condition: str) -> bool:
    """Return whether a condition uses a custom variable, not one of ROS."""
    return any(name not in VARIABLES for name in re.findall(r"\$([A-Za-z0-9_]+)", condition))


def misspelled(condition: str) -> Iterator[tuple[str, str]]:
    """Yield unknown variables and distributions, with the closest known ones.

    Args:
        condition: A condition that follows the grammar.
    """
    from difflib import get_close_matches

    variables = {f"${name}" for name in VARIABLES}
    for token in _tokens(condition):
        is_custom = not token.text.startswith("$R")  # such as GZ_VERSION
        if token.kind == "variable" and token.text not in variables and not is_custom:
            close = get_close_matches(token.text, variables, 1, _NEAR)
            yield from ((token.text, suggestion) for suggestion in close)
    for name in _unknown_distributions(condition):
        similar = get_close_matches(name.lower(), distributions.NAMES, 1, _NEAR)
        yield from ((name, suggestion) for suggestion in similar)


def _unknown_distributions(condition: str) -> list[str]:
    """Return the unknown names that ``$ROS_DISTRO`` is compared with."""
    return [
        other.content
        for left, _, right in _comparisons(condition)
        for side, other in ((left, right), (right, left))
        if side.text == f"${distributions.VARIABLE}"
        and other.kind != "variable"
        and other.content not in _DISTRIBUTIONS
    ]


class Constant(NamedTuple):
    """A comparison of two literals, whose result is always the same."""

    text: str
    variable: str
    """The variable named by a literal without ``$``; empty if none."""
    offset: int
    """The offset of that literal."""
    value: bool


def constants(condition: str) -> Iterator[Constant]:
    """Yield the comparisons without a variable.

    Args:
        condition: A condition that follows the grammar.
    """
    for left, operator, right in _comparisons(condition):
        if "variable" in {left.kind, right.kind}:
            continue
        named = next((token for token in (left, right) if token.text in VARIABLES), None)
        text = f"{left.text} {operator.text} {right.text}"
        offset = left.offset if named is None else named.offset
        yield Constant(text, named.text if named else "", offset, holds(text))


def is_never_true(condition: str) -> bool:
    """Return whether a condition is true on no distribution of ROS, whatever its Python is.

    Args:
        condition: A condition that follows the grammar.
    """
    if names_unknown(condition):
        return False
    environments: list[Mapping[str, str]] = [{}]
    for name in (*_DISTRIBUTIONS, *_unknown_distributions(condition)):
        version = "1" if name in distributions.OF_ROS1 else "2"
        environments += [
            {"ROS_VERSION": version, "ROS_DISTRO": name, "ROS_PYTHON_VERSION": python}
            for python in ("2", "3")
        ]
    return not any(holds(condition, environment) for environment in environments)


def _comparisons(condition: str) -> Iterator[tuple[_Token, _Token, _Token]]:
    """Yield the comparisons as operand, operator, operand."""
    tokens = _tokens(condition)
    for number, token in enumerate(tokens):
        if token.kind == "op":
            yield tokens[number - 1], token, tokens[number + 1]


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
    """Evaluates with two stacks: ``and`` binds tighter than ``or``; both associate left."""

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
            if self._is_parenthesis("("):
                self.at += 1
                levels.append((any_term, term))
                any_term, term = False, True
                continue
            term = self._comparison() and term
            while self._is_parenthesis(")") and levels:
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

    def _is_parenthesis(self, text: str) -> bool:
        return self.at < len(self.tokens) and self.tokens[self.at][:2] == ("paren", text)

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
