"""Measures the gain of `smoke --cluster`: the same packages with one worker, and with several.

Usage: ``python -m benchmarks.cluster_speed [--packages N] [--workers N] [--duration S]``

All workers run on this machine, so what they gain is what packages wait for: observation, and
processors that one package leaves idle. In the second run one worker is killed as soon as it has
started a node; every package has to have one result all the same.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import time
from collections import Counter
from pathlib import Path
from tempfile import TemporaryDirectory

from tests.dask_cluster import Running, cluster
from tests.smoke.smoke_packages import python_package, talker
from tests.smoke.smoke_runs import command_line, processes_of, variables, wait_until


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--packages", type=int, default=40)
    parser.add_argument("--workers", type=int, default=3)
    parser.add_argument("--duration", type=float, default=5.0, help="seconds of observation")
    options = parser.parse_args()
    with TemporaryDirectory() as scratch:
        sources = Path(scratch) / "src"
        names = [f"package_{number}" for number in range(options.packages)]
        for name in names:
            python_package(sources, name, {"talker": talker(f"/{name}")})
        for workers, is_killed in ((1, False), (options.workers, True)):
            directory = Path(scratch) / f"with-{workers}"
            (directory / "tmp").mkdir(parents=True)
            with cluster(directory, workers) as running:
                seconds = _run(sources, running, names, options.duration, is_killed=is_killed)
            killed = ", one of them killed" if is_killed else ""
            print(f"{workers} workers{killed}: {seconds:.0f} s, every result once", flush=True)


def _run(
    sources: Path, running: Running, names: list[str], duration: float, *, is_killed: bool
) -> float:
    begun = time.monotonic()
    command = command_line(
        sources, "--cluster", running.address, "--duration", str(duration), "--format", "json"
    )
    tmp = running.scheduler.tmp.parent / "tmp"
    with subprocess.Popen(
        command, env=variables(tmp), stdout=subprocess.PIPE, stderr=subprocess.DEVNULL
    ) as run:
        if is_killed:
            victim = running.workers[-1]
            wait_until(lambda: "talker" in " ".join(processes_of(victim.tmp)))
            victim.process.kill()
        out, _ = run.communicate()
    packages = json.loads(out)["packages"]
    if Counter(item["name"] for item in packages) != Counter(names):
        sys.exit("there is not one result for each package")
    failed = [item["name"] for item in packages if not item["executables"]]
    if failed:
        sys.exit(f"not run: {', '.join(failed)}")
    return time.monotonic() - begun


if __name__ == "__main__":
    main()
