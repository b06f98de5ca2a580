"""Quality of service as a user names it, and as rclpy writes it."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import NamedTuple

from scaffold.errors import InputError

MAX_DEPTH = 10_000


class Qos(NamedTuple):
    """The third argument of ``create_publisher``."""

    expression: str
    imports: tuple[str, ...]
    says: str
    """What it means, for people."""


_PROFILES: Mapping[str, str] = {
    "action_status_default": "reliable, late subscribers get the last message",
    "parameter_events": "reliable, depth 1000",
    "parameters": "reliable, depth 1000",
    "sensor_data": "best effort, depth 5",
    "services_default": "reliable, depth 10",
    "system_default": "what the middleware has as its default",
}
"""The profiles of ``rclpy.qos`` that suit a topic."""

NAMES = ("default", *_PROFILES)


def qos(text: str) -> Qos:
    """Return a quality of service for a depth or a name as ``ros2 topic`` has them.

    Raises:
        InputError: it is neither.
    """
    if text == "default":
        text = "10"
    if re.fullmatch(r"[0-9]{1,9}", text) and 0 < int(text) <= MAX_DEPTH:
        return Qos(str(int(text)), (), f"reliable, depth {int(text)}")
    if text in _PROFILES:
        name = f"qos_profile_{text}"
        return Qos(name, (f"from rclpy.qos import {name}",), f"{text}: {_PROFILES[text]}")
    raise InputError(
        f"the quality of service {text!r} is neither a depth from 1 to {MAX_DEPTH} nor one of "
        f"{', '.join(NAMES)}"
    )
