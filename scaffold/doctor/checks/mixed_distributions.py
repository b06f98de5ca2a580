"""Two distributions of ROS are mixed in one shell or one workspace."""

from __future__ import annotations

import os
from collections.abc import Iterator
from shlex import quote

from scaffold.diagnostic import Severity
from scaffold.doctor.finding import Finding
from scaffold.doctor.machine import Machine
from scaffold.doctor.shell import START_FILES

_VARIABLES = (
    "AMENT_PREFIX_PATH", "CMAKE_PREFIX_PATH", "COLCON_PREFIX_PATH", "PYTHONPATH",
    "LD_LIBRARY_PATH", "PATH",
)  # fmt: skip


def check(machine: Machine) -> Iterator[Finding]:
    """Yield findings for the variables, and for the underlays of the workspace."""
    places: dict[str, list[str]] = {}
    for variable in _VARIABLES:
        for path in machine.paths(variable):
            name = machine.distribution_of(path)
            if name is not None and variable not in places.setdefault(name, []):
                places[name].append(variable)
    if len(places) > 1:
        where = "; ".join(f"{name} in {', '.join(places[name])}" for name in sorted(places))
        yield Finding(
            Severity.ERROR,
            f"two distributions are sourced in one shell: {where}; their libraries are "
            "incompatible",
            _keep_one(machine),
        )
    named = machine.variables.get("ROS_DISTRO")
    every = map(machine.distribution_of, machine.prefixes)
    sourced = {name for name in every if name is not None}
    if named and sourced and named not in sourced:
        yield Finding(
            Severity.ERROR,
            f"ROS_DISTRO is {named!r}, but AMENT_PREFIX_PATH contains {', '.join(sorted(sourced))}",
            _keep_one(machine),
        )
    yield from _of_workspace(machine, sourced)


def _keep_one(machine: Machine) -> str:
    shell = os.path.basename(machine.variables.get("SHELL", ""))
    start = START_FILES.get(shell, START_FILES["bash"])
    return (
        f"grep -n {machine.installed}/ {start}  # keep the lines of one distribution, and open a "
        "new terminal"
    )


def _of_workspace(machine: Machine, sourced: set[str]) -> Iterator[Finding]:
    workspace = machine.workspace
    if workspace is None:
        return
    built_on = map(machine.distribution_of, workspace.chained())
    strange = {name for name in built_on if name is not None}
    strange -= sourced or set(machine.installations)
    if strange:
        yield Finding(
            Severity.ERROR,
            f"{workspace.install} was built with {', '.join(sorted(strange))}, which its setup "
            "files source",
            f"cd {quote(workspace.top)} && rm -r build install && colcon build",
        )
