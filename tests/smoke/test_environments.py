"""Selecting an environment with a flag, and messages about missing parts."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path

import pytest

from scaffold.errors import EnvironmentMissingError
from scaffold.model.package import Package
from scaffold.smoke import environment
from scaffold.smoke.building.unavailable import unavailable
from scaffold.smoke.environment import Environment
from tests.smoke.smoke_packages import python_package
from tests.smoke.smoke_runs import NEEDS_ROS


@pytest.mark.parametrize(
    ("wanted", "reason"),
    [
        ("sourced", "nothing is sourced; first source the setup file of a ROS 2 installation"),
        ("wheels", "they are missing; run: "),
        ("humble", "humble/setup.bash; use a directory, or one of sourced, wheels, jazzy"),
        ("/nowhere", "there is no /nowhere/setup.bash; use a directory, or one of "),
    ],
)
def test_missing_requested_environment_is_an_error(
    wanted: str, reason: str, tmp_path: Path
) -> None:
    (tmp_path / "jazzy").mkdir()
    (tmp_path / "jazzy" / "setup.bash").touch()
    with pytest.raises(EnvironmentMissingError) as raised:
        environment.select(
            {"PATH": "/usr/bin"}, forced=wanted, installed=tmp_path, own_prefix=str(tmp_path)
        )
    assert str(raised.value).startswith(f"--ros {wanted}: ")
    assert reason in str(raised.value)


@NEEDS_ROS
def test_requested_wheels_take_precedence_over_sourced_environment(tmp_path: Path) -> None:
    variables = {"PATH": os.environ["PATH"], "AMENT_PREFIX_PATH": str(tmp_path)}
    assert environment.select(variables, forced="wheels").kind == "wheels"


def test_missing_programs_are_named_with_install_commands(tmp_path: Path) -> None:
    index = tmp_path / "ros" / "share/ament_index/resource_index/packages"
    index.mkdir(parents=True)
    (index / "rclpy").touch()
    package = python_package(tmp_path, "viewer", {"viewer": "import cv_bridge\nimport rclpy\n"})
    manifest = package / "package.xml"
    text = manifest.read_text().replace(
        "  <exec_depend>std_msgs", "  <exec_depend>cv_bridge</exec_depend>\n  <exec_depend>std_msgs"
    )
    manifest.write_text(text)
    wheels = Environment(
        "wheels", "/wheels", "", "", "", {"AMENT_PREFIX_PATH": str(tmp_path / "ros")}
    )
    ((line, _),) = unavailable(wheels, [Package.at(str(package))])
    assert line == (
        "viewer needs cv_bridge, which /wheels lacks; there is no wheel; install it with "
        "sudo apt install ros-jazzy-cv-bridge, and use --ros jazzy"
    )
    installed = replace(wheels, kind="installed", prefix="/opt/ros/kilted")
    installed = replace(installed, distribution="kilted")
    ((line, _),) = unavailable(installed, [Package.at(str(package))])
    assert line == (
        "viewer needs cv_bridge, which /opt/ros/kilted lacks; "
        "run: sudo apt install ros-kilted-cv-bridge"
    )
