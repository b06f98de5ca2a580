"""Values in the user's cache, each in a file named after its key."""

from __future__ import annotations

import marshal
import os
from typing import Any

from scaffold.files import cache

MAX_ENTRIES = 20_000


class ValueCache:
    """Values that marshal can serialize, by key.

    Args:
        kind: The directory in the cache.
        head: What the files start with; it changes with the form of the values.
    """

    def __init__(self, kind: str, head: bytes) -> None:
        self._directory = cache.directory(kind)
        self._head = head
        self._is_changed = False

    @property
    def is_enabled(self) -> bool:
        """Whether values are kept at all."""
        return self._directory is not None

    def get_value(self, key: str) -> Any:  # noqa: ANN401  what was put
        """Return the value stored under a key; ``None`` if there is none."""
        if self._directory is None:
            return None
        data = cache.read_sealed(os.path.join(self._directory, key), self._head)
        return None if data is None else marshal.loads(data)  # noqa: S302  own files

    def put_value(self, key: str, value: Any) -> None:  # noqa: ANN401  for marshal
        """Store a value."""
        if self._directory is not None:
            path = os.path.join(self._directory, key)
            self._is_changed |= cache.write_sealed(path, self._head, marshal.dumps(value))

    def trim(self) -> None:
        """Remove the oldest values if there are too many after those that were stored."""
        if self._directory is not None and self._is_changed:
            cache.trim(self._directory, MAX_ENTRIES)
