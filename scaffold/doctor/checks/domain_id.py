"""ROS_DOMAIN_ID is not a usable number."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.diagnostic import Severity
from scaffold.doctor.finding import Finding
from scaffold.doctor.machine import Machine

LAST = 232
LAST_SAFE = 101
"""The last domain with ports below those that Linux uses for outgoing connections."""


def check(machine: Machine) -> Iterator[Finding]:
    """Yield a finding if the number is out of range."""
    text = machine.variables.get("ROS_DOMAIN_ID")
    if not text:
        return
    number = int(text) if text.isascii() and text.isdigit() else -1
    if not 0 <= number <= LAST:
        yield Finding(
            Severity.ERROR,
            f"ROS_DOMAIN_ID is {text!r}: no node starts; use a number from 0 to {LAST}",
            "export ROS_DOMAIN_ID=0",
        )
    elif number > LAST_SAFE:
        yield Finding(
            Severity.WARNING,
            f"ROS_DOMAIN_ID is {number}: its ports may be in use by other programs",
            f"export ROS_DOMAIN_ID={number % (LAST_SAFE + 1)}  # a number from 0 to {LAST_SAFE}",
        )
