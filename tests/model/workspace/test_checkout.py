"""A package may consist of several directories of its checkout."""

from __future__ import annotations

from pathlib import Path

import pytest

from scaffold.files.tree import DiskTree
from scaffold.model.install.modules import is_elsewhere
from scaffold.model.package import Package
from scaffold.model.workspace.workspace import Workspace


@pytest.mark.parametrize(
    ("module", "expected"),
    [
        ("robot/node.py", True),
        ("conf/robot/node.py", True),
        ("conf/robot/__init__.py", False),
        ("robot/other.py", False),
    ],
)
def test_module_above_the_package_is_found(tmp_path: Path, module: str, *, expected: bool) -> None:
    (tmp_path / ".git").mkdir()
    (tmp_path / "conf" / "ros2").mkdir(parents=True)
    (tmp_path / module).parent.mkdir(parents=True, exist_ok=True)
    (tmp_path / module).touch()
    package = Package(DiskTree(str(tmp_path / "conf" / "ros2")), workspace=Workspace())
    assert is_elsewhere(package, "robot.node") is expected


def test_module_next_to_setup_py_belongs_to_the_package(tmp_path: Path) -> None:
    (tmp_path / ".git").mkdir()
    (tmp_path / "robot").mkdir()
    (tmp_path / "robot" / "node.py").touch()
    package = Package(DiskTree(str(tmp_path / "robot")), workspace=Workspace())
    assert not is_elsewhere(package, "robot.node")
