"""Signals that interrupt a run, and how the run reacts."""

from __future__ import annotations

import asyncio
import signal
import threading
from collections.abc import Callable, Coroutine, Iterator
from contextlib import contextmanager
from types import FrameType, TracebackType
from typing import Any, TypeVar

Result = TypeVar("Result")

SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
"""Signals of ^C, of systemd and containers, and of a closed terminal."""


class InterruptedBySignalError(BaseException):
    """A signal ended the run, with everything that it started; ``number`` is the signal."""

    def __init__(self, number: int) -> None:
        super().__init__(number)
        self.number = number


class Interruption:
    """Converts the first signal to one exception, at a safe moment.

    A second signal is ignored, as it must not cut the cleanup short. Outside of the main
    thread no signal arrives, and nothing is done. The context manager is reentrant.
    """

    def __init__(self) -> None:
        self._number: int | None = None
        self._action: Callable[[], None] | None = None
        self._previous: dict[int, Any] = {}
        self._depth = 0

    def __enter__(self) -> Interruption:  # noqa: PYI034  Self came with Python 3.11
        self._depth += 1
        if self._depth > 1:
            return self
        if threading.current_thread() is threading.main_thread():
            for number in SIGNALS:
                previous = signal.getsignal(number)
                # With nohup, a run is supposed to outlive its terminal.
                if not (number == signal.SIGHUP and previous == signal.SIG_IGN):
                    self._previous[number] = previous
                    signal.signal(number, self._on_signal)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._depth -= 1
        if not self._depth:
            for number, previous in self._previous.items():
                signal.signal(number, previous)

    def check(self) -> None:
        """Raise if a signal has arrived.

        Raises:
            InterruptedBySignalError: a signal ended the run.
        """
        if self._number is not None:
            raise InterruptedBySignalError(self._number)

    @contextmanager
    def at_once(self) -> Iterator[None]:
        """Let a signal end the block immediately.

        Raises:
            InterruptedBySignalError: a signal ended the run.
        """
        previous, self._action = self._action, self.check
        try:
            self.check()
            yield
        finally:
            self._action = previous

    @contextmanager
    def later(self) -> Iterator[None]:
        """Delay a signal until `check`, as the cleanup must not be cut short."""
        previous, self._action = self._action, None
        try:
            yield
        finally:
            self._action = previous

    def run(
        self,
        main: Callable[[], Coroutine[Any, Any, Result]],
        tell: Callable[[], None] = lambda: None,
    ) -> Result:
        """Run a coroutine, which is cancelled when a signal arrives.

        Args:
            main: Returns the coroutine.
            tell: Called when a signal has arrived, as the cleanup may take a while.

        Raises:
            InterruptedBySignalError: a signal ended the run.
        """

        async def cancellable() -> Result:
            task = asyncio.current_task()
            loop = asyncio.get_running_loop()
            if task is not None:
                cancel = task.cancel
                self._action = lambda: _schedule(loop, tell, cancel)
            self.check()
            return await main()

        previous = self._action
        try:
            return asyncio.run(cancellable())
        except asyncio.CancelledError:
            self.check()
            raise
        finally:
            self._action = previous

    def _on_signal(self, number: int, _: FrameType | None) -> None:
        if self._number is None:
            self._number = number
            if self._action is not None:
                self._action()


def _schedule(loop: asyncio.AbstractEventLoop, *actions: Callable[[], object]) -> None:
    for action in actions:
        if not loop.is_closed():
            loop.call_soon_threadsafe(action)
