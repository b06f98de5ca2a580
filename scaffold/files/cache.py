"""The user's cache: sealed files that may be deleted at any time.

A file starts with a header, which identifies the writer and the inputs, and a checksum of its data.
Files with another header, and damaged ones, are ignored. Every start imports this module, so it
imports almost nothing.
"""

from __future__ import annotations

import os
from zlib import crc32

from scaffold.files import home

SWITCH = "SCAFFOLD_NO_CACHE"
"""The variable that switches the cache off."""
MAX_BYTES = 100_000_000
"""The size limit of all files of a kind."""
KINDS = ("runs", "style", "rules", "words", "manifests", "templates_", "stubs", "types", "pages")
"""Prefixes of the names of directories in the cache; locks must not be removed."""
TREES = ("content", "interfaces")
"""Directories whose entries are directories, each complete or missing."""
_ABANDONED_AFTER = 3600
"""Seconds after which a temporary file is no longer being written."""

_SEAL = 4
"""The size of the checksum, which detects damage and is five times as fast as a digest."""


def directory(kind: str) -> str | None:
    """Return the cache directory of a kind, ``None`` if there is no cache.

    It is disabled, there is no home, or it is in the current repository: the cache contains
    code, which a stranger could have committed.
    """
    if os.environ.get(SWITCH):
        return None
    kept = home.cache()
    # The default directory is the user's own, even if the home directory is a repository.
    if kept is None or ("XDG_CACHE_HOME" in os.environ and _is_in_repository(kept)):
        return None
    return os.path.join(kept, kind)


def read_sealed(path: str, head: bytes) -> bytes | None:
    """Return the data written with a header; ``None`` if missing, different or damaged.

    Files of other users are ignored.
    """
    try:
        with open(path, "rb", buffering=0) as file:
            status = os.fstat(file.fileno())
            is_read = status.st_uid == os.geteuid() and status.st_size <= MAX_BYTES
            # Space for MAX_BYTES would take longer to allocate than reading.
            stored = file.read(status.st_size) if is_read else b""
    except OSError:
        return None
    start = len(head) + _SEAL
    data = stored[start:]
    return data if stored[:start] == head + _checksum(data) else None


def _is_in_repository(path: str) -> bool:
    """Return whether a path is in the repository around the current directory."""
    try:
        directory = os.getcwd()
    except OSError:  # it was removed
        return False
    while not os.path.lexists(os.path.join(directory, ".git")):
        parent = os.path.dirname(directory)
        if parent == directory:
            return False
        directory = parent
    return os.path.realpath(path).startswith(os.path.join(directory, ""))


def write_sealed(path: str, head: bytes, data: bytes) -> bool:
    """Write a sealed file atomically; return whether that succeeded."""
    return _write(path, b"".join((head, _checksum(data), data)))


def _checksum(data: bytes) -> bytes:
    return crc32(data).to_bytes(_SEAL, "big")


def write_plain(path: str, data: bytes) -> bool:
    """Write a file for other programs, unless it exists; return whether it exists then."""
    try:
        with open(path, "rb", buffering=0) as file:
            if file.read(MAX_BYTES) == data:
                return True
    except OSError:
        pass  # just written
    return _write(path, data)


def _write(path: str, data: bytes) -> bool:
    from scaffold.files import temporary

    directory = os.path.dirname(path)
    aside = os.path.join(directory, temporary.name())
    try:
        with open(_created(aside), "wb") as file:
            try:
                file.write(data)
                file.flush()
                os.replace(aside, path)
            except BaseException:
                os.unlink(aside)
                raise
    except OSError:
        return False
    return True


def _created(path: str) -> int:
    """Create a file, and its directory if it does not exist yet, as only one of many does."""
    from scaffold.files import temporary

    try:
        return temporary.create(path)
    except FileNotFoundError:
        os.makedirs(os.path.dirname(path), exist_ok=True)
        return temporary.create(path)


def trim(kept: str, most: int) -> None:
    """Delete the least recently written files if there are too many, or too large ones.

    A quarter is deleted at once, so that the next runs need not trim again.

    Args:
        kept: The directory.
        most: The maximum number of files.
    """
    from time import time

    from scaffold.files import temporary

    files: list[tuple[float, int, str]] = []
    oldest = time() - _ABANDONED_AFTER
    try:
        with os.scandir(kept) as entries:
            for entry in entries:
                status = entry.stat(follow_symlinks=False)
                if temporary.is_temporary(entry.name):
                    if status.st_mtime < oldest:
                        os.unlink(entry.path)  # its writer was killed
                    continue
                files.append((status.st_mtime, status.st_size, entry.path))
        if len(files) <= most and sum(size for _, size, _ in files) <= MAX_BYTES:
            return
        count = total = 0
        for _, size, path in sorted(files, reverse=True):
            count, total = count + 1, total + size
            if count > 1 and (count > most // 4 * 3 or total > MAX_BYTES // 4 * 3):
                os.unlink(path)
    except OSError:
        return  # another process cleans up


def size(top: str) -> tuple[int, int]:
    """Return the number of files in the cache, and their total size."""
    count = total = 0
    for path in _files(top):
        try:
            total += os.lstat(path).st_size
        except OSError:
            continue  # another process cleans up
        count += 1
    return count, total


def clean(top: str) -> None:
    """Remove all files of the cache, and no others.

    Raises:
        OSError: the system refuses.
    """
    import shutil  # every start of the program imports this module

    for tree in TREES:  # atomically, as partial directories would go unnoticed
        shutil.rmtree(os.path.join(top, tree), ignore_errors=True)
    for path in _files(top):
        try:
            os.unlink(path)
        except FileNotFoundError:
            continue


def _files(top: str) -> list[str]:
    """Return the files in the directories of the cache; links to directories are not followed."""
    result: list[str] = []
    try:
        kinds = [name for name in os.listdir(top) if name.startswith((*KINDS, *TREES))]
    except OSError:
        return result
    for kind in sorted(kinds):
        for directory, _, names in os.walk(os.path.join(top, kind)):
            result += [os.path.join(directory, name) for name in names]
    return result
