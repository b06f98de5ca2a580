"""LF084: launch files pass declared arguments to xacro."""

from __future__ import annotations

import ast
import itertools
import re
from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, LaunchRule, Package, closest_name
from scaffold.api.launch import LaunchFile
from scaffold.api.robot import Expansion, robots

_ROBOT = (
    '<robot name="robot" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
    '  <xacro:arg name="use_sim" default="false"/>\n'
    "  {}\n"
    '  <link name="base"/>\n</robot>\n'
)
_LAUNCH = (
    "from launch import LaunchDescription\n"
    "from launch.substitutions import Command, PathJoinSubstitution\n"
    "from launch_ros.actions import Node\n"
    "from launch_ros.substitutions import FindPackageShare\n\n\n"
    "def generate_launch_description():\n"
    "    model = PathJoinSubstitution([FindPackageShare('demo'), 'urdf', 'robot.xacro'])\n"
    "    description = Command(['xacro ', model, ' {}:=true'])\n"
    "    return LaunchDescription([\n"
    "        Node(package='robot_state_publisher', executable='robot_state_publisher',\n"
    "             parameters=[{{'robot_description': description}}]),\n    ])\n"
)
_ENDINGS = (".xacro", ".urdf")
# linear: the texts of a launch file
_GIVEN = re.compile(r"(?:^|\s)([^\W\d]\w*):=")


class XacroArgumentUnknown(LaunchRule):
    """A launch file passes an argument to xacro that neither the file nor its includes declare.

    **Why.** xacro silently ignores it: the robot description uses the default.

    **Fix.** Use the name of an ``<xacro:arg>``, or declare one.

    **Source.** xacro, ``substitution_args_context``.
    """

    code = "LF084"
    name = "xacro-argument-unknown"
    effect = Effect.WRONG_BEHAVIOR
    examples = (
        Example(
            "declared",
            {
                "package.xml": "<package><name>demo</name></package>\n",
                "urdf/robot.xacro": _ROBOT.format(""),
                "launch/a.launch.py": _LAUNCH.format("use_sim"),
            },
        ),
        Example(
            "another file as the value of an argument",
            {
                "package.xml": "<package><name>demo</name></package>\n",
                "urdf/wheels.xacro": _ROBOT.format("").replace(' name="robot"', "", 1),
                "launch/a.launch.py": _LAUNCH.format("use_arm")
                .replace("    model", "    wheels")
                .replace("robot.xacro", "wheels.xacro")
                .replace(
                    "'xacro ', model,", "'xacro ', '/other/robot.xacro', ' wheels:=', wheels,"
                ),
            },
        ),
        Example(
            "an include of another package",
            {
                "package.xml": "<package><name>demo</name></package>\n",
                "urdf/robot.xacro": _ROBOT.format(
                    '<xacro:include filename="$(find other)/arm.xacro"/>'
                ),
                "launch/a.launch.py": _LAUNCH.format("use_arm"),
            },
        ),
        Example(
            "not declared",
            {
                "package.xml": "<package><name>demo</name></package>\n",
                "urdf/robot.xacro": _ROBOT.format(""),
                "launch/a.launch.py": _LAUNCH.format("use_simulation"),
            },
            "launch/a.launch.py:9:45: urdf/robot.xacro has no <xacro:arg> 'use_simulation': it is "
            "ignored; did you mean 'use_sim'?",
        ),
    )

    def check_in(self, package: Package, launch: LaunchFile) -> Iterator[Diagnostic]:
        for call in launch.find("Command"):
            parts = call.call.args[0] if call.call.args else None
            if not isinstance(parts, ast.List) or not _is_xacro(parts):
                continue
            robot = _robot(package, launch, parts)
            if robot is None or not robot.is_complete:
                continue
            for part in parts.elts:
                if not isinstance(part, ast.Constant) or not isinstance(part.value, str):
                    continue
                for name in _GIVEN.findall(part.value):
                    if name not in robot.arguments:
                        closest = closest_name(package, name, robot.arguments, 0.5)
                        hint = f"; did you mean {closest!r}?" if closest else ""
                        message = f"{robot.file.path} has no <xacro:arg> {name!r}: it is ignored"
                        yield self.report(launch.location(part), message + hint)


def _is_xacro(parts: ast.List) -> bool:
    match parts.elts:
        case [ast.Constant(value=str(word)), *_]:
            return word.split()[:1] == ["xacro"]
    return False


def _robot(package: Package, launch: LaunchFile, parts: ast.List) -> Expansion | None:
    """Return the only robot of the package whose file a command names."""
    values = {
        value
        for before, value in itertools.pairwise(parts.elts)
        if isinstance(before, ast.Constant) and str(before.value).endswith(":=")
    }
    texts = [launch.evaluator.joined_text(part) for part in parts.elts if part not in values]
    names = {
        text.rpartition("/")[2]
        for text in texts
        if isinstance(text, str) and text.endswith(_ENDINGS) and f"/{package.name}/" in text
    }
    candidates = [
        robot for robot in robots(package).whole if robot.file.path.rpartition("/")[2] in names
    ]
    return candidates[0] if len(candidates) == 1 and len(names) == 1 else None
