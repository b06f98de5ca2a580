"""What the commands ``string`` and ``list`` of CMake return."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence

from scaffold import lazy_re

_SIMPLE = lazy_re.compile(r"\^?(?:[\w/ -]|\\[.+*$^]|\.|\[[\w-]+\])*(?:[*+](?:[\w/-]|\\\.)*)?\$?")
"""Matches a regular expression with at most one repetition, which is the same for Python."""
_LONGEST_PATTERN = 200
_PARENTS = ("/package", "/home/user/workspace/src/package")
"""Directories in which a package may be."""

_OF_TEXT: Mapping[str, Callable[[str], str]] = {
    "TOLOWER": str.lower,
    "TOUPPER": str.upper,
    "STRIP": str.strip,
}
_OF_LIST: Mapping[str, Callable[[Sequence[str]], Sequence[str]]] = {
    "REMOVE_DUPLICATES": lambda items: [*dict.fromkeys(items)],
    "REVERSE": lambda items: items[::-1],
    "SORT": sorted,
}
CHANGING = frozenset({*_OF_LIST, "FILTER", "REMOVE_ITEM"})
"""The actions of ``list`` that change a list and are known."""


def place_of_output(values: Sequence[str]) -> int:
    """Return the place of the variable that ``string`` writes to; 0 if it is not known."""
    places = {"REPLACE": 3, "CONCAT": 1, **dict.fromkeys(_OF_TEXT, 2)}
    place = 4 if list(values[:2]) == ["REGEX", "REPLACE"] else places.get("".join(values[:1]), 0)
    return place if place < len(values) else 0


def text_of(given: Sequence[str]) -> str | None:
    """Return the result of ``string`` with some arguments; ``None`` if unknown."""
    match given:
        case ["REPLACE", old, new, _, *texts] if old:
            return "".join(texts).replace(old, new)
        case ["REGEX", "REPLACE", pattern, new, _, *texts] if "\\" not in new:
            found = _compiled(pattern)
            return None if found is None else found.sub(new, "".join(texts))
        case ["CONCAT", _, *texts]:
            return "".join(texts)
        case [action, text, _] if action in _OF_TEXT:
            return _OF_TEXT[action](text)
    return None


def changed(items: Sequence[str], action: str, words: Sequence[str], root: str) -> str | None:
    """Return a list after an action of ``list``; ``None`` if unknown.

    Args:
        items: The list.
        action: The action, such as ``FILTER``.
        words: What follows the name of the list.
        root: What stands for the directory of the package in items.
    """
    result: Sequence[str] | None = None
    match action, words:
        case "REMOVE_ITEM", _:
            result = [item for item in items if item not in words]
        case "FILTER", ["INCLUDE" | "EXCLUDE" as mode, "REGEX", pattern]:
            kinds = [_matches(pattern, item, root) for item in items]
            is_kept = mode == "INCLUDE"
            kept = [item for item, kind in zip(items, kinds, strict=True) if kind is is_kept]
            result = None if None in kinds else kept
        case _, []:
            result = _OF_LIST[action](items) if action in _OF_LIST else None
    return None if result is None else ";".join(result)


def _matches(pattern: str, item: str, root: str) -> bool | None:
    """Return whether a pattern matches an item, wherever the package is."""
    found = _compiled(pattern)
    if found is None:
        return None
    kinds = {found.search(item.replace(root, parent)) is not None for parent in _PARENTS}
    return kinds.pop() if len(kinds) == 1 else None


def _compiled(pattern: str) -> re.Pattern[str] | None:
    """Return a regular expression of CMake as one of Python, if it is simple enough."""
    is_simple = len(pattern) <= _LONGEST_PATTERN and _SIMPLE.fullmatch(pattern) is not None
    return re.compile(pattern) if is_simple else None
