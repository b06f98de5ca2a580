"""The active Python environment does not work with ROS 2."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

from scaffold.diagnostic import Severity
from scaffold.doctor.finding import Finding
from scaffold.doctor.machine import Machine, has_package


def check(machine: Machine) -> Iterator[Finding]:
    """Yield a finding if the packages of the system are hidden from Python."""
    conda = machine.variables.get("CONDA_PREFIX")
    if conda and machine.prefixes and not any(path.startswith(conda) for path in machine.prefixes):
        yield Finding(
            Severity.WARNING,
            f"the conda environment {conda} is active: its Python and libraries differ from "
            "those that ROS 2 was built with",
            "conda deactivate",
        )
    active = machine.variables.get("VIRTUAL_ENV")
    has_system_ros = bool(machine.prefixes or machine.installations)
    if not active or not has_system_ros or has_package(active, "rclpy"):
        return
    try:
        settings = Path(active, "pyvenv.cfg").read_text(encoding="utf-8", errors="replace")
    except OSError:
        return
    pairs = (line.partition("=") for line in settings.splitlines())
    stated = {name.strip(): value.strip().lower() for name, _, value in pairs}
    if stated.get("include-system-site-packages") != "true":
        yield Finding(
            Severity.WARNING,
            f"the virtual environment {active} has no access to system packages such as numpy "
            "and yaml, which rclpy and colcon need",
            f"python3 -m venv --system-site-packages {active} && touch "
            f"{os.path.join(active, 'COLCON_IGNORE')}",
        )
