"""The quality of service of publishers and subscriptions."""

from __future__ import annotations

from typing import Any

Ros = Any
"""Objects of rclpy, which are untyped."""

FOREVER = 10**9
"""Seconds: middlewares differ in the number that means no limit; all are above."""

_POLICIES = ("reliability", "durability", "history", "liveliness")
_DURATIONS = ("deadline", "lifespan", "liveliness_lease_duration")


def as_data(profile: Ros) -> dict[str, object]:
    """Return a profile as JSON data: names in lower case, and seconds or ``None`` for no limit.

    Values that the middleware does not report are ``unknown``, and a depth is 0.
    """
    data: dict[str, object] = {
        name: getattr(profile, name).name.lower() for name in _POLICIES if hasattr(profile, name)
    }
    data["depth"] = profile.depth
    for name in _DURATIONS:
        seconds = getattr(profile, name).nanoseconds / 1e9
        data[name] = seconds if 0 < seconds < FOREVER else None
    return data


def endpoint(kind: str, info: Ros) -> dict[str, object]:
    """Return a publisher or a subscription of a topic."""
    return {
        "kind": kind,
        "node": f"{info.node_namespace.rstrip('/')}/{info.node_name}",
        "type": info.topic_type,
        "qos": as_data(info.qos_profile),
    }
