"""Directory trees as bytes: workers unpack them at the same relative paths."""

from __future__ import annotations

import io
import os
import tarfile
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from scaffold.files.disk import MAX_BYTES
from scaffold.files.tree import BUILD_DIRECTORIES, ENVIRONMENT, MANIFEST, SETUP_CFG
from scaffold.model.discovery.colcon import IGNORE_MARKERS

_GIT = ".git"
_NOT_ENTERED = frozenset({_GIT, ".hg", ".svn", "__pycache__"})
_LOOKED_AT = frozenset(
    {MANIFEST, SETUP_CFG, ".flake8", ".gitignore", ".gitmodules", "tox.ini", *IGNORE_MARKERS}
)
_LICENSES = ("LICENSE", "LICENCE", "COPYING")
_MARKER = "COLCON_IGNORE"
"""The marker file in build products of colcon."""


@dataclass(frozen=True)
class Mirror:
    """Packed directories."""

    archive: bytes
    """A tar archive of files, symlinks and directories, by path without the leading slash."""
    sizes: Mapping[str, int]
    """The sizes of files that are too large to be read, whose content is not sent."""
    indexes: Mapping[str, bytes]
    """The git index of each checkout, by the top of the checkout."""


class Packer:
    """Packs directories and files, each only once."""

    def __init__(self) -> None:
        self._out = io.BytesIO()
        self._archive = tarfile.open(  # noqa: SIM115  closed by mirror()
            fileobj=self._out, mode="w:gz", compresslevel=1
        )
        self._packed: set[str] = set()
        self._sizes: dict[str, int] = {}
        self._indexes: dict[str, bytes] = {}

    def mirror(self) -> Mirror:
        """Return the packed directories."""
        self._archive.close()
        return Mirror(self._out.getvalue(), self._sizes, self._indexes)

    def add_tree(self, directory: str) -> None:
        """Pack a directory, without version control data and build products.

        Raises:
            OSError: it cannot be read.
        """
        self.add(directory)
        for parent, directories, files in os.walk(os.path.realpath(directory)):
            if ENVIRONMENT in files:
                directories.clear()
                files = [ENVIRONMENT]  # noqa: PLW2901  nothing else of it is looked at
            self._add_checkout(parent)
            for name in (*directories, *files):
                if name != _GIT:
                    self.add(os.path.join(parent, name))
            directories[:] = [name for name in directories if self._is_entered(parent, name)]

    def _is_entered(self, parent: str, name: str) -> bool:
        if name in _NOT_ENTERED:
            return False
        marker = os.path.join(parent, name, _MARKER)
        if name not in BUILD_DIRECTORIES or not os.path.exists(marker):
            return True
        self.add(marker)
        return False

    def add_above(self, path: str) -> None:
        """Pack the files in the directories above a path that `check` reads.

        Raises:
            OSError: it cannot be read.
        """
        for directory in _parents(os.path.realpath(path)):
            self._add_checkout(directory)
            for name in os.listdir(directory):
                if name in _LOOKED_AT or name.upper().startswith(_LICENSES):
                    self.add(os.path.join(directory, name))

    def add(self, path: str) -> None:
        """Pack a file, a symlink or an empty directory, and the symlinks in its path.

        Raises:
            OSError: it cannot be read.
        """
        path = os.path.abspath(path)
        for way in _parents(path):
            if os.path.islink(way):
                self._add_link(way)
        real = os.path.join(os.path.realpath(os.path.dirname(path)), os.path.basename(path))
        if os.path.islink(real):
            self._add_link(real)
        elif os.path.isdir(real):
            self._add(real, tarfile.DIRTYPE)
        elif os.path.isfile(real):
            self._add_file(real)

    def _add_link(self, path: str) -> None:
        """Pack a symlink and its target: a file with its content, a directory without."""
        target = os.path.join(os.path.dirname(path), os.readlink(path))
        way = os.path.relpath(target, os.path.dirname(path))
        if self._add(path, tarfile.SYMTYPE, link=way):
            self.add(os.path.normpath(target))

    def _add_file(self, path: str) -> None:
        size = os.path.getsize(path)
        if size > MAX_BYTES:
            self._sizes[path[1:]] = size
            return
        try:
            with open(path, "rb") as file:
                self._add(path, tarfile.REGTYPE, file.read())
        except PermissionError:
            self._add(path, tarfile.REGTYPE, mode=0)

    def _add(
        self, path: str, kind: bytes, data: bytes = b"", *, link: str = "", mode: int | None = None
    ) -> bool:
        """Pack an entry; return whether it was not packed before."""
        if path in self._packed or path == os.sep:
            return False
        self._packed.add(path)
        entry = tarfile.TarInfo(path[1:])
        entry.type, entry.linkname, entry.size = kind, link, len(data)
        is_own = mode is None and kind != tarfile.SYMTYPE
        entry.mode = os.stat(path).st_mode & 0o755 if is_own else mode or 0o755
        self._archive.addfile(entry, io.BytesIO(data))
        return True

    def _add_checkout(self, top: str) -> None:
        place = os.path.join(top, _GIT)
        if not os.path.exists(place):
            return
        if os.path.isfile(place):  # of a submodule or another worktree
            with open(place, encoding="utf-8", errors="surrogateescape") as file:
                place = os.path.join(top, file.read().partition("gitdir:")[2].strip())
        try:
            with open(os.path.join(place, "index"), "rb") as index:
                self._indexes[top[1:]] = index.read()
        except OSError:
            self._indexes[top[1:]] = b""


def unpack(mirror: Mirror, directory: str) -> None:
    """Unpack into an existing directory.

    Raises:
        OSError: it cannot be written.
    """
    with tarfile.open(fileobj=io.BytesIO(mirror.archive), mode="r:gz") as archive:
        # Only this tool packs archives, and their sender may run code here anyway.
        archive.extractall(directory, filter="tar")
    for path, size in mirror.sizes.items():
        place = os.path.join(directory, path)
        os.makedirs(os.path.dirname(place), exist_ok=True)
        with open(place, "wb") as file:
            file.truncate(size)
    for top, index in mirror.indexes.items():
        _write_checkout(os.path.join(directory, top, _GIT), index)


def _write_checkout(place: str, index: bytes) -> None:
    """Write the parts of a checkout that git needs to list tracked files."""
    for name in ("objects", "refs"):
        os.makedirs(os.path.join(place, name))
    for name, data in (("HEAD", b"ref: refs/heads/main\n"), ("index", index)):
        if data:
            with open(os.path.join(place, name), "wb") as file:
                file.write(data)


def _parents(path: str) -> Iterator[str]:
    """Yield the parent directories of a path, from the root."""
    parts = path.split(os.sep)
    for depth in range(2, len(parts)):
        yield os.sep.join(parts[:depth])
