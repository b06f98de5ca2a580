"""Message types in Python code: classes, fields and values."""

from __future__ import annotations

from scaffold.model.messages.classes import PARTS, MessageClass
from scaffold.model.messages.expected_errors import is_error_expected
from scaffold.model.messages.fields import TypeMismatches
from scaffold.model.messages.files import message_paths
from scaffold.model.messages.inference import Assigned, MessageTypes
from scaffold.model.messages.stamps import childless, lacking, unstamped
from scaffold.model.messages.value_types import ValueTypes, kind_of_field, rclpy_time

__all__ = [
    "PARTS",
    "Assigned",
    "MessageClass",
    "MessageTypes",
    "TypeMismatches",
    "ValueTypes",
    "childless",
    "is_error_expected",
    "kind_of_field",
    "lacking",
    "message_paths",
    "rclpy_time",
    "unstamped",
]
