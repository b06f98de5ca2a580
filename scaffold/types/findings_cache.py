"""A cache of type checker reports, keyed by a file and everything it imports."""

from __future__ import annotations

import marshal
import os
from collections.abc import Mapping, Sequence
from typing import Any

from scaffold.files import cache
from scaffold.files.disk import digest
from scaffold.record import NamedTuple
from scaffold.types.sources import Source
from scaffold.types.ty import TyDiagnostic

KIND = "types"
MOST = 20_000
_MAGIC = b"scaffold-types-10\n"
"""Changes with the format of the reports; see ``types.check``."""


class Reported(NamedTuple):
    """The reports about a file."""

    diagnostics: Sequence[TyDiagnostic]
    is_confirmed: bool
    """Whether they also appear without the annotations of the user's code."""


class Cache:
    """A directory of reports.

    Args:
        depends_on: Further dependencies besides the files: the type checker and the stubs.
    """

    def __init__(self, depends_on: str) -> None:
        self._directory = cache.directory(KIND)
        self._salt = depends_on

    def key(self, source: Source, reached: Mapping[str, Source], about: str = "") -> str:
        """Return the key of an entry about a file.

        Args:
            source: The file.
            reached: The files that it depends on, by place.
            about: The kind of entry, if it is not the reports.
        """
        parts = [f"{place} {reached[place].digest}" for place in sorted(reached)]
        head = f"{self._salt} {about}"
        return digest("\n".join([head, source.place, *parts]).encode("utf-8", "replace"))

    def get(self, key: str) -> Reported | None:
        """Return the reports under a key."""
        stored = self.get_plain(key)
        return stored and Reported([TyDiagnostic(*item) for item in stored[0]], stored[1])

    def put(self, key: str, reported: Reported) -> None:
        """Store reports."""
        self.put_plain(key, ([*map(tuple, reported.diagnostics)], reported.is_confirmed))

    def get_plain(self, key: str) -> Any:  # noqa: ANN401  what was put
        """Return another value that was stored under a key; ``None`` if there is none."""
        if self._directory is None:
            return None
        data = cache.read_sealed(os.path.join(self._directory, key), _MAGIC)
        return None if data is None else marshal.loads(data)  # noqa: S302  own files

    def put_plain(self, key: str, value: Any) -> None:  # noqa: ANN401  for marshal
        """Store a value that marshal can serialize."""
        if self._directory is not None:
            data = marshal.dumps(value)
            cache.write_sealed(os.path.join(self._directory, key), _MAGIC, data)

    def trim(self) -> None:
        """Remove the oldest entries if there are too many."""
        if self._directory is not None:
            cache.trim(self._directory, MOST)
