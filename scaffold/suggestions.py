"""Suggests known names that are similar to a misspelled one."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable
from itertools import pairwise
from typing import Protocol, TypeVar

MOST_COMPARED = 50_000
"""The maximum number of compared pairs per package; one takes some microseconds."""
LONGEST = 200
"""Limit on the length of a word to compare; the time grows with its square."""
MOST_LISTED = 5
"""The maximum number of names listed in a message."""
MOST_ORDERED = 100
"""The maximum number of names from which the closest are listed."""
CANDIDATES = 3
"""The number of closest names that are compared in lower case."""
View = TypeVar("View")


class Memory(Protocol):
    """What keeps values as long as it is unchanged: a package, or a file of it."""

    def remember(self, key: object, build: Callable[[], View]) -> View:
        """Return the result of ``build``, which is called once per key."""


class _Budget:
    def __init__(self) -> None:
        self.left = MOST_COMPARED


def closest_name(package: Memory, word: str, names: Collection[str], cutoff: float) -> str:
    """Return the name closest to a word.

    Args:
        package: The package with the word.
        word: The word.
        names: The names.
        cutoff: The required similarity, from 0 to 1.

    Returns:
        The name; empty if none is similar enough, or if the comparisons for this package are
        used up, which bounds the time.
    """
    from difflib import SequenceMatcher, get_close_matches

    budget = package.remember("comparisons", _Budget)
    budget.left -= len(names)
    if budget.left < 0 or len(word) > LONGEST:
        return ""
    if f"{word}_" in names:  # as the word itself is a Python keyword
        return f"{word}_"
    matches = get_close_matches(word, names, CANDIDATES, cutoff)
    if len(matches) <= 1:
        return "".join(matches)
    return max(matches, key=lambda name: SequenceMatcher(None, word.lower(), name.lower()).ratio())


def listed_names(names: Iterable[str], word: str, none: str = "none") -> str:
    """Return the end of a message that lists known names, only the closest if there are many.

    Args:
        names: The names.
        word: The unknown name.
        none: The result without any names.

    Returns:
        The names in order, such as ``a, b, c``; the closest ones and ``and 7 more`` if there are
        more than fit.
    """
    ordered = sorted(set(names))
    if len(ordered) <= MOST_LISTED:
        return ", ".join(ordered) or none
    if len(ordered) <= MOST_ORDERED:
        pairs = _pairs(word)
        ordered.sort(key=lambda name: -len(_pairs(name) & pairs))
    return f"{', '.join(ordered[:MOST_LISTED])} and {len(ordered) - MOST_LISTED} more"


def _pairs(word: str) -> set[tuple[str, str]]:
    """Return the pairs of adjacent letters of a word, which similar words share."""
    return {*pairwise(word[:LONGEST])}
