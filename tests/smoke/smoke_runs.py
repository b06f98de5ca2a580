"""Helpers to run ``smoke`` as users do, and to find what it leaves behind."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from collections.abc import Callable
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import pytest

from scaffold.smoke.isolation import shared_memory
from tests import PATIENCE

ROOT = Path(__file__).parents[2]
NEEDS_ROS = pytest.mark.skipif(
    find_spec("rclpy") is None and not Path("/opt/ros").exists(),
    reason="no ROS 2: install the extra 'ros' of this project",
)


def command_line(*arguments: str | Path) -> list[str]:
    """Return the command that runs ``smoke``."""
    return [sys.executable, "-m", "scaffold.cli.main", "smoke", *map(str, arguments)]


def variables(tmp: Path, **more: str) -> dict[str, str]:
    """Return environment variables that identify the processes of a test."""
    return {**os.environ, "PYTHONPATH": str(ROOT), "TMPDIR": str(tmp), **more}


def pids_of(tmp: Path) -> list[int]:
    """Return all living processes whose TMPDIR this is, or is below it."""
    wanted = (f"TMPDIR={tmp}\0".encode(), f"TMPDIR={tmp}/".encode())
    pids = []
    for directory in Path("/proc").glob("[0-9]*"):
        try:
            if any(item in (directory / "environ").read_bytes() for item in wanted):
                pids.append(int(directory.name))
        except OSError:
            continue
    return pids


def processes_of(tmp: Path) -> list[str]:
    """Return the command lines of these processes."""
    commands = []
    for pid in pids_of(tmp):
        try:
            text = Path("/proc", str(pid), "cmdline").read_bytes()
        except OSError:
            continue
        commands.append(text.replace(b"\0", b" ").decode())
    return [command for command in commands if command]


def wait_until(condition: Callable[[], bool]) -> None:
    """Wait until a condition holds."""
    deadline = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < deadline, "it did not happen"
        time.sleep(0.05)


def executables_of(package: Path, root: Path, *flags: str) -> list[dict[str, Any]]:
    """Run the executables of a package; return their reports, and fail if processes are left.

    Args:
        package: Its directory.
        root: A directory for temporary files.
        flags: More of them.
    """
    tmp = root / "tmp"
    tmp.mkdir()
    before = shared_memory.segments()
    done = subprocess.run(
        command_line(package, "--duration", "4", "--format", "json", *flags),
        env=variables(tmp, XDG_STATE_HOME=str(root / "state")),
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 1, done.stderr
    assert processes_of(tmp) == []
    assert os.listdir(tmp) == []
    assert [*(root / "state").glob("*/*/*")] == []
    assert shared_memory.segments() - before - shared_memory.used_by_anybody() == set()
    executables: list[dict[str, Any]] = json.loads(done.stdout)["packages"][0]["executables"]
    return executables
