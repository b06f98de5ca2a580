"""PF003: parameter files name nodes that exist, in the namespaces that they run in."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import SequenceMatcher

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity
from scaffold.api.launch import StartedNode, markup_files, node_names, started_nodes, use_of
from scaffold.api.parameters import (
    ParameterFile,
    Section,
    declared_by,
    own_nodes,
    parameter_files,
)
from scaffold.api.programs import KnownNode
from scaffold.api.python import UNKNOWN

_NODE = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n    def __init__(self):\n        super().__init__('talker')\n"
    "        self.declare_parameter('rate', 2.0)\n"
)
_FILE = "{}:\n  ros__parameters:\n    rate: 1.0\n"
_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch.substitutions import PathJoinSubstitution\n"
    "from launch_ros.actions import Node\nfrom launch_ros.substitutions import FindPackageShare\n"
    "\n\ndef generate_launch_description():\n"
    "    params = PathJoinSubstitution([FindPackageShare('demo'), 'config', 'demo.yaml'])\n"
    "    return LaunchDescription([\n"
    "        Node(package='eyes', executable='eye', name='camera', parameters=[params]),\n    ])\n"
)
_CONTROL = "controller_manager"
_CREATED = (
    (_CONTROL, ""),
    ("nav2_bt_navigator", "bt_navigator_"),
    ("nav2_controller", "local_costmap"),
    ("nav2_planner", "global_costmap"),
)
"""Packages whose node creates others, with the beginnings of their names: controllers, costmaps."""
_MANIFEST = '<package format="3"><name>demo</name></package>\n'
_ALIKE = 0.75


def _files(section: str) -> dict[str, str]:
    return {
        "package.xml": _MANIFEST,
        "launch/a.launch.py": _LAUNCH,
        "config/demo.yaml": _FILE.format(section),
    }


class NodeUnknown(Rule):
    """A section of a parameter file matches no node, or the wrong namespace.

    **Why.** The section is ignored without a warning, and the node runs with its defaults.

    **Fix.** Use the name that ``ros2 node list`` shows, ``/**/name`` for any namespace, or ``/**``
    for all nodes.

    **Source.** ROS 2 documentation, "Passing ROS arguments to nodes", parameter files.
    """

    code = "PF003"
    name = "node-unknown"
    other_severities = {
        Severity.WARNING: "no launch file uses the file, and no node has the parameters"
    }
    examples = (
        Example(
            "the name of the node, all nodes, a node of another package",
            {
                "talker.py": _NODE,
                "config/a.yaml": _FILE.format("talker"),
                "config/b.yaml": _FILE.format("/**"),
                "config/c.yaml": _FILE.format("camera"),
            },
        ),
        Example(
            "the name of the executable",
            {"talker.py": _NODE, "config/a.yaml": _FILE.format("talker_node")},
            "config/a.yaml:1:1: no node of this package is named 'talker_node'; did you mean "
            "'talker'?",
        ),
        Example(
            "a section for a node that no longer exists",
            {
                "talker.py": _NODE.replace("'talker'", "'gate_detector_node'"),
                "config/a.yaml": "drum_detector_node:\n  ros__parameters:\n    least_area: 800\n",
            },
            Report(
                "config/a.yaml:1:1",
                "no node of this package is named 'drum_detector_node' or has these "
                "parameters: the section is ignored",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "a launch file with another extension uses the file",
            {
                "talker.py": _NODE,
                "config/a.yaml": _FILE.format("talker_node"),
                "launch/a.launch": '<launch><node pkg="a" exec="b" name="talker_node">'
                '<param from="$(find-pkg-share a)/config/a.yaml"/></node></launch>\n',
            },
        ),
        Example(
            "a controller",
            {
                "package.xml": _MANIFEST,
                "launch/a.launch.py": _LAUNCH.replace("eyes", _CONTROL),
                "config/demo.yaml": _FILE.format("arm_controller"),
            },
        ),
        Example(
            "a costmap, which the planner server creates",
            {
                "package.xml": _MANIFEST,
                "launch/a.launch.py": _LAUNCH.replace("eyes", "nav2_planner"),
                "config/demo.yaml": _FILE.format("/global_costmap/global_costmap"),
            },
        ),
        Example(
            "the only node that gets the file is not launched",
            {
                "package.xml": _MANIFEST,
                "launch/a.launch.py": _LAUNCH.replace(
                    "    return LaunchDescription([\n        Node(", "    camera = Node("
                ).replace(",\n    ])", "\n    return LaunchDescription([])  # camera"),
                "config/demo.yaml": _FILE.format("eye"),
            },
        ),
        Example(
            "a node that gets a changed copy of the file",
            {
                "package.xml": _MANIFEST,
                "launch/a.launch.py": _LAUNCH.replace(
                    "    ])",
                    "        Node(package='eyes', executable='eye', name='eye',\n"
                    "             parameters=[RewrittenYaml(source_file=params,"
                    " param_rewrites={})]),\n    ])",
                ).replace("\n\n\n", "\nfrom nav2_common.launch import RewrittenYaml\n\n\n", 1),
                "config/demo.yaml": _FILE.format("eye"),
            },
        ),
        Example(
            "a name unlike that of the only node with these parameters",
            {
                "package.xml": _MANIFEST,
                "demo/talker.py": _NODE + "\n\ndef main():\n    Talker()\n",
                "setup.py": "from setuptools import setup\n\n"
                "setup(name='demo', packages=['demo'],\n"
                "      entry_points={'console_scripts': ['talk = demo.talker:main']})\n",
                "launch/a.launch.py": _LAUNCH.replace(
                    "    ])",
                    "        Node(package='demo', executable='talk', parameters=[params]),\n    ])",
                ),
                "config/demo.yaml": _FILE.format("camera") + _FILE.format("speech"),
            },
            "config/demo.yaml:4:1: no node that gets the file is named 'speech': the section is "
            "ignored; launch/a.launch.py:11 starts talker",
        ),
        Example(
            "the name in the code, which the launch file overrides",
            {
                "package.xml": _MANIFEST,
                "demo/talker.py": _NODE + "\n\ndef main():\n    Talker()\n",
                "setup.py": "from setuptools import setup\n\n"
                "setup(name='demo', packages=['demo'],\n"
                "      entry_points={'console_scripts': ['talk = demo.talker:main']})\n",
                "launch/a.launch.py": _LAUNCH.replace("eyes", "demo").replace("'eye'", "'talk'"),
                "config/demo.yaml": _FILE.format("talker"),
            },
            "config/demo.yaml:1:1: no node that gets the file is named 'talker': the section is "
            "ignored; launch/a.launch.py:10 starts camera",
        ),
        Example(
            "the name in the code, next to sections that fit",
            {
                "package.xml": _MANIFEST,
                "demo/talker.py": _NODE + "\n\ndef main():\n    Talker()\n",
                "setup.py": "from setuptools import setup\n\n"
                "setup(name='demo', packages=['demo'],\n"
                "      entry_points={'console_scripts': ['talk = demo.talker:main']})\n",
                "launch/a.launch.py": _LAUNCH.replace("eyes", "demo").replace("'eye'", "'talk'"),
                "config/demo.yaml": _FILE.format("/**") + _FILE.format("talker"),
            },
            "config/demo.yaml:4:1: no node that gets the file is named 'talker': the section is "
            "ignored; launch/a.launch.py:10 starts camera",
        ),
        Example(
            "not the name in the launch file",
            {
                "package.xml": _MANIFEST,
                "launch/a.launch.py": _LAUNCH,
                "config/demo.yaml": _FILE.format("eye"),
            },
            "config/demo.yaml:1:1: no node that gets the file is named 'eye': the section is "
            "ignored; launch/a.launch.py:10 starts camera",
        ),
        Example("a section without a namespace", _files("camera")),
        Example("a section for any namespace", _files("/**/camera")),
        Example(
            "a section for another namespace",
            _files("/front/camera"),
            "config/demo.yaml:1:1: section for '/front/camera' is ignored: launch/a.launch.py:10 "
            "starts '/camera'",
        ),
        Example(
            "a namespace that a group has by default",
            {
                **_files("camera"),
                "launch/a.launch.py": _LAUNCH.replace(
                    "return LaunchDescription([\n",
                    "return LaunchDescription([\n"
                    "        DeclareLaunchArgument('ns', default_value='robot1'),\n"
                    "        GroupAction([PushRosNamespace(LaunchConfiguration('ns')),\n",
                )
                .replace("parameters=[params]),", "parameters=[params])]),")
                .replace(
                    "from launch.substitutions import ",
                    "from launch.actions import DeclareLaunchArgument, GroupAction\n"
                    "from launch.substitutions import LaunchConfiguration, ",
                )
                .replace("import Node", "import Node, PushRosNamespace"),
            },
            "config/demo.yaml:1:1: section for '/camera' is ignored: launch/a.launch.py:13 starts "
            "'/robot1/camera'",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_nodes(package)
        yield from self._check_namespaces(package)

    def _check_nodes(self, package: Package) -> Iterator[Diagnostic]:
        for file in parameter_files(package):
            use = use_of(package, file.path)
            if use.nodes:
                yield from self._for_started(package, file)
            elif use.complete:
                yield from self._for_own(package, file)

    def _for_started(self, package: Package, file: ParameterFile) -> Iterator[Diagnostic]:
        """Check a file against the nodes to which launch files pass it."""
        use = use_of(package, file.path)
        given = [node.name(package) for node in use.nodes]
        names = {name for name in given if isinstance(name, str)}
        if any(not isinstance(name, str) for name in given):
            return
        useless = not any(s.is_pattern or s.name in names for s in file.sections)
        everywhere = node_names(package)
        owners = [node.owner(package) for node in use.nodes]
        codes = {owner.node_name for owner in owners if owner is not None}
        for section in file.sections:
            name = section.name
            if section.is_pattern or name in names or _may_be_created(use.nodes, name):
                continue
            alike = _names_alike(file, names, name)
            if not alike and use.complete and name not in everywhere:
                alike = _nodes_with_parameters(package, file, section, use.nodes)
            is_renamed = name not in everywhere or name in codes
            renamed = _renamed(package, file, name) if use.complete else []
            if alike or renamed or (useless and use.complete and is_renamed):
                meant = alike or renamed or sorted(names)
                first = next(
                    started for started in use.nodes if started.name(package) in meant
                ).location
                message = (
                    f"no node that gets the file is named {name!r}: the section is ignored; "
                    f"{first.path}:{first.line} starts {', '.join(meant)}"
                )
                yield self.report(section.key, message)

    def _for_own(self, package: Package, file: ParameterFile) -> Iterator[Diagnostic]:
        """Check a file that no launch file uses against the nodes in the package."""
        nodes, complete = own_nodes(package)
        names = {str(node.node_name) for node in nodes}
        everywhere = node_names(package)
        for section in file.sections if complete else ():
            name = section.name
            alike = _names_alike(file, names, name)
            if not alike or name in everywhere or section.is_pattern:
                continue
            message = f"no node of this package is named {name!r}"
            if _is_left_over(
                package, section, [started for started in nodes if started.node_name in alike]
            ):
                message += " or has these parameters: the section is ignored"
                yield self.report(section.key, message, severity=Severity.WARNING)
            else:
                yield self.report(section.key, f"{message}; did you mean {alike[0]!r}?")

    def _check_namespaces(self, package: Package) -> Iterator[Diagnostic]:
        for file in parameter_files(package):
            nodes = use_of(package, file.path).nodes
            if any(not isinstance(node.name(package), str) for node in nodes):
                continue
            for section in file.sections:
                if section.is_pattern or _may_be_created(nodes, section.name):
                    continue
                other = _other_node(package, section, nodes)
                if other is not None:
                    at = other.location
                    name = other.full_name(package) or ""
                    if other.default_namespace:
                        name = f"/{other.default_namespace}{name}"
                    message = (
                        f"section for {section.node!r} is ignored: {at.path}:{at.line} starts "
                        f"{name!r}"
                    )
                    yield self.report(section.key, message)


def _may_be_created(nodes: list[StartedNode], name: str) -> bool:
    """Return whether one of the nodes may create another node with a name in its process."""
    packages = {node.package for node in nodes}
    return any(
        package in packages and name != package and name.startswith(beginning)
        for package, beginning in _CREATED
    )


def _renamed(package: Package, file: ParameterFile, name: str) -> list[str]:
    """Return the names that launch files give to a node of a name, if all do and none has values.

    Values for the name in the code may be for `ros2 run`, if there are some for the new name too.
    """
    if any(item.value == name for file in markup_files(package) for item in file.attributes):
        return []
    given = set()
    for node in started_nodes(package):
        owner = node.owner(package)
        if owner.node_name == name if owner is not None else node.given_name == name:
            given.add(node.name(package))
    names = sorted(str(item) for item in given)
    is_known = name not in given and UNKNOWN not in given
    has_values = any(section.name in names for section in file.sections)
    return names if is_known and not has_values else []


def _is_left_over(package: Package, section: Section, nodes: list[KnownNode]) -> bool:
    """Return whether a section sets no parameters of nodes with similar names."""
    declarations = [declared_by(node, package) for node in nodes]
    return all(declared.complete for declared in declarations) and not any(
        entry.name in declared.types for entry in section.entries for declared in declarations
    )


def _other_node(package: Package, section: Section, nodes: list[StartedNode]) -> StartedNode | None:
    """Return the node of the same name that runs in another namespace."""
    named = [node for node in nodes if node.name(package) == section.name]
    names = [node.full_name(package) for node in named]
    if named and None not in names and all(node.default_namespace for node in named):
        pushed = [
            f"/{node.default_namespace}{name}" for node, name in zip(named, names, strict=True)
        ]
        return None if any(map(section.fits, pushed)) else named[0]
    if None in names or any(node.is_scoped or node.namespace for node in named):
        return None
    return named[0] if named and not any(section.fits(str(name)) for name in names) else None


def _names_alike(file: ParameterFile, names: set[str], name: str) -> list[str]:
    """Return the nodes without a section that one for ``name`` may be meant for."""
    given = {section.name for section in file.sections}
    return [other for other in sorted(names - given) if _is_alike(name, other)]


def _nodes_with_parameters(
    package: Package, file: ParameterFile, section: Section, nodes: list[StartedNode]
) -> list[str]:
    """Return the only node without a section that declares all parameters of one, if any."""
    given = {section.name for section in file.sections}
    found: set[str] = set()
    for node in nodes:
        owner, name = node.owner(package), node.name(package)
        if owner is None or not isinstance(name, str) or name in given or not section.entries:
            continue
        declared = declared_by(owner, package).types
        if all(entry.name in declared for entry in section.entries):
            found.add(name)
    return sorted(found) if len(found) == 1 else []


def _is_alike(name: str, other: str) -> bool:
    """Return whether one node name may be a misspelling of the other."""
    first, second = name.replace("_", "").lower(), other.replace("_", "").lower()
    if first == second:
        return name != other
    if first in {second + "node", "node" + second} or second in {first + "node", "node" + first}:
        return True
    return SequenceMatcher(None, first, second).ratio() >= _ALIKE
