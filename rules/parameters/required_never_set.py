"""PF009: parameters that are declared without a default are set."""

from __future__ import annotations

import re
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, RclpyRule, Severity, ViewError
from scaffold.api.launch import markup_paths, started_nodes
from scaffold.api.parameters import parameter_files
from scaffold.api.python import UNKNOWN, is_handled
from scaffold.api.rclpy import NodeDefinition, RclpyFile

_NODE = (
    "from rclpy.node import Node\nfrom rclpy.parameter import Parameter\n\n\n"
    "class Talker(Node):\n    def __init__(self):\n        super().__init__('talker')\n"
    "        self.declare_parameter('rate', {})\n"
    "        self.rate = self.get_parameter('rate').value\n"
)
_LAUNCH = (".py", ".launch", ".launch.xml", ".launch.yaml", ".launch.yml")
_PARAMETERS = (".yaml", ".yml")
_STARTING = (
    "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n    return LaunchDescription([\n"
    "        Node(package='demo', executable='talk', name={!r}),\n"
    "        Node(package='other', executable='speak', name='speaker2'),\n    ])\n"
)
_FILES = {
    "package.xml": "<package><name>demo</name></package>\n",
    "setup.py": "from setuptools import setup\n\nsetup(name='demo', packages=['demo'],\n"
    "      entry_points={'console_scripts': ['talk = demo.talker:main']})\n",
    "demo/talker.py": _NODE.format("Parameter.Type.DOUBLE") + "\n\ndef main():\n    Talker()\n",
    "config/a.yaml": "speaker:\n  ros__parameters:\n    rate: 3.0\n",
}
_ELSEWHERE = (*_LAUNCH, *_PARAMETERS)
"""Suffixes of files of other packages that may start the node."""


class RequiredNeverSet(RclpyRule):
    """A parameter without a default is read, and no file of the package sets it.

    **Why.** ``ParameterUninitializedException: The parameter 'rate' is not initialized``, when the
    node reads the parameter.

    **Fix.** Give a default, ``declare_parameter('rate', 2.0)``, or set it in the parameter file.

    **Source.** ``rclpy/node.py``, ``get_parameter``.
    """

    code = "PF009"
    name = "required-never-set"
    severity = Severity.WARNING
    examples = (
        Example("a default", {"talker.py": _NODE.format("2.0")}),
        Example(
            "set in a parameter file",
            {
                "talker.py": _NODE.format("Parameter.Type.DOUBLE"),
                "config/a.yaml": "talker:\n  ros__parameters:\n    rate: 3.0\n",
            },
        ),
        Example(
            "set for a node of another name, and started under that name",
            {**_FILES, "launch/a.launch.py": _STARTING.format("speaker")},
        ),
        Example(
            "set for another node",
            {**_FILES, "launch/a.launch.py": _STARTING.format("talker")},
            "demo/talker.py:9:21: parameter 'rate' is declared without a default in line 8, and "
            "no file of the package sets it: ParameterUninitializedException; add a default",
        ),
        Example(
            "set by another package of the workspace",
            {
                "package.xml": "<package><name>demo</name></package>\n",
                "talker.py": _NODE.format("Parameter.Type.DOUBLE"),
            },
            neighbors={
                "bringup": {
                    "package.xml": "<package><name>bringup</name></package>\n",
                    "launch/all.launch.py": "PARAMETERS = [{'rate': 3.0}]\n",
                }
            },
        ),
        Example(
            "set by a launch file in XML of another package",
            {
                "package.xml": "<package><name>demo</name></package>\n",
                "talker.py": _NODE.format("Parameter.Type.DOUBLE"),
            },
            neighbors={
                "bringup": {
                    "package.xml": "<package><name>bringup</name></package>\n",
                    "launch/all.launch": "<launch><node pkg='demo' exec='talker.py'>"
                    "<param name='rate' value='3.0'/></node></launch>\n",
                }
            },
        ),
        Example(
            "set under the name that a launch file gives the node",
            {
                "talker.py": _NODE.format("Parameter.Type.DOUBLE"),
                "config/a.yaml": "listener:\n  ros__parameters:\n    rate: 3.0\n",
                "launch/a.launch.py": "from launch import LaunchDescription\n"
                "from launch_ros.actions import Node\n\n\n"
                "def generate_launch_description():\n    return LaunchDescription([\n"
                "        Node(package='demo', executable='talk', name='listener')])\n",
            },
        ),
        Example(
            "a type without a default, and a value for another node",
            {
                "package.xml": "<package><name>demo</name></package>\n",
                "talker.py": _NODE.format("Parameter.Type.DOUBLE"),
                "config/a.yaml": "listener:\n  ros__parameters:\n    rate: 3.0\n",
            },
            "talker.py:9:21: parameter 'rate' is declared without a default in line 8, and no "
            "file of the package sets it: ParameterUninitializedException; add a default",
        ),
    )

    def check_in(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        for node in file.nodes:
            required = {
                parameter.name: parameter.location.line
                for parameter in node.parameters
                if parameter.declared_type is not None and isinstance(parameter.name, str)
            }
            for read in node.parameter_reads if required else ():
                name = read.name
                if read.method != "get_parameter" or name not in required or read.is_conditional:
                    continue
                if is_handled(file.module, read.call, "ParameterUninitializedException"):
                    continue
                if isinstance(name, str) and not _is_set(package, node, name):
                    message = (
                        f"parameter {name!r} is declared without a default in line "
                        f"{required[name]}, and no file of the package sets it: "
                        f"ParameterUninitializedException; add a default"
                    )
                    yield self.report(read, message)


def _is_set(package: Package, node: NodeDefinition, name: str) -> bool:
    """Return whether a parameter file or a launch file of a package may set a parameter."""
    for file in parameter_files(package):
        for section in file.sections:
            is_of_node = section.is_pattern or section.name == node.node_name
            is_of_node = is_of_node or not isinstance(node.node_name, str)
            if not any(entry.name == name for entry in section.entries):
                continue
            if is_of_node or _may_have_name(package, node, section.name):
                return True
    last = name.rpartition(".")[2]  # YAML has one line for each part of the name
    if _mentions(package, last, _LAUNCH):
        return True
    return any(
        _mentions(other, last, _ELSEWHERE)
        for other in package.workspace
        if other.name != package.name
    )


def _may_have_name(package: Package, node: NodeDefinition, name: str) -> bool:
    """Return whether a launch file may start a node under a name."""
    if markup_paths(package):
        return _mentions(package, name, _LAUNCH)
    for started in started_nodes(package):
        owner, given = started.owner(package), started.name(package)
        if not isinstance(started.package, str) or not isinstance(started.executable, str):
            return _mentions(package, name, _LAUNCH)
        is_this = owner is None or owner.definition(package).location == node.location
        if is_this and given in {name, UNKNOWN}:
            return True
    return False


def _mentions(package: Package, name: str, endings: tuple[str, ...]) -> bool:
    """Return whether a launch file, or a YAML file next to it, contains a name."""
    wanted = re.compile(rf"\b{re.escape(name)}\b")
    for path in package.files:
        if path.endswith(endings) and (not path.endswith(".py") or "launch" in path.lower()):
            try:
                if wanted.search(package.source(path).text):
                    return True
            except ViewError:
                continue
    return False
