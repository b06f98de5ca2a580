"""A lock that allows one run at a time in a workspace."""

from __future__ import annotations

import fcntl
import os
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from scaffold.errors import InputError

NAME = ".ros2-scaffold-smoke.lock"
WAIT = 30.0
"""Seconds to wait for another run to end."""
_PERIOD = 0.1


@contextmanager
def locked(workspace: Path, wait: float, tell: Callable[[str], None]) -> Iterator[None]:
    """Lock a workspace for the duration of the block.

    Args:
        workspace: The directory; created if missing.
        wait: Seconds to wait for another run to end.
        tell: Called with the reason for waiting.

    Raises:
        InputError: it is locked by another run, or not writable.
    """
    path = workspace / NAME
    try:
        workspace.mkdir(parents=True, exist_ok=True)
        descriptor = _acquire(path, wait, tell)
    except OSError as error:
        raise InputError(
            f"'{workspace}' cannot be used as a workspace: {error.strerror}"
        ) from error
    try:
        yield
    finally:
        # While locked: a waiting run notices that the file is gone, and creates another one.
        path.unlink(missing_ok=True)
        os.close(descriptor)


def _acquire(path: Path, wait: float, tell: Callable[[str], None]) -> int:
    """Return the descriptor of the locked file."""
    deadline = time.monotonic() + wait
    has_told = False
    while True:
        descriptor = _try_lock(path)
        if descriptor is not None:
            return descriptor
        holder = _lock_holder(path)
        if time.monotonic() >= deadline:
            raise InputError(
                f"'{path.parent}' is in use by another smoke ({holder}): wait for it, or choose "
                "another --workspace"
            )
        if not has_told:
            tell(f"waiting for another smoke ({holder}) in '{path.parent}'")
            has_told = True
        time.sleep(_PERIOD)


def _try_lock(path: Path) -> int | None:
    """Try to lock the file; record the process that holds it."""
    flags = os.O_RDWR | os.O_CREAT | os.O_CLOEXEC | os.O_NOFOLLOW
    descriptor = os.open(path, flags, 0o644)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        if not os.path.samestat(os.fstat(descriptor), os.stat(path)):
            raise BlockingIOError  # noqa: TRY301  its holder has just removed it
        os.ftruncate(descriptor, 0)
        os.write(descriptor, f"process {os.getpid()}".encode())
    except (BlockingIOError, FileNotFoundError):
        os.close(descriptor)
        return None
    return descriptor


def _lock_holder(path: Path) -> str:
    try:
        text = path.read_text(encoding="utf-8", errors="replace")
    except OSError:
        text = ""
    return text[:40] or "process unknown"
