"""LF014: launch arguments for parameters that are text stay text."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity
from scaffold.api.launch import started_nodes
from scaffold.api.parameters import declared_by

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


class TextReadAsYaml(Rule):
    """A launch argument goes to a parameter that is text, and launch reads it as YAML.

    **Why.** It works until somebody writes ``text:=42`` or ``text:=on``: ``InvalidParameterType
    Exception: Trying to set parameter 'text' to '42' of type 'INTEGER', expecting type 'STRING'``.

    **Fix.** ``ParameterValue(LaunchConfiguration('text'), value_type=str)``.

    **Source.** ``launch_ros/utilities/evaluate_parameters.py``; launch_ros issue 30.
    """

    code = "LF014"
    name = "text-read-as-yaml"
    severity = Severity.WARNING
    examples = (
        Example(
            "kept as text",
            {
                **_FILES,
                "launch/a.launch.py": _LAUNCH.format("ParameterValue(text, value_type=str)"),
            },
        ),
        Example(
            "one of certain texts",
            {
                **_FILES,
                "launch/a.launch.py": _LAUNCH.format("text").replace(
                    "default_value='hello'", "default_value='hello', choices=['hello', 'bye']"
                ),
            },
        ),
        Example(
            "read as YAML",
            {**_FILES, "launch/a.launch.py": _LAUNCH.format("text")},
            Report(
                "launch/a.launch.py:12:70",
                "text is a string, and launch reads a value such as 42 or on as "
                "YAML: wrap it in ParameterValue(..., value_type=str)",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for node in started_nodes(package):
            given = [x for x in node.parameters if x.is_configuration and not x.has_choices]
            owner = node.owner(package) if given else None
            declared = declared_by(owner, package) if owner is not None else None
            for item in given if declared is not None else ():
                if declared is None or declared.types.get(item.name) != "string":
                    continue
                if item.value is None or item.value.type == "string":
                    message = (
                        f"{item.name} is a string, and launch reads a value such as 42 or on as "
                        "YAML: wrap it in ParameterValue(..., value_type=str)"
                    )
                    yield self.report(item, message)
