"""LF045: names of nodes and namespaces are valid, and defaults of conditions are booleans."""

from __future__ import annotations

import re
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, LaunchRule
from scaffold.api.launch import NODES, LaunchFile

_TRUTHS = frozenset({"true", "false", "1", "0"})
_CONDITIONS = ("IfCondition", "UnlessCondition")
_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n"
    "    return LaunchDescription([\n"
    "        Node(package='talker', executable='node', name='{}', namespace='{}'),\n    ])\n"
)


class LaunchNameInvalid(LaunchRule):
    """A launch file has an invalid node name, namespace, or default of a condition.

    **Why.** The node fails at start: ``InvalidNodeNameException``, or ``Couldn't parse remap
    rule``. A condition with another value stops the launch: ``invalid condition expression``.

    **Fix.** Use letters, digits and ``_``, but no digit first, and ``/`` in namespaces only. Use
    ``true`` or ``false`` as the default of a condition.

    **Source.** ``rmw/validate_node_name.c``; ``launch/conditions``.
    """

    code = "LF045"
    name = "launch-name-invalid"
    examples = (
        Example("valid", {"launch/a.launch.py": _LAUNCH.format("talker", "/robot_1")}),
        Example(
            "a dash and a slash",
            {"launch/a.launch.py": _LAUNCH.format("my/talker", "robot-1")},
            "7:56: ROS 2 rejects the node name 'my/talker': use letters, digits and _ only",
            "7:79: ROS 2 rejects the namespace 'robot-1'",
        ),
        Example(
            "a condition",
            {
                "launch/a.launch.py": "from launch.conditions import IfCondition\n"
                "from launch.substitutions import LaunchConfiguration\n\n\n"
                "def generate_launch_description():\n"
                "    return IfCondition(LaunchConfiguration('use', default='yes'))\n"
            },
            "6:12: the default is 'yes', which is neither true nor false: the condition stops the "
            "launch",
        ),
    )

    def check_file(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        for call in launch.find(*NODES, "ComposableNode"):
            name, space = launch.text(call, "name"), launch.text(call, "namespace")
            if isinstance(name, str) and not re.fullmatch(r"[A-Za-z_]\w*", name, re.ASCII):
                message = f"ROS 2 rejects the node name {name!r}: use letters, digits and _ only"
                yield self.report(launch.location(call.given["name"]), message)
            is_space = re.fullmatch(r"(/?[A-Za-z_]\w*(/[A-Za-z_]\w*)*/?|/|)", str(space), re.ASCII)
            if isinstance(space, str) and not is_space:
                message = f"ROS 2 rejects the namespace {space!r}"
                yield self.report(launch.location(call.given["namespace"]), message)
        for call in launch.find(*_CONDITIONS):
            node = next(iter([*call.given.values(), *call.call.args]), None)
            value = launch.default_of(node)
            if isinstance(value, str) and value.lower() not in _TRUTHS:
                message = (
                    f"the default is {value!r}, which is neither true nor false: the "
                    f"condition stops the launch"
                )
                yield self.report(call, message)
