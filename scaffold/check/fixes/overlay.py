"""A file tree with in-memory changes on top of the files of a package."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from contextlib import suppress
from typing import Protocol

from scaffold.files.disk import MAX_BYTES
from scaffold.files.tree import Tree, within

MOST_KEPT = 2_000_000
"""The size in bytes up to which the content of a file is kept in memory."""


class Changes(Protocol):
    """The differences from the files below."""

    @property
    def changed(self) -> Mapping[str, bytes]:
        """New content by path."""

    @property
    def removed(self) -> Collection[str]:
        """The paths of removed files."""

    @property
    def executable(self) -> Collection[str]:
        """The files to make executable."""


class Overlay:
    """A tree with changes on top of another one, in memory.

    A file below the changes has its content of the first read, even if it changes meanwhile.
    A change of a symlink is a change of its target.
    """

    def __init__(self, base: Tree) -> None:
        self.base = base
        """The tree below the changes."""
        self.place: str | None = getattr(base, "root", None)
        """The directory of the tree below, if it is on disk."""
        self.changed: dict[str, bytes] = {}
        self.removed: set[str] = set()
        self.executable: set[str] = set()
        self.rounds: Counter[str] = Counter()
        """The number of rounds that edited each file."""
        self._read: dict[str, bytes] = {}
        self._real: dict[str, str | None] = {}

    @classmethod
    def of(cls, base: Tree, changes: Changes) -> Overlay:
        """Return an overlay with existing changes of a tree."""
        result = cls(base)
        result.changed.update(changes.changed)
        result.removed.update(changes.removed)
        result.executable.update(changes.executable)
        return result

    @property
    def files(self) -> tuple[str, ...]:
        """The paths of all files."""
        return tuple(sorted({*self.base.files, *self.changed} - self.removed))

    @property
    def directories(self) -> frozenset[str]:
        """The paths of all directories."""
        parents = {path[:at] for path in self.changed for at in _slashes(path)}
        return frozenset({*self.base.directories, *parents})

    @property
    def nested(self) -> tuple[str, ...]:
        """The directories of nested packages."""
        return tuple(self.base.nested)

    @property
    def broken_links(self) -> Sequence[str]:
        """The dangling symlinks."""
        return tuple(getattr(self.base, "broken_links", ()))

    def read(self, path: str, most: int = MAX_BYTES) -> bytes:
        """Return the content of a file with a size limit; raises OSError."""
        if path in self.removed:
            raise FileNotFoundError(path)
        if self.changed and path not in self.changed:
            path = self.real(path) or path
        if path in self.changed:
            return within(most, path, self.changed[path])
        return self.before(path, most)

    def before(self, path: str, most: int = MAX_BYTES) -> bytes:
        """Return the content of a file below the changes; see `read`."""
        if path in self._read:
            return within(most, path, self._read[path])
        data = self.base.read(path, most)
        if len(data) <= MOST_KEPT:
            self._read[path] = data
        return data

    def is_executable(self, path: str) -> bool:
        """Return whether the file has or will have an executable bit."""
        return path in self.executable or self.base.is_executable(path)

    def real(self, path: str) -> str | None:
        """Return the real path of a file, ``None`` outside of the root."""
        if self.place is None:
            return path
        if path not in self._real:
            root = os.path.realpath(self.place)
            target = os.path.realpath(os.path.join(root, path))
            is_inside = target.startswith(os.path.join(root, ""))
            self._real[path] = os.path.relpath(target, root) if is_inside else None
        return self._real[path]

    @property
    def differing(self) -> Mapping[str, bytes]:
        """The changed files that are new or differ from those below."""
        return {path: data for path, data in self.changed.items() if [*self.had(path)] != [data]}

    def had(self, path: str) -> Iterator[bytes]:
        """Yield the content of a file before the changes, if it existed."""
        with suppress(OSError):
            yield self.before(path)

    def edited_since(self, before: Overlay) -> list[str] | None:
        """Return the files with changed content, ``None`` if there is any other difference."""
        if (self.files, self.executable) != (before.files, before.executable):
            return None
        changed = {*self.changed, *before.changed}
        same = (self.real(path) in changed or path in changed for path in self.files)
        candidates = [path for path, is_one in zip(self.files, same, strict=True) if is_one]
        return [path for path in candidates if [*self._current(path)] != [*before._current(path)]]

    def _current(self, path: str) -> Iterator[bytes]:
        with suppress(OSError):
            yield self.read(path)

    def copy(self) -> Overlay:
        """Return an independent copy."""
        twin = Overlay(self.base)
        twin.changed, twin.removed = dict(self.changed), set(self.removed)
        twin.executable, twin.rounds = set(self.executable), self.rounds.copy()
        twin._read, twin._real = self._read, self._real
        return twin


def _slashes(path: str) -> list[int]:
    return [at for at, character in enumerate(path) if character == "/"]
