"""The loopback interface is down, or has no multicast."""

from __future__ import annotations

import os
from collections.abc import Iterator

from scaffold.diagnostic import Severity
from scaffold.doctor.finding import Finding
from scaffold.doctor.machine import Machine

_UP = 0x1
_MULTICAST = 0x1000


def check(machine: Machine) -> Iterator[Finding]:
    """Yield a finding if nodes on this machine may not find each other."""
    try:
        with open(os.path.join(machine.network, "lo", "flags"), encoding="ascii") as file:
            flags = int(file.read(), 16)
    except (OSError, ValueError):
        return
    if not flags & _UP:
        yield Finding(
            Severity.ERROR,
            "the loopback interface is down: nodes do not discover each other",
            "sudo ip link set lo up",
        )
    elif not flags & _MULTICAST:
        needs_it = machine.variables.get("RMW_IMPLEMENTATION") == "rmw_cyclonedds_cpp"
        yield Finding(
            Severity.WARNING if needs_it else Severity.INFO,
            "multicast is off on the loopback interface: without another network, nodes with "
            "Cyclone DDS do not discover each other",
            "sudo ip link set lo multicast on",
        )
