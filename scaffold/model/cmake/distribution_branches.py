"""Branches of CMakeLists.txt that are for other distributions: they ask for ROS_DISTRO."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from scaffold.distributions import VARIABLE, target
from scaffold.model.cmake.lists import CMakeLists
from scaffold.model.cmake.parser import Command

_VALUE = frozenset({f"$ENV{{{VARIABLE}}}", f"${{{VARIABLE}}}", VARIABLE})
"""How a condition names the distribution; the last two are common copies of the variable."""
_DEFINED = f"ENV{{{VARIABLE}}}"
_OPENING = frozenset({"if", "elseif", "else"})

Lines = tuple[int, int]


def lines_not_run(lists: CMakeLists) -> Iterator[Lines]:
    """Yield the first and last lines of what does not run on the target distribution."""
    opened: list[_Chain] = []
    for command in lists.commands:
        if command.name in _OPENING or command.name == "endif":
            line = lists.source.location(command.start, command.start).line
            if command.name == "if":
                opened.append(_Chain())
            elif opened and opened[-1].is_dead:
                yield opened[-1].line + 1, line - 1
            if command.name == "endif":
                if opened:
                    opened.pop()
            elif opened:
                opened[-1].enter(command, line)


class _Chain:
    """An ``if`` with what follows it, up to the branch that is read."""

    def __init__(self) -> None:
        self.line = 0
        self.is_dead = False
        self._is_decided = False

    def enter(self, command: Command, line: int) -> None:
        """Read the condition of a branch."""
        self.line = line
        holds = command.name == "else" or _Condition(command.values).holds()
        self.is_dead = self._is_decided or holds is False
        self._is_decided = self._is_decided or (holds is True and command.name != "else")


class _Condition:
    """The condition of an ``if``; what is not about the distribution is not known."""

    def __init__(self, words: Sequence[str]) -> None:
        self._words = list(words)

    def holds(self) -> bool | None:
        """Return whether it is true on the target; ``None`` if that is not known."""
        result = self._all()
        while self._take("OR"):
            result = _either(result, self._all())
        return result

    def _all(self) -> bool | None:
        result = self._single()
        while self._take("AND"):
            result = _not(_either(_not(result), _not(self._single())))
        return result

    def _single(self) -> bool | None:
        if self._take("NOT"):
            return _not(self._single())
        if self._take("("):
            inner = self.holds()
            self._take(")")
            return inner
        words: list[str] = []
        while self._words and self._words[0] not in {"AND", "OR", ")"}:
            words.append(self._words.pop(0))
        return _compared(words)

    def _take(self, word: str) -> bool:
        if self._words[:1] == [word]:
            del self._words[0]
            return True
        return False


def _compared(words: Sequence[str]) -> bool | None:
    name = target().name
    match words:
        case ["DEFINED", variable] if variable == _DEFINED:
            return True
        case [left, "STREQUAL", right] if left in _VALUE:
            return right == name
        case [left, "STREQUAL", right] if right in _VALUE:
            return left == name
        case [left, "MATCHES", pattern] if left in _VALUE:
            try:
                return re.search(pattern, name) is not None
            except re.error:
                return None
    return None


def _either(left: bool | None, right: bool | None) -> bool | None:  # noqa: FBT001  three values
    if left or right:
        return True
    return None if left is None or right is None else False


def _not(value: bool | None) -> bool | None:  # noqa: FBT001  three values
    return None if value is None else not value
