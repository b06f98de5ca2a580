"""Finds the processes of a run by a mark in their environment."""

from __future__ import annotations

import os
import signal
import time
from collections.abc import Mapping
from pathlib import Path

from scaffold.smoke.processes import table as process_table

MARK = "ROS2_SCAFFOLD_SMOKE"
"""The variable that identifies the processes of a run, even without their parent."""
GRACE_OF_KILL = 5.0
"""Seconds for the kernel to end a process."""


def marked(mark: str) -> dict[int, str]:
    """Return the living processes with a mark or one below it, with their command lines."""
    wanted = os.fsencode(f"{MARK}={mark}")
    result: dict[int, str] = {}
    for name in os.listdir("/proc"):
        if not name.isdigit():
            continue
        try:
            environment = Path("/proc", name, "environ").read_bytes()
        except OSError:  # it has ended meanwhile, or belongs to another user
            continue
        if any(_is_below(entry, wanted) for entry in environment.split(b"\0")):
            result[int(name)] = process_table.command_line(int(name))
    result.pop(os.getpid(), None)
    return result


def sweep(mark: str) -> list[str]:
    """Kill the processes with a mark; return their command lines."""
    killed: list[str] = []
    for _ in range(3):  # processes started while the list is read are caught in the next round
        alive = marked(mark)
        if not alive:
            break
        for pid, command in alive.items():
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                continue
            killed.append(command)
        _await_end(alive)
    return killed


def _await_end(pids: Mapping[int, str]) -> None:
    deadline = time.monotonic() + GRACE_OF_KILL
    while time.monotonic() < deadline:
        if not any(os.path.exists(f"/proc/{pid}/exe") for pid in pids):
            return
        time.sleep(0.01)


def _is_below(entry: bytes, wanted: bytes) -> bool:
    return entry == wanted or entry.startswith(wanted + b"/")
