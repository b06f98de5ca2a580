"""A real scheduler and three real workers run a workspace; one of them is killed in the middle."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
from collections import Counter
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path

import pytest

from scaffold.smoke.cleanup import leftovers
from scaffold.smoke.isolation import shared_memory
from tests import PATIENCE
from tests.smoke.smoke_packages import python_package, talker
from tests.smoke.smoke_runs import (
    NEEDS_ROS,
    ROOT,
    command_line,
    processes_of,
    variables,
    wait_until,
)

pytest.importorskip("distributed", reason="install the extra 'cluster' of this project")
pytestmark = [pytest.mark.nightly, NEEDS_ROS, pytest.mark.timeout(0)]

PACKAGES = int(os.environ.get("SCAFFOLD_CLUSTER_PACKAGES", "9"))


@dataclass
class Member:
    """A worker, with a directory for temporary files by which its processes are known."""

    process: subprocess.Popen[str]
    tmp: Path


@contextmanager
def dask(*arguments: str, log: Path, tmp: Path) -> Iterator[subprocess.Popen[str]]:
    """Run a part of the cluster for the length of the block."""
    command = [sys.executable, "-m", "distributed.cli." + arguments[0], *arguments[1:]]
    with (
        log.open("w") as out,
        subprocess.Popen(
            command,
            env={**variables(tmp, XDG_STATE_HOME=str(tmp.parent / f"{tmp.name}-state"))},
            stdout=out,
            stderr=out,
            cwd=ROOT,
            text=True,
        ) as process,
    ):
        try:
            yield process
        finally:
            process.kill()


@pytest.fixture
def cluster(tmp_path: Path) -> Iterator[tuple[str, list[Member]]]:
    """Start a scheduler and three workers; return its address and them."""
    with ExitStack() as stack:
        log = tmp_path / "scheduler.log"
        (tmp_path / "scheduler").mkdir()
        stack.enter_context(
            dask(
                "dask_scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard",
                log=log, tmp=tmp_path / "scheduler",
            )
        )  # fmt: skip
        wait_until(lambda: "Scheduler at" in log.read_text())
        address = re.search(r"tcp://[\d.]+:\d+", log.read_text())
        assert address is not None
        members = []
        for number in range(3):
            tmp = tmp_path / f"worker-{number}"
            tmp.mkdir()
            process = stack.enter_context(
                dask(
                    "dask_worker", address[0], "--nthreads", "1", "--no-nanny", "--no-dashboard",
                    "--local-directory", str(tmp_path / f"dask-{number}"),
                    log=tmp_path / f"worker-{number}.log", tmp=tmp,
                )
            )  # fmt: skip
            members.append(Member(process, tmp))
        logs = [tmp_path / f"worker-{number}.log" for number in range(3)]
        wait_until(lambda: all("Registered to" in log.read_text() for log in logs))
        yield address[0], members


def test_every_package_has_one_result_though_a_worker_is_killed(
    cluster: tuple[str, list[Member]], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    address, members = cluster
    before = shared_memory.segments()
    names = [f"cluster_{number}" for number in range(PACKAGES)]
    for name in names:
        python_package(tmp_path / "src", name, {"talker": talker(f"/{name}")})
    (tmp_path / "tmp").mkdir()
    with subprocess.Popen(
        command_line(
            tmp_path / "src", "--cluster", address, "--duration", "1", "--format", "json",
        ),
        env=variables(tmp_path / "tmp"),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    ) as run:  # fmt: skip
        victim = members[1]
        wait_until(lambda: "talker" in " ".join(processes_of(victim.tmp)))
        victim.process.send_signal(signal.SIGKILL)
        out, said = run.communicate(timeout=PATIENCE)

    assert run.returncode == 0, said
    packages = json.loads(out)["packages"]
    assert Counter(package["name"] for package in packages) == Counter(names)
    workers = Counter(package["worker"] for package in packages)
    assert None not in workers
    assert len(workers) in {2, 3}
    for package in packages:
        (executable,) = package["executables"]
        assert executable["topics"][0]["count"] > 0
    assert f"({PACKAGES} of {PACKAGES})" in said
    for member in members:
        if member is victim:
            monkeypatch.setenv("XDG_STATE_HOME", f"{member.tmp}-state")
            wait_until(lambda: processes_of(victim.tmp) == [])
            leftovers.sweep()  # as the next run on that machine does at first
        assert [name for name in os.listdir(member.tmp) if name.startswith("ros2-")] == []
    assert shared_memory.segments() - before - shared_memory.used_by_anybody() == set()
