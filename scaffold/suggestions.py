"""Which known name a word is nearly: for hints, where input may hold thousands of both."""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from scaffold.model.package import Package

MOST_COMPARED = 50_000
"""Pairs of words in one package; a comparison takes some microseconds."""
LONGEST = 200
"""Limit on the length of a word to compare; the time grows with its square."""


class _Budget:
    def __init__(self) -> None:
        self.left = MOST_COMPARED


def closest_name(package: Package, word: str, known: Collection[str], cutoff: float) -> str:
    """Return the known name that looks most like a word.

    Args:
        package: What the word is found in.
        word: The word.
        known: The names.
        cutoff: How similar they must be, from 0 to 1.

    Returns:
        The name; empty if none is similar enough, or if the comparisons for this package are
        used up, which bounds the time.
    """
    from difflib import get_close_matches

    budget = package.remember("comparisons", _Budget)
    budget.left -= len(known)
    if budget.left < 0 or len(word) > LONGEST:
        return ""
    return next(iter(get_close_matches(word, known, 1, cutoff)), "")
