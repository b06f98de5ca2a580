"""PF006: parameters are set to values of the declared type and range."""

from __future__ import annotations

import re
from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule, Safety
from scaffold.api.formats import Scalar, YamlNode
from scaffold.api.launch import consumers, started_nodes, values_in_files
from scaffold.api.parameters import (
    Declared,
    Entry,
    a_type,
    agreed_type,
    declared_by,
    narrow_default,
    number_of,
    place_of,
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
_NODE_DEFAULT = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n    def __init__(self):\n        super().__init__('talker')\n"
    "        self.declare_parameter('rate', {})\n"
)
_FILE_DEFAULT = "talker:\n  ros__parameters:\n    rate: {}\n"
_NODE_RANGE = (
    "from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor\n"
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n    def __init__(self):\n        super().__init__('talker')\n"
    "        limits = FloatingPointRange(from_value=0.0, to_value=1.0, step=0.1)\n"
    "        descriptor = ParameterDescriptor(floating_point_range=[limits])\n"
    "        self.declare_parameter('gain', 0.5, descriptor)\n"
)
_FILE_RANGE = "talker:\n  ros__parameters:\n    gain: {}\n"


def _files(default: str, value: str) -> dict[str, str]:
    return {"talker.py": _NODE_DEFAULT.format(default), "a.yaml": _FILE_DEFAULT.format(value)}


class ParameterUnfit(Rule):
    """A parameter is set to a value of the wrong type, or outside of its range.

    **Why.** The node fails at start: ``InvalidParameterTypeException: Trying to set parameter
    'rate' to '2' of type 'INTEGER', expecting type 'DOUBLE'``, or ``InvalidParameterValueException:
    ... out of range``, likewise for a value between two steps. ``on``, ``yes`` and ``n`` are
    booleans, ``2`` is not a double, and the default determines the type.

    **Fix.** Write ``2.0``, also as the default; quote words; change the value or the range.

    **Source.** ``rclpy/node.py``, ``declare_parameters``, ``_apply_floating_point_range``;
    ``rcl_yaml_param_parser/src/parse.c``.
    """

    code = "PF006"
    name = "parameter-unfit"
    examples = (
        Example("a double, a string", {"talker.py": _NODE, "a.yaml": _FILE.format("2.0", "fast")}),
        Example(
            "an integer for a double, a boolean for a string",
            {"talker.py": _NODE, "a.yaml": _FILE.format("2", "on")},
            Report(
                "a.yaml:3:11",
                "'rate' (talker.py:7) is a double, but this is an integer: "
                "InvalidParameterTypeException",
                fix="Convert the value to a double",
            ),
            Report(
                "a.yaml:4:11",
                "'mode' (talker.py:8) is a string, but this is a bool: "
                "InvalidParameterTypeException",
                unsafe_fix="Quote the value",
            ),
            fixed={"a.yaml": _FILE.format("2.0", "'on'")},
        ),
        Example(
            "a placeholder that is replaced before the node reads the file",
            {"talker.py": _NODE, "a.yaml": _FILE.format("REPLACE", "REPLACE")},
        ),
        Example(
            "a string for a double",
            {"talker.py": _NODE, "a.yaml": _FILE.format("'2.0'", "fast")},
            "a.yaml:3:11: 'rate' (talker.py:7) is a double, but this is a string: "
            "InvalidParameterTypeException",
        ),
        Example(
            "for a node of another package of the workspace",
            {"package.xml": _MANIFEST.format("demo_bringup"), "launch/demo.launch.py": _LAUNCH},
            "launch/demo.launch.py:8:22: 'rate' (demo/talker.py:7 of demo) is a double, but 2 is "
            "an integer: InvalidParameterTypeException",
            neighbors={
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
            "3:19: 'use_sim_time' (declared by rclpy) is a bool, but this is a string: "
            "InvalidParameterTypeException",
        ),
        Example("doubles as default and value", _files("1.0", "2.5")),
        Example(
            "an integer as the default of a double",
            _files("1", "2.5"),
            "talker.py:7:9: default is an integer, but a.yaml:3 sets a double: "
            "InvalidParameterTypeException; declare a double",
        ),
        Example(
            "a quoted number as default",
            _files("'1'", "2"),
            "talker.py:7:9: default is a string, but a.yaml:3 sets an integer: "
            "InvalidParameterTypeException; declare an integer",
        ),
        Example(
            "in the range and on a step",
            {"talker.py": _NODE_RANGE, "a.yaml": _FILE_RANGE.format("0.3")},
        ),
        Example(
            "too large; between two steps",
            {
                "talker.py": _NODE_RANGE,
                "a.yaml": _FILE_RANGE.format("1.5"),
                "b.yaml": _FILE_RANGE.format("0.25"),
            },
            "a.yaml:3:11: 1.5 is outside the range 0.0 to 1.0 in steps of 0.1 of 'gain' "
            "(talker.py:10): InvalidParameterValueException",
            "b.yaml:3:11: 0.25 is outside the range 0.0 to 1.0 in steps of 0.1 of 'gain' "
            "(talker.py:10): InvalidParameterValueException",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_type(package)
        yield from self._check_default(package)
        yield from self._check_range(package)

    def _check_type(self, package: Package) -> Iterator[Diagnostic]:
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

    def _check_default(self, package: Package) -> Iterator[Diagnostic]:
        for _, entry, declarations in values_in_files(package):
            kind, _ = agreed_type(package, declarations, entry.name)
            given = value_type(entry.value)
            if not kind or not given or given == kind:
                continue
            default = narrow_default(package, declarations, entry.name, given)
            if default is not None:
                at = entry.value.location
                message = (
                    f"default is {a_type(kind)}, but {at.path}:{at.line} sets "
                    f"{a_type(given)}: InvalidParameterTypeException; "
                    f"declare {a_type(given)}"
                )
                yield self.report(default, message)

    def _check_range(self, package: Package) -> Iterator[Diagnostic]:
        for _, entry, declarations in values_in_files(package):
            message = _message(package, declarations, entry.name, number_of(entry.value))
            if message:
                yield self.report(entry.value, message)
        for node in started_nodes(package):
            numbers = [x for x in node.parameters if x.value and x.value.number is not None]
            owner = node.owner(package) if numbers else None
            declarations = [declared_by(owner, package)] if owner is not None else []
            for given in numbers:
                number = given.value.number if given.value is not None else None
                message = _message(package, declarations, given.name, number)
                if message:
                    yield self.report(given, message)


def _is_placeholder(value: YamlNode, kind: str) -> bool:
    """Return whether a value is a placeholder that a launch file replaces."""
    is_word = isinstance(value, Scalar) and re.fullmatch(_PLACEHOLDER, value.text) is not None
    return is_word and kind in {"bool", "double", "integer"}


def _fix(path: str, entry: Entry, kind: str, given: str) -> Fix | None:
    value = entry.value
    if not isinstance(value, Scalar) or value.end - value.start != len(value.text):
        return None
    if kind == "double" and given == "integer" and value.text.lstrip("+-").isdecimal():
        return Fix("Convert the value to a double", (Edit(path, value.end, value.end, ".0"),))
    if kind == "string":
        edit = Edit(path, value.start, value.end, f"'{value.text}'")
        return Fix("Quote the value", (edit,), Safety.UNSAFE)
    return None


def _message(package: Package, declarations: list[Declared], name: str, value: float | None) -> str:
    """Return the message for a value outside of the range declared by its nodes."""
    kind = "integer" if isinstance(value, int) else "double"
    for declared in declarations if value is not None else ():
        place = declared.places.get(name)
        descriptor = place.descriptor if place is not None else None
        if place is None or descriptor is None or declared.types.get(name) != kind:
            continue
        for limits in descriptor.ranges:
            if value is not None and limits.type == kind and not limits.allows(value):
                where = place_of(place.package, place.location, package)
                return (
                    f"{value} is outside the range {limits.text} of {name!r} "
                    f"({where}): InvalidParameterValueException"
                )
    return ""
