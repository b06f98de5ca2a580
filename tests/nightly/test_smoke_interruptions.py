"""``smoke`` is ended in five ways at nine moments, and leaves nothing behind."""

from __future__ import annotations

import os
import signal
import subprocess
import time
from pathlib import Path

import pytest

from scaffold.smoke.cleanup import leftovers
from scaffold.smoke.isolation import shared_memory
from tests import PATIENCE
from tests.smoke.smoke_packages import ONCE, python_package, talker
from tests.smoke.smoke_runs import NEEDS_ROS, command_line, processes_of, variables, wait_until

pytestmark = [pytest.mark.nightly, NEEDS_ROS]

MOMENTS = 9
WAYS = ("SIGINT", "SIGTERM", "SIGHUP", "SIGKILL", "timeout")
"""The last is ``timeout -k``: SIGTERM, and soon after SIGKILL."""


@pytest.fixture(scope="module")
def package(tmp_path_factory: pytest.TempPathFactory) -> Path:
    modules = {"talker": talker("/numbers"), "once": ONCE}
    return python_package(tmp_path_factory.mktemp("sources"), "good_py", modules)


@pytest.fixture(scope="module")
def seconds(package: Path, tmp_path_factory: pytest.TempPathFactory) -> float:
    """Return the duration of a complete run."""
    begun = time.monotonic()
    environment = variables(tmp_path_factory.mktemp("tmp"))
    subprocess.run(arguments(package), env=environment, check=True, stdout=subprocess.DEVNULL)
    return time.monotonic() - begun


def arguments(package: Path) -> list[str]:
    return command_line(package, "--duration", "1", "--signal", "both")


@pytest.mark.parametrize("moment", range(MOMENTS))
@pytest.mark.parametrize("way", WAYS)
def test_interrupted_run_is_cleaned_up(
    package: Path,
    seconds: float,
    way: str,
    moment: int,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    delay = seconds * (moment + 0.5) / MOMENTS
    before = shared_memory.segments()
    state, tmp = tmp_path / "state", tmp_path / "tmp"
    tmp.mkdir()
    command = arguments(package)
    if way == "timeout":
        command = ["timeout", "-k", "0.3", f"{delay:.2f}", *command]
    with subprocess.Popen(
        command,
        env=variables(tmp, XDG_STATE_HOME=str(state)),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    ) as run:
        if way != "timeout":
            time.sleep(delay)
            run.send_signal(signal.Signals[way])
        _, errors = run.communicate(timeout=PATIENCE)
    if way in {"SIGINT", "SIGTERM", "SIGHUP"} and run.returncode:
        number = signal.Signals[way]
        assert run.returncode in {128 + number, -number}
        # Before Python has read its modules, the signal just ends it.
        assert errors.startswith("ros2-scaffold: interrupted") or run.returncode == -number
    else:
        wait_until(lambda: processes_of(tmp) == [])
        monkeypatch.setenv("XDG_STATE_HOME", str(state))
        leftovers.sweep()  # as the next run does at first
    assert processes_of(tmp) == []
    assert os.listdir(tmp) == []
    assert list(state.glob("*/*/*")) == []
    assert shared_memory.segments() - before - shared_memory.used_by_anybody() == set()
