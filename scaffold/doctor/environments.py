"""The ROS 2 environments of a machine, in the order in which ``smoke`` tries them."""

from __future__ import annotations

import os
from collections.abc import Iterator
from shlex import quote

from scaffold import distributions
from scaffold.doctor.machine import Machine, has_package
from scaffold.programs import wheels
from scaffold.record import NamedTuple

COLCON = "python3-colcon-common-extensions"


class Missing(NamedTuple):
    """A missing part of an environment, and the command that installs it."""

    what: str
    command: str


class Environment(NamedTuple):
    """A ROS 2 environment, installed or missing."""

    kind: str
    """``sourced``, ``installed`` or ``wheels``."""
    prefix: str
    """Its directory; empty if it does not exist."""
    distribution: str
    missing: list[Missing]
    reason: str
    """Why it is usable or not."""
    taken: bool = False

    @property
    def is_usable(self) -> bool:
        """Whether packages can be built and run with it."""
        return bool(self.prefix) and not self.missing


def environments(machine: Machine) -> list[Environment]:
    """Return all environments; ``smoke`` uses the first usable one."""
    every = [_sourced(machine), *_installed(machine), _wheels(machine)]
    taken = next((environment for environment in every if environment.is_usable), None)
    return [environment._replace(taken=environment is taken) for environment in every]


def _sourced(machine: Machine) -> Environment:
    distribution = machine.variables.get("ROS_DISTRO", "")
    if not machine.prefixes:
        return Environment("sourced", "", "", [], "AMENT_PREFIX_PATH is not set")
    prefix = next((path for path in machine.prefixes if has_package(path, "rclpy")), "")
    missing = list(_tools(machine))
    if not prefix:
        name = distribution or machine.distribution
        missing.insert(0, Missing("rclpy", f"sudo apt install ros-{name}-rclpy"))
    shown = prefix or machine.prefixes[-1]
    return Environment("sourced", shown, distribution, missing, "AMENT_PREFIX_PATH contains it")


def _installed(machine: Machine) -> Iterator[Environment]:
    if not machine.installations:
        yield Environment("installed", "", "", [], f"nothing in {machine.installed}")
    for name in machine.installations:
        prefix = os.path.join(machine.installed, name)
        missing = list(_tools(machine))
        if not has_package(prefix, "rclpy"):
            missing.insert(0, Missing("rclpy", f"sudo apt install ros-{name}-rclpy"))
        yield Environment("installed", prefix, name, missing, f"{prefix}/setup.bash exists")


def _wheels(machine: Machine) -> Environment:
    distribution = wheels.of(machine.own_prefix)
    command = wheels.command(distributions.named(distribution))
    if not has_package(machine.own_prefix, "rclpy"):
        missing = [Missing("the extra 'ros'", command)]
        return Environment(
            "wheels", "", "", missing, "rclpy is not installed in the environment of this tool"
        )
    needed = {"colcon": "bin/colcon", "ament_cmake": "share/ament_cmake"}
    lacking = [
        Missing(name, command)
        for name, path in needed.items()
        if not os.path.exists(os.path.join(machine.own_prefix, path))
    ]
    reason = "rclpy is installed in the environment of this tool"
    return Environment("wheels", machine.own_prefix, distribution, lacking, reason)


def colcon_command(machine: Machine) -> str:
    """Return the command that makes colcon available."""
    for prefix in machine.prefixes:
        directory = os.path.join(prefix, "bin")
        if os.access(os.path.join(directory, "colcon"), os.X_OK):  # of Python wheels
            return f"export PATH={quote(directory)}:$PATH"
    return f"sudo apt install {COLCON}"


def _tools(machine: Machine) -> Iterator[Missing]:
    if machine.python is None:
        yield Missing("python3", "sudo apt install python3")
    if machine.program("colcon") is None:
        yield Missing("colcon", colcon_command(machine))
