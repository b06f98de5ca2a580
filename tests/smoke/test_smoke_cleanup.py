"""``smoke`` cleans up processes, shared memory and directories, however it ends."""

from __future__ import annotations

import asyncio
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import threading
from collections.abc import Callable, Coroutine, Iterable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest

from scaffold.errors import InputError
from scaffold.smoke.cleanup import ledger, leftovers
from scaffold.smoke.cleanup.interruption import InterruptedBySignalError, Interruption
from scaffold.smoke.cleanup.workspace_lock import NAME, locked
from scaffold.smoke.isolation import shared_memory
from scaffold.smoke.options import Options
from scaffold.smoke.processes import marks, output, process, supervisor, table
from scaffold.smoke.processes.process import Origin
from scaffold.smoke.processes.uninterrupted import uninterrupted
from scaffold.smoke.session import smoke
from tests import PATIENCE
from tests.smoke.smoke_packages import python_package, talker
from tests.smoke.smoke_runs import (
    NEEDS_ROS,
    command_line,
    pids_of,
    processes_of,
    variables,
    wait_until,
)

DETACHED = """\
import os, sys
if os.fork() == 0:
    os.setsid()
    if os.fork() == 0:
        null = os.open(os.devnull, os.O_RDWR)
        for descriptor in range(3):
            os.dup2(null, descriptor)
        os.chdir('/')
        os.execve('/bin/sleep', ['sleep', '612'], {})
    os._exit(0)
os.wait()
"""
"""Starts a process that has nothing in common with its parent any more."""

STUBBORN = """\
import os, signal, time
for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
    signal.signal(number, signal.SIG_IGN)
for _ in range(10):
    if os.fork() == 0:
        os.setsid()
        for _ in range(1000):
            time.sleep(0.05)
            if os.fork():
                os._exit(0)
        os._exit(0)
print('ready', flush=True)
signal.pause()
"""
"""Ignores what can be ignored; its children are never the same for long, and end some time."""


def run_supervised(
    code: str, directory: Path, use: Callable[[process.Running], Coroutine[Any, Any, Any]]
) -> Any:  # noqa: ANN401  whatever the function returns
    """Run a Python program under a supervisor; return the result of a function of it."""

    async def run() -> Any:  # noqa: ANN401  likewise
        command = [sys.executable, "-u", "-S", "-c", code]
        origin = Origin(f"test-{os.getpid()}")
        running = await process.start(command, dict(os.environ), directory, origin)
        try:
            return await use(running)
        finally:
            await running.close()

    return asyncio.run(run())


async def wait_for_output(running: process.Running) -> None:
    while not output.read(running.out):
        assert running.exit_code is None, output.read(running.err)
        await asyncio.sleep(0.01)


def has_ended(entry: Path) -> bool:
    """Return whether the process of an entry in /proc has ended, zombies included."""
    try:
        return (entry / "stat").read_text().rpartition(")")[2].split()[0] in {"Z", "X"}
    except (FileNotFoundError, ProcessLookupError):
        return True


# -- processes


def test_detached_process_is_killed(tmp_path: Path) -> None:
    async def use(running: process.Running) -> list[str]:
        assert await running.ended_within(PATIENCE)
        return await running.finish(grace=0.1)

    assert run_supervised(DETACHED, tmp_path, use) == ["sleep 612"]


def test_cancellation_does_not_cut_a_cleanup_short() -> None:
    async def run() -> list[str]:
        may_end, steps = asyncio.Event(), list[str]()

        async def cleanup() -> None:
            steps.append("started")
            await may_end.wait()
            steps.append("ended")

        task = asyncio.create_task(uninterrupted(cleanup()))
        for _ in range(3):
            await asyncio.sleep(0.01)
            task.cancel()
        may_end.set()
        with pytest.raises(asyncio.CancelledError):
            await task
        return steps

    assert asyncio.run(run()) == ["started", "ended"]


def test_fork_bomb_is_killed(tmp_path: Path) -> None:
    children: list[Path] = []

    async def use(running: process.Running) -> None:
        await wait_for_output(running)
        children.append(Path("/proc", str(running.group)))

    run_supervised(STUBBORN, tmp_path, use)
    wait_until(lambda: has_ended(children[0]))
    assert marks.marked(f"test-{os.getpid()}") == {}


def test_program_that_kills_its_supervisor_is_cleaned_up(tmp_path: Path) -> None:
    async def use(running: process.Running) -> bool:
        assert await running.ended_within(PATIENCE)
        await running.finish()
        return running.lost_supervisor

    code = "import os, signal, time; os.kill(os.getppid(), signal.SIGKILL); time.sleep(600)"
    supervisor.become_subreaper()
    try:
        assert run_supervised(code, tmp_path, use)
    finally:
        supervisor.become_subreaper(enabled=False)
    assert marks.marked(f"test-{os.getpid()}") == {}


def test_program_that_cannot_be_started(tmp_path: Path) -> None:
    (tmp_path / "script").touch(mode=0o755)

    async def start(name: str) -> None:
        await process.start([str(tmp_path / name)], {}, tmp_path, Origin("test"))

    with pytest.raises(OSError, match="No such file or directory"):
        asyncio.run(start("missing"))
    with pytest.raises(OSError, match="Exec format error"):
        asyncio.run(start("script"))


def test_endless_output_is_bounded(tmp_path: Path) -> None:
    blocks, size = 400, 2**20
    code = f"import sys\nfor _ in range({blocks}): sys.stdout.write('x' * {size})\nprint('\\nend')"

    def taken(running: process.Running) -> int:
        return running.out.stat().st_blocks * 512

    async def use(running: process.Running) -> None:
        assert await running.ended_within(PATIENCE)
        await asyncio.to_thread(wait_until, lambda: taken(running) <= 2 * supervisor.MOST_OUTPUT)
        assert running.out.stat().st_size == blocks * size + len("\nend\n")
        assert output.read(running.out).endswith("xxx\nend\n")

    run_supervised(code, tmp_path, use)


def test_short_command_is_cleaned_up() -> None:
    code = f"print('out', flush=True)\n{DETACHED}"
    origin = Origin(f"test-{os.getpid()}")
    command = [sys.executable, "-S", "-c", code]
    done = process.capture(command, {"A": "b"}, origin, PATIENCE)
    assert (done.exit_code, done.out, done.err) == (0, "out\n", "")
    late = process.capture([sys.executable, "-c", "while True: pass"], {}, origin, 0.5)
    assert late.exit_code < 0
    assert "it did not exit within 0.5 s" in late.err


# -- what a killed run has left


@pytest.fixture
def state(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return the empty directory of the ledgers; scratch directories are elsewhere."""
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    return tmp_path / "state" / "ros2-scaffold" / "smoke"


def write_orphaned_ledger(state: Path, mark: str, *lines: dict[str, object]) -> Path:
    """Write a ledger without a living owner."""
    state.mkdir(parents=True, exist_ok=True)
    path = state / f"{mark}.jsonl"
    path.write_text("".join(json.dumps(line) + "\n" for line in lines))
    return path


def scratch_of(parent: Path, mark: str, marker: str | None = None) -> Path:
    scratch = parent / f"ros2-scaffold-smoke-{mark}"
    (scratch / "below").mkdir(parents=True)
    (scratch / "below" / "file").touch()
    (scratch / leftovers.MARKER).write_text(mark if marker is None else marker)
    return scratch


def first_line(state: Path, scratch: Path | None) -> dict[str, object]:
    """Return the first line of a ledger as a current run writes it."""
    with ledger.opened("other", scratch) as path:
        assert path is not None
        line: dict[str, object] = json.loads(path.read_text())
    assert not (state / "other.jsonl").exists() or scratch is not None
    return line


def test_run_removes_its_ledger_and_its_directory(state: Path, tmp_path: Path) -> None:
    with leftovers.recorded_run() as run:
        locked_out = run.scratch / "a" / "b"
        locked_out.mkdir(parents=True)
        locked_out.parent.chmod(0o000)
        leftovers.sweep()
        assert run.scratch.exists()
        assert run.origin.ledger is not None
        assert run.origin.ledger.exists()
    assert list(state.iterdir()) == []
    assert [path.name for path in tmp_path.iterdir()] == ["state"]


def test_directory_of_killed_run_is_removed(state: Path, tmp_path: Path) -> None:
    mark = "0" * 32
    scratch = scratch_of(tmp_path, mark)
    outside = tmp_path / "outside"
    outside.mkdir()
    (outside / "kept").touch()
    (scratch / "link").symlink_to(outside)
    path = write_orphaned_ledger(state, mark, {"place": "another boot", "scratch": str(scratch)})
    leftovers.sweep()
    assert not scratch.exists()
    assert not path.exists()
    assert (outside / "kept").exists()


@pytest.mark.parametrize("trouble", ["other marker", "other name", "link"])
def test_directory_of_unknown_origin_is_kept(state: Path, tmp_path: Path, trouble: str) -> None:
    mark = "1" * 32
    scratch = scratch_of(tmp_path, mark, marker="2" * 32 if trouble == "other marker" else None)
    if trouble == "other name":
        scratch = scratch.rename(tmp_path / "project")
    elif trouble == "link":
        real = scratch.rename(tmp_path / "real")
        scratch.symlink_to(real)
    write_orphaned_ledger(state, mark, {"place": "another boot", "scratch": str(scratch)})
    leftovers.sweep()
    assert (scratch / "below" / "file").exists()


def test_process_of_killed_run_is_killed(state: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(leftovers, "_PATIENCE", 0.1)
    line = first_line(state, None)
    with subprocess.Popen(["sleep", "600"]) as ours, subprocess.Popen(["sleep", "600"]) as other:
        entries = []
        for item, shift in ((ours, 0), (other, 1)):
            listed = table.of_pid(item.pid)
            assert listed is not None
            entries.append((item.pid, listed.started + shift))
        path = write_orphaned_ledger(state, "3" * 32, line, {"processes": entries})
        leftovers.sweep()
        assert ours.wait(PATIENCE) == -signal.SIGKILL
        assert other.poll() is None
        other.kill()
    assert not path.exists()


def test_damaged_ledgers_are_ignored(state: Path) -> None:
    state.mkdir(parents=True)
    (state / "a.jsonl").write_bytes(b'{"place": 1}\n[]\nnull\n{"processes": [["x"]]}\n\x80{')
    (state / "b.new").touch()
    (state / "c.jsonl").symlink_to("/dev/zero")
    os.mkfifo(state / "d.jsonl")
    leftovers.sweep()
    assert sorted(path.name for path in state.iterdir()) == ["c.jsonl", "d.jsonl"]


def test_run_without_a_writable_ledger_directory(state: Path) -> None:
    state.parent.mkdir(parents=True)
    state.touch()
    leftovers.sweep()
    with leftovers.recorded_run() as run:
        assert run.origin.ledger is None
    assert not run.scratch.exists()


# -- two runs in one workspace


def test_locked_workspace_is_an_error(tmp_path: Path) -> None:
    messages: list[str] = []
    with (
        locked(tmp_path, 0.0, messages.append),
        pytest.raises(InputError) as caught,
        locked(tmp_path, 0.2, messages.append),
    ):
        pass
    holder = f"process {os.getpid()}"
    assert str(caught.value) == (
        f"'{tmp_path}' is in use by another smoke ({holder}): wait for it, or choose another "
        "--workspace"
    )
    assert messages == [f"waiting for another smoke ({holder}) in '{tmp_path}'"]
    assert list(tmp_path.iterdir()) == []


def test_lock_of_workspace_is_waited_for(tmp_path: Path) -> None:
    is_waiting = threading.Event()
    is_held = threading.Event()

    def hold() -> None:
        with locked(tmp_path, 0.0, lambda _: None):
            is_held.set()
            assert is_waiting.wait(PATIENCE)

    holder = threading.Thread(target=hold)
    holder.start()
    assert is_held.wait(PATIENCE)
    with locked(tmp_path, PATIENCE, lambda _: is_waiting.set()):
        assert (tmp_path / NAME).exists()
    holder.join()


def test_file_as_workspace_is_an_error(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with (
        pytest.raises(InputError, match="cannot be used as a workspace"),
        locked(tmp_path / "file", 0.0, lambda _: None),
    ):
        pass


# -- real runs


@pytest.fixture(scope="module")
def package(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return python_package(
        tmp_path_factory.mktemp("sources"), "good_py", {"talker": talker("/numbers")}
    )


@pytest.fixture
def run(package: Path, tmp_path: Path) -> Iterator[subprocess.Popen[str]]:
    """Start a run that lasts until a test ends it."""
    (tmp_path / "tmp").mkdir()
    with subprocess.Popen(
        command_line(package, "--duration", "300"),
        env=variables(tmp_path / "tmp", XDG_STATE_HOME=str(tmp_path / "state")),
        stderr=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    ) as started:
        yield started
        started.kill()


def domains_of(pids: Iterable[int]) -> set[int]:
    """Return the ROS domains of processes."""
    domains = set()
    for pid in pids:
        with suppress(OSError):
            entries = Path("/proc", str(pid), "environ").read_bytes().split(b"\0")
            named = (item.partition(b"=") for item in entries)
            domains |= {int(value) for name, _, value in named if name == b"ROS_DOMAIN_ID"}
    return domains


def is_shared(segment: str, domains: set[int]) -> bool:
    """Return whether a segment is a port of another domain, which other processes may use."""
    port = re.fullmatch(r"fastrtps_port(\d+)", segment)
    return port is not None and (int(port[1]) - 7400) // 250 not in domains


def segments_in_use(tmp: Path) -> set[str]:
    """Wait until node and observer communicate; return the shared memory that only they use."""
    in_use: set[str] = set()

    def talk() -> bool:
        pids = pids_of(tmp)
        domains = domains_of(pids)
        used = shared_memory.used_by(pids)
        in_use.update(segment for segment in used if not is_shared(segment, domains))
        is_running = any("lib/good_py/talker" in command for command in processes_of(tmp))
        return is_running and len(in_use) >= 4

    wait_until(talk)
    return in_use


def remaining_segments(segments: set[str]) -> set[str]:
    """Return the remaining segments that no other process uses."""
    return (segments & shared_memory.segments()) - shared_memory.used_by_anybody()


@pytest.mark.build
@NEEDS_ROS
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_interrupted_run_is_cleaned_up(
    run: subprocess.Popen[str], tmp_path: Path, number: signal.Signals
) -> None:
    tmp = tmp_path / "tmp"
    segments = segments_in_use(tmp)
    run.send_signal(number)
    report, errors = run.communicate(timeout=PATIENCE)
    assert f"\nended early: interrupted by {number.name}\n" in report
    assert errors == f"ros2-scaffold: interrupted by {number.name}\n"
    assert run.returncode == 128 + number
    assert (processes_of(tmp), list(tmp.iterdir()), remaining_segments(segments)) == ([], [], set())
    assert list(tmp_path.glob("state/*/*/*")) == []


@pytest.mark.build
@NEEDS_ROS
@pytest.mark.parametrize("all_at_once", [False, True], ids=["smoke", "all its processes"])
def test_next_run_cleans_up_after_a_killed_run(
    run: subprocess.Popen[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    all_at_once: bool,
) -> None:
    tmp = tmp_path / "tmp"
    segments = segments_in_use(tmp)
    if all_at_once:
        written = tmp_path / "state" / "ros2-scaffold" / "smoke"
        wait_until(lambda: all(name in _text(written) for name in segments))
        pids = pids_of(tmp)
        for number in (signal.SIGSTOP, signal.SIGKILL):
            for pid in pids:
                os.kill(pid, number)
    run.kill()
    run.wait()
    wait_until(lambda: processes_of(tmp) == [])
    assert (remaining_segments(segments) != set()) == all_at_once
    assert len(list(tmp.iterdir())) == 1
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    leftovers.sweep()
    assert (list(tmp.iterdir()), remaining_segments(segments)) == ([], set())


@pytest.mark.build
@NEEDS_ROS
def test_closed_terminal_ends_the_run(package: Path, tmp_path: Path) -> None:
    pexpect = pytest.importorskip("pexpect")
    command, *arguments = command_line(package, "--duration", "300")
    terminal = pexpect.spawn(command, arguments, env=variables(tmp_path), encoding="utf-8")
    segments = segments_in_use(tmp_path)
    terminal.expect("running good_py/talker", timeout=PATIENCE)
    with suppress(pexpect.ExceptionPexpect):  # it does not wait for the end
        terminal.close(force=False)
    wait_until(lambda: processes_of(tmp_path) == [])
    assert (list(tmp_path.iterdir()), remaining_segments(segments)) == ([], set())


@pytest.mark.build
def test_interrupted_while_searching_for_ros(package: Path, tmp_path: Path) -> None:
    (tmp_path / "bin").mkdir()
    for name in ("python3", "colcon"):
        (tmp_path / "bin" / name).write_text("#!/bin/sh\nsleep 600 & wait\n")
        (tmp_path / "bin" / name).chmod(0o755)
    (tmp_path / "tmp").mkdir()
    path = f"{tmp_path / 'bin'}:/usr/bin:/bin"
    with subprocess.Popen(
        command_line(package),
        env=variables(tmp_path / "tmp", PATH=path, AMENT_PREFIX_PATH="/nowhere"),
        stderr=subprocess.PIPE,
        text=True,
    ) as run:
        wait_until(lambda: "sleep 600" in " ".join(processes_of(tmp_path / "tmp")))
        run.send_signal(signal.SIGTERM)
        _, errors = run.communicate(timeout=PATIENCE)
    assert (run.returncode, errors) == (143, "ros2-scaffold: interrupted by SIGTERM\n")
    assert processes_of(tmp_path / "tmp") == []
    assert list((tmp_path / "tmp").iterdir()) == []


def _text(directory: Path) -> str:
    return "".join(path.read_text() for path in directory.iterdir())


@NEEDS_ROS
def test_signal_during_cleanup_is_delayed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "scratch").mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "scratch"))
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    remove = leftovers.remove_scratch

    def interrupted(scratch: Path, mark: str) -> bool:
        signal.raise_signal(signal.SIGTERM)
        return remove(scratch, mark)

    monkeypatch.setattr(leftovers, "remove_scratch", interrupted)
    with Interruption() as interruption, interruption.at_once():
        smoke([], Options(), interruption=interruption)
        with pytest.raises(InterruptedBySignalError):
            interruption.check()

    assert os.listdir(tmp_path / "scratch") == []
