"""Exports the files of a git commit, and lists the files that differ from it.

Only git objects are read. Filters, text conversions and transports in `.git/config` and
`.gitattributes` are programs: they are never started, and nothing in the exported tree is executed.
"""

from __future__ import annotations

import hashlib
import os
import subprocess
from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property

from scaffold.errors import InputError
from scaffold.files.disk import MAX_BYTES, read_file
from scaffold.programs import git
from scaffold.record import NamedTuple

_LINK = "120000"
_EXECUTABLE = "100755"
_CHUNK = 50_000_000
"""The size of a chunk in bytes."""
_WORDS = 3
"""The header of each object: name, kind and size."""


class _Blob(NamedTuple):
    mode: str
    name: str
    size: int


def _name(data: bytes, like: _Blob) -> str:
    """Return the git hash of content, in the object format of the repository."""
    is_sha1 = len(like.name) == hashlib.sha1(usedforsecurity=False).digest_size * 2
    content = b"blob %d\0" % len(data) + data
    if is_sha1:
        return hashlib.sha1(content, usedforsecurity=False).hexdigest()
    return hashlib.sha256(content).hexdigest()


class Objects:
    """The files of a commit.

    Args:
        directory: A directory in the repository.
        name: The hash of the commit.
        origin: The origin of the name, for messages.

    Raises:
        InputError: there is no git, or it fails.
    """

    def __init__(self, directory: str, name: str, origin: str) -> None:
        self._directory = directory
        self._name = name
        self._origin = origin

    def _run(self, *words: str, data: bytes = b"") -> bytes | None:
        """Return the output of a command, ``None`` if it fails."""
        try:
            done = git.run(*words, directory=self._directory, data=data)
        except FileNotFoundError:
            raise InputError(f"{self._origin}: git is not installed") from None
        except (OSError, subprocess.TimeoutExpired) as error:
            raise InputError(f"{self._origin}: git failed: {error}") from error
        return done.stdout if done.returncode == 0 else None

    def files(self) -> dict[str, _Blob]:
        """Return all files of the commit by path; submodules are skipped."""
        listed = self._run("ls-tree", "-r", "-z", "--long", self._name) or b""
        blobs: dict[str, _Blob] = {}
        for line in listed.split(b"\0"):
            head, _, path = line.partition(b"\t")
            mode, kind, name, size = (head.decode().split() + [""] * 4)[:4]
            parts = os.fsdecode(path).split("/")
            if kind == "blob" and not {"", ".", "..", ".git"} & {*parts}:
                blobs[os.fsdecode(path)] = _Blob(mode, name, int(size))
        return blobs

    def read(self, blobs: Mapping[str, _Blob]) -> Iterator[tuple[str, bytes]]:
        """Yield paths and contents; only zeros for files too large to be checked."""
        chunk: list[str] = []
        size = 0
        for path, blob in blobs.items():
            if blob.size > MAX_BYTES:
                yield path, bytes(MAX_BYTES + 1)
                continue
            chunk.append(path)
            size += blob.size
            if size > _CHUNK:
                yield from self._read(chunk, blobs)
                chunk, size = [], 0
        yield from self._read(chunk, blobs)

    def _read(
        self, paths: Sequence[str], blobs: Mapping[str, _Blob]
    ) -> Iterator[tuple[str, bytes]]:
        names = "".join(f"{blobs[path].name}\n" for path in paths).encode()
        output = self._run("cat-file", "--batch", data=names) or b""
        start = 0
        for path in paths:
            end = output.find(b"\n", start)
            head = output[start:end].split()
            start = end + 1
            if end < 0 or len(head) != _WORDS:
                continue  # "<name> missing": a clone without this object
            stop = start + int(head[2])
            yield path, output[start:stop]
            start = stop + 1

    def export(self, directory: str, *, with_links: bool = True) -> None:
        """Write the files of the commit, with symlinks if wanted, into an empty directory."""
        blobs = self.files()
        links: list[tuple[str, bytes]] = []
        for path, data in self.read(blobs):
            place = os.path.join(directory, path)
            mode = blobs[path].mode
            if mode == _LINK:
                links.append((place, data))
                continue
            os.makedirs(os.path.dirname(place), exist_ok=True)
            bits = 0o700 if mode == _EXECUTABLE else 0o600
            flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW | os.O_CLOEXEC
            with open(os.open(place, flags, bits), "wb") as file:
                file.write(data)
        for place, target in links if with_links else ():
            # Symlinks are created last, so that nothing is written through them.
            os.makedirs(os.path.dirname(place), exist_ok=True)
            os.symlink(target, os.fsencode(place))


class Commit(Objects):
    """A commit of the repository around a directory.

    Args:
        directory: A directory in the work tree.
        revision: The commit as given by the user.

    Raises:
        InputError: there is no git, no repository, or no such commit.
    """

    def __init__(self, directory: str, revision: str) -> None:
        super().__init__(directory, "", f"--since {revision}")
        top = self._run("rev-parse", "--show-toplevel")
        if top is None:
            why = f"{directory} is not in a git repository of this user"
            raise InputError(f"--since {revision}: {why}")
        self.top = os.fsdecode(top.removesuffix(b"\n"))
        """The top of the work tree."""
        self._directory = self.top
        words = ("--verify", "--quiet", "--end-of-options", f"{revision}^{{commit}}")
        name = self._run("rev-parse", *words)
        if not name:
            raise InputError(f"--since {revision}: no such commit in the repository")
        self._name = os.fsdecode(name.strip())

    @cached_property
    def listed(self) -> frozenset[str]:
        """The paths of all files in the work tree that are not ignored, and of removed ones."""
        listed = self._run("ls-files", "-z", "--cached", "--others", "--exclude-standard") or b""
        return frozenset(os.fsdecode(path) for path in listed.split(b"\0") if path)

    def changed(self) -> frozenset[str]:
        """Return the paths, relative to the top, of files that differ from the commit.

        Files that git ignores are skipped; new and removed ones are not.
        """
        blobs = self.files()
        existing = {path for path in self.listed if os.path.lexists(os.path.join(self.top, path))}
        differing = {
            path for path in existing & blobs.keys() if not self._is_same(path, blobs[path])
        }
        return frozenset((existing ^ blobs.keys()) | differing)

    def _is_same(self, path: str, blob: _Blob) -> bool:
        place = os.path.join(self.top, path)
        try:
            if os.path.islink(place):
                return _name(os.fsencode(os.readlink(place)), blob) == blob.name
            data = read_file(place)
        except OSError:
            return False
        if _name(data, blob) == blob.name:
            return True
        return b"\r\n" in data and _name(data.replace(b"\r\n", b"\n"), blob) == blob.name
