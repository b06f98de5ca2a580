"""Builds messages from plain data, and reads values of their fields."""

from __future__ import annotations

from typing import Any

from scaffold import lazy_re

from .messages import find_type

Ros = Any
"""Objects of rclpy, which are untyped."""

_STEP = lazy_re.compile(r"[^.\[\]]+")
_ELEMENTS = lazy_re.compile(r"sequence<(?P<bounded>[^,>]+)(?:, ?\d+)?>|(?P<array>[^\[]+)\[\d*\]")


def fill(message: Ros, values: dict[str, Ros]) -> Ros:
    """Set fields of a message; return it.

    Raises:
        ValueError: a field does not exist, or cannot have the value.
    """
    kinds = message.get_fields_and_field_types()
    if hasattr(message, "_check_fields"):
        message._check_fields = True  # noqa: SLF001  a wrong value would crash the serialization
    for name, value in values.items():
        if name not in kinds:
            raise ValueError(f"no field {name!r}; there are {', '.join(kinds) or 'none'}")
        try:
            setattr(message, name, _converted(getattr(message, name), value, kinds[name]))
        except (AssertionError, TypeError, OverflowError) as error:
            raise ValueError(f"{name!r} cannot be {value!r}: {error}") from error
    return message


def field_of(message: Ros, path: str) -> Ros:
    """Return the value of a field such as ``header.stamp.sec`` or ``ranges[0]``.

    Raises:
        ValueError: there is none.
    """
    for step in _STEP.findall(path):
        try:
            message = message[int(step)] if step.isdigit() else getattr(message, step)
        except (AttributeError, IndexError, TypeError) as error:
            raise ValueError(f"no field {path!r}") from error
    return message


def _converted(old: Ros, value: Ros, kind: str) -> Ros:
    if hasattr(old, "get_fields_and_field_types"):
        if not isinstance(value, dict):
            raise TypeError("it has fields")
        return fill(old, value)
    if isinstance(old, float):
        return float(value)
    if isinstance(old, bytes) and isinstance(value, int):
        return bytes([value])
    elements = _ELEMENTS.fullmatch(kind)
    if elements is not None and isinstance(value, list):
        return _list(value, elements["bounded"] or elements["array"])
    return value


def _list(values: list[Ros], kind: str) -> list[Ros]:
    if "/" in kind:
        package, _, name = kind.rpartition("/")
        of_elements = find_type(f"{package}/msg/{name}")
        return [fill(of_elements(), value) for value in values]
    if kind in {"float", "double"}:
        return [float(value) for value in values]
    if kind == "octet":
        return [bytes([value]) for value in values]
    return values
