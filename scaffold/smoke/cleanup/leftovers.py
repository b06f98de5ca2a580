"""Cleans up after killed runs, using their ledgers."""

from __future__ import annotations

import os
import shutil
import signal
import stat
import tempfile
import time
import uuid
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path

from scaffold.smoke.cleanup import ledger
from scaffold.smoke.isolation import shared_memory
from scaffold.smoke.processes import marks
from scaffold.smoke.processes import table as process_table
from scaffold.smoke.processes.process import Origin

MARKER = ".ros2-scaffold-smoke"
"""The file in a scratch directory that holds the mark of its run."""
_PREFIX = "ros2-scaffold-smoke-"
_PATIENCE = 8.0
"""Seconds for the supervisors of a killed run to clean up themselves."""


@dataclass(frozen=True)
class Run:
    """A run in the ledger."""

    origin: Origin
    scratch: Path


@contextmanager
def recorded_run(*, keep: bool = False) -> Iterator[Run]:
    """Provide a scratch directory; clean up after the block.

    Args:
        keep: Whether to keep the scratch directory.
    """
    mark = uuid.uuid4().hex
    scratch = Path(tempfile.gettempdir(), _PREFIX + mark)
    with ledger.opened(mark, None if keep else scratch) as path:
        scratch.mkdir(mode=0o700)
        try:
            (scratch / MARKER).write_text(mark, encoding="ascii")
            yield Run(Origin(mark, path), scratch)
        finally:
            _clean_up(mark, path)
            if not keep:
                remove_scratch(scratch, mark)


def _clean_up(mark: str, path: Path | None) -> None:
    """Remove the leftovers of a run whose supervisors were killed."""
    marks.sweep(mark)
    if path is None:
        return
    with suppress(OSError):
        entries = ledger.read(path)
        _end(entries, patience=0.0)
        shared_memory.remove_unused(entries.segments)


def sweep() -> None:
    """Remove leftovers of dead runs of this user: processes, shared memory, directories.

    Only those of certain origin: processes with the recorded start time or the mark of the run,
    segments that these used and that are unused now, and directories with the mark.
    """
    with ledger.abandoned() as ledgers:
        for path, entries in ledgers:
            if entries.is_of_this_boot:
                _end(entries)
                shared_memory.remove_unused(entries.segments)
            if entries.scratch is None or remove_scratch(entries.scratch, entries.mark):
                with suppress(OSError):
                    path.unlink()


def remove_scratch(scratch: Path, mark: str) -> bool:
    """Remove the directory of a run, if it is one; return whether it no longer exists."""
    if not _is_scratch(scratch, mark):
        return not os.path.lexists(scratch)
    for unlock in (False, True):
        if unlock:
            _unlock(scratch)
        with os.scandir(scratch) as entries:
            for entry in entries:
                # The marker is removed last, so that a killed cleanup can be repeated.
                if entry.name != MARKER:
                    _remove(entry)
        with suppress(OSError):
            if os.listdir(scratch) in ([], [MARKER]):
                (scratch / MARKER).unlink(missing_ok=True)
                scratch.rmdir()
                return True
    return False


def _is_scratch(path: Path, mark: str) -> bool:
    """Return whether a directory was created by the run with a mark, and by this user."""
    if path.name != _PREFIX + mark or not path.is_absolute():
        return False
    try:
        status = os.lstat(path)
        if not stat.S_ISDIR(status.st_mode) or status.st_uid != os.geteuid():
            return False
        if not os.listdir(path):
            return True  # killed before writing the marker
        descriptor = os.open(path / MARKER, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK)
    except OSError:
        return False
    with os.fdopen(descriptor, "rb") as marker:
        return marker.read(len(mark) + 1) == mark.encode()


def _remove(entry: os.DirEntry[str]) -> None:
    if entry.is_dir(follow_symlinks=False):
        shutil.rmtree(entry.path, ignore_errors=True)
        return
    with suppress(OSError):
        os.unlink(entry.path)


def _unlock(root: Path) -> None:
    """Restore the permissions that executables have removed from their directories."""
    os.chmod(root, stat.S_IRWXU)
    for parent, names, _ in os.walk(root):
        for name in names:
            path = os.path.join(parent, name)
            with suppress(OSError):
                if stat.S_ISDIR(os.lstat(path).st_mode):
                    os.chmod(path, stat.S_IRWXU)


def _end(entries: ledger.Entries, patience: float = _PATIENCE) -> None:
    """End the processes of a dead run, after waiting for its living supervisors."""
    deadline = time.monotonic() + patience
    while _live_pids(entries) and time.monotonic() < deadline:
        time.sleep(0.05)
    deadline = time.monotonic() + marks.GRACE_OF_KILL
    while (pids := _live_pids(entries)) and time.monotonic() < deadline:
        for pid in pids:
            with suppress(OSError):
                os.kill(pid, signal.SIGKILL)
        time.sleep(0.01)


def _live_pids(entries: ledger.Entries) -> set[int]:
    table = process_table.snapshot()
    recorded = {
        pid
        for pid, started in entries.processes
        if pid in table and table[pid].started == started and table[pid].is_alive
    }
    below = {
        descendant.pid for pid in recorded for descendant in process_table.descendants(pid, table)
    }
    return (recorded | below | set(marks.marked(entries.mark))) - {os.getpid()}
