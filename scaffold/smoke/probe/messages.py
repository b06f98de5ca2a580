"""Converts messages to JSON data."""

from __future__ import annotations

import math
import struct
from importlib import import_module
from typing import Any

Ros = Any
"""Objects of rclpy, which are untyped."""

SHOWN_ELEMENTS = 16
SHOWN_CHARACTERS = 500


def find_type(name: str) -> Ros:
    """Return the class of a type such as ``std_msgs/msg/String``."""
    package, kind, message = name.split("/")
    return getattr(import_module(f"{package}.{kind}"), message)


def as_data(message: Ros) -> dict[str, object]:
    """Return a message as JSON data; long sequences and texts end in an ellipsis."""
    fields = message.get_fields_and_field_types()
    return {field: _field(getattr(message, field), kind) for field, kind in fields.items()}


def plain(value: Ros) -> object:
    """Return the value of a field as JSON data."""
    return None if value is None else _field(value, "")


def _field(value: Ros, kind: str) -> object:
    if hasattr(value, "get_fields_and_field_types"):
        return as_data(value)
    if isinstance(value, float):
        return _number(value, single=kind == "float")
    if isinstance(value, str) and len(value) > SHOWN_CHARACTERS:
        return value[:SHOWN_CHARACTERS] + "..."
    if isinstance(value, bytes) and len(value) == 1:  # a field of the type ``byte``
        return value[0]
    if isinstance(value, (bool, int, str)):
        return value
    return _sequence(value, kind)


def _sequence(values: Ros, kind: str) -> list[object]:
    """Return the first elements of a list, an array or bytes."""
    element = "float" if kind.startswith(("float[", "sequence<float")) else ""
    first = values[:SHOWN_ELEMENTS]
    plain = first.tolist() if hasattr(first, "tolist") else first
    shown = [_field(value, element) for value in plain]
    return [*shown, "..."] if len(values) > SHOWN_ELEMENTS else shown


def _number(value: float, *, single: bool) -> object:
    """Return a number for JSON; a float32 without spurious digits."""
    if not math.isfinite(value):
        return str(value)
    if not single:
        return value
    stored = struct.pack("f", value)
    for digits in range(6, 9):
        shorter = float(f"{value:.{digits}g}")
        if struct.pack("f", shorter) == stored:
            return shorter
    return value
