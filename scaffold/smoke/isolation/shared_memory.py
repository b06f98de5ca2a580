"""Shared memory segments that processes leave behind, such as those of Fast DDS."""

from __future__ import annotations

import fcntl
import os
import stat

from scaffold import lazy_re

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

DIRECTORY = "/dev/shm"  # noqa: S108  not our temporary file: where Linux keeps them
_NAME = lazy_re.compile(r"(?:sem\.)?(?P<segment>(?:fastrtps|fastdds|fast_datasharing)_[\w.-]+)")
_SUFFIXES = ("_mutex", "_el", "_sl")
_LOCKS = ("_el", "_sl")
_OF_ALL = "lttng-ust-"
"""Permanent segments of liblttng-ust, which tracetools uses, shared by all processes."""


def segments() -> set[str]:
    """Return the names of all segments that exist."""
    try:
        return {_segment(name) for name in os.listdir(DIRECTORY)}
    except OSError:
        return set()


def is_of_middleware(name: str) -> bool:
    """Return whether a segment is one of Fast DDS, several of which processes share."""
    return _NAME.fullmatch(name) is not None


def last_change() -> int:
    """Return a number that changes when a segment is created or removed."""
    try:
        return os.stat(DIRECTORY).st_mtime_ns
    except OSError:
        return 0


def used_by(pids: Iterable[int]) -> set[str]:
    """Return the segments that living processes have mapped or keep open."""
    used: set[str] = set()
    for pid in pids:
        paths = [*_mapped(pid), *_open_files(pid)]
        used.update(_segment(os.path.basename(path)) for path in paths if _is_segment(path))
    return used


def used_by_anybody() -> set[str]:
    """Return the segments that any process uses, as far as visible to this user."""
    return used_by(int(name) for name in os.listdir("/proc") if name.isdigit())


def remove_unused(names: Iterable[str]) -> list[str]:
    """Remove those of the segments that no process uses any more; return their paths.

    A living user has the segment mapped, or holds a lock on the file next to it: the latter is
    visible also for processes of other users. Files of other users are kept.
    """
    existing = segments()
    wanted = [name for name in names if name in existing]
    used = used_by_anybody() if wanted else set()
    return [path for name in wanted if name not in used for path in _remove(name)]


def _remove(name: str) -> list[str]:
    """Remove a segment with its files, unless it is locked."""
    base = os.path.join(DIRECTORY, name)
    semaphore = os.path.join(DIRECTORY, f"sem.{name}_mutex")
    locks = [base + suffix for suffix in _LOCKS]
    held: list[int] = []
    removed: list[str] = []
    try:
        for path in locks:
            descriptor = _lock(path)
            if descriptor is None:
                continue
            if descriptor < 0:
                return []
            held.append(descriptor)
        for path in (base, *locks, semaphore):
            if _is_own_file(path):
                os.unlink(path)
                removed.append(path)
    except OSError:
        return removed  # another process removes it at this moment
    finally:
        for descriptor in held:
            os.close(descriptor)
    return removed


def _lock(path: str) -> int | None:
    """Lock a file; return its descriptor, -1 if it is in use, ``None`` if it does not exist."""
    try:
        descriptor = os.open(path, os.O_RDONLY | os.O_CLOEXEC | os.O_NOFOLLOW | os.O_NONBLOCK)
    except OSError:
        return None
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        os.close(descriptor)
        return -1
    return descriptor


def _is_own_file(path: str) -> bool:
    try:
        status = os.lstat(path)
    except OSError:
        return False
    return stat.S_ISREG(status.st_mode) and status.st_uid == os.geteuid()


def _is_segment(path: str) -> bool:
    directory, name = os.path.split(path)
    return directory == DIRECTORY and not name.startswith(_OF_ALL)


def _segment(name: str) -> str:
    """Return the segment of a file; Fast DDS uses several files for one segment."""
    match = _NAME.fullmatch(name)
    if match is None:
        return name
    segment = match["segment"]
    for suffix in _SUFFIXES:
        segment = segment.removesuffix(suffix)
    return segment


def _mapped(pid: int) -> list[str]:
    try:
        with open(f"/proc/{pid}/maps", "rb") as file:
            maps = file.read()
    except OSError:
        return []
    if f" {DIRECTORY}/".encode() not in maps:
        return []  # most processes, as the whole table is scanned repeatedly
    return [
        line[line.index(DIRECTORY) :].removesuffix(" (deleted)")
        for line in maps.decode("utf-8", "replace").splitlines()
        if f" {DIRECTORY}/" in line
    ]


def _open_files(pid: int) -> list[str]:
    try:
        descriptors = os.listdir(f"/proc/{pid}/fd")
    except OSError:
        return []
    paths: list[str] = []
    for descriptor in descriptors:
        try:
            path = os.readlink(f"/proc/{pid}/fd/{descriptor}")
        except OSError:
            continue
        if path.startswith(f"{DIRECTORY}/"):
            paths.append(path.removesuffix(" (deleted)"))
    return paths
