"""LF068: xacro files are given to xacro, and not read as they are."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, LaunchRule, Location
from scaffold.api.launch import LaunchFile

_LAUNCH = (
    "import os\n\nfrom ament_index_python.packages import get_package_share_directory\n"
    "from launch import LaunchDescription\nfrom launch.substitutions import Command\n"
    "from launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n"
    "    path = os.path.join(get_package_share_directory('talker'), 'urdf', 'robot.{}')\n"
    "    description = {}\n"
    "    return LaunchDescription([\n"
    "        Node(package='robot_state_publisher', executable='robot_state_publisher',\n"
    "             parameters=[{{'robot_description': description}}]),\n    ])\n"
)


class XacroReadAsText(LaunchRule):
    """A launch file reads a xacro file as if it were URDF.

    **Why.** The macros stay as they are: robot_state_publisher finds no links, or ends with
    ``Failed to parse robot description``.

    **Fix.** ``ParameterValue(Command(['xacro ', path]), value_type=str)``.

    **Source.** xacro, README; ROS 2 documentation, "Using Xacro to clean up your code".
    """

    code = "LF068"
    name = "xacro-read-as-text"
    examples = (
        Example(
            "URDF; written",
            {
                "launch/a.launch.py": _LAUNCH.format("urdf", "open(path).read()"),
                "launch/b.launch.py": _LAUNCH.format("xacro", "open(path, 'w').write('')"),
            },
        ),
        Example(
            "given to xacro",
            {"launch/a.launch.py": _LAUNCH.format("xacro", "Command(['xacro ', path])")},
        ),
        Example(
            "read as it is",
            {
                "launch/a.launch.py": _LAUNCH.format("urdf.xacro", "open(path).read()"),
                "launch/b.launch.py": _LAUNCH.format("xacro", "Command(['cat ', path])"),
            },
            "launch/a.launch.py:11:19: a xacro file is read without expanding its macros; run "
            "xacro in a Command",
            "launch/b.launch.py:11:28: a xacro file is read without expanding its macros; run "
            "xacro in a Command",
        ),
    )

    def check_file(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        for at in _reads(launch):
            message = "a xacro file is read without expanding its macros; run xacro in a Command"
            yield self.report(at, message)


def _reads(launch: LaunchFile) -> Iterator[Location]:
    """Yield the places where the text of a xacro file is taken."""
    module = launch.module
    if module.mentions("xacro.process", "xacro.parse", "import xacro"):
        return
    for call in module.walk(ast.Call):
        match call:
            case ast.Call(func=ast.Name(id="open"), args=[path]):
                if _is_xacro(launch, path):
                    yield launch.location(call)
            case ast.Call(func=ast.Name(id="open"), args=[path, ast.Constant(value="r")]):
                if _is_xacro(launch, path):
                    yield launch.location(call)
    for program, node in launch.programs:
        call_node = module.parent(node)
        texts = ast.walk(call_node) if call_node is not None else iter(())
        if program == "cat" and any(
            isinstance(item, ast.expr) and _is_xacro(launch, item) for item in texts
        ):
            yield launch.location(node)


def _is_xacro(launch: LaunchFile, node: ast.expr) -> bool:
    text = launch.evaluator.joined_text(node)
    return isinstance(text, str) and text.endswith(".xacro")
