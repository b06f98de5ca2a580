"""Records log messages from ``/rosout``."""

from __future__ import annotations

from importlib import import_module
from typing import Any

Ros = Any
"""Objects of rclpy, which are untyped."""

TOPIC = "/rosout"
SHOWN_LINES = 50
"""The number of lines kept for each level."""
SHOWN_CHARACTERS = 500

_DEPTH = 1000
_LEVEL_AT = 12
"""The offset of the level in a serialized message: after the encoding and the stamp."""
_LEVELS = {10: "debug", 20: "info", 30: "warn", 40: "error", 50: "fatal"}


class Log:
    """Counts lines by level and keeps the first of each.

    Args:
        node: The observing node.
        qos: The module with the profiles.
        deserialize: Deserializes a message.
    """

    def __init__(self, node: Ros, qos: Ros, deserialize: Ros) -> None:
        self._type = import_module("rcl_interfaces.msg").Log
        self._deserialize = deserialize
        self._counts: dict[str, int] = {}
        self._lines: list[dict[str, object]] = []
        profile = qos.QoSProfile(
            depth=_DEPTH,
            reliability=qos.ReliabilityPolicy.RELIABLE,
            durability=qos.DurabilityPolicy.TRANSIENT_LOCAL,
        )
        node.create_subscription(self._type, TOPIC, self._receive, profile, raw=True)

    def as_data(self) -> dict[str, object]:
        """Return the data for the report."""
        return {"counts": self._counts, "lines": self._lines}

    def _receive(self, data: bytes) -> None:
        level = _LEVELS.get(data[_LEVEL_AT] if len(data) > _LEVEL_AT else 0, "unknown")
        self._counts[level] = count = self._counts.get(level, 0) + 1
        if count > SHOWN_LINES:
            return
        line = self._deserialize(data, self._type)
        self._lines.append(
            {
                "level": level,
                "node": line.name[:SHOWN_CHARACTERS],
                "text": line.msg[:SHOWN_CHARACTERS],
                "time": line.stamp.sec + line.stamp.nanosec / 1e9,
            }
        )
