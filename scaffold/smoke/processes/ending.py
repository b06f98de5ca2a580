"""Ends a process with signals, and reports which were needed."""

from __future__ import annotations

import signal
import time
from dataclasses import dataclass

from scaffold.smoke.processes.process import Running

GRACE = 5.0
"""Seconds for an executable to obey a signal."""
GRACE_OF_NEXT = 2.0
"""Seconds for the next signals, once the first was ignored."""


@dataclass(frozen=True)
class Ending:
    """How a process was ended."""

    asked: str
    """The first signal."""
    sent: tuple[str, ...]
    """All signals sent; only one if it was obeyed."""
    seconds: float
    grace: float = GRACE
    """Seconds allowed for the first one."""

    @property
    def was_ignored(self) -> bool:
        """Return whether the first signal did not end it."""
        return len(self.sent) > 1

    @property
    def was_missed(self) -> bool:
        """Return whether it ignored a signal once, and then obeyed."""
        return self.sent == (self.asked, self.asked)

    @property
    def of_ignored(self) -> str:
        """Describe what ended it instead of the first signal."""
        last = "a second one" if self.was_missed else self.sent[-1]
        return f"ignored {self.asked}: still running after {self.grace:g} s, {last} ended it"


async def end(running: Running, number: signal.Signals, grace: float = GRACE) -> Ending:
    """Send a signal to the group; if ignored, send it again, then stronger ones."""
    begun, seconds = time.monotonic(), grace
    sent: list[str] = []
    for item in (number, number, *{signal.SIGTERM} - {number}, signal.SIGKILL):
        sent.append(item.name)
        running.signal(item)
        if await running.ended_within(grace):
            break
        grace = GRACE_OF_NEXT
    return Ending(number.name, tuple(sent), time.monotonic() - begun, seconds)
