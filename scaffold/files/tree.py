"""The files of a package, on disk or in memory."""

from __future__ import annotations

import os
from collections.abc import Collection, Mapping, Sequence
from functools import cached_property
from typing import Protocol

from scaffold.files.disk import MAX_BYTES, Disk, LargeFileError

CMAKE_LISTS = "CMakeLists.txt"
SETUP_PY = "setup.py"
SETUP_CFG = "setup.cfg"
BUILD_DIRECTORIES = frozenset({"build", "install", "log"})
MANIFEST = "package.xml"
ENVIRONMENT = "pyvenv.cfg"
"""The file at the top of a virtual environment: its content is installed and not a source."""


def within(most: int, path: str, data: bytes) -> bytes:
    """Return the content of a file in memory, with the size limit of those on disk.

    Raises:
        LargeFileError: it is too large.
    """
    if len(data) > most:
        raise LargeFileError(path, len(data), most)
    return data


class Tree(Protocol):
    """Files by path relative to the root, with ``/`` as separator, in sorted order."""

    @property
    def files(self) -> Sequence[str]:
        """The paths of all files."""

    @property
    def directories(self) -> Collection[str]:
        """The paths of all directories below the root."""

    @property
    def nested(self) -> Sequence[str]:
        """The directories of nested packages, whose files are skipped."""

    def read(self, path: str, most: int = MAX_BYTES) -> bytes:
        """Return the content of a file with a size limit; raises OSError."""

    def is_executable(self, path: str) -> bool:
        """Return whether the file has an executable bit."""


class DiskTree:
    """A directory; it is listed once, on first use."""

    def __init__(self, root: str | os.PathLike[str], disk: Disk | None = None) -> None:
        self.root = os.fspath(root)
        self.disk = disk or Disk()
        self._nested: list[str] = []
        self._broken: list[str] = []
        self._environments: list[str] = []

    @cached_property
    def _listing(self) -> tuple[tuple[str, ...], frozenset[str]]:
        files: list[str] = []
        directories: list[str] = []
        pending = [""]
        while pending:
            parent = pending.pop()
            names, children, broken = self.disk.names(os.path.join(self.root, parent))
            if parent and MANIFEST in names:
                self._nested.append(parent.rstrip("/"))
                continue
            if parent and ENVIRONMENT in names:
                self._environments.append(parent.rstrip("/"))
                continue
            files.extend(parent + name for name in names)
            self._broken.extend(parent + name for name in broken)
            for name in children:
                path = parent + name
                if self._is_skipped(path, name):
                    continue
                directories.append(path)
                pending.append(path + "/")
        return tuple(sorted(files)), frozenset(directories)

    @property
    def files(self) -> Sequence[str]:
        """The paths of all files; links to directories are not followed."""
        return self._listing[0]

    @property
    def directories(self) -> Collection[str]:
        """The paths of all directories below the root."""
        return self._listing[1]

    @property
    def nested(self) -> Sequence[str]:
        """The directories of nested packages."""
        return sorted(self._nested) if self._listing else ()

    @property
    def environments(self) -> Sequence[str]:
        """The directories of virtual environments, whose files are skipped."""
        return sorted(self._environments) if self._listing else ()

    @property
    def broken_links(self) -> Sequence[str]:
        """The dangling symlinks, which are not among the files."""
        return sorted(self._broken) if self._listing else ()

    def forget(self) -> None:
        """Drop the listing."""
        self.__dict__.pop("_listing", None)
        self._nested.clear()
        self._environments.clear()
        self._broken.clear()

    def read(self, path: str, most: int = MAX_BYTES) -> bytes:
        """Return the content of a file with a size limit; raises OSError."""
        return self.disk.read(os.path.join(self.root, path), most)

    def digest_read(self, path: str) -> str | None:
        """Return the digest of a file when it was first read; empty if it did not exist.

        ``None`` if that is not determined yet.
        """
        question = ("content", os.path.join(self.root, path))
        if question in self.disk.seen:
            return str(self.disk.seen[question] or "")
        is_listed = "_listing" in self.__dict__ and self._is_covered(path)
        return "" if is_listed and path not in self._listing[0] else None

    def _is_covered(self, path: str) -> bool:
        """Return whether a file would be in the listing if it existed."""
        *above, _ = path.split("/")
        for depth, name in enumerate(above, 1):
            parent = "/".join(above[:depth])
            if parent not in self.directories:
                is_skipped = self._is_skipped(parent, name)
                own = os.path.join(self.disk.real(self.root), parent)
                is_link = self.disk.real(own) != own
                return not (is_skipped or parent in self.nested or is_link)
        return True

    def is_executable(self, path: str) -> bool:
        """Return whether the file has an executable bit."""
        return self.disk.is_executable(os.path.join(self.root, path))

    def _is_skipped(self, path: str, name: str) -> bool:
        if name.startswith(".") or name == "__pycache__" or name.endswith(".egg-info"):
            return True
        if name in BUILD_DIRECTORIES:
            # Build products of colcon have its marker; other directories of that name do not.
            return self.disk.exists(os.path.join(self.root, path, "COLCON_IGNORE"))
        return False


class MemoryTree:
    """Files in memory: those of an example, or generated but not yet written.

    A path that ends in ``/`` is an empty directory.
    """

    def __init__(self, files: Mapping[str, str | bytes], executable: Collection[str] = ()) -> None:
        self._files = {
            path: text.encode() if isinstance(text, str) else text
            for path, text in files.items()
            if not path.endswith("/")
        }
        self._executable = frozenset(executable)
        self._empty = [path.rstrip("/") for path in files if path.endswith("/")]

    @cached_property
    def nested(self) -> Sequence[str]:
        """The directories of nested packages."""
        ending = "/" + MANIFEST
        return sorted(path[: -len(ending)] for path in self._files if path.endswith(ending))

    @cached_property
    def files(self) -> Sequence[str]:
        """The paths of all files."""
        nested = tuple(path + "/" for path in self.nested)
        return tuple(sorted(path for path in self._files if not path.startswith(nested)))

    @cached_property
    def directories(self) -> Collection[str]:
        """The paths of all directories below the root."""
        directories = set(self._empty)
        for path in [*self.files, *self._empty]:
            parts = path.split("/")
            directories.update("/".join(parts[:depth]) for depth in range(1, len(parts)))
        return frozenset(directories)

    def read(self, path: str, most: int = MAX_BYTES) -> bytes:
        """Return the content of a file with a size limit; raises OSError."""
        try:
            return within(most, path, self._files[path])
        except KeyError:
            raise FileNotFoundError(path) from None

    def is_executable(self, path: str) -> bool:
        """Return whether the file has an executable bit."""
        return path in self._executable
