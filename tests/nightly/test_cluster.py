"""A real scheduler with three real workers runs a workspace; one worker is killed."""

from __future__ import annotations

import json
import os
import signal
import subprocess
from collections import Counter
from pathlib import Path

import pytest

from scaffold.smoke.cleanup import leftovers
from scaffold.smoke.isolation import shared_memory
from tests import PATIENCE
from tests.dask_cluster import cluster
from tests.smoke.smoke_packages import python_package, talker
from tests.smoke.smoke_runs import (
    NEEDS_ROS,
    command_line,
    processes_of,
    variables,
    wait_until,
)

pytest.importorskip("distributed", reason="install the extra 'cluster' of this project")
pytestmark = [pytest.mark.nightly, NEEDS_ROS, pytest.mark.timeout(0)]

PACKAGES = int(os.environ.get("SCAFFOLD_CLUSTER_PACKAGES", "9"))


def test_every_package_has_one_result_when_a_worker_is_killed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = shared_memory.segments()
    names = [f"cluster_{number}" for number in range(PACKAGES)]
    for name in names:
        python_package(tmp_path / "src", name, {"talker": talker(f"/{name}")})
    (tmp_path / "tmp").mkdir()
    with (
        cluster(tmp_path, 3) as running,
        subprocess.Popen(
            command_line(
                tmp_path / "src", "--cluster", running.address, "--duration", "1",
                "--format", "json",
            ),
            env=variables(tmp_path / "tmp"),
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        ) as run,
    ):  # fmt: skip
        victim = running.workers[1]
        wait_until(lambda: "talker" in " ".join(processes_of(victim.tmp)))
        victim.process.send_signal(signal.SIGKILL)
        out, errors = run.communicate(timeout=PATIENCE)

    assert run.returncode == 0, errors
    packages = json.loads(out)["packages"]
    assert Counter(package["name"] for package in packages) == Counter(names)
    workers = Counter(package["worker"] for package in packages)
    assert None not in workers
    assert len(workers) in {2, 3}
    for package in packages:
        (executable,) = package["executables"]
        assert executable["topics"][0]["count"] > 0
    assert f"({PACKAGES} of {PACKAGES})" in errors
    for member in running.workers:
        if member is victim:
            monkeypatch.setenv("XDG_STATE_HOME", f"{member.tmp}-state")
            wait_until(lambda: processes_of(victim.tmp) == [])
            leftovers.sweep()  # as the next run on that machine does at first
        assert [name for name in os.listdir(member.tmp) if name.startswith("ros2-")] == []
    assert shared_memory.segments() - before - shared_memory.used_by_anybody() == set()
