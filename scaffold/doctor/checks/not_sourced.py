"""ROS 2 is installed, but not sourced."""

from __future__ import annotations

import os
from collections.abc import Iterator

from scaffold.diagnostic import Severity
from scaffold.doctor.finding import Finding
from scaffold.doctor.machine import Machine


def check(machine: Machine) -> Iterator[Finding]:
    """Yield a finding if nothing is sourced."""
    if machine.prefixes or not machine.installations:
        return
    shell = os.path.basename(machine.variables.get("SHELL", "bash"))
    setup = f"setup.{'zsh' if shell == 'zsh' else 'bash'}"
    prefix = os.path.join(machine.installed, machine.installations[0])
    yield Finding(
        Severity.WARNING,
        f"ROS 2 is installed in {prefix}, but not sourced: `ros2` and `import rclpy` fail",
        f"source {prefix}/{setup}",
    )
