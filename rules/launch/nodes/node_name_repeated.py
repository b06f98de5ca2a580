"""LF012: nodes of a launch file have unique names."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, Package, Rule, Severity
from scaffold.api.launch import started_nodes

_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n"
    "    return LaunchDescription([\n"
    "        Node(package='a', executable='a', name='eye'{}),\n"
    "        Node(package='b', executable='b', name='{}'{}),\n    ])\n"
)


class NodeNameRepeated(Rule):
    """A launch file starts two nodes with the same name.

    **Why.** There is no error, but ``ros2 param``, ``ros2 node info`` and services of the node
    reach either one. **Fix.** Give each a unique name or namespace.

    **Source.** ROS 2 documentation, "Passing ROS arguments to nodes"; ROS 2 design, "Unique
    network flows".
    """

    code = "LF012"
    name = "node-name-repeated"
    severity = Severity.WARNING
    effect = Effect.WRONG_BEHAVIOR
    examples = (
        Example(
            "two names; two namespaces",
            {
                "launch/a.launch.py": _LAUNCH.format("", "ear", ""),
                "launch/b.launch.py": _LAUNCH.format("", "eye", ", namespace='right'"),
            },
        ),
        Example(
            "the same name",
            {
                "launch/a.launch.py": _LAUNCH.format("", "eye", ""),
                "launch/b.launch.py": _LAUNCH.format(
                    ", namespace='left'", "eye", ", namespace='/left'"
                ),
            },
            "launch/a.launch.py:8:48: the node in line 7 is also named /eye; give each a unique "
            "name or namespace",
            "launch/b.launch.py:8:48: the node in line 7 is also named /left/eye; give each a "
            "unique name or namespace",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        first: dict[tuple[str, str], int] = {}
        for node in started_nodes(package):
            full = node.full_name(package) if node.is_certain else None
            if full is None:
                continue
            at = node.name_location
            line = first.setdefault((at.path, full), at.line)
            if line != at.line:
                message = (
                    f"the node in line {line} is also named {full}; give each a unique name "
                    f"or namespace"
                )
                yield self.report(at, message)
