"""PF035: sections of a parameter file name the namespaces of the nodes."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.launch import StartedNode, use_of
from scaffold.api.parameters import Section, parameter_file, parameter_paths

_CONTROL = "controller_manager"
_MANIFEST = '<package format="3"><name>demo</name></package>\n'
_FILE = "{}:\n  ros__parameters:\n    rate: 1.0\n"
_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch.substitutions import PathJoinSubstitution\n"
    "from launch_ros.actions import Node\nfrom launch_ros.substitutions import FindPackageShare\n"
    "\n\ndef generate_launch_description():\n"
    "    params = PathJoinSubstitution([FindPackageShare('demo'), 'config', 'demo.yaml'])\n"
    "    return LaunchDescription([\n"
    "        Node(package='eyes', executable='eye', name='camera', parameters=[params]),\n    ])\n"
)


def _files(section: str) -> dict[str, str]:
    return {
        "package.xml": _MANIFEST,
        "launch/a.launch.py": _LAUNCH,
        "config/demo.yaml": _FILE.format(section),
    }


class SectionInOtherNamespace(Rule):
    """A section of a parameter file names a namespace that the node does not run in.

    **Why.** Nothing warns: the section is skipped, and the node runs with its defaults.

    **Fix.** Write the name as ``ros2 node list`` shows it, or ``/**/name`` for any namespace.

    **Source.** ROS 2 documentation, "Passing ROS arguments to nodes", parameter files.
    """

    code = "PF035"
    name = "section-in-other-namespace"
    examples = (
        Example("no namespace", _files("camera")),
        Example("any namespace", _files("/**/camera")),
        Example(
            "another namespace",
            _files("/front/camera"),
            Report(
                "config/demo.yaml:1:1",
                "section for '/front/camera' is ignored: launch/a.launch.py:10 starts '/camera'",
            ),
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
            Report(
                "config/demo.yaml:1:1",
                "section for '/camera' is ignored: launch/a.launch.py:13 starts '/robot1/camera'",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for path in parameter_paths(package):
            file = parameter_file(package, path)
            nodes = use_of(package, path).nodes if file is not None else []
            if any(not isinstance(node.name(package), str) for node in nodes):
                continue
            in_one_process = any(node.package == _CONTROL for node in nodes)
            for section in file.sections if file is not None else ():
                # The controller manager names the nodes that it creates after its controllers.
                if section.is_pattern or (in_one_process and section.name != _CONTROL):
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
