"""The shared memory that Fast DDS leaves behind when a process is killed."""

from __future__ import annotations

import fcntl
import os
from collections.abc import Iterable

DIRECTORY = "/dev/shm"  # noqa: S108  not a temporary file of ours: where Linux keeps them
_PREFIX = f"{DIRECTORY}/fastrtps_"
_LOCK = "_el"


def used_by(pids: Iterable[int]) -> set[str]:
    """Return the segments that living processes have mapped."""
    found: set[str] = set()
    for pid in pids:
        try:
            with open(f"/proc/{pid}/maps", encoding="utf-8", errors="replace") as lines:
                found.update(
                    line[line.index(_PREFIX) :].rstrip().removesuffix(" (deleted)")
                    for line in lines
                    if _PREFIX in line
                )
        except OSError:
            continue
    return found


def remove_unused(segments: Iterable[str]) -> list[str]:
    """Remove those of the segments that no process uses any more; return their paths.

    A living user holds a lock on the file beside the segment, also of one that is shared with
    processes which are not ours.
    """
    removed: list[str] = []
    for segment in segments:
        if not os.path.exists(segment) or _is_locked(segment + _LOCK):
            continue
        semaphore = f"{DIRECTORY}/sem.{os.path.basename(segment)}_mutex"
        for path in (segment, segment + _LOCK, semaphore):
            try:
                os.unlink(path)
            except OSError:
                continue
            removed.append(path)
    return removed


def _is_locked(path: str) -> bool:
    try:
        descriptor = os.open(path, os.O_RDONLY | os.O_CLOEXEC)
    except OSError:
        return False
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return True
    finally:
        os.close(descriptor)
    return False
