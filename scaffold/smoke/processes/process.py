"""Starts processes, and ends them with all their descendants."""

from __future__ import annotations

import asyncio
import json
import os
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any, BinaryIO

from scaffold.smoke.processes import table as process_table
from scaffold.smoke.processes.marks import GRACE_OF_KILL, MARK
from scaffold.smoke.processes.uninterrupted import uninterrupted

GRACE_OF_SUPERVISOR = 60.0
"""Seconds for a supervisor to end its processes and itself."""
GRACE_OF_CHILDREN = 1.0
"""Seconds that the children of a command may outlive it."""

LONGEST_EVENT = 2**24
"""The size limit of an event of a supervisor, which may have many command lines."""

_ROOT = os.path.dirname(str(Path(__file__).parent.parent.parent))
_SUPERVISE = (
    f"import sys; sys.path.append({_ROOT!r}); "
    "from scaffold.smoke.processes.supervisor import main; main()"
)
"""Runs without the site module, as that of the ROS wheels would start Python twice."""


@dataclass(frozen=True)
class Origin:
    """The run that a process belongs to."""

    mark: str
    """The mark of the process and its descendants, even without their parent."""
    ledger: Path | None = None
    """The ledger of leftovers, for cleanup by a later run."""

    def below(self, label: str) -> Origin:
        """Return the origin of a part of the run."""
        return Origin(f"{self.mark}/{label}", self.ledger)


class Running:
    """A command that is the leader of its own session and process group.

    A supervisor between it and this process ends all descendants of the command.
    """

    def __init__(
        self,
        supervisor: asyncio.subprocess.Process,
        control: tuple[asyncio.StreamReader, asyncio.StreamWriter],
        out: Path,
        err: Path,
    ) -> None:
        self.out = out
        self.err = err
        self.started = time.monotonic()
        self.group = 0
        self.exit_code: int | None = None
        """Negative for a signal that killed it; ``None`` while it runs."""
        self.lost_supervisor = False
        """Whether the supervisor was killed, by the command."""
        self._supervisor = supervisor
        self._events, self._requests = control
        self._left: list[str] = []
        self.leaked: Sequence[str] = ()
        """Paths of leftover shared memory, known once it is finished."""
        self.used: Sequence[str] = ()
        """Names of shared memory that it has used and created, known once it is finished."""
        self._is_closing = False
        self._is_started = asyncio.Event()
        self._is_ended = asyncio.Event()
        self._error: OSError | None = None
        self._reading = asyncio.create_task(self._read())

    @property
    def stdin(self) -> asyncio.StreamWriter | None:
        """The standard input of the command, if it is a pipe."""
        return self._supervisor.stdin

    @property
    def stdout(self) -> asyncio.StreamReader | None:
        """The standard output of the command, if it is a pipe."""
        return self._supervisor.stdout

    async def begin(
        self, command: Sequence[str], variables: Mapping[str, str], origin: Origin
    ) -> None:
        """Let the supervisor start the command.

        Raises:
            OSError: it cannot be started.
        """
        self._request(_configuration(command, variables, origin))
        await self._is_started.wait()
        if self._error is not None:
            raise self._error

    async def wait(self) -> None:
        """Wait for the end of the command."""
        await self._is_ended.wait()

    async def ended_within(self, seconds: float) -> bool:
        """Wait for the end with a timeout; return whether it has ended."""
        if not self._is_ended.is_set():
            with suppress(asyncio.TimeoutError):
                await asyncio.wait_for(self.wait(), max(seconds, 0.0))
        return self._is_ended.is_set()

    def signal(self, number: int) -> None:
        """Send a signal to the whole group, like ^C in a terminal."""
        self._request({"signal": int(number)})

    async def kill(self) -> None:
        """Kill the group."""
        self.signal(signal.SIGKILL)
        await self.ended_within(GRACE_OF_KILL)

    async def finish(self, grace: float = GRACE_OF_CHILDREN) -> list[str]:
        """End the remaining processes of the command; return their command lines.

        Args:
            grace: Seconds for them to end by themselves.
        """
        self._request({"finish": grace})
        await self._await_supervisor(grace)
        return self._left

    def captured(self) -> Captured:
        """Return the exit code and the output."""
        out = self.out.read_bytes().decode(errors="surrogateescape")
        err = self.err.read_bytes().decode(errors="replace")
        return Captured(self.exit_code or 0, out, err)

    async def close(self) -> None:
        """End the command and its descendants, if they have not ended."""
        self._is_closing = True
        with suppress(OSError):
            self._requests.close()
        await uninterrupted(self._await_supervisor(0.0))

    async def _await_supervisor(self, grace: float) -> None:
        try:
            await asyncio.wait_for(self._supervisor.wait(), grace + GRACE_OF_SUPERVISOR)
        except asyncio.TimeoutError:
            self._supervisor.kill()
            await self._supervisor.wait()
        await self._reading
        if self.lost_supervisor:
            _end_orphans()
        with suppress(OSError):
            self._requests.close()

    def _request(self, request: Mapping[str, object]) -> None:
        if not self._requests.is_closing():
            self._requests.write(json.dumps(request).encode() + b"\n")

    async def _read(self) -> None:
        """Process the events of the supervisor until it ends."""
        is_finished = False
        with suppress(OSError):
            async for line in self._events:
                event = json.loads(line)
                self._handle(event)
                is_finished = is_finished or "left" in event
        self.lost_supervisor = not is_finished and not self._is_closing
        if self.exit_code is None:
            self.exit_code = -signal.SIGKILL
        self._error = self._error or (None if self.group else OSError(0, "no supervisor"))
        self._is_started.set()
        self._is_ended.set()

    def _handle(self, event: Mapping[str, Any]) -> None:
        if "started" in event:
            self.group = event["started"]
            self.started = time.monotonic()
            self._is_started.set()
        elif "errno" in event:
            self._error = OSError(event["errno"], os.strerror(event["errno"]))
            self._is_started.set()
        elif "ended" in event:
            self.exit_code = event["ended"]
            self._is_ended.set()
        else:
            self._left, self.leaked, self.used = event["left"], event["leaked"], event["used"]


async def start(
    command: Sequence[str], variables: Mapping[str, str], directory: Path, origin: Origin
) -> Running:
    """Start a process in a session of its own; its output goes to files in the directory.

    Raises:
        OSError: it cannot be started.
    """
    out, err = directory / "stdout.log", directory / "stderr.log"
    with writing(out) as out_file, writing(err) as err_file:
        files = (asyncio.subprocess.DEVNULL, out_file, err_file)
        return await _start(command, variables, directory, origin, files)


async def start_with_pipes(
    command: Sequence[str],
    variables: Mapping[str, str],
    directory: Path,
    origin: Origin,
    *,
    limit: int,
) -> Running:
    """Start a process with pipes; its stderr goes to a file in the directory.

    Args:
        command: The command to run.
        variables: Its whole environment.
        directory: The working directory.
        origin: The run that it belongs to.
        limit: The maximum length of its output lines in bytes.

    Raises:
        OSError: it cannot be started.
    """
    with writing(directory / "stderr.log") as errors:
        files = (asyncio.subprocess.PIPE, asyncio.subprocess.PIPE, errors)
        return await _start(command, variables, directory, origin, files, limit=limit)


async def _start(
    command: Sequence[str],
    variables: Mapping[str, str],
    directory: Path,
    origin: Origin,
    files: tuple[int, int | IO[bytes], IO[bytes]],
    *,
    limit: int = 2**16,
) -> Running:
    ours, theirs = socket.socketpair()
    events, requests = await asyncio.open_connection(sock=ours, limit=LONGEST_EVENT)
    try:
        with theirs:
            supervisor = await asyncio.create_subprocess_exec(
                *_supervisor(theirs),
                cwd=directory,
                stdin=files[0],
                stdout=files[1],
                stderr=files[2],
                pass_fds=[theirs.fileno()],
                start_new_session=True,
                limit=limit,
            )
    except BaseException:
        requests.close()
        raise
    out, err = directory / "stdout.log", directory / "stderr.log"
    running = Running(supervisor, (events, requests), out, err)
    try:
        await running.begin(command, variables, origin)
    except BaseException:
        await running.close()
        raise
    return running


@dataclass(frozen=True)
class Captured:
    """The outcome of a short command."""

    exit_code: int
    """Negative for a signal that killed it, also after a timeout."""
    out: str
    err: str


def capture(
    command: Sequence[str], variables: Mapping[str, str], origin: Origin, timeout: float
) -> Captured:
    """Run a short command to its end, and end its descendants.

    Raises:
        OSError: it cannot be started.
    """
    ours, theirs = socket.socketpair()
    with (
        ours,
        theirs,
        subprocess.Popen(
            _supervisor(theirs),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            pass_fds=[theirs.fileno()],
            start_new_session=True,
        ) as supervisor,
    ):
        theirs.close()
        configuration = {**_configuration(command, variables, origin), "finish": 0.0}
        try:
            ours.sendall(json.dumps(configuration).encode() + b"\n")
            out, err = supervisor.communicate(timeout=timeout)
            events = [json.loads(line) for line in ours.makefile("rb")]
        except subprocess.TimeoutExpired:
            ours.close()
            out, err = supervisor.communicate()
            events = []
            err += f"\nit did not exit within {timeout:g} s\n".encode()
        finally:
            ours.close()  # in any case: the supervisor handles the rest
    reported = {name: value for event in events for name, value in event.items()}
    if "errno" in reported:
        raise OSError(reported["errno"], os.strerror(reported["errno"]))
    return Captured(
        reported.get("ended", -signal.SIGKILL),
        out.decode(errors="surrogateescape"),
        err.decode(errors="replace"),
    )


def _supervisor(control: socket.socket) -> list[str]:
    return [sys.executable, "-I", "-S", "-c", _SUPERVISE, str(control.fileno())]


def _configuration(
    command: Sequence[str], variables: Mapping[str, str], origin: Origin
) -> dict[str, object]:
    return {
        "command": list(command),
        "variables": {**variables, MARK: origin.mark},
        "ledger": None if origin.ledger is None else str(origin.ledger),
    }


def writing(path: Path) -> BinaryIO:
    """Open a file for writing, creating its directory."""
    path.parent.mkdir(parents=True, exist_ok=True)
    return path.open("wb")


def _end_orphans() -> None:
    """Kill the orphans of a killed supervisor, inherited by this process as subreaper."""
    deadline = time.monotonic() + GRACE_OF_KILL
    while time.monotonic() < deadline:
        table = process_table.snapshot()
        own = table[os.getpid()]
        orphans = [
            child
            for child in table.values()
            if child.parent == own.pid and child.session != own.session
            if child.is_alive and _SUPERVISE not in process_table.command_line(child.pid)
        ]
        if not orphans:
            return
        below = [
            descendant
            for child in orphans
            for descendant in process_table.descendants(child.pid, table)
        ]
        for process in (*below, *orphans):
            with suppress(OSError):
                os.kill(process.pid, signal.SIGKILL)
        time.sleep(0.01)
