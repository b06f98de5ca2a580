"""Evaluates ``if()`` conditions of CMake to true, false or unknown."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence

from scaffold import lazy_re
from scaffold.distributions import ALIASES, VARIABLE, target
from scaffold.model.cmake.parser import unescape
from scaffold.model.cmake.variables import split_list
from scaffold.record import NamedTuple

OF_DISTRIBUTION = frozenset({f"ENV{{{VARIABLE}}}", f"$ENV{{{VARIABLE}}}"})
_FALSE = frozenset({"", "0", "OFF", "NO", "FALSE", "N", "IGNORE", "NOTFOUND"})
_TRUE = frozenset({"1", "ON", "YES", "TRUE", "Y"})
_TEXTS: Mapping[str, Callable[[str, str], bool]] = {
    "EQUAL": lambda left, right: left == right,
    "LESS": lambda left, right: left < right,
    "GREATER": lambda left, right: left > right,
    "LESS_EQUAL": lambda left, right: left <= right,
    "GREATER_EQUAL": lambda left, right: left >= right,
}
"""The suffixes of ``STR`` and ``VERSION_`` comparisons."""
_VERSION = lazy_re.compile(r"\d+(?:\.\d+){0,3}")
_FIXED_PARTS = 2
"""The number of version components that are fixed within a distribution."""


class Known(NamedTuple):
    """The value of a variable or a word on the target."""

    value: str | None
    """``None`` if unknown."""
    is_specific: bool = False
    """Whether it depends on the distribution."""


UNKNOWN = Known(None)


class Decision(NamedTuple):
    """Whether a condition is true on the target."""

    holds: bool | None
    """``None`` if unknown."""
    is_specific: bool = False
    """Whether it depends on the distribution."""


UNDECIDED = Decision(None)


class Word(NamedTuple):
    """An argument of a condition."""

    text: str
    """The text without quotes."""
    is_quoted: bool


class Scope:
    """The variables of a file, as far as they are known; see `expand` and `lookup`."""

    def __init__(self) -> None:
        self._known: dict[str, Known] = {VARIABLE: Known(target().name, is_specific=True)}

    def set(self, name: str, value: Known) -> None:
        """Set a variable."""
        self._known[name] = value

    def lookup(self, name: str) -> Known:
        """Return the value of a variable; ``rclcpp_VERSION_MAJOR`` is that of the distribution."""
        if name in self._known:
            return self._known[name]
        package, _, part = name.rpartition("_VERSION_")
        released = target().fact("released").get(package)
        if part != "MAJOR" or released is None or target().name in ALIASES:
            return UNKNOWN
        return Known(released.partition(".")[0], is_specific=True)

    def is_set(self, name: str) -> bool:
        """Return whether the file sets a variable to a tracked value."""
        return name in self._known

    def expand(self, text: str) -> Known:
        """Return a text with its variables replaced."""
        is_specific = False
        parts: list[str] = []
        for piece in re.split(r"(\$(?:ENV|CACHE)?\{[^{}$]*\})", text):  # linear: nothing nests
            if not piece.endswith("}") or not piece.startswith("$"):
                parts.append(unescape(piece))
                continue
            part = self._value(piece)
            if part.value is None:
                return UNKNOWN
            is_specific |= part.is_specific
            parts.append(part.value)
        value = "".join(parts)
        return UNKNOWN if re.search(r"\$\w*[{<]", value) else Known(value, is_specific)

    def _value(self, reference: str) -> Known:
        if reference in OF_DISTRIBUTION:
            return Known(target().name, is_specific=True)
        return self.lookup(reference[2:-1]) if reference.startswith("${") else UNKNOWN


class Condition:
    """The arguments of an ``if()``.

    Args:
        words: The arguments.
        scope: The variables.
    """

    def __init__(self, words: Sequence[Word], scope: Scope) -> None:
        self._words = list(words)
        self._scope = scope

    def decide(self) -> Decision:
        """Return whether it is true on the target."""
        result = self._conjunction()
        while self._accept("OR"):
            result = _or(result, self._conjunction())
        return result

    def _conjunction(self) -> Decision:
        result = self._single()
        while self._accept("AND"):
            result = _not(_or(_not(result), _not(self._single())))
        return result

    def _single(self) -> Decision:
        if self._accept("NOT"):
            return _not(self._single())
        if self._accept("("):
            inner = self.decide()
            self._accept(")")
            return inner
        words: list[Word] = []
        while self._words and self._words[0].text not in {"AND", "OR", ")"}:
            words.append(self._words.pop(0))
        return _test(words, self._scope)

    def _accept(self, text: str) -> bool:
        if self._words[:1] == [Word(text, is_quoted=False)]:
            del self._words[0]
            return True
        return False


def _test(words: Sequence[Word], scope: Scope) -> Decision:
    match [word.text for word in words]:
        case ["DEFINED", variable] if variable in OF_DISTRIBUTION:
            return Decision(holds=True, is_specific=True)
        case [_]:
            return _truth_of(words[0], scope)
        case [name, operator, _] if operator.startswith("VERSION_"):
            return _version(name, operator.removeprefix("VERSION_"), words, scope)
        case [_, operator, _]:
            return _compared(words[0], operator, words[2], scope)
    return UNDECIDED


def _compared(first: Word, operator: str, second: Word, scope: Scope) -> Decision:
    left = _operand(first, scope)
    if operator == "IN_LIST":
        return _contained(left, scope.lookup(second.text))
    if operator == "MATCHES":
        return _matched(left, scope.expand(second.text))
    right = _operand(second, scope)
    if operator.startswith("STR"):
        return compare(operator.removeprefix("STR"), left, right)
    return _numeric(operator, left, right)


def _numeric(operator: str, left: Known, right: Known) -> Decision:
    values = [
        operand.value
        for operand in (left, right)
        if operand.value is not None and operand.value.isdigit()
    ]
    if len(values) < len((left, right)):
        return UNDECIDED
    longest = max(map(len, values))
    padded = [
        operand._replace(value=value.rjust(longest, "0"))
        for operand, value in zip((left, right), values, strict=True)
    ]
    return compare(operator, *padded)


def compare(operator: str, left: Known, right: Known) -> Decision:
    """Return the result of a comparison such as ``STRLESS``, given its suffix ``LESS``."""
    if left.value is None or right.value is None or operator not in _TEXTS:
        return UNDECIDED
    is_specific = left.is_specific or right.is_specific
    return Decision(_TEXTS[operator](left.value, right.value), is_specific)


def _operand(word: Word, scope: Scope) -> Known:
    """Return an operand of a comparison: the value of a variable, or the word itself."""
    value = UNKNOWN if word.is_quoted else scope.lookup(word.text)
    is_variable = not word.is_quoted and (scope.is_set(word.text) or value.value is not None)
    return value if is_variable else scope.expand(word.text)


def _truth_of(word: Word, scope: Scope) -> Decision:
    operand = _operand(word, scope)
    if operand.value is None or not operand.is_specific:
        return UNDECIDED
    value = operand.value.upper()
    if value in _FALSE or value.endswith("-NOTFOUND"):
        return Decision(holds=False, is_specific=True)
    return Decision(holds=True, is_specific=True) if value in _TRUE else UNDECIDED


def _contained(item: Known, listed: Known) -> Decision:
    if item.value is None or listed.value is None:
        return UNDECIDED
    return Decision(item.value in split_list(listed.value), item.is_specific or listed.is_specific)


def _matched(text: Known, pattern: Known) -> Decision:
    if text.value is None or pattern.value is None or "[:" in pattern.value:
        return UNDECIDED
    try:
        is_match = re.search(pattern.value, text.value) is not None
    except (re.error, RecursionError, OverflowError):
        return UNDECIDED
    return Decision(is_match, text.is_specific or pattern.is_specific)


def _version(left: str, operator: str, words: Sequence[Word], scope: Scope) -> Decision:
    """Return the result of a comparison with the version of a package released for ROS 2."""
    wanted = scope.expand(words[2].text).value
    name = left.removeprefix("${").removesuffix("}")
    package = name.removesuffix("_VERSION")
    if wanted is None or package == name or scope.is_set(name):
        return UNDECIDED
    released = target().fact("released").get(package)
    if released is None or not _VERSION.fullmatch(wanted) or operator not in _TEXTS:
        return UNDECIDED
    ours, theirs = _version_key(released), _version_key(wanted)
    if ours[:_FIXED_PARTS] == theirs[:_FIXED_PARTS]:
        return _between_releases(operator, theirs)
    if ours < theirs and target().name in ALIASES:  # which may be later than the known version
        return UNDECIDED
    order = (ours > theirs) - (ours < theirs)
    return Decision(_TEXTS[operator](chr(1 + order), chr(1)), is_specific=True)


def _between_releases(operator: str, wanted: tuple[int, ...]) -> Decision:
    """Return the result if it is the same for all releases with the same first numbers."""
    if any(wanted[_FIXED_PARTS:]) or operator not in {"LESS", "GREATER_EQUAL"}:
        return UNDECIDED
    return Decision(operator == "GREATER_EQUAL", is_specific=True)


def _version_key(version: str) -> tuple[int, ...]:
    numbers = [int(part) for part in version.split(".")]
    return (*numbers, *[0] * (4 - len(numbers)))


def _or(left: Decision, right: Decision) -> Decision:
    is_specific = left.is_specific or right.is_specific
    if left.holds or right.holds:
        return Decision(holds=True, is_specific=is_specific)
    is_open = left.holds is None or right.holds is None
    return Decision(None if is_open else False, is_specific)


def _not(decision: Decision) -> Decision:
    return decision._replace(holds=None if decision.holds is None else not decision.holds)
