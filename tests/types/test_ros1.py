"""ROS 1 packages: one finding instead of dozens about ROS 2."""

from __future__ import annotations

from pathlib import Path

import pytest

from scaffold.check.rules import registry
from scaffold.check.selection import Selection
from scaffold.check.session import Session
from scaffold.configuration import content
from scaffold.model.package import Package

MANIFEST = '<package format="3">\n  <name>old</name>\n{}  <depend>std_msgs</depend>\n{}</package>\n'
CATKIN = "  <buildtool_depend>catkin</buildtool_depend>\n"
FILES = {
    "CMakeLists.txt": "cmake_minimum_required(VERSION 3.0.2)\nproject(old)\n"
    "find_package(catkin REQUIRED COMPONENTS rospy)\ncatkin_package()\n",
    "scripts/talker.py": '#!/usr/bin/env python\nimport rospy\nprint "hello"\n',
    "src/old/other.py": 'import rospy\ndef f():\n    rospy.loginfo("x")\n',
}


def found(dependency: str, export: str = "") -> list[tuple[str, str, int]]:
    session = Session(registry.load(content.roots("rules")), Selection())
    files = {**FILES, "package.xml": MANIFEST.format(dependency, export)}
    reported = session.check(Package.of(files))
    return [(item.code, item.location.path, item.location.line) for item in reported]


@pytest.mark.parametrize("export", ["", "  <export><build_type>catkin</build_type></export>\n"])
def test_ros1_package_has_one_finding(export: str) -> None:
    assert found(CATKIN, export) == [("SC007", "package.xml", 3)]


@pytest.mark.parametrize(
    ("dependency", "export"),
    [
        (CATKIN, "  <export><build_type>ament_cmake</build_type></export>\n"),
        (f"{CATKIN}  <buildtool_depend>ament_cmake</buildtool_depend>\n", ""),
        (f"{CATKIN}  <depend>rclpy</depend>\n", ""),
        (CATKIN.replace(">", ' condition="$ROS_VERSION == 1">', 1), ""),
        ("", ""),
    ],
)
def test_package_for_ros1_and_ros2_is_checked(dependency: str, export: str) -> None:
    reported = {code for code, _, _ in found(dependency, export)}
    assert "SC007" not in reported
    assert {"E999", "E302"} <= reported


def test_package_that_calls_ament_is_checked() -> None:
    session = Session(registry.load(content.roots("rules")), Selection())
    lists = "find_package(ament_cmake REQUIRED)\nament_package()\n"
    files = {**FILES, "package.xml": MANIFEST.format(CATKIN, ""), "CMakeLists.txt": lists}
    assert "SC007" not in {item.code for item in session.check(Package.of(files))}


def test_ros1_package_without_build_file_has_one_finding() -> None:
    session = Session(registry.load(content.roots("rules")), Selection())
    files = {**FILES, "package.xml": MANIFEST.format(CATKIN, "")}
    del files["CMakeLists.txt"]
    assert [item.code for item in session.check(Package.of(files))] == ["SC007"]


def test_ros2_packages_next_to_a_ros1_package_are_checked(tmp_path: Path) -> None:
    from scaffold.cli.main import main

    assert main(["new", "talker", "--destination-directory", str(tmp_path)]) == 0
    for path, text in {**FILES, "package.xml": MANIFEST.format(CATKIN, "")}.items():
        (tmp_path / "old" / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "old" / path).write_text(text)
    assert main(["check", str(tmp_path / "talker")]) == 0
    assert main(["check", str(tmp_path)]) == 1
    (tmp_path / "old" / "COLCON_IGNORE").touch()
    assert main(["check", str(tmp_path)]) == 0


def test_ros1_package_outside_of_the_workspace_of_ros2(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    from scaffold.cli.main import main

    monkeypatch.chdir(tmp_path)
    ament = "  <buildtool_depend>ament_cmake</buildtool_depend>\n"
    for place, tool in {"robot_ws/src/talker": ament, "Assets/old": CATKIN}.items():
        (tmp_path / place).mkdir(parents=True)
        manifest = MANIFEST.format(tool, "").replace("old", place.rpartition("/")[2])
        (tmp_path / place / "package.xml").write_text(manifest)
    main(["check", "--select", "SC007", "."])
    assert " warning SC007 " in capsys.readouterr().out
    (tmp_path / "Assets" / "old" / "package.xml").write_text(
        MANIFEST.format(CATKIN, "").replace("old", "talker")
    )
    main(["check", "--select", "SC007", "."])
    assert " warning SC007 " in capsys.readouterr().out
    (tmp_path / "robot_ws").rename(tmp_path / "robot")
    (tmp_path / "robot" / "src").rename(tmp_path / "robot" / "packages")
    main(["check", "--select", "SC007", "."])
    assert " error SC007 " in capsys.readouterr().out
