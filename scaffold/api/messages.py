"""Message types in Python code: classes, fields and values."""

from __future__ import annotations

from scaffold.model.messages.fields import TypeMismatches, ValueTypes, rclpy_time
from scaffold.model.messages.inference import (
    PARTS,
    MessageClass,
    MessageTypes,
    interfaces_named,
    message_paths,
)
from scaffold.model.messages.stamps import unstamped

__all__ = [
    "PARTS",
    "MessageClass",
    "MessageTypes",
    "TypeMismatches",
    "ValueTypes",
    "interfaces_named",
    "message_paths",
    "rclpy_time",
    "unstamped",
]
