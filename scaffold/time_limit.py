"""A limit on the CPU time spent on one file."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from functools import lru_cache
from types import FrameType

from scaffold.errors import OutOfTimeError

SECONDS = 30.0
"""Of CPU for one rule on one package, or for the style of one file; the slowest of 800 public
packages takes less than one."""


@contextmanager
def limited(seconds: float = SECONDS) -> Iterator[None]:
    """Raise OutOfTimeError in the block each time it has used up the CPU time limit.

    CPU time does not depend on the load of the machine. Outside of the main thread there
    is no limit, as Python only delivers signals to that one.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    _handle()
    signal.setitimer(signal.ITIMER_VIRTUAL, seconds, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)


@lru_cache(maxsize=1)
def _handle() -> None:
    """Install the signal handler: doing so for each of 300 rules took a tenth of their time."""
    signal.signal(signal.SIGVTALRM, _expire)


def _expire(_number: int, _frame: FrameType | None) -> None:
    raise OutOfTimeError
