"""Inferred message types of expressions in Python code: only certain ones."""

from __future__ import annotations

import ast

import pytest

from scaffold.model.messages.expected_errors import is_error_expected
from scaffold.model.messages.inference import MessageTypes
from scaffold.model.package import Package

NODE = """\
from geometry_msgs.msg import PoseArray, Twist
from rclpy.action import ActionServer
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import SetBool, SetBool_Request


class Talker(Node):
    def __init__(self):
        super().__init__('talker')
        self.create_subscription(String, 'a', self.on_text, 10)
        self.create_subscription(String, 'b', self.on_both, 10)
        self.create_subscription(Twist, 'c', self.on_both, 10)
        self.create_subscription(String, 'd', self.on_raw, 10, raw=True)
        self.create_subscription(PoseArray, 'e', lambda poses: poses, 10)
        self.create_service(SetBool, 'f', self.on_set)
        self.last = None
        self.twist = Twist()

    def on_text(self, msg):
        self.last = msg
        return {}

    def on_both(self, msg):
        return {}

    def on_raw(self, msg):
        return {}

    def on_set(self, request, response):
        return {}

    def on_array(self, other):
        poses = PoseArray()
        first = poses.poses[0]
        mixed = Twist()
        mixed = other
        asked = Twist()
        if isinstance(asked, Twist):
            pass
        for pose in poses.poses:
            return {}
"""


def type_in(line: str, expression: str) -> str | None:
    """Return the message type of an expression returned below a line of NODE."""
    head, _, tail = NODE.partition(line)
    text = head + line + tail.replace("return {}", f"return {expression}", 1)
    types = MessageTypes.of(Package.of({"node.py": text}), "node.py")
    returned = [
        node.value
        for node in types.module.walk(ast.Return)
        if node.value is not None and types.module.text(node.value) == expression
    ]
    result = types.type_of(returned[0])
    return result.name if result else None


@pytest.mark.parametrize(
    ("line", "expression", "expected"),
    [
        ("def on_text", "msg", "std_msgs/msg/String"),
        ("def on_text", "self.last", "std_msgs/msg/String"),
        ("def on_text", "self.twist.linear", "geometry_msgs/msg/Vector3"),
        ("def on_text", "self.other", None),
        ("def on_text", "SetBool_Request()", "std_srvs/srv/SetBool.Request"),
        ("def on_text", "SetBool()", None),
        ("def on_text", "String", None),
        ("def on_both", "msg", None),
        ("def on_raw", "msg", None),
        ("def on_set", "request", "std_srvs/srv/SetBool.Request"),
        ("def on_set", "response", "std_srvs/srv/SetBool.Response"),
        ("def on_array", "first.position", "geometry_msgs/msg/Point"),
        ("def on_array", "pose.orientation", "geometry_msgs/msg/Quaternion"),
        ("def on_array", "poses.poses", None),
        ("def on_array", "poses.poses[1:]", None),
        ("def on_array", "poses.poses[0].position.x", None),
        ("def on_array", "mixed", None),
        ("def on_array", "asked", None),
        ("def on_array", "other", None),
    ],
)
def test_message_type_of_expression(line: str, expression: str, expected: str | None) -> None:
    assert type_in(line, expression) == expected


@pytest.mark.parametrize(
    "around",
    [
        "import pytest\ndef test():\n    with pytest.raises(AttributeError):\n        {}",
        "try:\n    {}\nexcept AttributeError:\n    pass",
        "def test(self):\n    self.assertRaises(TypeError, lambda: {})",
    ],
)
def test_expected_assignment_errors_are_ignored(around: str) -> None:
    text = "from std_msgs.msg import String\n" + around.format("String().text")
    package = Package.of({"node.py": text})
    types = MessageTypes.of(package, "node.py")
    (wrong,) = (node for node in types.module.walk(ast.Attribute) if node.attr == "text")
    assert is_error_expected(types.module, wrong)


def test_ros_1_code_is_ignored() -> None:
    text = "from std_msgs.msg import String\nString().text\n"
    files = {"node.py": text, "old.py": f"import rospy\n{text}"}
    (types,) = MessageTypes.of_package(Package.of(files))
    assert types.module.path == "node.py"


def test_other_assignment_errors_are_not_ignored() -> None:
    text = "from std_msgs.msg import String\ntry:\n    pass\nexcept E:\n    String().text\n"
    types = MessageTypes.of(Package.of({"node.py": text}), "node.py")
    (wrong,) = (node for node in types.module.walk(ast.Attribute) if node.attr == "text")
    assert not is_error_expected(types.module, wrong)


def test_a_synchronizer_passes_a_message_of_each_topic() -> None:
    text = (
        "from message_filters import Subscriber, TimeSynchronizer\n"
        "from rclpy.node import Node\nfrom sensor_msgs.msg import CameraInfo, Image\n\n\n"
        "class Viewer(Node):\n"
        "    def __init__(self):\n"
        "        super().__init__('viewer')\n"
        "        image = Subscriber(self, Image, 'image')\n"
        "        filters = [image, Subscriber(self, CameraInfo, 'info')]\n"
        "        sync = TimeSynchronizer(filters, 10)\n"
        "        sync.registerCallback(self.view)\n\n"
        "    def view(self, image, info):\n"
        "        return image, info\n"
    )
    types = MessageTypes.of(Package.of({"node.py": text}), "node.py")
    (last,) = types.module.walk(ast.Return)
    assert isinstance(last.value, ast.Tuple)
    names = [getattr(types.type_of(element), "name", None) for element in last.value.elts]
    assert names == ["sensor_msgs/msg/Image", "sensor_msgs/msg/CameraInfo"]


def test_assigned_values_are_found_once_in_order() -> None:
    text = (
        "from std_msgs.msg import Header, String\n\nheader = Header(frame_id='a')\n"
        "header.frame_id, other = 'b', String(data='c')\nother.data += 'd'\n"
    )
    types = MessageTypes.of(Package.of({"node.py": text}), "node.py")
    result = [(item.field.name, types.module.text(item.value)) for item in types.assigned]
    assert result == [("frame_id", "'a'"), ("frame_id", "'b'"), ("data", "'c'")]
