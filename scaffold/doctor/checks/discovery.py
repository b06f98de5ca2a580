"""Variables that control discovery, and their changes between distributions."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold import distributions
from scaffold.diagnostic import Severity
from scaffold.doctor.finding import Finding
from scaffold.doctor.machine import Machine

RANGES = ("SUBNET", "LOCALHOST", "OFF", "SYSTEM_DEFAULT")

_OLD = "ROS_LOCALHOST_ONLY"
"""The variable used before the discovery range."""
_TRUE = "1"


def check(machine: Machine) -> Iterator[Finding]:
    """Yield findings for variables that are ignored, deprecated or switch everything off."""
    is_old = _OLD in distributions.nearest(machine.distribution).fact("templates.only_here")
    only = machine.variables.get(_OLD, "")
    reach = machine.variables.get("ROS_AUTOMATIC_DISCOVERY_RANGE", "")
    if only and not is_old:
        instead = "export ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST"
        yield Finding(
            Severity.WARNING,
            f"ROS_LOCALHOST_ONLY is deprecated in {machine.distribution}"
            + (", and overrides ROS_AUTOMATIC_DISCOVERY_RANGE" if reach and only == _TRUE else ""),
            f"unset ROS_LOCALHOST_ONLY; {instead}" if only == _TRUE else "unset ROS_LOCALHOST_ONLY",
        )
    if reach and is_old:
        yield Finding(
            Severity.WARNING,
            f"{machine.distribution} ignores ROS_AUTOMATIC_DISCOVERY_RANGE",
            "export ROS_LOCALHOST_ONLY=1",
        )
    elif reach and reach.upper() not in RANGES:
        yield Finding(
            Severity.WARNING,
            f"ROS_AUTOMATIC_DISCOVERY_RANGE is {reach!r}, which counts as LOCALHOST",
            f"export ROS_AUTOMATIC_DISCOVERY_RANGE={RANGES[0]}  # or {', '.join(RANGES[1:])}",
        )
    elif reach.upper() == "OFF":
        yield Finding(
            Severity.WARNING,
            "ROS_AUTOMATIC_DISCOVERY_RANGE is 'OFF': nodes do not find each other, not even on "
            "this machine",
            "unset ROS_AUTOMATIC_DISCOVERY_RANGE",
        )
