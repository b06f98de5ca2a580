"""ROS 2 is installed, but colcon is not."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.diagnostic import Severity
from scaffold.doctor.environments import colcon_command
from scaffold.doctor.finding import Finding
from scaffold.doctor.machine import Machine


def check(machine: Machine) -> Iterator[Finding]:
    """Yield a finding if there is no colcon on the search path."""
    has_ros = bool(machine.prefixes or machine.installations)
    if has_ros and machine.program("colcon") is None:
        yield Finding(
            Severity.ERROR,
            "colcon is not on PATH: packages cannot be built",
            colcon_command(machine),
        )
