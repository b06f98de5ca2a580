"""Finds conflict markers of git in a file."""

from __future__ import annotations

from collections.abc import Iterable

_MARKS = ("<<<<<<<", "=======", ">>>>>>>")
"""The markers in the order of git, each at the start of a line."""


def first_conflict(lines: Iterable[str]) -> int:
    """Return the line, from 1, on which the first conflict starts; 0 without one."""
    start, expected = 0, 0
    for number, line in enumerate(lines, 1):
        if line.startswith(_MARKS[0]):
            start, expected = number, 1
        elif expected and line.startswith(_MARKS[expected]):
            expected += 1
            if expected == len(_MARKS):
                return start
    return 0
