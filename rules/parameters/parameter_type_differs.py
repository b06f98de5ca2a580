"""PF006: values have the declared type."""

from __future__ import annotations

import re
from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule, Safety
from scaffold.api.formats import Scalar, YamlNode
from scaffold.api.launch import consumers, values_in_files
from scaffold.api.parameters import (
    Entry,
    a_type,
    agreed_type,
    declared_by,
    narrow_default,
    value_type,
)

_NODE = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n    def __init__(self):\n        super().__init__('talker')\n"
    "        self.declare_parameter('rate', 2.0)\n"
    "        self.declare_parameter('mode', 'slow')\n"
)
_PLACEHOLDER = r"(?!(?:TRUE|FALSE|YES|OFF)$)[A-Z_]{3,}|<\w+>|\$\(.*\)|\{\{.*\}\}"
_ERROR = "InvalidParameterTypeException"
_FILE = "talker:\n  ros__parameters:\n    rate: {}\n    mode: {}\n"
_MANIFEST = (
    "<package><name>{}</name><export><build_type>ament_python</build_type></export></package>\n"
)
_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n    return LaunchDescription([\n"
    "        Node(package='demo', executable='talk', parameters=[\n"
    "            {'rate': 2, 'mode': 'fast'}]),\n    ])\n"
)


class ParameterTypeDiffers(Rule):
    """A parameter is set to a value of another type than the node declares.

    **Why.** The node ends at start: ``InvalidParameterTypeException: Trying to set parameter
    'rate' to '2' of type 'INTEGER', expecting type 'DOUBLE'``. ``on``, ``yes`` and ``n`` are
    booleans, ``2`` is not a double.

    **Fix.** Write ``2.0``; quote words.

    **Source.** ``rclpy/node.py``, ``declare_parameters``; ``rcl_yaml_param_parser/src/parse.c``.
    """

    code = "PF006"
    name = "parameter-type-differs"
    examples = (
        Example("a double, a string", {"talker.py": _NODE, "a.yaml": _FILE.format("2.0", "fast")}),
        Example(
            "an integer for a double, a boolean for a string",
            {"talker.py": _NODE, "a.yaml": _FILE.format("2", "on")},
            Report(
                "a.yaml:3:11",
                "'rate' (talker.py:7) is a double, but this is an integer: "
                "InvalidParameterTypeException",
                fix="write it as a double",
            ),
            Report(
                "a.yaml:4:11",
                "'mode' (talker.py:8) is a string, but this is a bool: "
                "InvalidParameterTypeException",
                unsafe_fix="quote it",
            ),
            fixed={"a.yaml": _FILE.format("2.0", "'on'")},
        ),
        Example(
            "a word that is replaced before the node gets the file",
            {"talker.py": _NODE, "a.yaml": _FILE.format("REPLACE", "REPLACE")},
        ),
        Example(
            "a string for a double",
            {"talker.py": _NODE, "a.yaml": _FILE.format("'2.0'", "fast")},
            Report(
                "a.yaml:3:11",
                "'rate' (talker.py:7) is a double, but this is a string: "
                "InvalidParameterTypeException",
            ),
        ),
        Example(
            "for a node of another package of the workspace",
            {"package.xml": _MANIFEST.format("demo_bringup"), "launch/demo.launch.py": _LAUNCH},
            Report(
                "launch/demo.launch.py:8:22",
                "'rate' (demo/talker.py:7 of demo) is a double, but 2 is an "
                "integer: InvalidParameterTypeException",
            ),
            neighbours={
                "demo": {
                    "package.xml": _MANIFEST.format("demo"),
                    "setup.py": "from setuptools import setup\n\nsetup(entry_points={\n"
                    "    'console_scripts': ['talk = demo.talker:main']})\n",
                    "demo/talker.py": _NODE,
                }
            },
        ),
        Example(
            "a string for a parameter of every node",
            {"a.yaml": "camera:\n  ros__parameters:\n    use_sim_time: 'true'\n"},
            Report(
                "3:19",
                "'use_sim_time' (declared by rclpy) is a bool, but this is a "
                "string: InvalidParameterTypeException",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for path, entry, declarations in values_in_files(package):
            kind, where = agreed_type(package, declarations, entry.name)
            given = value_type(entry.value)
            if not kind or not given or given == kind or _is_placeholder(entry.value, kind):
                continue
            if narrow_default(package, declarations, entry.name, given) is None:
                message = f"{where} is {a_type(kind)}, but this is {a_type(given)}: {_ERROR}"
                yield self.report(entry.value, message, _fix(path, entry, kind, given))
        yield from self._in_launch_files(package)

    def _in_launch_files(self, package: Package) -> Iterator[Diagnostic]:
        for node in consumers(package):
            owner = node.owner(package) if node.parameters else None
            declarations = [declared_by(owner, package)] if owner is not None else []
            for item in node.parameters:
                kind, where = agreed_type(package, declarations, item.name)
                given = item.value
                if kind and given and given.type != kind:
                    actual = f"{given.text} is {a_type(given.type)}"
                    message = f"{where} is {a_type(kind)}, but {actual}: {_ERROR}"
                    yield self.report(item, message)


def _is_placeholder(value: YamlNode, kind: str) -> bool:
    """Tell whether a value stands for a number or a truth that a launch file puts there."""
    is_word = isinstance(value, Scalar) and re.fullmatch(_PLACEHOLDER, value.text) is not None
    return is_word and kind in {"bool", "double", "integer"}


def _fix(path: str, entry: Entry, kind: str, given: str) -> Fix | None:
    value = entry.value
    if not isinstance(value, Scalar) or value.end - value.start != len(value.text):
        return None
    if kind == "double" and given == "integer" and value.text.lstrip("+-").isdecimal():
        return Fix("write it as a double", (Edit(path, value.end, value.end, ".0"),))
    if kind == "string":
        edit = Edit(path, value.start, value.end, f"'{value.text}'")
        return Fix("quote it", (edit,), Safety.UNSAFE)
    return None
