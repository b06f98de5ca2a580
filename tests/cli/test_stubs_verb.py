"""The verb `stubs`: the files it writes and keeps, and its messages."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from scaffold.cli.main import main
from tests.test_stubs import definitions_of


@pytest.fixture(autouse=True)
def workspace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a workspace with an interface package, which is the current directory."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.delenv("AMENT_PREFIX_PATH", raising=False)
    definitions_of(tmp_path, {"msg/Level.msg": "uint8 level\n", "srv/Reset.srv": "---\n"})
    return tmp_path


def files(directory: Path) -> set[str]:
    return {str(path.relative_to(directory)) for path in directory.rglob("*") if path.is_file()}


def test_stubs_of_libraries_and_interfaces_are_written(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["stubs"]) == 0
    assert {
        "rclpy/node.pyi",
        "launch_ros/actions/node.pyi",
        "std_msgs/msg/_string.pyi",
        "robot_interfaces/msg/_level.pyi",
        "robot_interfaces/srv/_reset.pyi",
    } <= files(workspace / "typings")
    assert 'mypy needs `mypy_path = "typings"`' in capsys.readouterr().out


def test_strict_pyright_has_no_findings_in_stubs(workspace: Path) -> None:
    main(["stubs"])
    (workspace / "pyrightconfig.json").write_text('{"typeCheckingMode": "strict"}')
    command = [sys.executable, "-m", "basedpyright", "typings/rclpy", "typings/ament_flake8"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout


def test_mypy_has_no_findings_in_stubs_of_another_distribution(workspace: Path) -> None:
    main(["stubs", "--distro", "lyrical"])
    (workspace / "program.py").write_text(
        "from rclpy.action import ActionServer\n\nprint(ActionServer.wrong)\n"
    )
    command = [sys.executable, "-m", "mypy", "--config-file=", "--strict", "program.py"]
    environment = {**os.environ, "MYPYPATH": "typings"}
    done = subprocess.run(command, capture_output=True, text=True, check=False, env=environment)
    result = [
        line.partition(": error")[0] for line in done.stdout.splitlines() if ": error" in line
    ]
    assert result == ["program.py:3"], done.stdout


def test_only_changed_stubs_are_rewritten(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    main(["stubs"])
    (workspace / "robot_interfaces/msg/Level.msg").write_text("uint8 level\nbool is_low\n")
    capsys.readouterr()
    assert main(["stubs"]) == 0
    assert ", 1 written\n" in capsys.readouterr().out
    assert "is_low: bool" in (workspace / "typings/robot_interfaces/msg/_level.pyi").read_text()


def test_stubs_of_removed_interfaces_are_deleted_and_user_stubs_kept(workspace: Path) -> None:
    main(["stubs"])
    own = workspace / "typings/camera_driver/__init__.pyi"
    own.parent.mkdir()
    own.write_text("def grab() -> bytes: ...\n")
    (workspace / "robot_interfaces/srv/Reset.srv").unlink()
    assert main(["stubs"]) == 0
    assert "robot_interfaces/srv/_reset.pyi" not in files(workspace / "typings")
    assert own.read_text() == "def grab() -> bytes: ...\n"


def test_user_files_are_not_overwritten(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    own = workspace / "typings/rclpy/node.pyi"
    own.parent.mkdir(parents=True)
    own.write_text("class Node: ...\n")
    assert main(["stubs"]) == 2
    assert "would overwrite rclpy/node.pyi in typings" in capsys.readouterr().err
    assert files(workspace / "typings") == {"rclpy/node.pyi"}
    assert main(["stubs", "--force"]) == 0
    assert "def create_publisher" in own.read_text()


@pytest.mark.parametrize("flag", ["--dry-run", "--diff"])
def test_preview_writes_nothing(
    workspace: Path, capsys: pytest.CaptureFixture[str], flag: str
) -> None:
    before = files(workspace)
    assert main(["stubs", flag]) == 0
    assert files(workspace) == before
    out = capsys.readouterr().out
    assert "would be written" in out or "+class Level(Message):" in out


def test_advice_names_the_chosen_directory(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["stubs", "--output", "build/types"]) == 0
    assert '"stubPath": "build/types"' in capsys.readouterr().out
    assert not (workspace / "typings").exists()


def test_missing_directory_is_an_error(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["stubs", "nowhere"]) == 2
    assert "nowhere: no such directory" in capsys.readouterr().err


def test_a_file_in_place_of_the_directory_is_an_error(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (workspace / "typings").write_text("")
    assert main(["stubs"]) == 2
    assert "typings: Not a directory" in capsys.readouterr().err


def test_library_stubs_are_written_without_any_package(
    tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch
) -> None:
    empty = tmp_path_factory.mktemp("empty")
    monkeypatch.chdir(empty)
    assert main(["stubs"]) == 0
    assert "rclpy/node.pyi" in files(empty / "typings")
