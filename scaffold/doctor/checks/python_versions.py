"""PYTHONPATH has directories of another Python version than the running one."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.diagnostic import Severity
from scaffold.doctor.finding import Finding
from scaffold.doctor.machine import Machine, python_in


def check(machine: Machine) -> Iterator[Finding]:
    """Yield a finding if extension modules such as those of rclpy will not be found."""
    running = machine.python_version
    if running is None:
        return
    others: dict[str, str] = {}
    for path in machine.paths("PYTHONPATH"):
        version = python_in(path)
        if version is not None and version != running:
            others.setdefault(version, path)
    for _, path in sorted(others.items()):
        yield Finding(
            Severity.ERROR,
            f"PYTHONPATH names {path}, but python3 is {running} ({machine.python}): compiled "
            "modules, such as those of rclpy, are not found",
            f"unset PYTHONPATH  # then source a ROS 2 for Python {running}",
        )
