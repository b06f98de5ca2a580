"""The files that `exclude` excludes, by patterns relative to the configuration."""

from __future__ import annotations

import os
from collections.abc import Iterator
from fnmatch import fnmatchcase
from typing import TYPE_CHECKING

from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from scaffold.files.disk import Disk


class Exclusion(NamedTuple):
    """Patterns, and the directory that they are relative to."""

    patterns: tuple[str, ...] = ()
    origin: str = ""
    """The file with the patterns."""

    def covers(self, disk: Disk, path: str) -> bool:
        """Return whether a path, or a directory above it, is excluded.

        Args:
            disk: Records accesses.
            path: The path as given by the user.
        """
        relative = self.relative(disk, path)
        return relative is not None and self.covers_relative(relative)

    def relative(self, disk: Disk, path: str) -> str | None:
        """Return a path relative to the directory of the configuration; ``None`` outside of it."""
        if not self.patterns:
            return None
        base = os.path.join(disk.real(os.path.dirname(self.origin)), "")
        real = disk.real(path)
        if os.path.join(real, "") == base:
            return ""
        return real[len(base) :] if real.startswith(base) else None

    def covers_relative(self, path: str) -> bool:
        """Tell the same of a path relative to the directory of the configuration."""
        return any(
            fnmatchcase(above, pattern) for above in _parents(path) for pattern in self._normal
        )

    @property
    def _normal(self) -> list[str]:
        return [pattern.removeprefix("./").rstrip("/") for pattern in self.patterns]


def _parents(path: str) -> Iterator[str]:
    while path:
        yield path
        path = path.rpartition("/")[0]
