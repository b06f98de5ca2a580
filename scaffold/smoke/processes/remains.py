"""Processes and shared memory that remain after a command has ended."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from scaffold.smoke.processes.process import Running


@dataclass(frozen=True)
class Remains:
    """A process or segment that remained and was ended or removed."""

    commands: tuple[str, ...]
    """The names of the commands that may have left it: several may use the same shared memory."""
    message: str
    """Such as ``leaves a process running: sleep 600``."""


async def remains(runs: Mapping[str, Running]) -> list[Remains]:
    """Finish commands that have ended; return their leftovers.

    They are finished together, as they may share segments.

    Args:
        runs: The commands by name.
    """
    left = await asyncio.gather(*(running.finish() for running in runs.values()))
    return [
        *(
            Remains((name,), f"leaves a process running: {child}")
            for name, children in zip(runs, left, strict=True)
            for child in children
        ),
        *_shared_memory(runs),
        *(
            Remains((name,), "killed the process that started it")
            for name, running in runs.items()
            if running.lost_supervisor
        ),
    ]


def _shared_memory(runs: Mapping[str, Running]) -> Iterator[Remains]:
    for path in sorted({path for running in runs.values() for path in running.leaked}):
        segment = Path(path).name
        users = tuple(name for name, running in runs.items() if segment in running.used)
        yield Remains(users, f"leaves shared memory behind: {path}")
