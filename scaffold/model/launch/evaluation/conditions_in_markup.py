"""Evaluates substitutions in the attributes of launch files in XML and YAML."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from scaffold.model.launch.evaluation.conditions import UNKNOWN, Text, applied, joined, truth

_MAX_DEPTH = 20
"""The maximum depth of nested substitutions and variables."""


class Variables:
    """The values of ``$(var name)``.

    Args:
        given: The values in ``<let>`` and ``<arg>`` of the file.
    """

    def __init__(self, given: Mapping[str, Sequence[str]]) -> None:
        self._given = given

    def decide(self, condition: str) -> bool | None:
        """Return whether an ``if`` is true on the target; ``None`` if that is open."""
        return truth(self.text(condition))

    def text(self, value: str, depth: int = 0) -> Text:
        """Return an attribute with its substitutions replaced."""
        if depth > _MAX_DEPTH:
            return UNKNOWN
        return joined(self._parts(value, depth))

    def _parts(self, value: str, depth: int) -> Iterator[Text]:
        at = 0
        while (start := value.find("$(", at)) >= 0:
            end = _closing(value, start + 2)
            if end < 0:
                yield UNKNOWN
                return
            yield Text(value[at:start])
            name, *operands = [*_words(value[start + 2 : end])] or [""]
            if name == "var" and operands:
                yield self._variable(operands[0], depth)
            else:
                yield applied(name, [self.text(operand, depth + 1) for operand in operands])
            at = end + 1
        yield Text(value[at:])

    def _variable(self, name: str, depth: int) -> Text:
        """Return the value of a variable that depends on the distribution; others may be set."""
        values = self._given.get(name, ())
        text = self.text(values[0], depth + 1) if len(values) == 1 else UNKNOWN
        return text if text.is_specific else UNKNOWN


def substitution_words(value: str) -> Iterator[list[str]]:
    """Yield the words of each substitution of an attribute, those in others left out."""
    at = 0
    while (start := value.find("$(", at)) >= 0:
        at = _closing(value, start + 2)
        if at < 0:
            return
        yield [*_words(value[start + 2 : at])]


def _closing(value: str, at: int) -> int:
    """Return the end of a substitution whose text starts at an offset; -1 if unterminated."""
    quotes = [""]
    while at < len(value):
        letter = value[at]
        if letter == "\\":
            at += 1
        elif value.startswith("$(", at):
            quotes.append("")
            at += 1
        elif quotes[-1]:
            quotes[-1] = "" if letter == quotes[-1] else quotes[-1]
        elif letter in "\"'":
            quotes[-1] = letter
        elif letter == ")":
            quotes.pop()
            if not quotes:
                return at
        at += 1
    return -1


def _words(value: str) -> Iterator[str]:
    """Yield the name and the arguments of a substitution, without their quotes."""
    word, quote = "", ""
    at = 0
    while at < len(value):
        letter = value[at]
        if letter == "\\" and at + 1 < len(value):
            word += value[at + 1]
            at += 1
        elif value.startswith("$(", at):
            end = _closing(value, at + 2)
            word += value[at : end + 1]
            at = end
        elif letter == quote or (not quote and letter in "\"'"):
            quote = "" if quote else letter
        elif quote or not letter.isspace():
            word += letter
        elif word:
            yield word
            word = ""
        at += 1
    if word:
        yield word
