"""SIGTERM and SIGHUP: they end a run as they end any program, after its cleanup."""

from __future__ import annotations

import os
import signal
from contextlib import contextmanager

TYPE_CHECKING = False  # the one of typing is slow to import
if TYPE_CHECKING:
    from collections.abc import Iterator
    from types import FrameType

SIGNALS = (signal.SIGTERM, signal.SIGHUP)


class Termination(KeyboardInterrupt):
    """A signal ends the run; what handles Ctrl-C handles it as well."""

    def __init__(self, number: int) -> None:
        super().__init__(number)
        self.number = number


@contextmanager
def cleaned_up() -> Iterator[None]:
    """Let SIGTERM and SIGHUP end the block with its cleanup, and then the process, silently."""
    ours = [number for number in SIGNALS if signal.getsignal(number) == signal.SIG_DFL]
    try:
        for number in ours:  # ignored ones stay ignored, as with nohup
            signal.signal(number, _terminate)
        yield
    except Termination as end:
        signal.signal(end.number, signal.SIG_DFL)
        os.kill(os.getpid(), end.number)
        raise  # not reached
    finally:
        for number in ours:
            signal.signal(number, signal.SIG_DFL)


def leave_to_default() -> None:
    """Let the signals end this process, a child of the run, at once, even if it began blocked."""
    for number in SIGNALS:
        signal.signal(number, signal.SIG_DFL)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, SIGNALS)


def _terminate(number: int, _: FrameType | None) -> None:
    for other in SIGNALS:
        signal.signal(other, signal.SIG_IGN)  # a second one must not cut the cleanup short
    raise Termination(number)
