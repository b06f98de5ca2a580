"""LF014: launch arguments for string parameters remain strings."""

from __future__ import annotations

import re
from collections.abc import Iterator

from scaffold.api import (
    Diagnostic,
    Example,
    Location,
    Package,
    Report,
    Rule,
    Severity,
    ViewError,
    fact,
)
from scaffold.api.launch import NODES, LaunchFile, launch_paths, parameters_given, started_nodes
from scaffold.api.parameters import declared_by
from scaffold.api.robot import is_launched, robot_paths

_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch.actions import DeclareLaunchArgument\n"
    "from launch.substitutions import LaunchConfiguration\nfrom launch_ros.actions import Node\n"
    "from launch_ros.parameter_descriptions import ParameterValue\n"
    "\n\ndef generate_launch_description():\n"
    "    text = LaunchConfiguration('text')\n"
    "    return LaunchDescription([\n"
    "        DeclareLaunchArgument('text', default_value='hello'),\n"
    "        Node(package='demo', executable='talk', parameters=[{{'text': {}}}]),\n    ])\n"
)
_FILES = {
    "package.xml": '<package format="3"><name>demo</name>'
    "<export><build_type>ament_python</build_type></export></package>\n",
    "setup.py": "from setuptools import setup\n\nsetup(\n    name='demo',\n"
    "    entry_points={'console_scripts': ['talk = demo.talk:main']},\n)\n",
    "demo/talk.py": "from rclpy.node import Node\n\n\nclass Talker(Node):\n"
    "    def __init__(self):\n        super().__init__('talker')\n"
    "        self.declare_parameter('text', '')\n",
}

_COMMAND = (
    "from launch import LaunchDescription\nfrom launch.substitutions import Command\n"
    "from launch_ros.actions import Node\n"
    "from launch_ros.parameter_descriptions import ParameterValue\n"
    "\n\ndef generate_launch_description():\n"
    "    urdf = Command(['xacro ', 'urdf/robot.urdf'])\n"
    "    return LaunchDescription([\n"
    "        Node(package='robot_state_publisher', executable='robot_state_publisher',\n"
    "             parameters=[{{'robot_description': {}}}]),\n    ])\n"
)
_NAMES_SOMETHING = (
    r"(?:^|_)(?:file|filename|path|dir|directory|folder|topic|url|uri|frame|frame_id|namespace"
    r"|ip|ip_address|host|hostname)$"
)
"""Matches parameters with names as values, which do not look like numbers or booleans."""


class TextReadAsYaml(Rule):
    """launch parses a launch argument or the output of a command as YAML instead of a string.

    **Why.** It works until a user passes ``text:=42`` or ``text:=on``: ``InvalidParameterType
    Exception: Trying to set parameter 'text' to '42' of type 'INTEGER', expecting type 'STRING'``.
    A robot description that contains a colon and a space, as in a comment, stops the launch:
    ``Unable to parse the value of parameter robot_description as yaml``.

    **Fix.** ``ParameterValue(LaunchConfiguration('text'), value_type=str)``.

    **Source.** ``launch_ros/utilities/evaluate_parameters.py``; launch_ros issue 30.
    """

    code = "LF014"
    name = "text-read-as-yaml"
    severity = Severity.WARNING
    other_severities = {Severity.ERROR: "it is a robot description, which YAML cannot parse"}
    examples = (
        Example(
            "kept as a string",
            {
                **_FILES,
                "launch/a.launch.py": _LAUNCH.format("ParameterValue(text, value_type=str)"),
            },
        ),
        Example(
            "one of several choices",
            {
                **_FILES,
                "launch/a.launch.py": _LAUNCH.format("text").replace(
                    "default_value='hello'", "default_value='hello', choices=['hello', 'bye']"
                ),
            },
        ),
        Example(
            "a path, which does not look like a number",
            {
                path: text.replace("'text'", "'map_file'")
                for path, text in {
                    **_FILES,
                    "launch/a.launch.py": _LAUNCH.format("text"),
                }.items()
            },
        ),
        Example(
            "an address, which does not look like a number",
            {
                path: text.replace("'text'", "'robot_ip'")
                for path, text in {
                    **_FILES,
                    "launch/a.launch.py": _LAUNCH.format("text"),
                }.items()
            },
        ),
        Example(
            "parsed as YAML",
            {**_FILES, "launch/a.launch.py": _LAUNCH.format("text")},
            "launch/a.launch.py:12:70: text is a string, but launch parses values such as 42 or "
            "on as YAML: InvalidParameterTypeException; wrap it in ParameterValue(..., "
            "value_type=str)",
        ),
        Example(
            "the output of a command, kept as a string",
            {"launch/a.launch.py": _COMMAND.format("ParameterValue(urdf, value_type=str)")},
        ),
        Example(
            "a description that YAML parses as a string; a comment that xacro drops",
            {
                "launch/a.launch.py": _COMMAND.format("urdf"),
                "urdf/robot.urdf": '<robot name="a" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
                '  <!-- mass: as weighed -->\n  <xacro:arg name="c" default=""/>\n'
                '  <link name="b"/>\n</robot>\n',
            },
        ),
        Example(
            "a description that is not YAML",
            {
                "launch/a.launch.py": _COMMAND.format("urdf"),
                "launch/b.launch.py": _COMMAND.format("ParameterValue(urdf)"),
                "urdf/robot.urdf": '<robot name="a">\n  <!-- mass: as weighed -->\n'
                '  <link name="b"/>\n</robot>\n',
            },
            Report(
                "launch/a.launch.py:11:48",
                "launch parses the output of this command for robot_description as "
                "YAML, which fails at ': ' in urdf/robot.urdf:2; wrap it in "
                "ParameterValue(..., value_type=str)",
                severity=Severity.ERROR,
            ),
            Report(
                "launch/b.launch.py:11:48",
                "launch parses the output of this command for robot_description as "
                "YAML, which fails at ': ' in urdf/robot.urdf:2; wrap it in "
                "ParameterValue(..., value_type=str)",
                severity=Severity.ERROR,
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for path in launch_paths(package):
            try:
                outputs = _outputs(package, path)
            except ViewError:
                continue
            broken = _with_colon(package) if outputs else None
            for name, at in outputs if broken is not None else ():
                message = (
                    f"launch parses the output of this command for {name} as YAML, which fails at "
                    f"': ' in {broken}; wrap it in ParameterValue(..., value_type=str)"
                )
                cause = f"command read as YAML in {path}"
                yield self.report(at, message, severity=Severity.ERROR, cause=cause)
        for node in started_nodes(package):
            given = [
                x for x in node.parameters if x.configuration is not None and not x.has_choices
            ]
            owner = node.owner(package) if given else None
            declared = declared_by(owner, package) if owner is not None else None
            for item in given if declared is not None else ():
                if declared is None or declared.types.get(item.name) != "string":
                    continue
                if re.search(_NAMES_SOMETHING, item.name):
                    continue
                if item.value is None or item.value.type == "string":
                    message = (
                        f"{item.name} is a string, but launch parses values such as 42 or on as "
                        f"YAML: InvalidParameterTypeException; wrap it in ParameterValue(..., "
                        f"value_type=str)"
                    )
                    cause = f"text read as YAML in {item.location.path}"
                    yield self.report(item, message, cause=cause)


@fact
def _outputs(package: Package, path: str) -> tuple[tuple[str, Location], ...]:
    """Return the parameters set to the raw output of a command, with their places."""
    launch = LaunchFile.of(package, path)
    result: list[tuple[str, Location]] = []
    for call in launch.find(*NODES, "ComposableNode"):
        for name, _, value in parameters_given(launch, call):
            given = launch.call_of(value)
            if given is not None and given.kind == "ParameterValue":
                typed = "value_type" in given.given or len(given.call.args) > 1
                given = None if typed else launch.call_of(given.given.get("value"))
            if given is not None and given.kind == "Command":
                result.append((name, launch.location(value)))
    return tuple(result)


def _without_dropped_comments(text: str) -> str:
    """Return the text without the comments before xacro elements."""
    first, *others = text.split("<!--")
    kept = ""
    for part in reversed(others):
        comment, end, rest = part.partition("-->")
        following = rest + kept
        is_dropped = bool(end) and (rest.strip() or kept).lstrip().startswith("<xacro:")
        kept = following.lstrip() if is_dropped else f"<!--{comment}{end}{following}"
    return first + kept


def _with_colon(package: Package) -> str | None:
    """Return the place in a robot description that YAML parses as a key.

    xacro drops a comment before its own elements.
    """
    for path in robot_paths(package):
        try:
            text = package.source(path).text
        except ViewError:
            continue
        kept = _without_dropped_comments(text)
        if ": " in kept and is_launched(package, path):
            row = next(line for line in kept.splitlines() if ": " in line).strip()
            number = next(number for number, line in enumerate(text.splitlines(), 1) if row in line)
            return f"{path}:{number}"
    return None
