"""Launch files of packages: which are run, how their nodes behave, what is missing to run them."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import pytest

from scaffold.errors import EnvironmentMissingError
from scaffold.model.package import Package
from scaffold.smoke import environment, launching, together
from scaffold.smoke.processes.process import Origin
from tests.smoke.smoke_packages import python_package, talker
from tests.smoke.smoke_runs import NEEDS_ROS, command_line, variables

HAS_LAUNCH = find_spec("launch_ros") is not None


def test_only_installed_launch_files_are_run(tmp_path: Path) -> None:
    share = tmp_path / "share" / "robot"
    for name in ("launch/b.launch.py", "launch/a_launch.xml", "launch/c.launch.yaml", "x.py"):
        (share / name).parent.mkdir(parents=True, exist_ok=True)
        (share / name).touch()
    (share / "hook").mkdir()
    (share / "hook" / "launch.py").touch()
    prefixes = {"AMENT_PREFIX_PATH": f"{tmp_path / 'other'}{os.pathsep}{tmp_path}"}
    groups = launching.groups("robot", "python3", prefixes)
    assert [group.name for group in groups] == [
        "launch/a_launch.xml", "launch/b.launch.py", "launch/c.launch.yaml",
    ]  # fmt: skip
    (words,) = groups[1].commands.values()
    assert words[-1] == str(share / "launch/b.launch.py")
    assert launching.groups("absent", "python3", prefixes) == []


def test_failures_of_nodes_started_by_launch(tmp_path: Path) -> None:
    """A node that ends after launch was interrupted has not died."""
    (tmp_path / "err").touch()
    (tmp_path / "out").write_text(
        "[ERROR] [talker-1]: process has died [pid 7, exit code 1, cmd '/x/talker'].\n"
        "[WARNING] [launch]: user interrupted with ctrl-c (SIGINT)\n"
        "[ERROR] [listener-2]: process has died [pid 8, exit code -2, cmd '/x/listener'].\n"
        "[ERROR] [deaf-3]: process[deaf-3] failed to terminate '5' seconds after receiving "
        "'SIGINT', escalating to 'SIGTERM'\n"
        "[ERROR] [deaf-3]: process[deaf-3] failed to terminate '10.0' seconds after receiving "
        "'SIGTERM', escalating to 'SIGKILL'\n"
        "[ERROR] [deaf-3]: process has died [pid 9, exit code -9, cmd '/x/deaf'].\n"
    )
    running = SimpleNamespace(out=tmp_path / "out", err=tmp_path / "err", exit_code=0)
    assert list(together.below_launch({"a.launch.py": cast("Any", running)})) == [
        "talker-1 died, exit code 1",
        "deaf-3 ignored SIGINT: still running after 5 s",
    ]


@NEEDS_ROS
@pytest.mark.skipif(HAS_LAUNCH, reason="launch_ros is there")
def test_missing_launch_is_reported_with_a_fix(tmp_path: Path) -> None:
    ros = environment.select(os.environ, forced="wheels")
    with pytest.raises(EnvironmentMissingError, match="lacks launch_ros; there is no wheel") as no:
        launching.require(ros, [], Origin("test"))
    assert "git clone --branch jazzy https://github.com/ros2/launch_ros" in str(no.value)
    own = python_package(tmp_path, "launch_ros", {"talker": talker("/a")})
    launching.require(ros, [Package.at(str(own))], Origin("test"))


@NEEDS_ROS
@pytest.mark.build
@pytest.mark.skipif(not HAS_LAUNCH, reason="no launch_ros: install ROS 2, or build its sources")
def test_nodes_of_a_launch_file_are_observed_together(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "scaffold.cli.main", "new", "robot", "--extras", "launch"]
    subprocess.run(command, cwd=tmp_path, env=variables(tmp_path), check=True)
    done = subprocess.run(
        command_line(tmp_path / "robot", "--launch", "--duration", "2", "--format", "json"),
        env=variables(tmp_path),
        capture_output=True,
        text=True,
        check=False,
    )
    (launched,) = json.loads(done.stdout)["packages"][0]["launches"]
    assert launched["problems"] == []
    assert launched["nodes"] == ["/minimal_publisher"]
