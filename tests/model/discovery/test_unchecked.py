"""A package checked alone has the same findings as in its workspace."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from scaffold.check import runner
from scaffold.check.rules import registry
from scaffold.configuration import content
from scaffold.diagnostic import Diagnostic
from scaffold.files.disk import holds
from scaffold.model.discovery import targets as discovery
from scaffold.model.discovery import unchecked
from scaffold.model.package import Package

RULES = [rule() for rule in registry.load(content.roots("rules"))]
MANIFEST = """\
<?xml version="1.0"?>
<package format="3">
  <!-- The name says it. -->
  <name>{name}</name>
  <version>0.1.0</version>
  <description>A package.</description>
  <maintainer email="a@example.org">A</maintainer>
  <license>MIT</license>
  <exec_depend>{needs}</exec_depend>
  <export><build_type>ament_python</build_type></export>
</package>
"""
LAUNCH = """\
from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([Node(package='driver', executable='{program}')])
"""
SETUP = """\
from setuptools import setup

setup(
    name='driver', version='0.1.0', packages=['driver'],
    entry_points={'console_scripts': ['drive = driver.drive:main']},
)
"""


def write(top: Path, files: dict[str, str]) -> None:
    for name, text in files.items():
        path = top / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)


@pytest.fixture
def workspace(tmp_path: Path) -> Path:
    manifests = {
        "bringup/package.xml": MANIFEST.format(name="bringup", needs="driver"),
        "group/driver-of-2026/package.xml": MANIFEST.format(name="driver", needs="launch"),
        "ignored/driver/package.xml": MANIFEST.format(name="hidden", needs="launch"),
        "ignored/COLCON_IGNORE": "",
    }
    write(tmp_path / "src", manifests)
    write(tmp_path / "src/bringup", {"launch/robot.launch.py": LAUNCH.format(program="dirve")})
    write(tmp_path / "src/group/driver-of-2026", {"setup.py": SETUP, "driver/drive.py": ""})
    return tmp_path


def found_package(path: Path, name: str = "bringup") -> Package:
    """Return the package with a name among those selected by a path."""
    targets = discovery.find([str(path)])
    return next(target.package for target in targets if target.package.name == name)


def findings(package: Package, *codes: str) -> list[Diagnostic]:
    return [finding for finding in runner.check(package, RULES) if finding.code in codes]


def test_findings_are_the_same_with_and_without_the_workspace(workspace: Path) -> None:
    alone = findings(found_package(workspace / "src/bringup"), "LF005", "LF006")
    assert [finding.code for finding in alone] == ["LF006"]
    assert "driver" in alone[0].message
    assert alone == findings(found_package(workspace), "LF005", "LF006")
    assert alone == findings(
        found_package(workspace / "src/bringup/launch/robot.launch.py"), "LF005", "LF006"
    )


def test_other_packages_are_not_checked(workspace: Path) -> None:
    (target,) = discovery.find([str(workspace / "src/bringup")])
    assert target.package.name == "bringup"
    assert target.package.workspace.names == ["bringup", "driver"]
    assert target.package.workspace.get("hidden") is None


def test_whole_workspace_needs_no_search(workspace: Path) -> None:
    for given in (workspace, workspace / "src"):
        around = found_package(given).known_workspace
        assert around is not None
        assert around.around is None


def test_other_packages_are_read_lazily(workspace: Path) -> None:
    package = found_package(workspace / "src/bringup")
    manifest = str(workspace / "src/group/driver-of-2026/package.xml")
    assert ("content", manifest) not in package.outside.seen
    assert package.workspace.get("driver") is not None
    assert ("content", manifest) in package.outside.seen


def test_findings_depend_on_files_of_other_packages(workspace: Path) -> None:
    package = found_package(workspace / "src/bringup")
    assert findings(package, "LF006")
    seen = package.outside.seen
    assert holds(seen)
    setup = workspace / "src/group/driver-of-2026/setup.py"
    setup.write_text(SETUP.replace("drive =", "dirve ="))
    assert not holds(seen)
    assert not findings(found_package(workspace / "src/bringup"), "LF006")


def test_search_is_limited_to_a_number_of_directories(
    workspace: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(unchecked, "MOST_DIRECTORIES", 3)
    package = found_package(workspace / "src/bringup")
    assert package.workspace.names == ["bringup"]
    assert not findings(package, "LF006")


@pytest.fixture
def repository(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a directory with packages, none of them below ``src``."""
    manifests = {
        "robot/bringup/package.xml": MANIFEST.format(name="bringup", needs="driver"),
        "robot/driver/package.xml": MANIFEST.format(name="driver", needs="launch"),
        "robot/group/more/package.xml": MANIFEST.format(name="more", needs="launch"),
        "robot/driver/inner/package.xml": MANIFEST.format(name="inner", needs="launch"),
        "robot/hidden/package.xml": MANIFEST.format(name="hidden", needs="launch"),
        "robot/hidden/COLCON_IGNORE": "",
        "msgs/package.xml": MANIFEST.format(name="msgs", needs="launch"),
    }
    write(tmp_path, manifests)
    monkeypatch.chdir(tmp_path / "robot" / "group")
    return tmp_path


def test_packages_side_by_side_without_a_workspace(repository: Path) -> None:
    assert found_package(repository / "robot/bringup").workspace.names == ["bringup", "driver"]


def test_packages_in_the_current_directory(
    repository: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(repository)
    assert found_package(repository / "robot/bringup").workspace.names == [
        "bringup",
        "driver",
        "msgs",
    ]
    monkeypatch.setattr(unchecked, "MOST_DIRECTORIES", 3)
    assert found_package(repository / "robot/bringup").workspace.names == ["bringup", "msgs"]


def test_other_files_next_to_a_package_change_no_findings(repository: Path) -> None:
    package = found_package(repository / "robot/bringup")
    assert package.workspace.get("driver") is not None
    (repository / "robot" / "notes").mkdir()
    (repository / "robot" / "notes.txt").touch()
    assert holds(package.outside.seen)
    write(repository, {"robot/new/package.xml": MANIFEST.format(name="new", needs="launch")})
    assert not holds(package.outside.seen)


def test_packages_of_the_same_repository(repository: Path) -> None:
    (repository / "robot" / ".git").mkdir()
    names = ["bringup", "driver", "more"]
    assert found_package(repository / "robot/bringup").workspace.names == names
    around = found_package(repository / "robot").known_workspace
    assert around is not None
    assert around.around is None


def test_message_types_of_a_package_next_to_this_one(repository: Path) -> None:
    node = "from driver.msg import Speed\n\nspeed = Speed(value=1.0, unit='m/s')\n"
    write(repository / "robot/driver", {"msg/Speed.msg": "float64 value\n"})
    write(repository / "robot/bringup", {"bringup/__init__.py": "", "bringup/go.py": node})
    (finding,) = findings(found_package(repository / "robot/bringup"), "MS003")
    assert "'unit'" in finding.message


def test_nested_source_directory(workspace: Path) -> None:
    inner = workspace / "src/repository/src/inner"
    write(inner, {"package.xml": MANIFEST.format(name="inner", needs="driver")})
    assert found_package(inner, "inner").workspace.names == ["inner"]
    os.mkdir(workspace / "install")
    assert found_package(inner, "inner").workspace.names == ["bringup", "driver", "inner"]
