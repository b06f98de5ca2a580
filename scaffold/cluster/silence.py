"""Detects silent workers and schedulers: a network failure may not close a connection."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable, Mapping
from typing import Any

PERIOD = 5.0
"""Seconds between two requests to the scheduler."""
PATIENCE = 30.0
"""Seconds of silence before a report; workers and schedulers send a heartbeat every second."""


class Silence:
    """Polls the scheduler, and reports workers without a recent heartbeat.

    Args:
        client: Dask's.
        tell: Called with messages for the user.
    """

    def __init__(self, client: Any, tell: Callable[[str], None]) -> None:  # noqa: ANN401  Dask's
        self._client = client
        self._tell = tell
        self._next = time.monotonic() + PERIOD
        self._heard: dict[str, tuple[float, float]] = {}
        self._told: set[str] = set()

    def has_come(self) -> bool:
        """Return whether the scheduler has been silent for long, polling it periodically."""
        if time.monotonic() < self._next:
            return False
        try:
            answer = self._client.sync(self._client.scheduler.identity, callback_timeout=PATIENCE)
        except (TimeoutError, asyncio.TimeoutError):
            return True
        except OSError:
            answer = {}  # the connection is closed: Dask itself ends waiting for results
        self._next = time.monotonic() + PERIOD
        self._look_at(answer.get("workers", {}))
        return False

    def _look_at(self, workers: Mapping[str, Mapping[str, Any]]) -> None:
        now = time.monotonic()
        for address, worker in workers.items():
            seen, since = self._heard.get(address, (None, now))
            if worker["last_seen"] != seen:
                self._heard[address] = (worker["last_seen"], now)
                self._told.discard(address)
            elif now - since >= PATIENCE and address not in self._told:
                self._told.add(address)
                self._tell(
                    f"{address} has not been heard for {now - since:.0f} s; what it was given "
                    "runs elsewhere once the scheduler gives it up "
                    "(distributed.scheduler.worker-ttl)"
                )
