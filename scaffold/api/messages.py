"""Message types in Python code: classes, fields and values."""

from __future__ import annotations

from scaffold.model.messages.fields import TypeMismatches
from scaffold.model.messages.inference import (
    PARTS,
    MessageClass,
    MessageTypes,
    message_paths,
)
from scaffold.model.messages.stamps import childless, lacking, unstamped
from scaffold.model.messages.value_types import ValueTypes, rclpy_time

__all__ = [
    "PARTS",
    "MessageClass",
    "MessageTypes",
    "TypeMismatches",
    "ValueTypes",
    "childless",
    "lacking",
    "message_paths",
    "rclpy_time",
    "unstamped",
]
