"""``smoke`` on real packages: built with colcon, run, observed over the middleware, stopped."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import venv
from pathlib import Path
from typing import Any

import pytest

from scaffold.model.discovery import targets
from scaffold.smoke.isolation import shared_memory
from scaffold.smoke.options import Options
from scaffold.smoke.reports.json import as_data
from scaffold.smoke.session import packages_of, smoke
from tests import PATIENCE
from tests.smoke.smoke_packages import BAD, GOOD, ONCE, cmake_package, python_package, talker, write
from tests.smoke.smoke_runs import (
    NEEDS_ROS,
    ROOT,
    command_line,
    processes_of,
    variables,
    wait_until,
)

pytestmark = [pytest.mark.build, NEEDS_ROS]

Result = dict[str, Any]

TIMEOUT = 20.0
"""Seconds that executables get to appear; one of those of the tests never does."""


@pytest.fixture(scope="session")
def sources(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a directory of packages: good ones, and one for each kind of failure."""
    root = tmp_path_factory.mktemp("sources")
    python_package(root, "good_py", GOOD)
    cmake_package(root, "good_cmake", {"talker": talker("numbers")})
    python_package(root, "bad_py", BAD)
    cmake_package(root, "unbuilt_cmake", {"talker": talker("numbers")})
    lists = root / "unbuilt_cmake" / "CMakeLists.txt"
    lists.write_text(lists.read_text().replace("(rclpy", "(no_such_package"))
    python_package(root, "unbuilt_py", {"once": ONCE})
    write(root, {"unbuilt_py/setup.py": "import no_such_module\n"})
    python_package(root, "dependent", {"once": ONCE})
    manifest = root / "dependent" / "package.xml"
    depend = "<depend>unbuilt_cmake</depend>"
    manifest.write_text(manifest.read_text().replace("<exec", f"{depend}\n  <exec", 1))
    python_package(root, "uninstalled", {"once": ONCE})
    (root / "uninstalled" / "setup.cfg").unlink()
    return root


@pytest.fixture(scope="session")
def original_sources(sources: Path) -> dict[str, bytes]:
    """Return the content of the sources before the runs."""
    return {str(path): path.read_bytes() for path in sorted(sources.rglob("*")) if path.is_file()}


@pytest.fixture(scope="session")
def packages(
    sources: Path, original_sources: dict[str, bytes], tmp_path_factory: pytest.TempPathFactory
) -> dict[str, Result]:
    """Return the reports on all packages, by name, of one run."""
    assert original_sources
    before = shared_memory.segments()
    tmp = tmp_path_factory.mktemp("scratch")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("TMPDIR", str(tmp))
        patch.setattr("tempfile.tempdir", None)
        patch.setenv("RMW_IMPLEMENTATION", "rmw_no_such_thing")
        patch.setenv("ROS_DOMAIN_ID", "232")
        actual = packages_of(targets.find([str(sources)]))
        result = smoke(actual, Options(duration=2.0, timeout=TIMEOUT, jobs=6))
    assert processes_of(tmp) == []
    assert list(tmp.iterdir()) == []
    assert shared_memory.segments() - before - shared_memory.used_by_anybody() == set()
    data = json.loads(json.dumps(as_data(result)))
    return {package["name"]: package for package in data["packages"]}


def is_about_10(rate: float) -> bool:
    """Return whether a rate is that of the talkers, with tolerance for a busy machine."""
    return 5.0 < rate < 20.0


def executable(packages: dict[str, Result], package: str, name: str) -> Result:
    result: list[Result] = packages[package]["executables"]
    return next(item for item in result if item["name"] == name)


def failed_executable(packages: dict[str, Result], name: str) -> tuple[Result, str]:
    """Return the report of a failed executable, and its only problem."""
    result = executable(packages, "bad_py", name)
    assert not result["ok"]
    (problem,) = result["problems"]
    return result, problem


@pytest.mark.parametrize(("package", "name"), [("good_py", "talker"), ("good_cmake", "talker.py")])
def test_good_publisher_has_no_problems(
    packages: dict[str, Result], package: str, name: str
) -> None:
    assert packages[package]["build"]["ok"]
    assert packages[package]["build"]["warnings"] == []
    result = executable(packages, package, name)

    assert (result["ok"], result["problems"], result["nodes"]) == (True, [], ["/talker"])
    (topic,) = result["topics"]
    assert (topic["name"], topic["type"]) == ("/numbers", "std_msgs/msg/String")
    assert (topic["publishers"], topic["subscribers"]) == (1, 0)
    assert is_about_10(topic["rate_hz"])
    assert topic["count"] >= 5
    texts = [message["data"] for message in topic["messages"]]
    first = int(texts[0].removeprefix("number "))
    assert texts == [f"number {first + step}" for step in range(5)]
    assert (result["stop"]["signal"], result["stop"]["exit_code"]) == ("SIGINT", 0)
    assert result["stop"]["traceback"] is None


def test_keys_of_the_report(packages: dict[str, Result]) -> None:
    package = packages["good_py"]
    assert set(package) == {
        "name", "dependency", "worker", "build", "executables", "together", "launches", "tests",
    }  # fmt: skip
    assert set(package["build"]) == {"ok", "interrupted", "seconds", "errors", "warnings"}
    result = executable(packages, "good_py", "talker")
    assert set(result) == {
        "name", "ok", "interrupted", "nodes", "topics", "services", "actions", "parameters",
        "transitions", "log", "usage", "stop", "problems", "notes",
    }  # fmt: skip
    assert set(result["topics"][0]) == {
        "name", "type", "publishers", "subscribers", "rate_hz", "count", "messages", "endpoints",
        "first_after", "lost", "interval", "bytes", "size", "bandwidth", "delay", "transport",
        "rates",
    }  # fmt: skip
    assert set(result["stop"]) == {"signal", "exit_code", "seconds", "traceback"}


def test_namespace_latched_message_and_relay(packages: dict[str, Result]) -> None:
    result = executable(packages, "good_py", "listener")
    assert (result["ok"], result["nodes"]) == (True, ["/deep/listener"])
    topics = {topic["name"]: topic for topic in result["topics"]}
    assert set(topics) == {"/deep/listener/kept", "/deep/relayed", "/heard"}
    kept = topics["/deep/listener/kept"]
    assert (kept["type"], kept["count"]) == ("std_msgs/msg/Float32MultiArray", 1)
    assert kept["rate_hz"] is None
    assert kept["messages"][0]["data"] == [0.1] * 16 + ["..."]
    assert (topics["/heard"]["publishers"], topics["/heard"]["subscribers"]) == (0, 1)
    assert result["notes"] == ["no message on /deep/relayed: it is only published on some event"]
    assert result["services"] == [
        {"name": "/deep/answers", "type": "rcl_interfaces/srv/ListParameters"}
    ]


def test_program_that_is_no_node(packages: dict[str, Result]) -> None:
    result = executable(packages, "good_py", "once")
    assert (result["ok"], result["nodes"], result["topics"]) == (True, [], [])
    assert (result["stop"]["signal"], result["stop"]["exit_code"]) == (None, 0)
    assert result["notes"][0].startswith("exited on its own after ")


def test_crash_at_start(packages: dict[str, Result]) -> None:
    result, problem = failed_executable(packages, "crashes")
    assert problem.splitlines()[0] == (
        "crashed at start, exit code 1: RuntimeError: no configuration found"
    )
    assert '  File "bad_py/crashes.py", line 8, in read_configuration' in problem
    assert (result["nodes"], result["stop"]["exit_code"]) == ([], 1)


def test_crash_after_start(packages: dict[str, Result]) -> None:
    result, problem = failed_executable(packages, "crashes_later")
    assert problem.splitlines()[0].endswith("s, exit code 1: ValueError: the counter is worn out")
    assert problem.startswith("crashed after ")
    assert result["nodes"] == ["/talker"]
    assert 1 <= result["topics"][0]["count"] <= 8


def test_program_that_hangs_before_creating_a_node(packages: dict[str, Result]) -> None:
    _, problem = failed_executable(packages, "hangs")
    lines = problem.splitlines()
    assert lines[:2] == [f"hangs: no node appeared within {TIMEOUT:g} s", "waiting for the device"]
    assert "    threading.Event().wait()" in lines


def test_program_that_ignores_signals(packages: dict[str, Result]) -> None:
    result, problem = failed_executable(packages, "ignores")
    assert problem == "ignored SIGINT: still running after 5 s, SIGKILL ended it"
    assert (result["stop"]["signal"], result["stop"]["exit_code"]) == ("SIGKILL", -9)


def test_program_that_leaves_a_process(packages: dict[str, Result]) -> None:
    _, problem = failed_executable(packages, "parent")
    assert problem.startswith("leaves a process running: ")
    assert problem.endswith("-c import time; time.sleep(600)")


def test_node_that_never_publishes(packages: dict[str, Result]) -> None:
    result, problem = failed_executable(packages, "silent")
    assert problem == "no message on /silent: no running code calls publish()"
    assert result["topics"][0]["count"] == 0


def test_node_with_wrong_rate(packages: dict[str, Result]) -> None:
    result, problem = failed_executable(packages, "slow")
    # How slow the machine is decides whether the rate or the count is reported.
    assert problem.startswith(("/slow comes at ", "only "))
    assert problem.endswith(": bad_py/slow.py publishes std_msgs/msg/String at 10 Hz")
    assert (result["topics"][0]["rate_hz"] or 0) < 6.0


def test_wrong_rate_in_one_of_two_runs_is_a_note(packages: dict[str, Result]) -> None:
    result = executable(packages, "bad_py", "late_once")
    assert (result["ok"], result["problems"]) == (True, [])
    (note,) = result["notes"]
    # How late the first run is decides whether its rate or its count is reported.
    reported = ("/late_once comes at ", "only ")
    assert note.removeprefix("in the first of two runs only: ").startswith(reported)
    assert note.endswith(": bad_py/late_once.py publishes std_msgs/msg/String at 10 Hz")
    assert is_about_10(result["topics"][0]["rate_hz"])


def test_traceback_on_shutdown(packages: dict[str, Result]) -> None:
    result, problem = failed_executable(packages, "traceback")
    assert problem.splitlines()[0] == (
        "does not stop cleanly on SIGINT, killed by SIGINT: KeyboardInterrupt"
    )
    assert result["stop"]["exit_code"] == -2
    assert result["stop"]["traceback"].endswith("\nKeyboardInterrupt")


def test_node_that_is_not_spun(packages: dict[str, Result]) -> None:
    _, problem = failed_executable(packages, "unspun")
    assert problem.startswith("exited on its own after ")
    assert "before a message on /unspun: bad_py/unspun.py publishes" in problem


def test_node_that_exits_before_publishing(packages: dict[str, Result]) -> None:
    result, problem = failed_executable(packages, "leaves")
    assert problem.startswith("exited on its own after ")
    assert problem.endswith(
        "before a message on /leaves: bad_py/leaves.py publishes std_msgs/msg/String at 2 Hz"
    )
    assert (result["stop"]["signal"], result["stop"]["exit_code"]) == (None, 0)


def test_package_that_does_not_build(packages: dict[str, Result]) -> None:
    for name, first, some in (
        ("unbuilt_cmake", "CMake Error at CMakeLists.txt:5 (find_package):", "no_such_package"),
        ("unbuilt_py", "Traceback (most recent call last):", "No module named 'no_such_module'"),
    ):
        build = packages[name]["build"]
        assert not build["ok"]
        assert build["errors"][0] == first
        assert any(some in line for line in build["errors"])
        assert packages[name]["executables"] == []


def test_package_with_failed_dependency(packages: dict[str, Result]) -> None:
    assert packages["dependent"]["build"] == {
        "ok": False,
        "interrupted": False,
        "seconds": 0.0,
        "errors": ["not built: it depends on unbuilt_cmake, which failed"],
        "warnings": [],
    }


def test_package_that_colcon_ignores(tmp_path: Path) -> None:
    package = python_package(tmp_path, "ignored", {"once": ONCE})
    (package / "COLCON_IGNORE").touch()
    result = smoke(packages_of(targets.find([str(package)])), Options())
    assert not result.ok
    assert result.packages[0].build.errors == ("not built: colcon does not find the package",)


def test_package_with_a_broken_manifest(tmp_path: Path) -> None:
    package = python_package(tmp_path, "broken", {"once": ONCE})
    (package / "package.xml").write_text("<package>\n  <name>broken</name>\n")
    result = smoke(packages_of(targets.find([str(package)])), Options())
    assert not result.ok
    (error,) = result.packages[0].build.errors
    assert error.startswith("not built: package.xml:")
    assert "<package> opened at line 1 is not closed" in error


def test_build_timeout(sources: Path) -> None:
    actual = packages_of(targets.find([str(sources / "good_py")]))
    result = smoke(actual, Options(build_timeout=0.1))
    assert not result.ok
    assert result.packages[0].build.errors[-1] == "the build did not finish within 0.1 s"


def test_executable_not_found_by_ros2_run(packages: dict[str, Result]) -> None:
    result = executable(packages, "uninstalled", "once")
    assert result["problems"] == [
        "ros2 run does not find it: it is declared, but not in lib/uninstalled"
    ]
    assert result["stop"]["exit_code"] is None


def test_sources_are_not_changed(
    packages: dict[str, Result], sources: Path, original_sources: dict[str, bytes]
) -> None:
    assert packages
    assert original_sources == {
        str(path): path.read_bytes() for path in sorted(sources.rglob("*")) if path.is_file()
    }


def test_json_report_from_the_command_line(sources: Path, tmp_path: Path) -> None:
    workspace = tmp_path / "workspace"
    done = subprocess.run(
        command_line(
            sources / "good_py", "--duration", "1", "--signal", "both", "--format", "json",
            "--workspace", workspace,
        ),
        env=variables(tmp_path),
        capture_output=True,
        text=True,
        check=False,
    )  # fmt: skip
    assert (done.returncode, done.stderr) == (0, "")
    data = json.loads(done.stdout)
    assert set(data) == {
        "schema_version", "environment", "packages", "ok", "ended_early", "seconds",
    }  # fmt: skip
    assert set(data["environment"]) == {"kind", "distribution", "prefix", "rmw"}
    assert data["ok"] is True
    talker_ = next(e for e in data["packages"][0]["executables"] if e["name"] == "talker")
    assert [(s["signal"], s["exit_code"]) for s in talker_["stops"]] == [
        ("SIGINT", 0), ("SIGTERM", 0),
    ]  # fmt: skip
    assert (workspace / "install" / "setup.sh").exists()
    assert [path.name for path in tmp_path.iterdir()] == ["workspace"]


def test_text_report(sources: Path, tmp_path: Path) -> None:
    done = subprocess.run(
        command_line(sources / "good_cmake", sources / "unbuilt_py", "--duration", "1", "--keep"),
        env=variables(tmp_path),
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 1
    (kept,) = tmp_path.iterdir()
    assert done.stderr == f"kept: {kept}\n"
    lines = done.stdout.splitlines()
    assert lines[0].startswith("ROS 2 Jazzy (")
    assert "  talker.py: ok" in lines
    assert "    node /talker" in lines
    (topic,) = [line.split() for line in lines if line.startswith("    /numbers")]
    assert topic[:4] == ["/numbers", "std_msgs/msg/String", "1", "publisher"]
    assert is_about_10(float(topic[4]))
    assert topic[5] == "Hz"
    assert any(line.startswith('      {data: "number ') for line in lines)
    assert any(line.startswith("    stopped by SIGINT in ") for line in lines)
    assert "unbuilt_py: does not build" in lines
    assert "  ModuleNotFoundError: No module named 'no_such_module'" in lines
    assert lines[-1].startswith("2 packages, 1 executable: unbuilt_py not built in ")
    assert "\033" not in done.stdout


@pytest.mark.parametrize(
    ("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143), (signal.SIGKILL, -9)]
)
def test_interrupted_while_running(
    sources: Path, tmp_path: Path, number: signal.Signals, code: int
) -> None:
    with subprocess.Popen(
        command_line(sources / "good_py", "--duration", "300"),
        env=variables(tmp_path),
        stderr=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    ) as run:
        wait_until(lambda: any("lib/good_py/talker" in item for item in processes_of(tmp_path)))
        run.send_signal(number)
        report, errors = run.communicate(timeout=PATIENCE)
    assert run.returncode == code
    wait_until(lambda: processes_of(tmp_path) == [])
    if number != signal.SIGKILL:
        assert f"\nended early: interrupted by {number.name}\n" in report
        assert errors == f"ros2-scaffold: interrupted by {number.name}\n"
        assert list(tmp_path.iterdir()) == []


def test_interrupted_during_the_build(sources: Path, tmp_path: Path) -> None:
    with subprocess.Popen(
        command_line(sources / "good_py"), env=variables(tmp_path), stderr=subprocess.PIPE
    ) as run:
        wait_until(lambda: any("setup.py" in item for item in processes_of(tmp_path)))
        run.send_signal(signal.SIGINT)
        run.communicate(timeout=PATIENCE)
    assert run.returncode == 130
    assert processes_of(tmp_path) == []
    assert list(tmp_path.iterdir()) == []


@pytest.mark.skipif(Path("/opt/ros").exists(), reason="there is a ROS 2 installation")
def test_error_without_ros(sources: Path, tmp_path: Path) -> None:
    python = tmp_path / "bare" / "bin" / "python"
    venv.create(tmp_path / "bare", symlinks=True)
    done = subprocess.run(
        [python, "-m", "scaffold.cli.main", "smoke", sources / "good_py"],
        env={"PATH": os.defpath, "PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == (
        "ros2-scaffold: error: no ROS 2 environment found: source the setup file of a ROS 2 "
        "installation, install ROS 2 Jazzy, or run: pipx install --force '.[ros]' "
        "(in a clone of its repository)\n"
    )
