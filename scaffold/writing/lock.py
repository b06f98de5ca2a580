"""A lock per directory: one process at a time reads and writes a package.

The lock is on the directory itself: it leaves no file behind, is visible in every container that
mounts the directory, and is released by the kernel when its holder ends. If a file system cannot
lock directories, such as NFS, a lock file in the user's cache is used instead.
"""

from __future__ import annotations

import errno
import fcntl
import os
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress

from scaffold.errors import InputError, LockedError
from scaffold.files.disk import digest

PATIENCE = 30.0
"""Seconds to wait for each holder of the lock."""
_PAUSE = 0.03
"""Seconds between two attempts."""

_UNSUPPORTED = {errno.EBADF, errno.EINVAL, errno.ENOLCK, errno.ENOSYS, errno.EOPNOTSUPP}


@contextmanager
def locked(directory: str, notify: Callable[[str], None]) -> Iterator[None]:
    """Hold the lock of a directory; wait for another holder.

    Args:
        directory: The directory, which exists.
        notify: Called with a line if there is a holder to wait for.

    Raises:
        LockedError: another process has kept the lock for too long.
        InputError: the directory does not exist.
    """
    descriptor = _acquire(directory, notify)
    try:
        yield
    finally:
        os.close(descriptor)


def try_lock(directory: str) -> int | None:
    """Return a descriptor with the lock of a directory, ``None`` if it is locked already.

    Raises:
        OSError: there is no such directory, or it cannot be locked.
    """
    flags = os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW | os.O_CLOEXEC
    descriptor = os.open(directory, flags)
    try:
        if _is_ours(descriptor) and _is_current(descriptor, directory):
            return descriptor
    except OSError:
        os.close(descriptor)
        raise
    os.close(descriptor)
    return None


def _acquire(directory: str, notify: Callable[[str], None]) -> int:
    while True:
        descriptor, path = _open(directory)
        try:
            _wait(descriptor, directory, notify)
            if _is_current(descriptor, path):
                return descriptor
        except BaseException:
            os.close(descriptor)
            raise
        os.close(descriptor)  # the directory was replaced while this process waited


def _open(directory: str) -> tuple[int, str]:
    """Return a descriptor that can be locked, and its path."""
    try:
        descriptor = os.open(directory, os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC)
    except PermissionError:
        return _open_file(directory)
    except OSError as error:
        raise InputError(f"{directory}: {error.strerror}") from error
    try:
        fcntl.flock(descriptor, fcntl.LOCK_SH | fcntl.LOCK_NB)
        fcntl.flock(descriptor, fcntl.LOCK_UN)
    except OSError as error:
        if error.errno in _UNSUPPORTED:
            os.close(descriptor)
            return _open_file(directory)
    return descriptor, directory


def _open_file(directory: str) -> tuple[int, str]:
    """Return the lock file of a directory in the user's cache."""
    status = os.stat(directory)
    key = f"{os.path.realpath(directory)}\0{status.st_dev}\0{status.st_ino}"
    cache_home = os.environ.get("XDG_CACHE_HOME") or os.path.join(os.path.expanduser("~"), ".cache")
    path = os.path.join(cache_home, "ros2-scaffold", "locks", digest(os.fsencode(key)))
    try:
        os.makedirs(os.path.dirname(path), exist_ok=True)
        flags = os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_CLOEXEC
        return os.open(path, flags, 0o600), path
    except OSError as error:
        raise InputError(
            f"{directory} cannot be locked, and neither can {path}: {error.strerror}"
        ) from error


def _wait(descriptor: int, directory: str, notify: Callable[[str], None]) -> None:
    if _is_ours(descriptor):
        return
    holder = _lock_holder(descriptor)
    notify(f"waiting for {holder}, which is changing {directory}")
    deadline = time.monotonic() + PATIENCE
    while not _is_ours(descriptor):
        time.sleep(_PAUSE)
        current = _lock_holder(descriptor)
        if current != holder:
            holder, deadline = current, time.monotonic() + PATIENCE
        elif time.monotonic() > deadline:
            raise LockedError(
                f"{directory} is locked by {holder} for more than {PATIENCE:.0f} s; "
                "nothing was written: wait for it or stop it, then run the command again"
            )


def _is_ours(descriptor: int) -> bool:
    """Try to take the lock; return whether that succeeded."""
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    return True


def _is_current(descriptor: int, path: str) -> bool:
    """Return whether a path still refers to the opened file."""
    try:
        return os.path.samestat(os.fstat(descriptor), os.stat(path))
    except FileNotFoundError:
        return False


def _lock_holder(descriptor: int) -> str:
    """Return the process that holds a lock, if the kernel shows it."""
    inode = str(os.fstat(descriptor).st_ino)
    with suppress(OSError), open("/proc/locks", encoding="ascii", errors="replace") as locks:
        for line in locks:
            fields = line.split()
            # 1: FLOCK  ADVISORY  WRITE 4711 fe:00:131073 0 EOF; waiters have an arrow.
            if fields[1] == "FLOCK" and fields[5].rpartition(":")[2] == inode:
                return _description(fields[4])
    return "another process"


def _description(process: str) -> str:
    try:
        with open(f"/proc/{process}/cmdline", "rb") as file:
            words = file.read().decode(errors="replace").rstrip("\0").split("\0")
    except OSError:
        return f"process {process}"
    return f"process {process} ({' '.join(words)[:200]})"
