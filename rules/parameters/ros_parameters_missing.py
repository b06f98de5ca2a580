"""PF002: parameters are nested under ros__parameters."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress

from scaffold.api import (
    Diagnostic,
    Edit,
    Effect,
    Example,
    Fix,
    Package,
    Report,
    Rule,
    Severity,
    ViewError,
)
from scaffold.api.launch import StartedNode, consumers, is_loaded, use_of
from scaffold.api.parameters import (
    KEY,
    Misplaced,
    ParameterFile,
    declared_by,
    own_nodes,
    parameter_file,
    parameter_paths,
)
from scaffold.api.python import paths_importing

_FILE = "talker:\n  {}:\n    rate: 2.0\n"
_NODE = (
    "from rclpy.node import Node\n\n\nclass Talker(Node):\n    def __init__(self):\n"
    "        super().__init__('talker')\n        self.declare_parameter('rate', 2.0)\n"
)
_LAUNCH = (
    "import os\n\nfrom ament_index_python.packages import get_package_share_directory\n"
    "from launch import LaunchDescription\nfrom launch_ros.actions import LoadComposableNodes\n"
    "from launch_ros.descriptions import ComposableNode\n\n\n"
    "def generate_launch_description():\n"
    "    plan = os.path.join(get_package_share_directory('demo'), 'maps', 'hall.yaml')\n"
    "    server = ComposableNode(package='demo', plugin='demo::Plan', parameters=[plan])\n"
    "    return LaunchDescription([\n"
    "        LoadComposableNodes(target_container='all', composable_node_descriptions=[server]),\n"
    "    ])\n"
)


class RosParametersMissing(Rule):
    """Parameters are not nested under ``ros__parameters``, or the key is misspelled.

    **Why.** The node does not start: ``RCLError: failed to initialize rcl: Couldn't parse params
    file ... Cannot have a value before ros__parameters at line 3``.

    **Fix.** Write the node name, below it ``ros__parameters`` with two underscores, and below that
    the parameters.

    **Source.** ``rcl_yaml_param_parser/src/parse.c``; ROS 2 documentation, "Passing ROS arguments
    to nodes".
    """

    code = "PF002"
    name = "ros-parameters-missing"
    effect = Effect.STOPS_START
    other_severities = {Severity.WARNING: "no launch file passes the file to a node"}
    examples = (
        Example(
            "nested under ros__parameters", {"config/talker.yaml": _FILE.format("ros__parameters")}
        ),
        Example(
            "a node of that name",
            {"config/a.yaml": _FILE.format("ros__parameters").replace("talker", "parameters")},
        ),
        Example(
            "one underscore; a missing letter",
            {
                "config/a.yaml": _FILE.format("ros_parameters"),
                "config/b.yaml": _FILE.format("ros__parameter"),
            },
            Report(
                "config/a.yaml:2:3",
                "unknown key 'ros_parameters': rcl rejects the file; did you mean "
                "'ros__parameters'?",
                fix="Rename the key to 'ros__parameters'",
            ),
            Report(
                "config/b.yaml:2:3",
                "unknown key 'ros__parameter': rcl rejects the file; did you mean "
                "'ros__parameters'?",
                fix="Rename the key to 'ros__parameters'",
            ),
            fixed={
                "config/a.yaml": _FILE.format("ros__parameters"),
                "config/b.yaml": _FILE.format("ros__parameters"),
            },
        ),
        Example(
            "a map as the parameters of a component, which launch_ros reads",
            {
                "package.xml": "<package><name>demo</name></package>\n",
                "CMakeLists.txt": "project(demo)\ninstall(DIRECTORY maps DESTINATION share/demo)\n",
                "maps/hall.yaml": "image: hall.png\nresolution: 0.05\n",
                "launch/map.launch.py": _LAUNCH,
            },
        ),
        Example(
            "nested parameters of a component; the name of the component above them",
            {
                "package.xml": "<package><name>demo</name></package>\n",
                "CMakeLists.txt": "project(demo)\ninstall(DIRECTORY maps DESTINATION share/demo)\n",
                "maps/hall.yaml": "timer:\n  rate: 20.0\n",
                "maps/room.yaml": "plan:\n  rate: 20.0\n",
                "launch/hall.launch.py": _LAUNCH,
                "launch/room.launch.py": _LAUNCH.replace("hall.yaml", "room.yaml").replace(
                    "plugin=", "name='plan', plugin="
                ),
            },
            "maps/room.yaml:2:3: 'rate' is not under 'ros__parameters': launch sets 'plan.rate'",
        ),
        Example(
            "missing in a file that no launch file names; a file that the node reads itself",
            {
                "talker.py": _NODE,
                "config/a.yaml": "talker:\n  rate: 2.0\n",
                "config/b.yaml": "talker:\n  rate: 2.0\n  model: small\n",
            },
            Report(
                "config/a.yaml:2:3",
                "'rate' is not under 'ros__parameters': rcl rejects the file",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "missing, with nested parameters",
            {
                "talker.py": _NODE.replace("'rate'", "'limits.rate'"),
                "config/a.yaml": "talker:\n  limits:\n    rate: 2.0\n",
            },
            Report(
                "config/a.yaml:3:5",
                "'rate' is not under 'ros__parameters': rcl rejects the file",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "missing, and something reads YAML itself",
            {
                "talker.py": _NODE,
                "settings.py": "import yaml\n",
                "config/a.yaml": "talker:\n  rate: 2.0\n",
            },
        ),
        Example(
            "missing for one of two nodes",
            {"config/a.yaml": _FILE.format("ros__parameters") + "listener:\n  rate: 1.0\n"},
            Report(
                "5:3",
                "'rate' is not under 'ros__parameters': rcl rejects the file",
                severity=Severity.WARNING,
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        paths = parameter_paths(package)
        others = [*self._launched_files(package), *_files_named_after_nodes(package)]
        paths = [*dict.fromkeys([*paths, *others])]
        for path in paths:
            file = parameter_file(package, path)
            if file is None or not file.misplaced:
                continue
            nodes = use_of(package, path).nodes
            if nodes and all(_takes_whole(package, node, file) for node in nodes):
                continue
            is_given = bool(nodes)
            is_read = is_given or bool(file.sections and not is_loaded(package, path))
            for entry in file.misplaced[:1]:
                if entry.node_key is not None and (is_read or self._is_meant(file.misplaced)):
                    edit = Edit(path, entry.node_key.start, entry.node_key.end, KEY)
                    message = f"unknown key {entry.node_key.text!r}: rcl rejects the file; "
                    message += f"did you mean {KEY!r}?"
                    yield self.report(
                        entry.node_key, message, Fix(f"Rename the key to {KEY!r}", (edit,))
                    )
                elif entry.node_key is None and (is_read or _is_of_node(package, file)):
                    message = f"{entry.key.text!r} is not under {KEY!r}: rcl rejects the file"
                    if is_given and not file.sections and all(n.is_component for n in nodes):
                        name = ".".join([*entry.above, entry.key.text])
                        message = f"{entry.key.text!r} is not under {KEY!r}: launch sets {name!r}"
                    severity = Severity.ERROR if is_given else Severity.WARNING
                    yield self.report(entry.key, message, severity=severity)

    def _is_meant(self, misplaced: list[Misplaced]) -> bool:
        """Return whether this is a parameter file, not a file of another tool with such a key."""
        return all(entry.node_key is not None and entry.depth == 1 for entry in misplaced)

    def _launched_files(self, package: Package) -> Iterator[str]:
        """Yield the files that launch files pass to nodes."""
        for node in consumers(package):
            for path, _ in node.parameter_files:
                if package.has(path) and path.endswith((".yaml", ".yml")):
                    yield path


def _files_named_after_nodes(package: Package) -> Iterator[str]:
    """Yield the YAML files that begin with the name of a node."""
    nodes, _ = own_nodes(package)
    names = tuple(f"{node.node_name}:" for node in nodes if isinstance(node.node_name, str))
    for path in package.files if names else ():
        if path.endswith((".yaml", ".yml")) and not {"test", "tests"} & set(path.split("/")):
            with suppress(ViewError):
                lines = package.source(path).text.splitlines()
                if any(line.startswith(names) for line in lines):
                    yield path


def _takes_whole(package: Package, node: StartedNode, file: ParameterFile) -> bool:
    """Return whether a file without nodes is all parameters of a component.

    launch_ros reads the files of components itself, and takes all values if none is below
    ``ros__parameters``.
    """
    is_plain = not file.sections and all(entry.node_key is None for entry in file.misplaced)
    above = {entry.above[0].strip("/") for entry in file.misplaced if entry.above}
    return node.is_component and is_plain and above.isdisjoint({node.name(package), "**"})


def _is_of_node(package: Package, file: ParameterFile) -> bool:
    """Return whether a file only has parameters of one node, and no code reads YAML itself."""
    nodes, _ = own_nodes(package)
    names = {".".join([*entry.above[1:], entry.key.text]) for entry in file.misplaced}
    above = {entry.above[:1] for entry in file.misplaced}
    return not any(paths_importing(package, "yaml")) and any(
        above == {(node.node_name,)} and names.issubset(declared_by(node, package).types)
        for node in nodes
    )
