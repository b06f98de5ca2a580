"""Messages that are certainly published without a stamp."""

from __future__ import annotations

import pytest

from scaffold.model.messages.inference import MessageTypes
from scaffold.model.messages.stamps import unstamped
from scaffold.model.package import Package

NODE = """\
import builtin_interfaces.msg
from cv_bridge import CvBridge
from geometry_msgs.msg import PoseStamped, TransformStamped
from rclpy.node import Node
from rclpy.time import Time
from sensor_msgs.msg import Image, Temperature
from std_msgs.msg import Header
from tf2_ros import StaticTransformBroadcaster, TransformBroadcaster

class Talker(Node):
    def __init__(self):
        super().__init__('talker')
        self.publisher = self.create_publisher(Temperature, 'temperature', 10)
        self.images = self.create_publisher(Image, 'image', 10)
        self.poses = self.create_publisher(PoseStamped, 'goal_pose', 10)
        self.other = self.create_publisher(PoseStamped, 'tool', 10)
        self.broadcaster = TransformBroadcaster(self)
        self.static = StaticTransformBroadcaster(self)
        self.bridge = CvBridge()
        self.kept = Temperature()
        self.kept.header.frame_id = 'base'

    def tick(self, frame):
        {}

    def other(self):
        {}
"""


def found(*lines: str, other: str = "pass") -> list[str]:
    """Return the messages without a stamp."""
    text = NODE.format("\n        ".join(lines), other)
    types = MessageTypes.of(Package.of({"talker.py": text}), "talker.py")
    return [item.message.name for item in unstamped(types)]


TRANSFORM = "geometry_msgs/msg/TransformStamped"


@pytest.mark.parametrize("stamp", ["Time().to_msg()", "builtin_interfaces.msg.Time()"])
def test_zero_stamp_of_a_moving_transform(stamp: str) -> None:
    made = "t = TransformStamped()", f"t.header.stamp = {stamp}", "t.header.frame_id = 'odom'"
    assert found(*made, "self.broadcaster.sendTransform(t)") == [TRANSFORM]
    assert found(*made, "self.static.sendTransform(t)") == []


def test_zero_stamp_with_and_without_frame() -> None:
    made = "p = PoseStamped()", "p.header.stamp = Time().to_msg()"
    assert found(*made, "self.poses.publish(p)") == ["geometry_msgs/msg/PoseStamped"]
    assert found(*made, "p.header.frame_id = frame", "self.poses.publish(p)") == []
    assert found(made[0], "self.poses.publish(p)") == []


def test_frame_only_used_within_the_package() -> None:
    lines = "p = PoseStamped()", "p.header.stamp = Time().to_msg()", "self.other.publish(p)"
    assert found(*lines) == []


def test_message_returned_by_a_method() -> None:
    made = "t = TransformStamped()", "t.header.frame_id = 'odom'", "return t"
    sent = "self.broadcaster.sendTransform(self.tick('a'))"
    assert found(*made, other=sent) == [TRANSFORM]
    assert found(made[0], "t.header.stamp = frame.stamp", *made[1:], other=sent) == []
    assert found("if frame: return None", *made, other=sent) == []


@pytest.mark.parametrize(
    "lines",
    [
        ("m = Temperature()", "m.header.frame_id = 'a'", "self.publisher.publish(m)"),
        ("m = Temperature(header=Header(frame_id='a'))", "self.publisher.publish(m)"),
        ("self.publisher.publish(Temperature(header=Header(frame_id='a')))",),
        ("m = Temperature()", "m.header = Header(frame_id='a')", "self.publisher.publish(m)"),
        ("self.publisher.publish(self.kept)",),
        ("self.publisher.publish(self.kept)", "print(f'{self.kept.temperature}')"),
    ],
)
def test_stamp_never_set(lines: tuple[str, ...]) -> None:
    assert found(*lines) == ["sensor_msgs/msg/Temperature"]


def test_stamp_of_images_and_transforms() -> None:
    image = "m = self.bridge.cv2_to_imgmsg(frame, 'bgr8')"
    publish = "self.images.publish(m)"
    assert found(image, "m.header.frame_id = 'a'", publish) == ["sensor_msgs/msg/Image"]
    assert found(image, "m.header.stamp = self.now()", publish) == []
    assert found("m = self.bridge.cv2_to_imgmsg(frame, 'bgr8', self.header)", publish) == []
    transform = ("t = TransformStamped()", "t.header.frame_id = 'a'")
    name = "geometry_msgs/msg/TransformStamped"
    assert found(*transform, "self.broadcaster.sendTransform(t)") == [name]
    assert found(*transform, "self.static.sendTransform(t)") == []


@pytest.mark.parametrize(
    "line",
    [
        "m.header.stamp = self.now()",
        "m.header.stamp.sec = 3",
        "m.header = frame.header",
        "m.header = Header(frame_id='b', stamp=self.now())",
        "m.header = Header(**self.fields)",
        "self.fill(m)",
        "self.fill(m.header)",
        "self.fill(m.header.stamp)",
        "setattr(m, 'header', frame.header)",
        "n = m",
        "self.last = m",
        "messages = [m]",
        "m = self.filled()",
    ],
)
def test_stamp_possibly_set(line: str) -> None:
    lines = ("m = Temperature()", "m.header.frame_id = 'a'", line, "self.publisher.publish(m)")
    assert found(*lines) == []


def test_stamp_set_in_another_method() -> None:
    other = "self.kept.header.stamp = self.now()"
    assert found("self.publisher.publish(self.kept)", other=other) == []


def test_unused_header_needs_no_stamp() -> None:
    assert found("self.publisher.publish(Temperature())") == []


def test_zero_stamp_of_a_pose_means_latest() -> None:
    pose = ("m = PoseStamped()", "m.header.frame_id = 'map'", "self.poses.publish(m)")
    assert found(*pose) == []
