"""Measures the overhead of `smoke` over the build and the observation, and the error of its rates.

Usage: ``python -m benchmarks.smoke_speed [--repeat N] [--duration S]``

The overhead is the least wall time of N runs of `smoke` over the package that `new` writes, as a
ratio to the least wall time of `colcon build` of it alone plus the observation. For the rates, one
package has a node for each of 1, 2, 10, 50 and 100 Hz, which `smoke` runs one after the other; the
error is that of the rate it reports. Both need an idle machine to mean anything.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import time
from pathlib import Path
from tempfile import TemporaryDirectory

from scaffold.smoke import environment
from tests.smoke.smoke_packages import python_package, talker

RATES = (1, 2, 10, 50, 100)


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--duration", type=float, default=5.0, help="seconds of observation")
    options = parser.parse_args()
    with TemporaryDirectory() as scratch:
        _overhead(Path(scratch), options.repeat, options.duration)
        _rates(Path(scratch), options.duration)


def _overhead(scratch: Path, repeat: int, duration: float) -> None:
    tool = [sys.executable, "-m", "scaffold.cli.main"]
    subprocess.run(
        [*tool, "new", "talker", "--destination-directory", str(scratch / "src")],
        check=True,
        capture_output=True,
    )
    ros = environment.select(os.environ)
    builds, runs = [], []
    for number in range(repeat):
        workspace = scratch / f"workspace-{number}"
        workspace.mkdir()
        build = [ros.colcon, "build", "--paths", str(scratch / "src" / "talker")]
        builds.append(_seconds(build, workspace, dict(ros.variables)))
        smoke = [*tool, "smoke", str(scratch / "src"), "--duration", str(duration)]
        runs.append(_seconds(smoke, scratch, dict(os.environ)))
    bare = min(builds) + duration
    print(f"colcon build {min(builds):.2f} s + observation {duration:g} s = {bare:.2f} s")
    print(f"smoke {min(runs):.2f} s, ratio {min(runs) / bare:.2f}")


def _seconds(command: list[str], directory: Path, variables: dict[str, str]) -> float:
    begun = time.perf_counter()
    subprocess.run(command, cwd=directory, env=variables, check=True, capture_output=True)
    return time.perf_counter() - begun


def _rates(scratch: Path, duration: float) -> None:
    modules = {
        f"rate_{rate}": talker(f"/rate_{rate}", node=f"rate_{rate}", period=str(1 / rate))
        for rate in RATES
    }
    package = python_package(scratch / "rates", "rates", modules)
    smoke = [sys.executable, "-m", "scaffold.cli.main", "smoke", str(package), "--jobs", "1"]
    flags = ["--duration", str(duration), "--format", "json"]
    done = subprocess.run([*smoke, *flags], check=False, capture_output=True, text=True)
    print(f"{'rate, Hz':>8} {'reported':>9} {'error':>7}")
    executables = json.loads(done.stdout)["packages"][0]["executables"]
    topics = {topic["name"]: topic for item in executables for topic in item["topics"]}
    for rate in RATES:
        seen = topics[f"/rate_{rate}"]["rate_hz"]
        print(f"{rate:8g} {seen:9.3f} {abs(seen / rate - 1):7.2%}")


if __name__ == "__main__":
    main()
