"""The file system as `check` sees it: every access is recorded, for the cache.

All accesses of `check` to packages and their surroundings go through here. While ``holds`` finds
the same answers, cached results are valid. Files are compared by content, not by modification time,
so checkouts, copies and wrong clocks do no harm.

Every start imports this module, so it imports almost nothing.
"""

from __future__ import annotations

import errno
import os
import stat

TYPE_CHECKING = False  # importing that of typing would take longer than checking a package
if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    Question = tuple[str, str]
    """A kind of access and its path."""
    Answer = bool | str | None
    Names = tuple[list[str], list[str], list[str]]
    """Files, directories and broken symlinks, each sorted."""


MAX_BYTES = 10_000_000
"""The size limit of any file; parsers of text have lower limits of their own."""


class LargeFileError(OSError):
    """A file is too large, and was not read."""

    def __init__(self, path: str, size: int, most: int) -> None:
        reason = f"it has {size // 1000} kB; the limit is {most // 1000} kB"
        super().__init__(errno.EFBIG, reason, path)
        self.size = size


class Disk:
    """Accesses to the file system, recorded with their results."""

    def __init__(self) -> None:
        self.seen: dict[Question, Answer] = {}
        self.is_settled = True
        """False if an access was not recorded, or a file has changed meanwhile."""

    def note(self, seen: Mapping[Question, Answer], *, is_settled: bool = True) -> None:
        """Add recorded answers of another Disk."""
        self.is_settled &= is_settled
        for question, answer in seen.items():
            if self.seen.setdefault(question, answer) != answer:
                self.is_settled = False

    def read(self, path: str, most: int = MAX_BYTES) -> bytes:
        """Return the content of a regular file.

        Args:
            path: The file.
            most: The size limit, at most ``MAX_BYTES``.

        Raises:
            LargeFileError: it is larger; it is then identified by its stamp.
            OSError: it cannot be read. Reading a pipe would wait forever, and a device may have
                no end.
        """
        try:
            data = read_file(path, most)
        except LargeFileError:
            self._ask("stamp", path)
            raise
        except OSError:
            self.note({("content", path): None})
            raise
        self.note({("content", path): digest(data)})
        return data

    def read_renewed(self, path: str, most: int = MAX_BYTES) -> bytes:
        """Return the content of a file that its program replaces, but never edits.

        It is identified by its stamp, as hashing it in each run would take too long.

        Args:
            path: The file.
            most: The size limit.

        Raises:
            OSError: it cannot be read, or is too large.
        """
        self._ask("stamp", path)
        return read_file(path, most)

    def names(self, directory: str) -> Names:
        """Return the entries of a directory; symlinks to directories are skipped.

        A directory that cannot be listed is empty.
        """
        entries = _names(directory)
        self.note({("names", directory): _digest_of(*entries)})
        return entries

    def entries(self, directory: str, *starts: str) -> list[str]:
        """Return the names in a directory; one that cannot be listed is empty.

        Args:
            directory: The directory.
            starts: The prefix of the names in upper case, matched without case; empty for all.
        """
        names = _entries(directory, starts)
        self.note({(" ".join(("entries", *starts)), directory): _digest_of(names)})
        return names

    def directories_with(self, directory: str, name: str, most: int) -> list[str]:
        """Return the names of subdirectories that contain a file; other entries do not matter.

        Args:
            directory: The directory; one that cannot be listed is empty.
            name: The name of the file, without spaces.
            most: The maximum number of subdirectories; with more, the result is empty.
        """
        directories = _directories_with(directory, name, most)
        self.note({(f"with {name} {most}", directory): _digest_of(directories)})
        return directories

    def exists(self, path: str) -> bool:
        """Return whether a path exists."""
        return bool(self._ask("exists", path))

    def is_file(self, path: str) -> bool:
        """Return whether a path is a regular file or a symlink to one."""
        return bool(self._ask("is_file", path))

    def is_directory(self, path: str) -> bool:
        """Return whether a path is a directory or a symlink to one."""
        return bool(self._ask("is_directory", path))

    def is_executable(self, path: str) -> bool:
        """Return whether a file has an executable bit."""
        return bool(self._ask("is_executable", path))

    def real(self, path: str) -> str:
        """Return a path with symlinks resolved."""
        return str(self._ask("real", path))

    def is_own(self, path: str) -> bool:
        """Return whether a file, and a symlink to it, belong to the current user.

        Under sudo, the calling user is accepted as well.
        """
        return bool(self._ask("is_own", path))

    def is_shared(self, path: str) -> bool:
        """Return whether a directory is world-writable, like ``/tmp``."""
        return bool(self._ask("is_shared", path))

    def owner(self, path: str) -> str:
        """Return the user id of the owner of a file; empty if there is no file."""
        return str(self._ask("owner", path))

    def stamp(self, path: str) -> str:
        """Return a value that changes when a program is reinstalled."""
        return str(self._ask("stamp", path))

    def _ask(self, kind: str, path: str) -> Answer:
        answer = _answer(kind, path)
        self.note({(kind, path): answer})
        return answer


def holds(seen: Mapping[Question, Answer]) -> bool:
    """Return whether all recorded accesses still have the same result."""
    return all(_answer(kind, path) == answer for (kind, path), answer in seen.items())


def changed(seen: Mapping[Question, Answer]) -> list[Question]:
    """Return the recorded accesses with a different result now."""
    return [asked for asked, answer in seen.items() if _answer(*asked) != answer]


def digest(data: bytes) -> str:
    """Return a collision-resistant digest."""
    try:
        # The import of hashlib takes longer than hashing a package.
        from _blake2 import blake2b
    except ImportError:
        from hashlib import blake2b
    return blake2b(data, digest_size=20).hexdigest()


def read_file(path: str, most: int = MAX_BYTES) -> bytes:
    """Return the content of a regular file; its size is checked before reading.

    Raises:
        LargeFileError: it is too large.
        OSError: it cannot be read, or is not a regular file.
    """
    # Opening a device may have effects; a pipe that replaces the file meanwhile must not block.
    if not os.path.isfile(path):
        raise FileNotFoundError(errno.ENOENT, "no such file", path)
    descriptor = os.open(path, os.O_RDONLY | os.O_CLOEXEC | os.O_NONBLOCK | os.O_NOCTTY)
    try:
        status = os.fstat(descriptor)
        if not stat.S_ISREG(status.st_mode):
            raise FileNotFoundError(errno.ENOENT, "not a regular file", path)
        size = status.st_size
        parts: list[bytes] = []
        count = 0
        while count <= most >= size:
            part = os.read(descriptor, max(size, 4096) + 1 - count if count <= size else 65536)
            if not part:
                return parts[0] if len(parts) == 1 else b"".join(parts)
            parts.append(part)
            count += len(part)
    finally:
        os.close(descriptor)
    raise LargeFileError(path, max(size, count), most)


def size(path: str) -> int:
    """Return the size of a file, only to distribute work, as it is not recorded."""
    try:
        return os.stat(path).st_size
    except OSError:
        return 0


def _names(directory: str) -> Names:
    files: list[str] = []
    directories: list[str] = []
    broken: list[str] = []
    try:
        with os.scandir(directory) as entries:
            for entry in entries:
                if entry.is_dir(follow_symlinks=False):
                    directories.append(entry.name)
                elif not entry.is_symlink():
                    # Pipes, sockets and devices are not sources.
                    if entry.is_file():
                        files.append(entry.name)
                elif os.path.isfile(entry.path):
                    files.append(entry.name)
                elif not os.path.exists(entry.path):
                    broken.append(entry.name)
    except OSError:
        return [], [], []
    return sorted(files), sorted(directories), sorted(broken)


def _entries(directory: str, starts: Sequence[str]) -> list[str]:
    try:
        names = sorted(os.listdir(directory))
    except OSError:
        return []
    return [name for name in names if name.upper().startswith((*starts,))] if starts else names


def _directories_with(directory: str, name: str, most: int) -> list[str]:
    directories = _names(directory)[1]
    if len(directories) > most:
        return []
    return [item for item in directories if os.path.isfile(os.path.join(directory, item, name))]


def _digest_of(*names: list[str]) -> str:
    # No name holds these two characters.
    return digest("/".join("\0".join(kind) for kind in names).encode("utf-8", "surrogateescape"))


def _digest_of_content(path: str) -> str | None:
    try:
        return digest(read_file(path))
    except OSError:
        return None


def stamp(path: str) -> str:
    """Return a value that changes when a file is written or replaced; empty without a file."""
    try:
        status = os.stat(path)
    except OSError:
        return ""
    return f"{status.st_ino} {status.st_size} {status.st_mtime_ns} {status.st_ctime_ns}"


def _is_executable(path: str) -> bool:
    try:
        return bool(os.stat(path).st_mode & 0o111)
    except OSError:
        return False


def _is_own(path: str) -> bool:
    users = {os.geteuid()}
    caller = os.environ.get("SUDO_UID", "")
    if users == {0} and caller.isdecimal():
        users.add(int(caller))
    try:
        return {os.lstat(path).st_uid, os.stat(path).st_uid} <= users
    except OSError:
        return False


def _is_shared(path: str) -> bool:
    # Without the sticky bit it is a mount without owners, as in virtual machines.
    try:
        return os.stat(path).st_mode & _SHARED == _SHARED
    except OSError:
        return False


_SHARED = 0o1002


def _owner(path: str) -> str:
    try:
        return str(os.stat(path).st_uid)
    except OSError:
        return ""


_ANSWERS: dict[str, Callable[[str], Answer]] = {
    "content": _digest_of_content,
    "names": lambda path: _digest_of(*_names(path)),
    "exists": os.path.exists,
    "is_file": os.path.isfile,
    "is_directory": os.path.isdir,
    "is_executable": _is_executable,
    "real": os.path.realpath,
    "is_own": _is_own,
    "is_shared": _is_shared,
    "owner": _owner,
    "stamp": stamp,
}


def _answer(kind: str, path: str) -> Answer:
    name, *words = kind.split(" ")
    if name == "entries":
        return _digest_of(_entries(path, words))
    if name == "with":
        return _digest_of(_directories_with(path, words[0], int(words[1])))
    return _ANSWERS[name](path)
