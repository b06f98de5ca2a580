"""Compares the speed of `new` and `ros2 pkg create`, started alternately as users do.

Usage: ``python benchmarks/new_speed.py [--ros2 PROGRAM] [--repeat N]``

``ros2`` is looked for on the PATH. Each figure is the least of N runs, of the wall time and of the
CPU time, user and system, of the process with all that it starts; a first run of each fills the
caches and does not count. `ros2 pkg create` writes a package with one node that prints a line;
`new` writes one with a publisher, its tests and its README, or one with five nodes, and checks
all of it with every rule before it is written.
"""

from __future__ import annotations

import argparse
import os
import resource
import shutil
import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple


class Cost(NamedTuple):
    """The cost of a command in seconds."""

    wall: float
    cpu: float


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--ros2", default=shutil.which("ros2"), metavar="PROGRAM")
    parser.add_argument("--repeat", type=int, default=15)
    options = parser.parse_args()
    with TemporaryDirectory() as scratch:
        commands = _commands(options.ros2)
        costs: dict[str, list[Cost]] = {name: [] for name in commands}
        for number in range(options.repeat + 1):
            for name, command in commands.items():
                cost = _run([*command, f"package_{number}"], Path(scratch), name)
                if number:  # the first one fills the caches of the system and ours
                    costs[name].append(cost)
    least = {name: _least(measured) for name, measured in costs.items()}
    base = least["ros2 pkg create" if options.ros2 else "new"]
    print(f"{'':22} {'wall s':>7} {'ratio':>6} {'CPU s':>7} {'ratio':>6}")
    for name, (wall, cpu) in least.items():
        ratios = wall / base.wall, cpu / base.cpu
        print(f"{name:22} {wall:7.3f} {ratios[0]:6.2f} {cpu:7.3f} {ratios[1]:6.2f}")


def _least(measured: Sequence[Cost]) -> Cost:
    return Cost(min(cost.wall for cost in measured), min(cost.cpu for cost in measured))


def _commands(ros2: str | None) -> dict[str, list[str]]:
    """Return the commands by name, to be completed with a package name."""
    user = ["--maintainer-name", "Ada", "--maintainer-email", "ada@example.com"]
    new = [sys.executable, "-m", "scaffold", "new", *user]
    kinds = ("publisher", "subscriber", "service_server", "service_client", "timer")
    several = [f"--add={kind}:{kind}_one" for kind in kinds]
    commands = {
        "new": new,
        "new, ament_python": [*new, "--build-type", "ament_python"],
        "new, two nodes": [*new, *several[:2]],
        "new, five nodes": [*new, *several],
    }
    if ros2 is None:
        sys.stderr.write(
            "no ros2 on the PATH, and none in the wheels of the extra 'ros': source an "
            "installation, or name one with --ros2; until then `new` is compared with itself\n"
        )
        return commands
    flags = ["--build-type", "ament_python", "--node-name", "talker", "--license", "Apache-2.0"]
    commands["ros2 pkg create"] = [ros2, "pkg", "create", *flags, *user]
    return commands


def _run(command: Sequence[str], scratch: Path, name: str) -> Cost:
    place = scratch / "".join(filter(str.isalnum, name))
    place.mkdir(exist_ok=True)
    variables = {**os.environ, "XDG_CACHE_HOME": str(scratch / "cache")}
    variables.pop("PYTHONDONTWRITEBYTECODE", None)
    before, begun = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    subprocess.run(command, cwd=place, env=variables, check=True, capture_output=True)
    wall, after = time.perf_counter() - begun, resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return Cost(wall, cpu)


if __name__ == "__main__":
    main()
