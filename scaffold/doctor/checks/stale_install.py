"""The install space of the workspace differs from its sources."""

from __future__ import annotations

import os
from collections.abc import Iterator
from shlex import quote

from scaffold.diagnostic import Severity
from scaffold.doctor.finding import Finding
from scaffold.doctor.machine import Machine
from scaffold.doctor.workspace import Workspace


def check(machine: Machine) -> Iterator[Finding]:
    """Yield findings for packages that were removed, changed, or never built."""
    workspace = machine.workspace
    if workspace is None:
        return
    yield from _removed_packages(workspace)
    for name, directories in workspace.sources.items():
        if len(directories) > 1:
            newest = max(directories, key=os.path.getctime)
            yield Finding(
                Severity.ERROR,
                f"two packages are called {name!r}: {', '.join(directories)}; colcon builds "
                "neither",
                f"touch {quote(os.path.join(newest, 'COLCON_IGNORE'))}  # or rename one",
            )
        elif name in workspace.installed:
            moment = workspace.built(name)
            changed = moment and workspace.changed_since(directories[0], name, moment)
            if changed:
                yield Finding(
                    Severity.WARNING,
                    f"{changed} has changed since {name!r} was built: the old code runs",
                    f"cd {quote(workspace.top)} && colcon build --packages-select {name}",
                )
        elif workspace.installed:
            yield Finding(
                Severity.INFO,
                f"{name!r} is not built",
                f"cd {quote(workspace.top)} && colcon build --packages-select {name}",
            )


def _removed_packages(workspace: Workspace) -> Iterator[Finding]:
    for name in workspace.installed:
        if name not in workspace.sources:
            prefix = workspace.installed[name]
            places = [os.path.join(workspace.top, "build", name), prefix]
            if prefix == workspace.install:
                places = [os.path.join(workspace.top, "build"), workspace.install]
            yield Finding(
                Severity.WARNING,
                f"{name!r} is installed in {workspace.install}, but no longer in src: `ros2 run` "
                "still finds it",
                f"rm -r {' '.join(map(quote, places))}",
            )
