"""A subprocess that runs one command and ends all of its descendants.

It runs between ``smoke`` and the command, as the subreaper of everything that the command starts:
detached processes become its children. It ends when its socket closes: if ``smoke`` is interrupted
or killed, it ends what it has started and removes the shared memory that those processes used. It
imports only the standard library and its neighbors, because it runs in an isolated interpreter.

It reads lines of JSON: first ``{"command": [...], "variables": {...}, "ledger": path or null}``,
then ``{"signal": number}`` for the process group of the command, and ``{"finish": seconds}`` after
the command has ended: its children may run for so long. If the first line contains ``finish``,
the supervisor finishes when the command ends. It writes lines of JSON: ``{"started": pid}`` or
``{"errno": number}``, ``{"ended": status}``, and finally ``{"left": [command lines], "leaked":
[paths], "used": [names of segments]}``.
"""

from __future__ import annotations

import ctypes
import json
import os
import select
import signal
import socket
import stat
import sys
import time

from scaffold.smoke.isolation import shared_memory
from scaffold.smoke.processes import table
from scaffold.smoke.processes.table import Process

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping
    from typing import Any

PERIOD = 0.05
"""Seconds between two checks of shared memory and the end of children, which have no events."""
GRACE = 2.0
"""Seconds for processes to obey SIGTERM."""
GRACE_OF_STOP = 0.2
"""Seconds for the kernel to stop a process after SIGSTOP."""
GRACE_OF_KILL = 10.0
"""Seconds for the kernel to kill processes that may fork all the time."""
LISTING_PERIOD = 1.0
"""Seconds between two listings of the processes."""
SECOND_LOOK = 0.5
"""Seconds after a change of the shared memory at which its users are looked for once more: a file
is created before it is mapped."""

SHOWN_COMMAND = 500
"""The maximum length of a shown command line."""

MOST_OUTPUT = 2**26
"""The number of output bytes kept on disk; earlier output is freed."""
_KEEP_SIZE_PUNCH_HOLE = 3

_SET_CHILD_SUBREAPER = 36
_STOPPED = frozenset("TtZX")
"""States of processes that run no code: stopped, traced, and ended."""
_OWN_SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGPIPE, signal.SIGXFSZ)


def become_subreaper(*, enabled: bool = True) -> bool:
    """Make this process adopt orphaned descendants; return whether that works."""
    try:
        done: int = ctypes.CDLL(None).prctl(_SET_CHILD_SUBREAPER, int(enabled), 0, 0, 0)
    except (OSError, AttributeError):
        return False
    return done == 0


class Supervisor:
    """Starts a command, watches it and ends it.

    Args:
        control: The socket that connects it with ``smoke``.
    """

    def __init__(self, control: socket.socket) -> None:
        self._control = control
        self._received = b""
        self._abandoned = False
        self._child = 0
        self._ended = False
        self._finish: float | None = None
        self._finish_after_command: float | None = None
        self._ledger: str | None = None
        self._segments: set[str] = set()
        self._existing = {
            name for name in shared_memory.segments() if not shared_memory.is_of_middleware(name)
        }
        """Segments of other processes, which must be kept."""
        self._processes: set[tuple[int, int]] = set()
        self._next_listing = 0.0
        self._last_change = shared_memory.last_change()
        self._second_look: float | None = None

    def run(self) -> None:
        """Serve until the command and its descendants have ended."""
        become_subreaper()
        wakeup, wakeup_writer = socket.socketpair()
        wakeup_writer.setblocking(False)  # noqa: FBT003  takes no keyword
        signal.set_wakeup_fd(wakeup_writer.fileno(), warn_on_full_buffer=False)
        signal.signal(signal.SIGCHLD, lambda *_: None)
        while self._finish is None and not self._abandoned:
            readable, _, _ = select.select([self._control, wakeup], [], [], PERIOD)
            if self._control in readable:
                self._receive()
            if wakeup in readable:
                wakeup.recv(4096)
            self._reap()
            self._watch_segments()
            self._note_processes()
            self._bound_output()
        self._await_children(self._finish or 0.0)
        left = self._end_all()
        removed = shared_memory.remove_unused(self._segments)
        leaked = [
            path for path in removed if not shared_memory.is_of_middleware(os.path.basename(path))
        ]
        used = [name for name in self._segments if not shared_memory.is_of_middleware(name)]
        self._notify({"left": left, "leaked": sorted(leaked), "used": sorted(used)})

    # -- requests of smoke

    def _receive(self) -> None:
        try:
            data = self._control.recv(2**16)
        except OSError:
            data = b""
        if not data:
            self._abandoned = True
            return
        *lines, self._received = (self._received + data).split(b"\n")
        for line in lines:
            self._handle(json.loads(line))

    def _handle(self, request: Mapping[str, Any]) -> None:
        if "command" in request:
            self._start(request)
        elif "signal" in request:
            self._signal(request["signal"])
        else:
            self._finish = request["finish"]

    def _start(self, request: Mapping[str, Any]) -> None:
        self._ledger = request["ledger"]
        self._finish_after_command = request.get("finish")
        command = request["command"]
        try:
            self._child = os.posix_spawn(
                command[0],
                command,
                {name: os.fsencode(value) for name, value in request["variables"].items()},
                setsid=True,
                setsigmask=[],
                setsigdef=[*_OWN_SIGNALS, signal.SIGCHLD],
            )
        except OSError as error:
            self._notify({"errno": error.errno})
            self._end_of_command()
            return
        _leave_pipes()
        self._next_listing = 0.0
        self._notify({"started": self._child})

    def _signal(self, number: int) -> None:
        if self._child and not self._ended:
            _send(self._child, number, group=True)

    def _notify(self, event: Mapping[str, object]) -> None:
        try:
            self._control.sendall(json.dumps(event).encode() + b"\n")
        except OSError:
            self._abandoned = True

    # -- while the command runs

    def _reap(self) -> None:
        """Reap the command and orphans."""
        while True:
            try:
                pid, status = os.waitpid(-1, os.WNOHANG)
            except ChildProcessError:
                return
            if not pid:
                return
            if pid == self._child:
                self._notify({"ended": os.waitstatus_to_exitcode(status)})
                self._end_of_command()

    def _end_of_command(self) -> None:
        self._ended = True
        if self._finish is None:
            self._finish = self._finish_after_command

    def _watch_segments(self) -> None:
        """Find the users of shared memory after a change."""
        now = time.monotonic()
        change = shared_memory.last_change()
        if change != self._last_change:
            self._last_change = change
            self._second_look = now + SECOND_LOOK
            self._note_segments()
        elif self._second_look is not None and now >= self._second_look:
            self._second_look = None
            self._note_segments()

    def _note_segments(self) -> None:
        """Record the segments that the processes use in the ledger, in case we are killed."""
        pids = [process.pid for process in table.descendants(os.getpid())]
        new = sorted(shared_memory.used_by(pids) - self._segments - self._existing)
        if not new:
            return
        self._segments.update(new)
        self._write_down({"segments": new})

    def _note_processes(self) -> None:
        """Record the processes, including this one, in the ledger, in case we are killed."""
        if time.monotonic() < self._next_listing:
            return
        self._next_listing = time.monotonic() + LISTING_PERIOD
        own = table.of_pid(os.getpid())
        processes = [*table.descendants(os.getpid()), *([own] if own else [])]
        new = {(process.pid, process.started) for process in processes} - self._processes
        if new:
            self._processes.update(new)
            self._write_down({"processes": sorted(new)})

    def _write_down(self, line: Mapping[str, object]) -> None:
        if self._ledger is None:
            return
        try:
            descriptor = os.open(self._ledger, os.O_WRONLY | os.O_APPEND | os.O_CLOEXEC)
        except OSError:
            return
        try:
            os.write(descriptor, json.dumps(line).encode() + b"\n")
        except OSError:
            return
        finally:
            os.close(descriptor)

    def _bound_output(self) -> None:
        """Free the disk space of old output."""
        for descriptor in (1, 2):
            status = os.fstat(descriptor)
            if status.st_blocks * 512 > 2 * MOST_OUTPUT:
                _punch_hole(descriptor, status.st_size - MOST_OUTPUT)

    # -- the end

    def _await_children(self, seconds: float) -> None:
        """Give the descendants of the command time to end by themselves."""
        deadline = time.monotonic() + seconds
        while time.monotonic() < deadline and self._descendants():
            time.sleep(PERIOD)

    def _descendants(self) -> list[Process]:
        self._reap()
        return table.descendants(os.getpid())

    def _end_all(self) -> list[str]:
        """End all descendants; return the command lines of those that outlived the command."""
        living = self._stop_descendants()
        left = [table.command_line(process.pid)[:SHOWN_COMMAND] for process in living]
        for process in living:
            _send(process.pid, signal.SIGTERM)
            _send(process.pid, signal.SIGCONT)
        deadline = time.monotonic() + GRACE
        while self._descendants() and time.monotonic() < deadline:
            self._watch_segments()
            time.sleep(PERIOD / 5)
        self._stop_descendants()
        deadline = time.monotonic() + GRACE_OF_KILL
        while (living := self._descendants()) and time.monotonic() < deadline:
            # The kernel kills a group at once, even one that forks all the time.
            for group in {process.group for process in living} - {os.getpgrp()}:
                _send(group, signal.SIGKILL, group=True)
            for process in living:
                _send(process.pid, signal.SIGKILL)
            self._reap()
        return left

    def _stop_descendants(self) -> list[Process]:
        """Stop all descendants and note their segments; return the processes.

        A running one could create a segment unnoticed and end without removing it. Stopped between
        creating and mapping a segment, it still has the file open.
        """
        living = self._descendants()
        for process in living:
            _send(process.pid, signal.SIGSTOP)
        deadline = time.monotonic() + GRACE_OF_STOP
        while any(map(_is_running, living)) and time.monotonic() < deadline:
            time.sleep(PERIOD / 50)
        self._note_segments()
        return living


def _is_running(process: Process) -> bool:
    now = table.of_pid(process.pid)
    return now is not None and now.started == process.started and now.state not in _STOPPED


def _leave_pipes() -> None:
    """Close the pipes of the command, as their readers wait for the end."""
    null = os.open(os.devnull, os.O_RDWR | os.O_CLOEXEC)
    for descriptor in range(3):
        if not stat.S_ISREG(os.fstat(descriptor).st_mode):
            os.dup2(null, descriptor)
    os.close(null)


def _send(pid: int, number: int, *, group: bool = False) -> None:
    try:
        (os.killpg if group else os.kill)(pid, number)
    except (ProcessLookupError, PermissionError):
        return


def _punch_hole(descriptor: int, end: int) -> None:
    """Free the blocks of a file up to an offset, without changing its size and offsets."""
    try:
        ctypes.CDLL(None).fallocate(
            descriptor,
            _KEEP_SIZE_PUNCH_HOLE,
            ctypes.c_int64(0),
            ctypes.c_int64(end),
        )
    except (OSError, AttributeError):
        return


def main() -> None:
    """Serve the socket whose descriptor is the only argument."""
    for number in _OWN_SIGNALS:
        signal.signal(number, signal.SIG_IGN)
    control = socket.socket(fileno=int(sys.argv[1]))
    control.set_inheritable(False)
    Supervisor(control).run()


if __name__ == "__main__":
    main()
