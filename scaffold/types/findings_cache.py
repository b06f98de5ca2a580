"""A cache of type checker reports, keyed by a file and everything it imports."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from scaffold.files.disk import digest
from scaffold.files.values import ValueCache
from scaffold.record import NamedTuple
from scaffold.types.sources import Source
from scaffold.types.ty import TyDiagnostic

KIND = "types"
_MAGIC = b"scaffold-types-10\n"
"""Changes with the format of the reports; see ``types.check``."""


class Reported(NamedTuple):
    """The reports about a file."""

    diagnostics: Sequence[TyDiagnostic]
    is_confirmed: bool
    """Whether they also appear without the annotations of the user's code."""


class ReportCache(ValueCache):
    """The reports about files, and other values about them.

    Args:
        depends_on: Further dependencies besides the files: the type checker and the stubs.
    """

    def __init__(self, depends_on: str) -> None:
        super().__init__(KIND, _MAGIC)
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
        stored = self.get_value(key)
        return stored and Reported([TyDiagnostic(*item) for item in stored[0]], stored[1])

    def put(self, key: str, reported: Reported) -> None:
        """Store reports."""
        self.put_value(key, ([*map(tuple, reported.diagnostics)], reported.is_confirmed))
