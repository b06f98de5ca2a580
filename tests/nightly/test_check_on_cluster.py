"""`check --cluster` with a real scheduler and real workers."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

import pytest

from tests import PATIENCE
from tests.dask_cluster import Member, cluster
from tests.smoke.smoke_runs import processes_of, variables, wait_until

pytest.importorskip("distributed", reason="install the extra 'cluster' of this project")
pytestmark = [pytest.mark.nightly, pytest.mark.timeout(0)]

MANIFEST = """\
<package format="3">
  <name>{name}</name>
  <version>0.0.0</version>
  <description>Something to check.</description>
  <maintainer email="robin@example.com">Robin</maintainer>
  <license>MIT</license>
  <depend>rclpy</depend>
  <build_depend>{other}</build_depend>
  <export><build_type>ament_python</build_type></export>
</package>
"""
NODE = """\
from {other}.names import TOPIC
import rclpy
from std_msgs.msg import String

rclpy.create_node('talker').create_publisher(String, TOPIC, '10')
rclpy.create_node('other').get_topic_name()
"""


def command_line(*words: str) -> list[str]:
    return [sys.executable, "-m", "scaffold.cli.main", "check", "--format", "json", *words]


def workspace(directory: Path, packages: int) -> Path:
    """Write dependent packages with findings, in a checkout with a configuration."""
    names = [f"package_{number}" for number in range(packages)]
    for name, other in zip(names, [*names[1:], names[0]], strict=True):
        package = directory / "src" / name
        (package / name).mkdir(parents=True)
        (package / "package.xml").write_text(MANIFEST.format(name=name, other=other))
        (package / "setup.py").write_text("from setuptools import setup\n\nsetup()\n")
        (package / name / "__init__.py").touch()
        (package / name / "names.py").write_text("TOPIC = '/chatter'\n")
        (package / name / "node.py").write_text(NODE.format(other=other))
        (package / name / "generated.py").write_text("import nowhere\n")
        (package / "linked.py").symlink_to(directory / "src" / name / name / "node.py")
    (directory / ".gitignore").write_text("generated.py\n")
    (directory / "LICENSE").write_text("MIT\n")
    (directory / "ros2-scaffold.toml").write_text(
        "[check]\nexclude = ['src/package_0/package_0/names.py']\n"
        "[check.per-path-ignores]\n'src/package_1/*' = ['D100']\n"
    )
    subprocess.run(["git", "init", "--quiet", directory], check=True)
    subprocess.run(["git", "-C", directory, "add", "."], check=True)
    return directory


def first_busy(workers: Sequence[Member]) -> Member:
    """Wait until a worker checks packages, and return it."""
    busy: list[Member] = []

    def find() -> bool:
        busy.extend(item for item in workers if "batch_process" in " ".join(processes_of(item.tmp)))
        return bool(busy)

    wait_until(find)
    return busy[0]


def test_report_equals_local_check_when_a_worker_is_killed(tmp_path: Path) -> None:
    where = workspace(tmp_path / "ws", 8)
    (tmp_path / "tmp").mkdir()
    environment = variables(tmp_path / "tmp")
    alone = subprocess.run(
        command_line(), cwd=where, env=environment, capture_output=True, text=True, check=False
    )
    codes = {item["code"] for item in json.loads(alone.stdout)["diagnostics"]}
    assert {"PX009", "PX020", "ND091", "TY003"} <= codes
    with (
        cluster(tmp_path, 2) as running,
        subprocess.Popen(
            command_line("--cluster", running.address),
            cwd=where,
            env=environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        ) as run,
    ):
        victim = first_busy(running.workers)
        victim.process.send_signal(signal.SIGKILL)
        out, errors = run.communicate(timeout=PATIENCE)
        wait_until(lambda: processes_of(victim.tmp) == [])
    assert (out, errors, run.returncode) == (alone.stdout, alone.stderr, alone.returncode)
    for member in running.workers:
        assert [name for name in os.listdir(member.tmp) if name.startswith("ros2-")] == []
