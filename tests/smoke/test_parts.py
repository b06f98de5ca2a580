"""The parts of ``smoke`` that need no build: environments, domains, processes, output."""

from __future__ import annotations

import asyncio
import fcntl
import os
import signal
import socket
import sys
from collections.abc import Callable, Coroutine, Sequence
from contextlib import ExitStack
from importlib.util import find_spec
from io import StringIO
from pathlib import Path
from typing import Any, TypeVar

import pytest

from scaffold.errors import EnvironmentMissingError
from scaffold.programs import installation
from scaffold.smoke import environment
from scaffold.smoke import run as trial
from scaffold.smoke.building import build
from scaffold.smoke.isolation import domain, shared_memory
from scaffold.smoke.probe import messages
from scaffold.smoke.processes import ending, marks, output, process
from scaffold.smoke.processes.process import Origin
from scaffold.smoke.reports import report
from scaffold.smoke.result import (
    Build,
    Executable,
    Observation,
    PackageResult,
    Problem,
    Smoke,
    Stop,
    Topic,
)

Result = TypeVar("Result")
HAS_WHEELS = os.path.exists(os.path.join(sys.prefix, "share", "ament_cmake"))
needs_wheels = pytest.mark.skipif(
    not HAS_WHEELS, reason="no ROS wheels: install the extra 'ros' of this project"
)
BINARIES = os.path.join(sys.prefix, "bin")


# -- environments


@needs_wheels
def test_environment_of_wheels_inherits_nothing(tmp_path: Path) -> None:
    user = {
        "HOME": "/home/user", "LC_ALL": "C.UTF-8", "PATH": "/usr/bin", "PYTHONPATH": "/elsewhere",
        "RMW_IMPLEMENTATION": "rmw_no_such_thing", "ROS_DOMAIN_ID": "5", "LD_PRELOAD": "x.so",
        "COLCON_DEFAULTS_FILE": "/elsewhere",
    }  # fmt: skip
    result = environment.select(user, installed=tmp_path)
    assert (result.kind, result.prefix, result.rmw) == ("wheels", sys.prefix, "rmw_fastrtps_cpp")
    assert result.notes == ()
    assert result.variables["PATH"] == f"{BINARIES}:/usr/bin"
    assert result.variables["AMENT_PREFIX_PATH"] == sys.prefix
    assert result.variables["RMW_IMPLEMENTATION"] == "rmw_fastrtps_cpp"
    assert result.variables["HOME"] == "/home/user"
    assert result.variables["LC_ALL"] == "C.UTF-8"
    gone = {"PYTHONPATH", "ROS_DOMAIN_ID", "LD_PRELOAD", "COLCON_DEFAULTS_FILE"}
    assert gone.isdisjoint(result.variables)


@needs_wheels
def test_sourced_environment_takes_precedence(tmp_path: Path) -> None:
    user = {
        "PATH": f"{BINARIES}:/usr/bin:/bin", "AMENT_PREFIX_PATH": sys.prefix, "MINE": "kept",
        "ROS_STATIC_PEERS": "10.0.0.1", "RMW_IMPLEMENTATION": "rmw_fastrtps_cpp",
    }  # fmt: skip
    result = environment.select(user, installed=tmp_path)
    assert (result.kind, result.prefix) == ("sourced", sys.prefix)
    assert (result.python, result.colcon) == (f"{BINARIES}/python3", f"{BINARIES}/colcon")
    assert result.variables["MINE"] == "kept"
    assert "ROS_STATIC_PEERS" not in result.variables


@needs_wheels
def test_middleware_that_is_not_installed_is_replaced(tmp_path: Path) -> None:
    user = {
        "PATH": f"{BINARIES}:/usr/bin:/bin",
        "AMENT_PREFIX_PATH": sys.prefix,
        "RMW_IMPLEMENTATION": "rmw_no_such_thing",
    }
    result = environment.select(user, installed=tmp_path)
    assert (result.kind, result.rmw) == ("sourced", "rmw_fastrtps_cpp")


@needs_wheels
def test_installation_is_sourced(tmp_path: Path) -> None:
    for distro in ("humble", "jazzy"):
        (tmp_path / distro).mkdir()
        (tmp_path / distro / "setup.bash").write_text(
            f"export AMENT_PREFIX_PATH={sys.prefix} ROS_DISTRO={distro}\n"
            f"export PATH={BINARIES}:/usr/bin:/bin\n"
        )
    user = {"PATH": "/usr/bin:/bin", "RMW_IMPLEMENTATION": "rmw_no_such_thing", "MINE": "kept"}
    result = environment.select(user, installed=tmp_path)
    assert (result.kind, result.prefix, result.rmw) == ("installed", sys.prefix, "rmw_fastrtps_cpp")
    assert result.variables["ROS_DISTRO"] == "jazzy"
    assert result.variables["MINE"] == "kept"


@needs_wheels
def test_unusable_environments_are_noted(tmp_path: Path) -> None:
    (tmp_path / "jazzy").mkdir()
    (tmp_path / "jazzy" / "setup.bash").write_text("echo no such file >&2; exit 3\n")
    user = {"PATH": str(tmp_path), "AMENT_PREFIX_PATH": "/nowhere"}
    user["PATH"] += ":/usr/bin:/bin"
    result = environment.select(user, installed=tmp_path)
    assert result.kind == "wheels"
    sourced, installed = result.notes
    assert sourced.startswith("the sourced environment (AMENT_PREFIX_PATH is set) ")
    assert installed == f"{tmp_path}/jazzy/setup.bash cannot be sourced: no such file"


def test_no_environment_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(EnvironmentMissingError) as caught:
        environment.select({"PATH": "/usr/bin"}, installed=tmp_path, own_prefix=str(tmp_path))
    assert str(caught.value) == (
        "no ROS 2 environment found: source the setup file of a ROS 2 installation, install "
        f"ROS 2 Jazzy, or run: {installation.command('ros')}"
    )
    assert "\n" not in str(caught.value)


# -- domains


def test_reserved_domains_are_distinct() -> None:
    with domain.reserved() as item, domain.reserved() as other:
        assert item != other
        assert {item, other} <= set(range(1, 102))


def test_domains_reserved_by_other_processes_are_skipped() -> None:
    coordinator = pytest.importorskip("domain_coordinator")
    with ExitStack() as stack:
        others = {stack.enter_context(coordinator.domain_id()) for _ in range(90)}
        assert stack.enter_context(domain.reserved()) not in others


def test_domain_with_ports_in_use_is_skipped() -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as other:
        other.bind(("127.0.0.1", 0))
        port = other.getsockname()[1]
        assert (port - 7400) // 250 in domain.domains_in_use()


def test_domain_of_a_process() -> None:
    """It follows from the two ports of a participant."""
    with domain.reserved() as number, ExitStack() as stack:
        first = 7400 + 250 * number + 12
        for port in (0, first, first + 1):
            assert number not in domain.domains_of([os.getpid()])
            item = stack.enter_context(socket.socket(socket.AF_INET, socket.SOCK_DGRAM))
            item.bind(("127.0.0.1", port))
        assert number in domain.domains_of([os.getpid()])
        assert number not in domain.domains_of([1, 2**30])


def test_error_when_all_domains_are_in_use(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(domain, "domains_in_use", lambda: set(range(1, 102)))
    with pytest.raises(EnvironmentMissingError, match="all ROS domains"), domain.reserved():
        pass


# -- processes


def run_async(run: Callable[[], Coroutine[Any, Any, Result]]) -> Result:
    return asyncio.run(run())


async def started(code: str, directory: Path, mark: str) -> process.Running:
    """Start a Python program and wait for its first output."""
    command = [sys.executable, "-u", "-S", "-c", code]
    running = await process.start(command, dict(os.environ), directory, Origin(mark))
    while not output.read(running.out):
        assert running.exit_code is None, output.read(running.err)
        await asyncio.sleep(0.01)
    return running


def test_signal_that_is_obeyed(tmp_path: Path) -> None:
    async def run() -> tuple[ending.Ending, int | None]:
        running = await started("print(1); input_ = __import__('time').sleep(60)", tmp_path, "a")
        try:
            return await ending.end(running, signal.SIGINT), running.exit_code
        finally:
            await running.close()

    stop, code = run_async(run)
    assert (stop.sent, stop.was_ignored, code) == (("SIGINT",), False, -2)


def test_signal_that_is_ignored(tmp_path: Path) -> None:
    code = (
        "import signal, time\n"
        "signal.signal(signal.SIGINT, signal.SIG_IGN)\n"
        "print(1)\n"
        "while True: time.sleep(60)\n"
    )

    async def run() -> tuple[ending.Ending, int | None]:
        running = await started(code, tmp_path, "a")
        try:
            return await ending.end(running, signal.SIGINT, grace=2.0), running.exit_code
        finally:
            await running.close()

    stop, exit_code = run_async(run)
    assert (stop.sent, exit_code) == (("SIGINT", "SIGINT", "SIGTERM"), -15)
    assert (stop.was_ignored, stop.was_missed) == (True, False)


def test_second_signal_is_obeyed(tmp_path: Path) -> None:
    code = (
        "import signal, time\n"
        "def once(number, frame): signal.signal(number, signal.SIG_DFL)\n"
        "signal.signal(signal.SIGTERM, once)\n"
        "print(1)\n"
        "while True: time.sleep(60)\n"
    )

    async def run() -> ending.Ending:
        running = await started(code, tmp_path, "a")
        try:
            return await ending.end(running, signal.SIGTERM, grace=2.0)
        finally:
            await running.close()

    stop = run_async(run)
    assert (stop.sent, stop.was_missed) == (("SIGTERM", "SIGTERM"), True)


def test_leftover_shared_memory_is_found(tmp_path: Path) -> None:
    """Segments that existed before are kept, as are those that LTTng shares."""
    code = (
        "import mmap, os, sys\n"
        "def map(path):\n"
        "    file = os.open(path, os.O_RDWR | os.O_CREAT)\n"
        "    os.truncate(file, 4096)\n"
        "    return mmap.mmap(file, 4096)\n"
        "maps = [map(path) for path in {paths}]\n"
        "print(1, flush=True)\n"
        "import time\n"
        "while True: time.sleep(60)\n"
    )
    there, new = (
        Path(shared_memory.DIRECTORY, f"scaffold-{os.getpid()}-{name}") for name in ("there", "new")
    )
    of_all = Path(shared_memory.DIRECTORY, f"lttng-ust-scaffold-{os.getpid()}")

    async def run() -> Sequence[str]:
        paths = [str(there), str(new), str(of_all)]
        running = await started(code.replace("{paths}", repr(paths)), tmp_path, "a")
        try:
            await asyncio.sleep(1.0)  # the second look at what has changed
            await ending.end(running, signal.SIGTERM)
            await running.finish()
            return running.leaked
        finally:
            await running.close()

    there.touch()
    try:
        assert run_async(run) == [str(new)]
        assert there.exists()
        assert of_all.exists()
        assert not new.exists()
    finally:
        for path in (there, new, of_all):
            path.unlink(missing_ok=True)


def test_sweep_finds_orphaned_processes(tmp_path: Path) -> None:
    mark = f"test-{os.getpid()}"
    code = (
        "import subprocess, sys\n"
        "command = [sys.executable, '-S', '-c', 'import time; time.sleep(600)']\n"
        "subprocess.Popen(command, start_new_session=True)\n"
        "print(1)\n"
    )

    async def run() -> list[str]:
        running = await started(code, tmp_path, f"{mark}/one")
        try:
            assert await running.ended_within(30)
            commands = list(marks.marked(mark).values())
            assert marks.marked(f"{mark}/other") == {}
            assert len(marks.sweep(mark)) == 1
            return commands
        finally:
            await running.close()

    assert [item.endswith("time.sleep(600)") for item in run_async(run)] == [True]
    assert marks.marked(mark) == {}


# -- shared memory


def test_only_unused_segments_are_removed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(shared_memory, "DIRECTORY", str(tmp_path))
    for name in ("fastrtps_used", "fastrtps_left"):
        (tmp_path / name).touch()
        (tmp_path / f"{name}_el").touch()
        (tmp_path / f"sem.{name}_mutex").touch()
    with (tmp_path / "fastrtps_used_el").open() as lock:
        fcntl.flock(lock, fcntl.LOCK_SH)
        removed = shared_memory.remove_unused(
            ["fastrtps_used", "fastrtps_left", "fastrtps_gone", "../elsewhere"]
        )
    left = ["fastrtps_left", "fastrtps_left_el", "sem.fastrtps_left_mutex"]
    assert [os.path.basename(path) for path in removed] == left
    assert sorted(path.name for path in tmp_path.iterdir()) == [
        "fastrtps_used", "fastrtps_used_el", "sem.fastrtps_used_mutex",
    ]  # fmt: skip


# -- output

CHAINED = """\
noise
Traceback (most recent call last):
  File "/usr/lib/python3.12/runpy.py", line 1, in run
    run()
  File "/ws/install/demo/lib/python3.12/site-packages/demo/talker.py", line 7, in main
    work()
KeyError: 'first'

During handling of the above exception, another exception occurred:

Traceback (most recent call last):
  File "/ws/install/demo/lib/python3.12/site-packages/demo/talker.py", line 7, in main
    work()
  File "/ws/install/demo/lib/python3.12/site-packages/demo/talker.py", line 3, in work
    rclpy.spin(node)
  File "/opt/ros/jazzy/lib/python3.12/site-packages/rclpy/executors.py", line 9, in spin
    raise error
ValueError: second
more noise
"""


def test_last_traceback_is_found() -> None:
    trace = output.traceback(CHAINED)
    assert trace is not None
    assert output.exception(trace) == "ValueError: second"
    shown = output.relative(output.short(trace), Path("/ws/install"))
    assert shown == [
        "Traceback (most recent call last):",
        "  ...",
        '  File "demo/talker.py", line 7, in main',
        "    work()",
        '  File "demo/talker.py", line 3, in work',
        "    rclpy.spin(node)",
        "ValueError: second",
    ]
    assert output.traceback("nothing of the kind") is None


def test_ignored_exception_is_no_traceback() -> None:
    ignored = (
        "Exception ignored in: <function Future.__del__ at 0x7f327814e0c0>\n"
        "Traceback (most recent call last):\n"
        '  File "rclpy/task.py", line 56, in __del__\n'
        "AttributeError: 'Task' object has no attribute '_exception'\n"
    )
    assert output.traceback(ignored) is None
    trace = output.traceback(CHAINED + ignored)
    assert trace is not None
    assert output.exception(trace) == "ValueError: second"


def test_traceback_of_the_caller_is_omitted() -> None:
    text = (
        "Traceback (most recent call last):\n"
        '  File "setup.py", line 1, in <module>\n'
        "ModuleNotFoundError: No module named 'x'\n"
        "Traceback (most recent call last):\n"
        '  File "colcon.py", line 1, in <module>\n'
        "subprocess.CalledProcessError: Command '['python']' returned non-zero exit status 1.\n"
    )
    assert output.errors(text)[-1] == "ModuleNotFoundError: No module named 'x'"


@pytest.mark.parametrize(
    ("text", "lines"),
    [
        (
            (
                "-- Found x\nCMake Error at CMakeLists.txt:3 (find_package):\n  Not\n\n  found\n\n"
                "-- Configuring incomplete, errors occurred!\n"
            ),
            ["CMake Error at CMakeLists.txt:3 (find_package):", "  Not", "  found"],
        ),
        (
            "running build\nerror: package directory 'x' does not exist\n",
            ["error: package directory 'x' does not exist"],
        ),
        (
            "[1/2] Building\nmain.cpp:3:5: error: expected ';' before '}' token\n  3 | }\n",
            ["main.cpp:3:5: error: expected ';' before '}' token"],
        ),
        ("one\n\ntwo\n", ["one", "two"]),
    ],
)
def test_errors_of_a_build(text: str, lines: list[str]) -> None:
    assert output.errors(text) == lines


def test_warnings_of_a_build() -> None:
    text = (
        "CMake Warning at CMakeLists.txt:3 (message):\n  Careful: this\n\n-- Done\n"
        "/x/dist.py:1: UserWarning: Unknown distribution option: 'tests_require'\n"
        "warning: install_lib: byte-compiling is disabled, skipping.\n"
    )
    assert output.warnings(text) == [
        "CMake Warning at CMakeLists.txt:3 (message):",
        "  Careful: this",
        "/x/dist.py:1: UserWarning: Unknown distribution option: 'tests_require'",
    ]


def test_warnings_of_colcon_about_a_package() -> None:
    text = (
        "[0.2s] WARNING:colcon.colcon_core.x:Failed to parse in '/ws/demo': Error:\n"
        "Package version is wrong\n"
        "[0.3s] WARNING:colcon.colcon_core.x:Failed to parse in '/ws/other': Error\n"
        "Starting >>> demo\n"
    )
    assert output.complaints(text, "/ws/demo") == [
        "Failed to parse in '/ws/demo': Error:",
        "Package version is wrong",
    ]


def test_error_message_without_a_traceback() -> None:
    text = '  File "talker.py", line 3\n    print x\n    ^^^^^^^\nSyntaxError: invalid\n'
    assert output.named_error(text) == "SyntaxError: invalid"
    assert output.named_error("usage: talker\ntalker: error: no argument\n") is None


INDEXED = """\
Traceback (most recent call last):
  File "/ws/install/demo/lib/demo/serial", line 33, in <module>
    sys.exit(load_entry_point('demo', 'console_scripts', 'serial')())
  File "/ws/demo/serial.py", line 7, in main
    {line}
        ~~~~~~~~^^^
{exception}
"""


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        (
            "usage: serial [-h] port\nserial: error: the following arguments are required: port\n",
            "the following arguments are required: port",
        ),
        (
            "Usage: serial [OPTIONS] PORT\nTry --help.\n\nError: Missing argument 'PORT'.\n",
            "Missing argument 'PORT'.",
        ),
        ("Usage: serial PORT\n", "Usage: serial PORT"),
        (
            INDEXED.format(
                line="port = sys.argv[1]", exception="IndexError: list index out of range"
            ),
            "IndexError: list index out of range",
        ),
        (
            INDEXED.format(
                line="name, port = sys.argv",
                exception="ValueError: not enough values to unpack (expected 2, got 1)",
            ),
            "ValueError: not enough values to unpack (expected 2, got 1)",
        ),
        (
            INDEXED.format(
                line="first = self.ports[0]", exception="IndexError: list index out of range"
            ),
            None,
        ),
        ("usage: serial [-h]\nserial: error: unrecognized arguments: --ros-args\n", None),
        ("terminate called after throwing an instance of 'std::bad_alloc'\n", None),
    ],
)
def test_missing_arguments_are_recognized(text: str, reason: str | None) -> None:
    assert output.missing_arguments(text) == reason


def test_long_output_is_cut(tmp_path: Path) -> None:
    file = tmp_path / "log"
    file.write_bytes(b"first\n" + b"x" * output.READ_BYTES + b"\n\x1b[31mlast\x1b[0m \xff\n")
    assert output.read(file).endswith("\nlast \ufffd\n")
    assert "first" not in output.read(file)
    many = "\n".join(f"error: {number}" for number in range(100))
    assert len(output.errors(many)) == output.SHOWN_LINES + 1
    assert output.read(tmp_path / "none") == ""


# -- messages


@pytest.mark.skipif(find_spec("std_msgs") is None, reason="no ROS messages")
def test_message_as_plain_data() -> None:
    message = messages.find_type("std_msgs/msg/Float32MultiArray")()
    message.data = [0.1, float("nan"), float("-inf"), 1e30] + [1.0] * 20
    dimension = messages.find_type("std_msgs/msg/MultiArrayDimension")
    message.layout.dim = [dimension(label="x" * 600, size=2)]
    data = messages.as_data(message)
    assert data == {
        "layout": {
            "dim": [{"label": "x" * 500 + "...", "size": 2, "stride": 0}],
            "data_offset": 0,
        },
        "data": [0.1, "nan", "-inf", 1e30] + [1.0] * 12 + ["..."],
    }


@pytest.mark.skipif(find_spec("std_msgs") is None, reason="no ROS messages")
@pytest.mark.parametrize(
    ("kind", "given", "shown"),
    [
        ("Bool", True, True),
        ("Byte", b"\x07", 7),
        ("Float32", 0.1, 0.1),
        ("Float64", 0.1, 0.1),
        ("Int64", -(2**62), -(2**62)),
        ("String", "h\u00e4", "h\u00e4"),
        ("UInt8MultiArray", b"\x00\xff", [0, 255]),
    ],
)
def test_field_as_plain_data(kind: str, given: object, shown: object) -> None:
    message = messages.find_type(f"std_msgs/msg/{kind}")()
    message.data = given
    assert messages.as_data(message)["data"] == shown


# -- hostile output


def test_build_output_is_parsed_in_linear_time(tmp_path: Path) -> None:
    """Each of these took minutes to hours while a pattern was quadratic."""
    size = output.READ_BYTES
    assert output.warnings("x" * size) == []
    assert output.errors("x" * size) == ["x" * size]
    assert output.errors("error in " * (size // 9))
    log = tmp_path / "stdout.log"
    log.write_text("--- stderr: \n" * (size // 13))
    unended = output.read(log)
    assert build.without_repeats(unended) == unended
    error = "RCLError: " * (size // 10)
    assert not trial.is_late_call(error)
    assert trial.is_late_call(error + "the context is invalid")


def test_repeated_stderr_of_colcon_is_removed() -> None:
    console = "before\n--- stderr: demo\nerror: of demo\n---\nafter\n--- stderr: cut off\n"
    assert build.without_repeats(console) == "before\nafter\n--- stderr: cut off\n"


ESCAPES = "\x1b]0;title\x07 \x00 \u202eevil \x9b31m"


def test_report_escapes_control_characters() -> None:
    executable = Executable(
        f"run{ESCAPES}",
        Observation(
            nodes=(f"/node{ESCAPES}",),
            topics=(Topic(f"/topic{ESCAPES}", "a/msg/A", 1, messages=({"data": ESCAPES},)),),
            services=((f"/service{ESCAPES}", "a/srv/A"),),
        ),
        stops=(Stop("SIGINT", 1, 0.1),),
        problems=(Problem(f"crashed: {ESCAPES}", (f"\tline {ESCAPES}",)),),
        notes=(f"note {ESCAPES}",),
    )
    packages = (
        PackageResult("demo", Build(ok=True, warnings=(f"warning: {ESCAPES}",)), (executable,)),
        PackageResult("other", Build(ok=False, errors=(f"error: {ESCAPES}",))),
    )
    environment = {"kind": "wheels", "prefix": f"/opt{ESCAPES}", "rmw": "rmw"}
    out = StringIO()
    report(Smoke(environment, packages, notes=(f"broken {ESCAPES}",)), "text", out)
    text = out.getvalue()
    assert [line for line in text.split("\n") if not line.isprintable()] == []
    assert "crashed: \\x1b]0;title" in text
