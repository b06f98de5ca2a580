"""The environment refers to an installation or workspace that no longer exists."""

from __future__ import annotations

import os
from collections.abc import Iterator
from shlex import quote

from scaffold.diagnostic import Severity
from scaffold.doctor.finding import Finding
from scaffold.doctor.machine import Machine
from scaffold.doctor.shell import START_FILES


def check(machine: Machine) -> Iterator[Finding]:
    """Yield a finding for directories that no longer exist."""
    gone = [path for path in machine.prefixes if not os.path.isdir(path)]
    if not gone:
        return
    shell = os.path.basename(machine.variables.get("SHELL", ""))
    start = START_FILES.get(shell, START_FILES["bash"])
    nothing = len(gone) == len(machine.prefixes)
    yield Finding(
        Severity.ERROR if nothing else Severity.WARNING,
        f"AMENT_PREFIX_PATH contains {', '.join(gone)}, which "
        f"{'does' if len(gone) == 1 else 'do'} not exist: "
        f"{'no package' if nothing else 'nothing in it'} is found",
        f"grep -n {quote(os.path.commonpath(gone))} {start}  # remove the lines that source it, "
        "and open a new terminal",
    )
