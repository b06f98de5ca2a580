"""Types are looked up in the workspace that the package will be in."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from scaffold.cli.main import main


@pytest.fixture(autouse=True)
def _own_place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """No setting of the machine reaches a test, and its files are its own."""
    for name in ("HOME", "XDG_CONFIG_HOME"):
        monkeypatch.setenv(name, str(tmp_path / "home"))
    monkeypatch.setenv("GIT_CONFIG_GLOBAL", os.devnull)
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "ws" / "src").mkdir(parents=True)
    monkeypatch.chdir(tmp_path / "elsewhere")


def new(*words: str) -> int:
    """Write a package into the workspace, from somewhere else."""
    return main(["new", *words, "--destination-directory", "../ws/src"])


def test_messages_of_the_workspace(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert new("leg_interfaces", "--add", "message:Leg fields='float64 angle'") == 0
    assert new("walker", "--message-type", "leg_interfaces/msg/Leg") == 0
    node = (tmp_path / "ws/src/walker/walker/minimal_publisher.py").read_text()
    assert "from leg_interfaces.msg import Leg" in node
    assert "msg.angle = " in node
    capsys.readouterr()


def test_a_node_named_like_a_class_that_it_imports(capsys: pytest.CaptureFixture[str]) -> None:
    assert new("poses", "--node-name", "pose", "--message-type", "geometry_msgs/PoseArray") == 0
    assert "internal error" not in capsys.readouterr().err
