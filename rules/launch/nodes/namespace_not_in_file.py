"""LF016: parameter files match the namespace of the node."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, Package, Rule
from scaffold.api.install import share_of
from scaffold.api.launch import StartedNode, consumers
from scaffold.api.parameters import ParameterFile, parameter_file

_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch.substitutions import PathJoinSubstitution\n"
    "from launch_ros.actions import Node\nfrom launch_ros.substitutions import FindPackageShare\n"
    "\n\ndef generate_launch_description():\n"
    "    params = PathJoinSubstitution([FindPackageShare('demo'), 'config', 'demo.yaml'])\n"
    "    return LaunchDescription([\n"
    "        Node(package='demo', executable='talk', name='talker', namespace='left',\n"
    "             parameters=[params]),\n    ])\n"
)
_FILES = {
    "package.xml": '<package format="3"><name>demo</name></package>\n',
    "launch/a.launch.py": _LAUNCH,
}
_FILE = "{}:\n  ros__parameters:\n    rate: 1.0\n"


class NamespaceNotInFile(Rule):
    """A node runs in a namespace that its key in the parameter file does not include.

    **Why.** ``talker`` in the file is ``/talker``, not ``/left/talker``: the node runs with its
    defaults, without a warning.

    **Fix.** Write ``/left/talker``, ``/**/talker`` or ``/**`` in the file.

    **Source.** ROS 2 documentation, "Passing ROS arguments to nodes", parameter files; ros2 issue
    569.
    """

    code = "LF016"
    name = "namespace-not-in-file"
    effect = Effect.WRONG_BEHAVIOR
    examples = (
        Example("the full name", {**_FILES, "config/demo.yaml": _FILE.format("/left/talker")}),
        Example("all namespaces", {**_FILES, "config/demo.yaml": _FILE.format("/**/talker")}),
        Example(
            "the name without the namespace",
            {**_FILES, "config/demo.yaml": _FILE.format("talker")},
            "launch/a.launch.py:10:74: the node runs as /left/talker, but config/demo.yaml:1 is "
            "for /talker: the section is ignored; write /left/talker",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        installed = share_of(package).files
        for node in consumers(package):
            if node.is_scoped or node.full_name(package) is None or not node.namespace:
                continue
            for named, _ in node.parameter_files:
                path = installed.get(named, named)
                file = parameter_file(package, path) if package.has(path) else None
                message = _problem(package, node, file) if file is not None else None
                if message is not None:
                    yield self.report(node.namespace_location, message)


def _problem(package: Package, node: StartedNode, file: ParameterFile) -> str | None:
    full = node.full_name(package) or ""
    if any(section.fits(full) for section in file.sections):
        return None
    for section in file.sections:
        if section.node.rpartition("/")[2] == node.name(package):
            return (
                f"the node runs as {full}, but {file.path}:{section.key.location.line} is for "
                f"{section.node}: the section is ignored; write {full}"
            )
    return None
