"""Runs launch files of packages, each in a separate domain."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path

from scaffold import distributions
from scaffold.errors import EnvironmentMissingError
from scaffold.model.package import Package
from scaffold.smoke.environment import TIMEOUT, Environment
from scaffold.smoke.processes import process
from scaffold.smoke.processes.process import Origin
from scaffold.smoke.together import Group

_ENDINGS = ("launch.py", "launch.xml", "launch.yaml", "launch.yml")
_GRACE = 12.0
"""Seconds from SIGINT to the end: launch gives its nodes five, and five more after SIGTERM."""
_CODE = """\
import sys
from launch import LaunchDescription, LaunchService
from launch.actions import IncludeLaunchDescription
from launch.launch_description_sources import AnyLaunchDescriptionSource

service = LaunchService(noninteractive=True)
source = AnyLaunchDescriptionSource(sys.argv[1])
service.include_launch_description(LaunchDescription([IncludeLaunchDescription(source)]))
sys.exit(service.run())
"""
"""A replacement for `ros2 launch`, which the ROS wheels lack."""


def require(environment: Environment, packages: Sequence[Package], origin: Origin) -> None:
    """Make sure that launch files can be run.

    Args:
        environment: The ROS 2.
        packages: The packages to build, which may include launch.
        origin: The run.

    Raises:
        EnvironmentMissingError: there is no launch_ros; the message says how to get it.
    """
    if any(package.name == "launch_ros" for package in packages):
        return
    command = [environment.python, "-c", "import launch_ros.actions"]
    if not process.capture(command, environment.variables, origin, TIMEOUT).exit_code:
        return
    distribution = environment.distribution or distributions.DEFAULT
    way = f"run: sudo apt install ros-{distribution}-launch-ros"
    if environment.kind == "wheels":
        branches = f"--branch {distribution} https://github.com/ros2"
        way = (
            "there is no wheel; clone its sources next to your packages: "
            f"git clone {branches}/launch && git clone {branches}/launch_ros, "
            f"and install their dependencies: {environment.python} -m pip install lark "
            "osrf-pycommon"
        )
    raise EnvironmentMissingError(f"--launch: {environment.prefix} lacks launch_ros; {way}")


def groups(package: str, python: str, variables: Mapping[str, str]) -> list[Group]:
    """Return the launch files that a package installs, each as a group.

    Args:
        package: Its name.
        python: The interpreter that has launch.
        variables: The variables of the environment with the built packages.
    """
    for prefix in variables.get("AMENT_PREFIX_PATH", "").split(os.pathsep):
        share = Path(prefix, "share", package)
        if not share.is_dir():
            continue
        files = sorted(
            path
            for path in share.rglob("*")
            if path.name.endswith(_ENDINGS) and "/hook/" not in str(path) and path.is_file()
        )
        return [
            Group(
                str(path.relative_to(share)),
                f"{package}/launch/{number}",
                {path.name: [python, "-c", _CODE, str(path)]},
                _GRACE,
            )
            for number, path in enumerate(files)
        ]
    return []
