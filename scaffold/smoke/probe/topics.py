"""Records the messages of a topic."""

from __future__ import annotations

import time
from typing import Any

from .messages import as_data
from .statistics import Moments, Spread, stamp

Ros = Any
"""Objects of rclpy, which are untyped."""

SHOWN_MESSAGES = 5
QUEUE_DEPTH = 1000
"""The maximum queue depth: two seconds of a topic at 500 Hz."""
QUEUE_BYTES = 2**28
"""The size limit of the queue of a topic: that of large messages is shortened if they wait long."""
LONG_WAIT = 1.0
"""Seconds in the queue from which the observer does not keep up."""

_HEADER = "std_msgs/Header"
_SEQUENCE_UNSUPPORTED = 2**64 - 1


class Topic:
    """The messages received on a topic; source times are those of ``time.time``, in seconds."""

    def __init__(self) -> None:
        self.count = 0
        self.error: str | None = None
        self.subscription: Ros = None
        self.profile: tuple[bool, bool] | None = None
        """Whether all publishers are reliable, and whether all are transient local."""
        self.depth = QUEUE_DEPTH
        self._first = 0.0
        self._last = 0.0
        self._first_number = 0
        self._last_number = 0
        self._messages: list[object] = []
        self._intervals = Spread()
        self._sizes = Spread()
        self._bytes = 0
        self._delays = Spread()
        self._transports = Spread()
        self._moments = Moments()
        self._is_late = False

    def take(self, data: bytes, info: dict[str, int], message_type: Ros) -> None:
        """Record a serialized message and its metadata from the middleware."""
        now = _sending(info)
        self.count += 1
        if self.count == 1:
            self._first = now
            self._first_number = _number(info)
        else:
            self._intervals.add(max(now - self._last, 0.0))
        self._last = now
        self._last_number = _number(info)
        self._moments.add(now)
        self._bytes += len(data)
        self._sizes.add(len(data))
        self._take_times(data, info, message_type)

    def keep(self, data: bytes, message_type: Ros, deserialize: Ros) -> None:
        """Keep a message for the report."""
        try:
            self._messages.append(as_data(deserialize(data, message_type)))
        except Exception as error:  # noqa: BLE001  what cannot be decoded is a finding
            self.error = f"{type(error).__name__}: {error}"

    def fitting_depth(self) -> int:
        """Return the queue depth for messages as large as the observed ones.

        A new queue loses messages, so it is only shortened where messages wait.
        """
        sizes = self._sizes.as_data()
        if sizes is None or not self._is_late:
            return QUEUE_DEPTH
        return max(1, min(QUEUE_DEPTH, int(QUEUE_BYTES // max(sizes["greatest"], 1))))

    def as_report(self, *, publishers: int) -> dict[str, object]:
        """Return the data for the report."""
        lost = self._last_number - self._first_number + 1 - self.count
        return {
            "count": self.count,
            "first": self._first,
            "last": self._last,
            "messages": self._messages,
            "error": self.error,
            "lost": lost if publishers == 1 and self._first_number and lost >= 0 else None,
            "interval": self._intervals.as_data(),
            "bytes": self._bytes,
            "size": self._sizes.as_data(),
            "delay": self._delays.as_data(),
            "transport": self._transports.as_data(),
            "rates": self._moments.rates(),
        }

    def _take_times(self, data: bytes, info: dict[str, int], message_type: Ros) -> None:
        """Record the age of a message when it was sent, and its transport time."""
        sent, received = info.get("source_timestamp"), info.get("received_timestamp")
        if not sent:
            return
        if received and time.time() - received / 1e9 > LONG_WAIT:
            self._is_late = True
        if received and received >= sent:
            self._transports.add((received - sent) / 1e9)
        fields = message_type.get_fields_and_field_types()
        if next(iter(fields.values()), "") == _HEADER:
            stamped = stamp(data)
            if stamped is not None:
                self._delays.add(sent / 1e9 - stamped)


def _number(info: dict[str, int]) -> int:
    """Return the sequence number of a message; 0 if the middleware has none."""
    number = info.get("publication_sequence_number") or 0
    return 0 if number >= _SEQUENCE_UNSUPPORTED else number


def _sending(info: dict[str, int]) -> float:
    """Return the source timestamp of a message from the middleware.

    The receiving time depends on this process, and latched messages arrive at once.
    """
    sent = info.get("source_timestamp") or info.get("received_timestamp")
    return sent / 1e9 if sent else time.time()
