"""Streaming statistics in constant memory."""

from __future__ import annotations

import math
import struct

MOST_POINTS = 240
"""The number of times kept for a topic, enough for a plot."""

_HEADER_SIZE = 12
"""Bytes of a serialized message up to the end of the stamp: four that name the encoding, and two
numbers of four."""


class Spread:
    """Mean, standard deviation and extremes, with Welford's algorithm."""

    def __init__(self) -> None:
        self.count = 0
        self._mean = 0.0
        self._squares = 0.0
        self._least = math.inf
        self._greatest = -math.inf

    def add(self, value: float) -> None:
        """Add a value."""
        self.count += 1
        before = value - self._mean
        self._mean += before / self.count
        self._squares += before * (value - self._mean)
        self._least = min(self._least, value)
        self._greatest = max(self._greatest, value)

    def as_data(self) -> dict[str, float] | None:
        """Return the statistics; ``None`` if there was no value."""
        if not self.count:
            return None
        return {
            "count": self.count,
            "mean": self._mean,
            "deviation": math.sqrt(self._squares / self.count),
            "least": self._least,
            "greatest": self._greatest,
        }


class Moments:
    """Arrival times of messages: all at first, then every second, fourth and so on."""

    def __init__(self) -> None:
        self._times: list[float] = []
        self._stride = 1
        self._until_next = 1

    def add(self, moment: float) -> None:
        """Add the time of a message."""
        self._until_next -= 1
        if self._until_next:
            return
        self._times.append(moment)
        if len(self._times) > MOST_POINTS:
            self._times = self._times[::2]
            self._stride *= 2
        self._until_next = self._stride

    def rates(self) -> list[list[float]]:
        """Return pairs: seconds since the first message, and the rate in hertz until then."""
        if not self._times:
            return []
        first = self._times[0]
        return [
            [round(now - first, 4), round(self._stride / (now - before), 4)]
            for before, now in zip(self._times, self._times[1:])  # noqa: B905  any Python
            if now > before
        ]


def stamp(data: bytes) -> float | None:
    """Return the time in the header with which a serialized message begins, if it is set."""
    if len(data) < _HEADER_SIZE:
        return None
    order = "<" if data[1] & 1 else ">"
    seconds, nanoseconds = struct.unpack_from(order + "iI", data, 4)
    if not seconds and not nanoseconds:
        return None
    return float(seconds + nanoseconds / 1e9)
