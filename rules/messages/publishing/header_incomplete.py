"""MS010: messages have the stamp, the frame and the other fields that they need."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, MessageRule, Package, Severity
from scaffold.api.messages import MessageTypes, childless, lacking, unstamped
from scaffold.api.rclpy import is_used_elsewhere

_NODE = (
    "from rclpy.node import Node\nfrom sensor_msgs.msg import Temperature\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.publisher = self.create_publisher(Temperature, 'temperature', 10)\n\n"
    "    def tick(self):\n"
    "        reading = Temperature(temperature=20.0)\n"
    "        reading.header.frame_id = 'base_link'\n"
    "{}"
    "        self.publisher.publish(reading)\n"
)
_STATES = {
    "stamp": "with a zero stamp",
    "frame_id": "without a frame",
    "stamp frame_id": "without a stamp and a frame",
}


class HeaderIncomplete(MessageRule):
    """A message is published with its data, but without its stamp, frame, size or range.

    **Why.** With a zero stamp, tf2 has no transform for that time, ``message_filters`` finds no
    match, and RViz drops the message. With an empty frame, RViz shows nothing, and Nav2 rejects
    the goal. In a scan with ``range_max`` 0, all readings are out of range.

    **Fix.** Set ``message.header.stamp = self.get_clock().now().to_msg()`` and
    ``message.header.frame_id = 'map'``.

    **Source.** ``std_msgs/msg/Header``; ROS 2 documentation, "Debugging tf2 problems".
    """

    code = "MS010"
    name = "header-incomplete"
    severity = Severity.WARNING
    examples = (
        Example(
            "stamp and frame set",
            {
                "talker.py": _NODE.format(
                    "        reading.header.stamp = self.get_clock().now().to_msg()\n"
                )
            },
        ),
        Example(
            "stamp never set",
            {"talker.py": _NODE.format("")},
            "11:19: sensor_msgs/msg/Temperature is published in line 13 with a zero stamp; set "
            "header.stamp",
        ),
        Example(
            "odometry without a stamp, point without stamp and frame",
            {
                "odom.py": "from geometry_msgs.msg import PointStamped, TransformStamped\n"
                "from nav_msgs.msg import Odometry\nfrom rclpy.node import Node\n\n\n"
                "class Wheels(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('wheels')\n"
                "        self.publisher = self.create_publisher(Odometry, 'odom', 10)\n"
                "        self.points = self.create_publisher(PointStamped, 'point', 10)\n\n"
                "    def tick(self):\n"
                "        odometry = Odometry(child_frame_id='base_link')\n"
                "        odometry.header.frame_id = 'odom'\n"
                "        self.publisher.publish(odometry)\n"
                "        transform = TransformStamped()\n"
                "        transform.header = odometry.header\n"
                "        self.broadcast(transform.transform)\n\n"
                "    def show(self, x):\n"
                "        point = PointStamped()\n"
                "        point.point.x = x\n"
                "        self.points.publish(point)\n"
            },
            "13:20: nav_msgs/msg/Odometry is published in line 15 with a zero stamp; set "
            "header.stamp",
            "21:17: geometry_msgs/msg/PointStamped is published in line 23 without a stamp and a "
            "frame; set header.stamp and header.frame_id",
        ),
        Example(
            "pose without a frame",
            {
                "talker.py": _NODE.format("")
                .replace("frame_id = 'base_link'", "stamp = self.get_clock().now().to_msg()")
                .replace("sensor_msgs", "geometry_msgs")
                .replace("Temperature(temperature=20.0)", "PoseStamped()")
                .replace("Temperature", "PoseStamped")
                .replace("'temperature'", "'goal_pose'")
            },
            "11:19: geometry_msgs/msg/PoseStamped is published in line 13 without a frame; set "
            "header.frame_id",
        ),
        Example(
            "odometry without a child frame",
            {
                "odom.py": "from nav_msgs.msg import Odometry\nfrom rclpy.node import Node\n\n\n"
                "class Wheels(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('wheels')\n"
                "        self.publisher = self.create_publisher(Odometry, 'odom', 10)\n\n"
                "    def tick(self):\n"
                "        odometry = Odometry()\n"
                "        odometry.header.stamp = self.get_clock().now().to_msg()\n"
                "        odometry.header.frame_id = 'odom'\n"
                "        odometry.twist.twist.linear.x = 0.5\n"
                "        self.publisher.publish(odometry)\n"
            },
            "11:20: nav_msgs/msg/Odometry is sent in line 15 without a child frame; set "
            "child_frame_id",
        ),
        Example(
            "scan without range_max, odometry without a frame",
            {
                "scan.py": "from nav_msgs.msg import Odometry\nfrom rclpy.node import Node\n"
                "from sensor_msgs.msg import LaserScan\n\n\n"
                "class Fake(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('fake')\n"
                "        self.scans = self.create_publisher(LaserScan, 'scan', 10)\n"
                "        self.odometry = self.create_publisher(Odometry, 'odom', 10)\n\n"
                "    def tick(self, driver):\n"
                "        scan = LaserScan(angle_min=-1.5, angle_max=1.5, angle_increment=0.1)\n"
                "        scan.ranges = [1.0] * 31\n"
                "        scan.range_min = 0.1\n"
                "        self.scans.publish(scan)\n"
                "        other = LaserScan(ranges=[1.0])\n"
                "        driver.complete(other)\n"
                "        self.scans.publish(other)\n"
                "        self.scans.publish(LaserScan())\n"
                "        here = Odometry(child_frame_id='base_link')\n"
                "        here.header.stamp = self.get_clock().now().to_msg()\n"
                "        self.odometry.publish(here)\n"
            },
            "13:16: sensor_msgs/msg/LaserScan is published in line 16 with its data, and "
            "range_max is left at its default, zero or empty: set it",
            "21:16: nav_msgs/msg/Odometry is published in line 23 without a frame; set "
            "header.frame_id",
        ),
        Example(
            "map without a resolution; with one; with a whole info",
            {
                "map.py": "from nav_msgs.msg import MapMetaData, OccupancyGrid\n"
                "from rclpy.node import Node\n\n\n"
                "class Maps(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('maps')\n"
                "        self.maps = self.create_publisher(OccupancyGrid, 'map', 1)\n\n"
                "    def send(self):\n"
                "        grid = OccupancyGrid()\n"
                "        grid.header.stamp = self.get_clock().now().to_msg()\n"
                "        grid.header.frame_id = 'map'\n"
                "        grid.info.width = grid.info.height = 2\n"
                "        grid.data = [0, 0, 0, 0]\n"
                "        self.maps.publish(grid)\n\n"
                "    def send_scaled(self):\n"
                "        grid = OccupancyGrid(data=[0])\n"
                "        grid.header.stamp = self.get_clock().now().to_msg()\n"
                "        grid.header.frame_id = 'map'\n"
                "        grid.info.width = grid.info.height = 1\n"
                "        grid.info.resolution = 0.05\n"
                "        self.maps.publish(grid)\n\n"
                "    def send_whole(self):\n"
                "        grid = OccupancyGrid(data=[0])\n"
                "        grid.header.stamp = self.get_clock().now().to_msg()\n"
                "        grid.header.frame_id = 'map'\n"
                "        grid.info = MapMetaData(width=1, height=1, resolution=0.05)\n"
                "        self.maps.publish(grid)\n"
            },
            "11:16: nav_msgs/msg/OccupancyGrid is published in line 16 with its data, and "
            "info.resolution is left at its default, zero or empty: set it",
        ),
        Example(
            "trajectory points without time_from_start",
            {
                "arm.py": "from rclpy.node import Node\n"
                "from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint\n\n\n"
                "class Arm(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('arm')\n"
                "        self.publisher = self.create_publisher(JointTrajectory, 'move', 10)\n\n"
                "    def move(self):\n"
                "        point = JointTrajectoryPoint(positions=[0.1])\n"
                "        moved = JointTrajectory(joint_names=['a'], points=[point])\n"
                "        self.publisher.publish(moved)\n",
                "feedback.py": "from rclpy.node import Node\n"
                "from sensor_msgs.msg import JointState\n"
                "from trajectory_msgs.msg import JointTrajectoryPoint\n\n\n"
                "class Arm(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('arm')\n"
                "        self.publisher = self.create_publisher(JointState, 'state', 10)\n"
                "        self.now = JointTrajectoryPoint(positions=[0.0])\n",
            },
            "arm.py:11:17: time_from_start of the points is never set: the trajectory has no "
            "duration, and controllers reject it",
        ),
        Example(
            "message passed to a method that may set the stamp",
            {"talker.py": _NODE.format("        self.stamp(reading)\n")},
        ),
        Example(
            "transform without a child frame, returned by a function",
            {
                "odom.py": "from geometry_msgs.msg import TransformStamped\n"
                "from nav_msgs.msg import Odometry\nfrom rclpy.node import Node\n"
                "from tf2_ros import TransformBroadcaster\n\n\n"
                "def transform_of(odom):\n"
                "    transform = TransformStamped()\n"
                "    transform.header = odom.header\n"
                "    transform.transform.rotation = odom.pose.pose.orientation\n"
                "    return transform\n\n\n"
                "class Odom(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('odom')\n"
                "        self.broadcaster = TransformBroadcaster(self)\n"
                "        self.create_subscription(Odometry, 'odom', self.on_odom, 10)\n\n"
                "    def on_odom(self, odom):\n"
                "        self.broadcaster.sendTransform(transform_of(odom))\n"
            },
            "8:17: geometry_msgs/msg/TransformStamped is sent in line 21 without a child frame; "
            "set child_frame_id",
        ),
        Example(
            "image of cv_bridge without a header, where one is known",
            {
                "edges.py": "from cv_bridge import CvBridge\n"
                "from rclpy.node import Node\nfrom sensor_msgs.msg import Image\n\n\n"
                "class Edges(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('edges')\n"
                "        self.bridge = CvBridge()\n"
                "        self.edges = self.create_publisher(Image, 'edges', 10)\n"
                "        self.create_subscription(Image, 'image', self.on_image, 10)\n\n"
                "    def on_image(self, msg):\n"
                "        pixels = self.bridge.imgmsg_to_cv2(msg)\n"
                "        out = self.bridge.cv2_to_imgmsg(pixels)\n"
                "        out.header = msg.header\n"
                "        self.edges.publish(out)\n"
                "        self.edges.publish(self.bridge.cv2_to_imgmsg(pixels, 'bgr8'))\n\n"
                "    def tick(self, pixels):\n"
                "        self.edges.publish(self.bridge.cv2_to_imgmsg(pixels))\n",
            },
            "18:28: sensor_msgs/msg/Image is published in line 18 without a stamp and a frame; "
            "set header.stamp and header.frame_id",
        ),
    )

    def check_in(self, package: Package, types: MessageTypes) -> Iterator[Diagnostic]:
        if types.module.in_tests:
            return
        for unset in unstamped(types):
            if _is_ours(package, types, unset.sent.args[0]):
                line = types.module.location(unset.sent).line
                message = (
                    f"{unset.message.name} is published in line {line} {_STATES[unset.missing]}; "
                    f"set {' and '.join(f'header.{name}' for name in unset.missing.split())}"
                )
                yield self.report(types.module.location(unset.made), message)
        for unset in childless(types):
            if _is_ours(package, types, unset.sent.args[0]):
                line = types.module.location(unset.sent).line
                message = (
                    f"{unset.message.name} is sent in line {line} without a child frame; "
                    "set child_frame_id"
                )
                yield self.report(types.module.location(unset.made), message)
        for unset in lacking(types):
            if _is_ours(package, types, unset.sent.args[0]):
                line = types.module.location(unset.sent).line
                message = (
                    f"{unset.message.name} is published in line {line} with its data, and "
                    f"{unset.missing} is left at its default, zero or empty: set it"
                )
                yield self.report(types.module.location(unset.made), message)
        for made in _points_without_time(types):
            message = "time_from_start of the points is never set: the trajectory has no duration"
            yield self.report(types.module.location(made), f"{message}, and controllers reject it")


_POINT = "trajectory_msgs/msg/JointTrajectoryPoint"
_TRAJECTORY = "trajectory_msgs/msg/JointTrajectory"


def _points_without_time(types: MessageTypes) -> Iterator[ast.Call]:
    """Yield trajectory points without any time that a file creates and sends."""
    module = types.module
    if module.mentions("time_from_start") or not module.mentions(
        "create_publisher", "ActionClient"
    ):
        return
    made: dict[str, list[ast.Call]] = {}
    for call in module.walk(ast.Call):
        class_ = types.class_of(call.func)
        if class_ is not None and class_.name in {_POINT, _TRAJECTORY} and not call.args:
            made.setdefault(class_.name, []).append(call)
    for call in made.get(_POINT, []) if _TRAJECTORY in made else ():
        words = {word.arg for word in call.keywords}
        if None not in words and ("positions" in words or module.mentions(".positions")):
            yield call


def _is_ours(package: Package, types: MessageTypes, sent: ast.expr) -> bool:
    """Return whether no other module uses the attribute with a message."""
    return not isinstance(sent, ast.Attribute) or not is_used_elsewhere(
        package, types.file, sent.attr
    )
