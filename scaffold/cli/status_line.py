"""A status line on a terminal: the current activity and its duration."""

from __future__ import annotations

import sys
import threading
import time

from scaffold import columns
from scaffold.cli import terminal
from scaffold.printable import printable

_PERIOD = 1.0
_LONGEST_TIME = len(" 00:00:00")
_ERASE = "\r\033[K"


class StatusLine:
    """A line on standard error that is updated in place, if that is a terminal."""

    def __init__(self) -> None:
        self._is_shown = sys.stderr.isatty()
        self._text = ""
        self._begun = time.monotonic()
        self._lock = threading.RLock()  # reentrant, as a signal may interrupt this thread
        self._is_done = threading.Event()
        self._clock = threading.Thread(target=self._tick, daemon=True)

    def __enter__(self) -> StatusLine:  # noqa: PYI034  Self came with Python 3.11
        if self._is_shown:
            self._clock.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._is_done.set()
        with self._lock:
            self._text = ""
            self._draw()
        if self._is_shown:
            self._clock.join()

    def show(self, text: str) -> None:
        """Set the current activity."""
        with self._lock:
            self._text = printable(text)
            self._draw()

    def announce(self, text: str) -> None:
        """Print a permanent line above the status line."""
        with self._lock:
            if self._is_shown:
                terminal.write_error(_ERASE)
            terminal.say(f"ros2-scaffold: {text}")
            self._draw()

    def _tick(self) -> None:
        while not self._is_done.wait(_PERIOD):
            with self._lock:
                self._draw()

    def _draw(self) -> None:
        if not self._is_shown:
            return
        line = ""
        if self._text:
            passed = _clock(time.monotonic() - self._begun)
            width = columns.of_terminal(sys.stderr) or columns.USUAL
            # The last column stays free: some terminals wrap there.
            line = f"{columns.cut(self._text, width - 1 - _LONGEST_TIME)} {passed}"
        terminal.write_error(_ERASE + line)


def _clock(seconds: float) -> str:
    """Format a duration like a clock."""
    minutes, rest = divmod(int(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{rest:02}" if hours else f"{minutes}:{rest:02}"
