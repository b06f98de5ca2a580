"""Records the values of selected message fields."""

from __future__ import annotations

import math
from typing import Any

from .building import field_of
from .messages import plain

Ros = Any
"""Objects of rclpy, which are untyped."""


class Field:
    """One field of the messages of a topic.

    Args:
        path: Such as ``header.frame_id``.
    """

    def __init__(self, path: str) -> None:
        self._path = path
        self._count = 0
        self._changes = 0
        self._first: object = None
        self._last: object = None
        self._least: float | None = None
        self._greatest: float | None = None
        self._error = ""
        self._is_finite = True

    def take(self, message: Ros) -> None:
        """Record the value in a message."""
        try:
            value = field_of(message, self._path)
        except ValueError as error:
            self._error = str(error)
            return
        shown = plain(value)
        if self._count and shown != self._last:
            self._changes += 1
        if not self._count:
            self._first = shown
        self._last = shown
        self._count += 1
        if isinstance(value, float) and not math.isfinite(value):
            self._is_finite = False
        elif isinstance(value, (int, float)) and not isinstance(value, bool):
            self._least = value if self._least is None else min(self._least, value)
            self._greatest = value if self._greatest is None else max(self._greatest, value)

    def as_data(self) -> dict[str, object]:
        """Return the data for the report."""
        return {
            "count": self._count,
            "changes": self._changes,
            "first": self._first,
            "last": self._last,
            "least": self._least if self._is_finite else None,
            "greatest": self._greatest if self._is_finite else None,
            "error": self._error,
        }
