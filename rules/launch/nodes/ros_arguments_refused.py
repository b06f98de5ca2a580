"""LF085: executables started by launch files accept ROS arguments."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Location, Package, Rule, ViewError, fact
from scaffold.api.launch import started_nodes
from scaffold.api.python import PythonModule

_PLAYER = (
    "import argparse\nimport sys\n\nimport rclpy\nfrom rclpy.node import Node\n"
    "from rclpy.utilities import remove_ros_args\n\n\n"
    "class Player(Node):\n    def __init__(self, speed):\n"
    "        super().__init__('player')\n        self.speed = speed\n\n\n"
    "def main():\n"
    "    parser = argparse.ArgumentParser()\n"
    "    parser.add_argument('--speed', type=float, default=1.0)\n"
    "    options = parser.{}\n"
    "    rclpy.init()\n    rclpy.spin(Player(options.speed))\n"
)
_HANDLED = ("remove_ros_args(", "parse_known", "sys.argv =", "argv.remove", "ros-args")
"""Words in programs that handle ROS arguments."""
_REMOVED = "parse_args(remove_ros_args(sys.argv)[1:])"
_FILES = {
    "package.xml": "<package><name>demo</name>"
    "<export><build_type>ament_python</build_type></export></package>\n",
    "setup.py": "from setuptools import setup\n\nsetup(name='demo', packages=['demo'],\n"
    "      entry_points={'console_scripts': ['play = demo.player:main']})\n",
    "demo/__init__.py": "",
    "launch/play.launch.py": "from launch import LaunchDescription\n"
    "from launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n"
    "    return LaunchDescription([Node(package='demo', executable='play')])\n",
}


class RosArgumentsRefused(Rule):
    """A launch file starts an executable that does not accept ROS arguments.

    **Why.** ``Node`` of launch_ros adds ``--ros-args`` to every command line: argparse prints
    ``error: unrecognized arguments: --ros-args``, and the executable exits.

    **Fix.** Write ``parser.parse_args(rclpy.utilities.remove_ros_args(sys.argv)[1:])``.

    **Source.** ``launch_ros``, ``actions/node.py``; ``rclpy/utilities.py``.
    """

    code = "LF085"
    name = "ros-arguments-refused"
    examples = (
        Example(
            "ROS arguments are removed",
            {
                **_FILES,
                "demo/player.py": _PLAYER.format("parse_args(remove_ros_args(sys.argv)[1:])"),
            },
        ),
        Example(
            "unknown arguments are accepted",
            {**_FILES, "demo/player.py": _PLAYER.format("parse_known_args()[0]")},
        ),
        Example(
            "all arguments are parsed",
            {**_FILES, "demo/player.py": _PLAYER.format("parse_args()")},
            "demo/player.py:18:15: launch/play.launch.py:6 starts this executable with --ros-args: "
            "argparse exits with an error; use remove_ros_args()",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        seen: set[str] = set()
        for node in started_nodes(package):
            owner = node.owner(package) if node.package == package.name else None
            if owner is None or owner.path in seen:
                continue
            seen.add(owner.path)
            for at in _parsing(package, owner.path):
                message = (
                    f"{node.launch}:{node.location.line} starts this executable with --ros-args: "
                    f"argparse exits with an error; use remove_ros_args()"
                )
                yield self.report(at, message)


@fact
def _parsing(package: Package, path: str) -> list[Location]:
    """Return the places where an executable parses its whole command line."""
    try:
        module = package.module(path) if b"argparse" in package.data(path) else None
    except ViewError:
        return []
    if module is None or module.mentions(*_HANDLED):
        return []
    return [module.location(call) for call in _parse_calls(module)]


def _parse_calls(module: PythonModule) -> Iterator[ast.Call]:
    made = {
        assigned.targets[0].id
        for assigned in module.walk(ast.Assign)
        if isinstance(assigned.value, ast.Call)
        and module.qualified_name(assigned.value.func) == "argparse.ArgumentParser"
        and isinstance(assigned.targets[0], ast.Name)
    }
    for attribute in module.index.attributes("parse_args"):
        call = module.parent(attribute)
        if not isinstance(call, ast.Call) or call.args or call.keywords:
            continue
        if isinstance(attribute.value, ast.Name) and attribute.value.id in made:
            yield call
