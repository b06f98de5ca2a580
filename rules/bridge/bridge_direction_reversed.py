"""BR004: a bridge carries data the way that it flows."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity
from scaffold.api.messages import message_paths
from scaffold.api.programs import topics_of
from scaffold.api.robot import bridge_entries

_ENTRY = (
    "- ros_topic_name: {0}\n  gz_topic_name: /{0}\n  ros_type_name: {1}\n"
    "  gz_type_name: gz.msgs.{2}\n  direction: {3}\n"
)
_NODE = (
    "from geometry_msgs.msg import Twist\nfrom rclpy.node import Node\n\n\n"
    "class Driver(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('driver')\n"
    "        self.pub = self.create_publisher(Twist, 'cmd_vel', 10)\n"
)
_OF_SENSORS = frozenset(
    {"rosgraph_msgs/msg/Clock", "sensor_msgs/msg/LaserScan", "sensor_msgs/msg/Image"}
    | {"sensor_msgs/msg/CameraInfo", "sensor_msgs/msg/Imu", "sensor_msgs/msg/PointCloud2"}
    | {"sensor_msgs/msg/NavSatFix", "sensor_msgs/msg/MagneticField"}
)
"""What Gazebo measures, and never takes from ROS."""


class BridgeDirectionReversed(Rule):
    """A bridge carries commands to ROS, or measurements to Gazebo.

    **Why.** Nobody publishes on the side that it listens to: the robot does not move, the nodes
    get no data, and there is no error.

    **Fix.** ``ROS_TO_GZ`` for what nodes publish, ``GZ_TO_ROS`` for sensors and the clock.

    **Source.** ros_gz_bridge, README.
    """

    code = "BR004"
    name = "bridge-direction-reversed"
    severity = Severity.WARNING
    examples = (
        Example(
            "both ways",
            {
                "driver.py": _NODE,
                "a.yaml": _ENTRY.format("cmd_vel", "geometry_msgs/msg/Twist", "Twist", "ROS_TO_GZ")
                + _ENTRY.format("clock", "rosgraph_msgs/msg/Clock", "Clock", "GZ_TO_ROS"),
            },
        ),
        Example(
            "the other way round",
            {
                "driver.py": _NODE,
                "a.yaml": _ENTRY.format("cmd_vel", "geometry_msgs/msg/Twist", "Twist", "GZ_TO_ROS")
                + _ENTRY.format("clock", "rosgraph_msgs/msg/Clock", "Clock", "ROS_TO_GZ"),
            },
            Report(
                "a.yaml:5:14",
                "'cmd_vel' comes from Gazebo, but driver.py:8 publishes it: nothing "
                "arrives there; write ROS_TO_GZ",
            ),
            Report(
                "a.yaml:10:14",
                "'clock' goes to Gazebo, which publishes it itself: nothing arrives "
                "in ROS; write GZ_TO_ROS",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for entry in bridge_entries(package):
            direction = entry.values.get("direction")
            if direction is None:
                continue
            if entry.direction == "ROS_TO_GZ" and entry.text("ros_type_name") in _OF_SENSORS:
                message = (
                    f"{entry.ros_topic!r} goes to Gazebo, which publishes it itself: nothing "
                    "arrives in ROS; write GZ_TO_ROS"
                )
                yield self.report(direction, message)
            elif entry.direction == "GZ_TO_ROS" and message_paths(package):
                topic = topics_of(package).get(entry.ros_topic.removeprefix("/"))
                if topic is not None and topic.publishers and not topic.subscriptions:
                    at = topic.publishers[0].location
                    message = (
                        f"{entry.ros_topic!r} comes from Gazebo, but {at.path}:{at.line} publishes "
                        "it: nothing arrives there; write ROS_TO_GZ"
                    )
                    yield self.report(direction, message)
