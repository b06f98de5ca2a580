"""PF004: parameters that files set are declared by the node."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from scaffold.api import (
    Diagnostic,
    Example,
    Location,
    Package,
    Report,
    Rule,
    Severity,
    ViewError,
    closest_name,
    listed_names,
)
from scaffold.api.launch import (
    GivenParameter,
    is_loaded,
    is_only_loaded,
    nodes_for,
    started_nodes,
)
from scaffold.api.parameters import Declared, declared_by, parameter_files
from scaffold.api.programs import KnownNode

from ._own_values import comparable, comparable_in_file, own_texts, own_values, plain_name

_NODE = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n    def __init__(self):\n        super().__init__('talker'{})\n"
    "        self.declare_parameter('rate', 2.0)\n"
    "        self.declare_parameter('limits.high', 3)\n"
)
_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch.substitutions import LaunchConfiguration\n"
    "from launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n    return LaunchDescription([\n"
    "        Node(package='demo', executable='talk', parameters=[{\n"
    "            'rate': LaunchConfiguration('rate'), 'rates': LaunchConfiguration('rate'),\n"
    "            'raet': LaunchConfiguration('speed')}]),\n    ])\n"
)
_LAUNCH_FILE = (
    "from launch import LaunchDescription\nfrom launch.substitutions import PathJoinSubstitution\n"
    "from launch_ros.actions import Node\nfrom launch_ros.substitutions import FindPackageShare\n"
    "\n\ndef generate_launch_description():\n"
    "    config = PathJoinSubstitution([FindPackageShare('demo'), 'config', 'a.yaml'])\n"
    "    return LaunchDescription([\n"
    "        Node(package='demo', executable='talk', parameters=[config]),\n    ])\n"
)
_PACKAGE = {
    "package.xml": "<package><name>demo</name><export>"
    "<build_type>ament_python</build_type></export></package>\n",
    "setup.py": "from setuptools import setup\n\nsetup(entry_points={\n"
    "    'console_scripts': ['talk = demo.talker:main']})\n",
    "demo/__init__.py": "",
    "demo/talker.py": "import rclpy\n"
    + _NODE.format("")
    + "\n\ndef main():\n    rclpy.spin(Talker())\n",
}
_FILE = "talker:\n  ros__parameters:\n    rate: 1.0\n    use_sim_time: true\n    {}\n"


class ParameterUndeclared(Rule):
    """A parameter file or launch file sets a parameter that the node does not declare.

    **Why.** The value is ignored without a warning, and the node runs with its default.

    **Fix.** Use the name that the node declares, or declare the parameter.

    **Source.** ROS 2 documentation, "Parameters", section "Declaring parameters".
    """

    code = "PF004"
    name = "parameter-undeclared"
    other_severities = {
        Severity.WARNING: "the node has this value anyway: as the default of the closest "
        "parameter, under the right name as well, or in its code; or the value is empty"
    }
    examples = (
        Example(
            "declared", {"talker.py": _NODE.format(""), "a.yaml": _FILE.format("limits: {high: 4}")}
        ),
        Example(
            "a node that accepts undeclared parameters",
            {
                "talker.py": _NODE.format(", allow_undeclared_parameters=True"),
                "a.yaml": _FILE.format("high: 4"),
            },
        ),
        Example(
            "declared by the code that constructs the node",
            {
                "talker/__init__.py": "",
                "talker/node.py": _NODE.format(""),
                "talker/main.py": "import rclpy\n\nfrom .node import Talker\n\n\n"
                "def main():\n    node = Talker()\n    node.declare_parameter('high', 4)\n",
                "a.yaml": _FILE.format("high: 4"),
            },
        ),
        Example(
            "declared by an object that gets the node",
            {
                "talker/parts.py": "class Limits:\n    def configure(self):\n"
                "        self.talker.declare_parameter('high', 4)\n",
                "talker/node.py": _NODE.format("") + "        limits = Limits()\n"
                "        limits.talker = self\n",
                "a.yaml": _FILE.format("high: 4"),
            },
        ),
        Example(
            "declared by a subclass that has the node as an attribute",
            {
                "talker/__init__.py": "",
                "talker/base.py": "import rclpy\n\n\nclass Base:\n    def __init__(self):\n"
                "        self.node = rclpy.create_node('talker')\n"
                "        self.node.declare_parameter('rate', 1.0)\n",
                "talker/talker.py": "from .base import Base\n\n\nclass Talker(Base):\n"
                "    def __init__(self):\n        super().__init__()\n"
                "        self.high = self.node.declare_parameter('high', 4).value\n",
                "a.yaml": _FILE.format("high: 4"),
            },
        ),
        Example(
            "in a file that the node loads itself",
            {
                "talker.py": "import yaml\n"
                + _NODE.format("")
                + "        with open(self.declare_parameter('file', '').value) as stream:\n"
                "            self.settings = yaml.safe_load(stream)\n",
                "a.yaml": _FILE.format("topics: [{name: joy, topic: joy_vel}]"),
            },
        ),
        Example(
            "in a file that other code loads, with another library",
            {
                "talker.py": _NODE.format(""),
                "tool.py": "from ruamel.yaml import YAML\n\n"
                "settings = YAML().load(open('a.yaml'))\n",
                "a.yaml": _FILE.format("topics: [joy]"),
            },
        ),
        Example(
            "a key that other code reads from the file, which the node gets as well",
            {
                **_PACKAGE,
                "demo/tool.py": "import yaml\n\n"
                "settings = yaml.safe_load(open('a.yaml'))\nprint(settings['host'])\n",
                "launch/a.launch.py": _LAUNCH_FILE,
                "config/a.yaml": _FILE.format("host: robot\n    port: 80"),
            },
            "config/a.yaml:6:5: node 'talker' declares no parameter 'port': the value is ignored; "
            "it has limits.high, rate",
        ),
        Example(
            "the default value of the node",
            {
                "talker.py": _NODE.format("")
                + "        self.text = ['hello']\n        self.size = 2\n",
                "a.yaml": _FILE.format(
                    "limits:\n      hihg: 3\n    text: hello\n    size: 2\n    device: ''"
                ),
            },
            Report(
                "a.yaml:6:7",
                "node 'talker' declares no parameter 'limits.hihg': the value is "
                "ignored; did you mean 'limits.high'?",
                severity=Severity.WARNING,
            ),
            Report(
                "a.yaml:7:5",
                "node 'talker' declares no parameter 'text': the value is ignored; it "
                "has limits.high, rate",
                severity=Severity.WARNING,
            ),
            Report(
                "a.yaml:8:5",
                "node 'talker' declares no parameter 'size': the value is ignored; it "
                "has limits.high, rate",
                severity=Severity.WARNING,
            ),
            Report(
                "a.yaml:9:5",
                "node 'talker' declares no parameter 'device': the value is ignored; "
                "it has limits.high, rate",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "set under the right name as well",
            {
                "talker.py": _NODE.format(""),
                "a.yaml": _FILE.format("limits:\n      high: 5\n      hihg: 5"),
            },
            Report(
                "a.yaml:7:7",
                "node 'talker' declares no parameter 'limits.hihg': the value is "
                "ignored; did you mean 'limits.high'?",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "one launch argument set under both names",
            {
                **_PACKAGE,
                "launch/a.launch.py": _LAUNCH,
            },
            Report(
                "launch/a.launch.py:9:50",
                "node 'talker' declares no parameter 'rates': the value is ignored; "
                "did you mean 'rate'?",
                severity=Severity.WARNING,
            ),
            "launch/a.launch.py:10:13: node 'talker' declares no parameter 'raet': the value is "
            "ignored; it has limits.high, rate",
        ),
        Example(
            "a node whose name is set on the command line",
            {
                **_PACKAGE,
                "launch/a.launch.py": _LAUNCH.replace(
                    "executable='talk'", "executable='talk', name=LaunchConfiguration('name')"
                ),
            },
            Report(
                "launch/a.launch.py:9:50",
                "this node declares no parameter 'rates': the value is ignored; did "
                "you mean 'rate'?",
                severity=Severity.WARNING,
            ),
            "launch/a.launch.py:10:13: this node declares no parameter 'raet': the value is "
            "ignored; it has limits.high, rate",
        ),
        Example(
            "misspelled, and missing",
            {
                "talker.py": _NODE.format(""),
                "a.yaml": _FILE.format("limits:\n      hihg: 4\n    text: hello"),
            },
            "a.yaml:6:7: node 'talker' declares no parameter 'limits.hihg': the value is ignored; "
            "did you mean 'limits.high'?",
            "a.yaml:7:5: node 'talker' declares no parameter 'text': the value is ignored; it has "
            "limits.high, rate",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._in_files(package)
        yield from self._in_launch_files(package)

    def _in_files(self, package: Package) -> Iterator[Diagnostic]:
        for file in parameter_files(package):
            for section in file.sections:
                owners = nodes_for(package, file.path, section)
                declarations = [declared_by(owner, package) for owner in owners]
                if not declarations or not all(node.complete for node in declarations):
                    continue
                if is_only_loaded(package, file.path, owners):
                    continue
                for entry in section.entries:
                    is_declared = any(node.has(entry.name) for node in declarations)
                    key = entry.name.rpartition(".")[2]
                    if not is_declared and not is_loaded(package, file.path, owners, key):
                        value = comparable_in_file(entry.value)
                        others = {
                            other.name: comparable_in_file(other.value) for other in section.entries
                        }
                        ignored = _Ignored(package, owners, declarations, entry.name, value, others)
                        name = owners[0].node_name if section.is_pattern else section.name
                        yield self._report(entry.location, ignored, name)

    def _in_launch_files(self, package: Package) -> Iterator[Diagnostic]:
        for node in started_nodes(package):
            owner = node.owner(package)
            declared = declared_by(owner, package) if owner is not None else None
            if owner is None or declared is None or not declared.complete:
                continue
            for given in node.parameters:
                if not declared.has(given.name):
                    value = _comparable_in_launch(given)
                    others = {other.name: _comparable_in_launch(other) for other in node.parameters}
                    ignored = _Ignored(package, [owner], [declared], given.name, value, others)
                    yield self._report(given.key_location, ignored, node.name(package))

    def _report(self, at: Location, ignored: _Ignored, node: object) -> Diagnostic:
        who = f"node {node!r}" if isinstance(node, str) else "this node"
        hint, severity = ignored.judged()
        message = f"{who} declares no parameter {ignored.name!r}: the value is ignored; {hint}"
        return self.report(at, message, severity=severity, cause=f"parameters of {node}")


class _Ignored(NamedTuple):
    """A parameter that nodes do not declare."""

    package: Package
    owners: Sequence[KnownNode]
    declarations: Sequence[Declared]
    name: str
    value: str
    """See `comparable`."""
    others: Mapping[str, str]
    """The comparable values of all parameters that are set next to it."""

    def judged(self) -> tuple[str, Severity]:
        """Return a hint at the parameters of the node, and the severity."""
        names = sorted({key for declared in self.declarations for key in declared.types})
        closest = closest_name(self.package, self.name, names, 0.6)
        # A parameter that is set as well is meant only if its name is much the same.
        unset = [name for name in names if name not in self.others]
        meant = closest_name(self.package, self.name, unset, 0.6)
        meant = meant or closest_name(self.package, self.name, names, 0.8)
        hint = f"it has {listed_names(names, self.name)}"
        if meant:
            hint = f"did you mean {meant!r}?"
        pairs = zip(self.owners, self.declarations, strict=True)
        is_empty = self.value == comparable("")
        is_harmless = is_empty or all(self._has_value(*pair, closest) for pair in pairs)
        return hint, Severity.WARNING if is_harmless else Severity.ERROR

    def _has_value(self, owner: KnownNode, declared: Declared, closest: str) -> bool:
        """Return whether a node has the value anyway, as a default or under the right name."""
        if not self.value:
            return False
        meant = declared.places.get(closest)
        if meant is not None and comparable(meant.default) == self.value:
            return True
        if self._is_set_under_right_name(declared):
            return True
        home = owner.home(self.package)
        try:
            own = own_values(home, owner.path).get(plain_name(self.name), frozenset())
            return own == {self.value} or self.value in own_texts(home, owner.path)
        except ViewError:
            return False

    def _is_set_under_right_name(self, declared: Declared) -> bool:
        """Return whether a declared parameter with a similar name is set to the same value, too."""
        names = [
            name
            for name, value in self.others.items()
            if value == self.value and declared.has(name)
        ]
        return bool(names) and bool(closest_name(self.package, self.name, names, 0.6))


def _comparable_in_launch(given: GivenParameter) -> str:
    """Return the comparable part of a value from a launch file; empty if there is none."""
    value = given.value
    if isinstance(given.configuration, str):
        return f"$(var {given.configuration})"
    if value is None or given.configuration is not None:
        return ""
    return value.text if value.number is None else comparable(value.number)
