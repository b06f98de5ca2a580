"""Message types are looked up in the workspace of the new package."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from scaffold.cli.main import main
from scaffold.generate import payload


@pytest.fixture(autouse=True)
def _isolated_directories(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Isolate a test from the user's settings, in a directory of its own."""
    for name in ("HOME", "XDG_CONFIG_HOME"):
        monkeypatch.setenv(name, str(tmp_path / "home"))
    monkeypatch.setenv("GIT_CONFIG_GLOBAL", os.devnull)
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "ws" / "src").mkdir(parents=True)
    monkeypatch.chdir(tmp_path / "elsewhere")


def new(*words: str) -> int:
    """Write a package into the workspace from another directory."""
    return main(["new", *words, "--destination-directory", "../ws/src"])


def test_messages_of_the_workspace(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert new("leg_interfaces", "--add", "message:Leg fields='float64 angle'") == 0
    assert new("walker", "--message-type", "leg_interfaces/msg/Leg") == 0
    node = (tmp_path / "ws/src/walker/walker/minimal_publisher.py").read_text()
    assert "from leg_interfaces.msg import Leg" in node
    assert "msg.angle = " in node
    capsys.readouterr()


def test_node_named_like_an_imported_class(capsys: pytest.CaptureFixture[str]) -> None:
    assert new("poses", "--node-name", "pose", "--message-type", "geometry_msgs/PoseArray") == 0
    assert "internal error" not in capsys.readouterr().err


@pytest.mark.parametrize("place", [".", "my_robot", "beat_interfaces"])
def test_messages_of_packages_side_by_side(
    place: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """In a repository without `src`, run from its top, a directory and a package."""
    top = tmp_path / "repository"
    top.mkdir()
    monkeypatch.chdir(top)
    assert main(["new", "beat_interfaces", "--add", "message:Beat fields='int32 count'"]) == 0
    (top / ".git").mkdir()
    (top / "my_robot").mkdir()
    names = payload.definitions(str(top / place)).matches("Beat")
    assert names == ["beat_interfaces/msg/Beat"]


def test_messages_next_to_a_package_without_a_repository(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["new", "beat_interfaces", "--add", "message:Beat fields='int32 count'"]) == 0
    assert main(["new", "heart", "--message-type", "beat_interfaces/Beat"]) == 0
    (tmp_path / "beat_interfaces" / "COLCON_IGNORE").touch()
    assert payload.definitions(str(tmp_path)).matches("Beat") == []
    assert payload.definitions(str(tmp_path / "nowhere")).matches("Beat") == []
