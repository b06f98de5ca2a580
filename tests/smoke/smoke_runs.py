"""Running ``smoke`` as users do, and seeing what it leaves behind."""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable
from importlib.util import find_spec
from pathlib import Path

import pytest

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
    """Return variables by which the processes of a test can be told from all others."""
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
    """Return their command lines."""
    commands = []
    for pid in pids_of(tmp):
        try:
            text = Path("/proc", str(pid), "cmdline").read_bytes()
        except OSError:
            continue
        commands.append(text.replace(b"\0", b" ").decode())
    return [command for command in commands if command]


def wait_until(condition: Callable[[], bool]) -> None:
    """Wait for something to happen."""
    deadline = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < deadline, "it did not happen"
        time.sleep(0.05)
