"""CPU time and memory of a command and all its descendants."""

from __future__ import annotations

import asyncio
import os
import time
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager, suppress

from scaffold.smoke.processes import table
from scaffold.smoke.result import Usage

PERIOD = 0.5
"""Seconds between two measurements."""

_TICKS = os.sysconf("SC_CLK_TCK")
_PAGE = os.sysconf("SC_PAGE_SIZE")
_MAX_PROCESSES = 100
"""The maximum number of measured processes per executable, as a fork bomb must not keep us busy."""


class Meter:
    """Measures the session of a process."""

    def __init__(self, session: int) -> None:
        self._session = session
        self._begin: tuple[float, float] | None = None
        self._now = 0.0
        self._cpu_of: dict[tuple[int, int], float] = {}
        self._memory = 0
        self._peak = 0

    def begin(self) -> None:
        """Start measuring the load."""
        self.measure()
        self._begin = (self._now, sum(self._cpu_of.values()))

    def measure(self) -> None:
        """Measure once; ended processes keep their last values."""
        self._now = time.monotonic()
        members = [
            member for member in table.snapshot().values() if member.session == self._session
        ]
        memory = 0
        for process in members[:_MAX_PROCESSES]:
            # Ended since they were listed.
            with suppress(OSError, ValueError, IndexError):
                self._cpu_of[process.pid, process.started] = _cpu_seconds(process.pid)
                memory += _resident(process.pid)
        if memory:
            self._memory = memory
            self._peak = max(self._peak, memory)

    def usage(self) -> Usage | None:
        """Return the usage; ``None`` if it ended before the first measurement."""
        if not self._peak:
            return None
        cpu = sum(self._cpu_of.values())
        percent = None
        if self._begin is not None and self._now > self._begin[0]:
            percent = 100 * (cpu - self._begin[1]) / (self._now - self._begin[0])
        return Usage(cpu, percent, self._memory, self._peak)


@asynccontextmanager
async def measuring(session: int) -> AsyncIterator[Meter]:
    """Measure periodically until the end of the block."""
    meter = Meter(session)
    task = asyncio.create_task(_go_on(meter))
    try:
        yield meter
    finally:
        task.cancel()


async def _go_on(meter: Meter) -> None:
    while True:
        meter.measure()
        await asyncio.sleep(PERIOD)


def _cpu_seconds(pid: int) -> float:
    with open(f"/proc/{pid}/stat", "rb") as file:
        status = file.read()
    values = status[status.rindex(b")") + 2 :].split()
    return (int(values[11]) + int(values[12])) / _TICKS


def _resident(pid: int) -> int:
    with open(f"/proc/{pid}/statm", "rb") as file:
        return int(file.read().split()[1]) * _PAGE
