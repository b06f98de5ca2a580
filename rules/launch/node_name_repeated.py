"""LF012: nodes of a launch file have names of their own."""

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
    """A launch file starts two nodes with one name.

    **Why.** Nothing warns, but ``ros2 param``, services and ``ros2 node info`` reach one of the two
    at random. **Fix.** Give each its own name or namespace.

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
            "one name",
            {
                "launch/a.launch.py": _LAUNCH.format("", "eye", ""),
                "launch/b.launch.py": _LAUNCH.format(
                    ", namespace='left'", "eye", ", namespace='/left'"
                ),
            },
            "launch/a.launch.py:8:48: the node in line 7 is named /eye as well",
            "launch/b.launch.py:8:48: the node in line 7 is named /left/eye as well",
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
                message = f"the node in line {line} is named {full} as well"
                yield self.report(at, message)
