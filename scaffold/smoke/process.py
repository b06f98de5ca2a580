"""Starting processes and ending them, with all that they have started."""

from __future__ import annotations

import asyncio
import os
import signal
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

MARK = "ROS2_SCAFFOLD_SMOKE"
"""The variable by which a process of a run is known, whatever has become of its parent."""

GRACE = 5.0
"""Seconds that an executable has to obey a signal."""
GRACE_OF_NEXT = 2.0
"""Seconds that it has to obey the next one, once it has ignored the first."""
GRACE_OF_KILL = 5.0
"""Seconds that the kernel has to end a process."""


@dataclass
class Running:
    """A process that leads a session, and so a process group, of its own."""

    process: asyncio.subprocess.Process
    out: Path
    err: Path
    started: float

    @property
    def group(self) -> int:
        """The process group."""
        return self.process.pid

    @property
    def exit_code(self) -> int | None:
        """Negative for a signal that killed it; ``None`` while it runs."""
        return self.process.returncode

    async def ended_within(self, seconds: float) -> bool:
        """Wait for the end at most so long; tell whether it came."""
        if self.process.returncode is not None:
            return True
        try:
            await asyncio.wait_for(self.process.wait(), max(seconds, 0.0))
        except asyncio.TimeoutError:
            return False
        return True

    def signal(self, number: int) -> None:
        """Send a signal to the whole group, as ^C in a terminal does."""
        try:
            os.killpg(self.group, number)
        except ProcessLookupError:
            return

    async def kill(self) -> None:
        """End the group in the way that cannot be ignored."""
        self.signal(signal.SIGKILL)
        await self.ended_within(GRACE_OF_KILL)


async def start(
    command: Sequence[str], variables: Mapping[str, str], directory: Path, mark: str
) -> Running:
    """Start a process in a session of its own; its output goes to files in the directory.

    Raises:
        OSError: it cannot be started.
    """
    out, err = directory / "stdout.log", directory / "stderr.log"
    with writing(out) as out_file, writing(err) as err_file:
        process = await asyncio.create_subprocess_exec(
            *command,
            env={**variables, MARK: mark},
            cwd=directory,
            stdin=asyncio.subprocess.DEVNULL,
            stdout=out_file,
            stderr=err_file,
            start_new_session=True,
        )
    return Running(process, out, err, time.monotonic())


def writing(path: Path) -> BinaryIO:
    """Open a file for writing in a directory that need not exist."""
    path.parent.mkdir(parents=True, exist_ok=True)
    return path.open("wb")


@dataclass(frozen=True)
class Ending:
    """How a process was ended."""

    asked: str
    """The first signal that was sent."""
    sent: tuple[str, ...]
    """All of them: one if it was obeyed."""
    seconds: float

    @property
    def was_ignored(self) -> bool:
        """Tell whether the first signal did not end it."""
        return len(self.sent) > 1

    @property
    def was_missed(self) -> bool:
        """Tell whether it did not react once, and then did."""
        return self.sent == (self.asked, self.asked)


async def end(running: Running, number: signal.Signals, grace: float = GRACE) -> Ending:
    """Send a signal to the group; where it is ignored, again, then what is harder to ignore."""
    begun = time.monotonic()
    sent: list[str] = []
    for one in (number, number, *{signal.SIGTERM} - {number}, signal.SIGKILL):
        sent.append(one.name)
        running.signal(one)
        if await running.ended_within(grace):
            break
        grace = GRACE_OF_NEXT
    return Ending(number.name, tuple(sent), time.monotonic() - begun)


def marked(mark: str) -> dict[int, str]:
    """Return the living processes of a mark, or of marks below it, with their command lines."""
    wanted = os.fsencode(f"{MARK}={mark}")
    found: dict[int, str] = {}
    for name in os.listdir("/proc"):
        if not name.isdigit():
            continue
        try:
            environment = Path("/proc", name, "environ").read_bytes()
            if not any(_is_below(entry, wanted) for entry in environment.split(b"\0")):
                continue
            command = Path("/proc", name, "cmdline").read_bytes()
        except OSError:  # it has ended meanwhile, or belongs to somebody else
            continue
        found[int(name)] = command.replace(b"\0", b" ").decode("utf-8", "replace").strip()
    found.pop(os.getpid(), None)
    return found


def sweep(mark: str) -> list[str]:
    """Kill the processes of a mark; return their command lines."""
    killed: list[str] = []
    for _ in range(3):  # what is started while the list is read is caught in the next round
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
