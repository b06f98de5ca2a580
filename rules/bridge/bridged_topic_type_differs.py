"""BR003: a bridge and the nodes of its package agree on the type of a topic."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.messages import message_paths
from scaffold.api.parameters import keeps_default_name
from scaffold.api.programs import is_remapped, topics_of
from scaffold.api.robot import bridge_entries

_ENTRY = (
    "- ros_topic_name: {}\n  gz_topic_name: /cmd_vel\n  ros_type_name: geometry_msgs/msg/{}\n"
    "  gz_type_name: gz.msgs.Twist\n  direction: {}\n"
)
_NODE = (
    "from geometry_msgs.msg import TwistStamped\nfrom rclpy.node import Node\n\n\n"
    "class Driver(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('driver')\n"
    "        self.pub = self.create_publisher(TwistStamped, 'cmd_vel', 10)\n"
)


class BridgedTopicTypeDiffers(Rule):
    """A bridge has another type for a topic than the nodes of its package.

    **Why.** The two never connect: in the simulation nothing moves or nothing arrives, without an
    error.

    **Fix.** Use the same type on both sides; ``Twist`` and ``TwistStamped`` both go with
    ``gz.msgs.Twist``.

    **Source.** ROS 2 documentation, "Topics": a topic has one type.
    """

    code = "BR003"
    name = "bridged-topic-type-differs"
    examples = (
        Example(
            "the same type; another direction; another topic",
            {
                "driver.py": _NODE,
                "a.yaml": _ENTRY.format("/cmd_vel", "TwistStamped", "ROS_TO_GZ")
                + _ENTRY.format("cmd_vel", "Twist", "GZ_TO_ROS")
                + _ENTRY.format("cmd_vel_nav", "Twist", "ROS_TO_GZ"),
            },
        ),
        Example(
            "another type",
            {"driver.py": _NODE, "a.yaml": _ENTRY.format("/cmd_vel", "Twist", "ROS_TO_GZ")},
            Report(
                "a.yaml:3:18",
                "'/cmd_vel' has type geometry_msgs/msg/Twist here, but "
                "geometry_msgs/msg/TwistStamped in driver.py:8: they never connect",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        entries = [*bridge_entries(package)]
        if not entries or not message_paths(package):
            return
        topics = topics_of(package)
        for entry in entries:
            topic = topics.get(entry.ros_topic.removeprefix("/"))
            if topic is None or not topic.is_plain_by_default:
                continue
            sides = {
                "ROS_TO_GZ": topic.publishers,
                "GZ_TO_ROS": topic.subscriptions,
                "BIDIRECTIONAL": [*topic.publishers, *topic.subscriptions],
            }
            type_ = entry.values.get("ros_type_name")
            for endpoint in sides.get(entry.direction, ()):
                if type_ is None or endpoint.interface in {type_.text, None}:
                    continue
                if not keeps_default_name(package, endpoint) or is_remapped(package, endpoint):
                    continue
                at = endpoint.location
                message = (
                    f"{entry.ros_topic!r} has type {type_.text} here, but {endpoint.interface} in "
                    f"{at.path}:{at.line}: they never connect"
                )
                yield self.report(type_, message)
