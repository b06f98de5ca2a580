"""A ledger of started processes and created files, so that a later run can clean up.

A ledger is a file of JSON lines in the user's state directory. The run holds a lock on it, which
the kernel releases when the process ends: a ledger without a lock belongs to a dead run. The
supervisors of the run add the processes and shared memory that they see.
"""

from __future__ import annotations

import fcntl
import json
import os
import stat
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

_SUFFIX = ".jsonl"
_NEW_SUFFIX = ".new"
_ATTEMPTS = 3


@dataclass
class Entries:
    """The contents of a ledger; damaged entries are skipped."""

    mark: str
    is_of_this_boot: bool = False
    """Whether it is from the current boot, so that process ids and shared memory are valid."""
    scratch: Path | None = None
    processes: set[tuple[int, int]] = field(default_factory=set)
    """Ids and start times."""
    segments: set[str] = field(default_factory=set)


def directory() -> Path | None:
    """Return the directory of the ledgers of this user, if there is one."""
    state_home = os.environ.get("XDG_STATE_HOME") or os.path.join(
        os.path.expanduser("~"), ".local", "state"
    )
    return Path(state_home, "ros2-scaffold", "smoke") if os.path.isabs(state_home) else None


@contextmanager
def opened(mark: str, scratch: Path | None) -> Iterator[Path | None]:
    """Keep a ledger for the duration of the block, if there is a directory for it.

    Args:
        mark: Marks the processes of the run.
        scratch: The directory that the run is about to create, unless it will be kept.
    """
    created = _create(mark, scratch)
    if created is None:
        yield None
        return
    path, descriptor = created
    try:
        yield path
    finally:
        if scratch is None or not os.path.lexists(scratch):
            with suppress(OSError):
                path.unlink()
        os.close(descriptor)


def read(path: Path) -> Entries:
    """Return the entries of a ledger.

    Raises:
        OSError: it cannot be read.
    """
    descriptor = os.open(path, os.O_RDONLY | os.O_CLOEXEC | os.O_NOFOLLOW)
    try:
        return _read(path, descriptor)
    finally:
        os.close(descriptor)


@contextmanager
def abandoned() -> Iterator[list[tuple[Path, Entries]]]:
    """Return the ledgers of dead runs of this user, locked for the duration of the block."""
    held: list[int] = []
    ledgers: list[tuple[Path, Entries]] = []
    parent = directory()
    try:
        for path in _files(parent) if parent else ():
            descriptor = _lock_stale(path)
            if descriptor is not None:
                held.append(descriptor)
                ledgers.append((path, _read(path, descriptor)))
        yield ledgers
    finally:
        for descriptor in held:
            os.close(descriptor)


def _files(parent: Path) -> list[Path]:
    return sorted(path for path in parent.glob("*") if path.suffix in {_SUFFIX, _NEW_SUFFIX})


def _create(mark: str, scratch: Path | None) -> tuple[Path, int] | None:
    """Create and lock a ledger with its first line; return ``None`` if that fails."""
    parent = directory()
    if parent is None:
        return None
    path, new = parent / f"{mark}{_SUFFIX}", parent / f"{mark}{_NEW_SUFFIX}"
    first = {"place": _place(), "scratch": None if scratch is None else str(scratch)}
    for _ in range(_ATTEMPTS):
        try:
            parent.mkdir(parents=True, exist_ok=True, mode=0o700)
            descriptor = os.open(new, os.O_RDWR | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC, 0o600)
        except OSError:
            return None
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX)
            os.write(descriptor, json.dumps(first).encode() + b"\n")
            # It gets its name once it is locked: until then, it looks like an abandoned one.
            os.rename(new, path)
        except FileNotFoundError:
            os.close(descriptor)  # another run has cleaned up
        except OSError:
            os.close(descriptor)
            return None
        else:
            return path, descriptor
    return None


def _lock_stale(path: Path) -> int | None:
    """Open and lock a ledger of a dead run of this user; ``None`` for any other."""
    try:
        descriptor = os.open(path, os.O_RDONLY | os.O_CLOEXEC | os.O_NOFOLLOW | os.O_NONBLOCK)
    except OSError:
        return None
    status = os.fstat(descriptor)
    is_ours = stat.S_ISREG(status.st_mode) and status.st_uid == os.geteuid()
    if is_ours:
        with suppress(OSError):
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
            return descriptor
    os.close(descriptor)
    return None


def _read(path: Path, descriptor: int) -> Entries:
    entries = Entries(path.stem)
    with os.fdopen(os.dup(descriptor), encoding="utf-8", errors="replace") as lines:
        for line in lines:
            with suppress(ValueError, TypeError, KeyError):
                _add(entries, json.loads(line))
    return entries


def _add(entries: Entries, line: Mapping[str, Any]) -> None:
    if "place" in line:
        entries.is_of_this_boot = line["place"] == _place()
        entries.scratch = Path(line["scratch"]) if line["scratch"] else None
    elif "segments" in line:
        entries.segments.update(map(str, line["segments"]))
    else:
        entries.processes.update((int(pid), int(started)) for pid, started in line["processes"])


def _place() -> str:
    """Return an id of the current boot and container."""
    try:
        with open("/proc/sys/kernel/random/boot_id", encoding="ascii") as file:
            boot = file.read().strip()
        return f"{boot} {os.readlink('/proc/self/ns/pid')}"
    except OSError:
        return "unknown"
