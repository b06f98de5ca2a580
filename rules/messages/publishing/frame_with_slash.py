"""MS007: frame names have no leading slash."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence

from scaffold.api import (
    Diagnostic,
    Edit,
    Example,
    Fix,
    MessageRule,
    Package,
    Report,
    Severity,
)
from scaffold.api.catalog import ROS_PACKAGES
from scaffold.api.messages import MessageTypes
from scaffold.api.rclpy import rclpy_paths

_FIELDS = ("frame_id", "child_frame_id")
_LOOKUPS = frozenset({"lookup_transform", "can_transform", "lookup_transform_async"})
_FRAMES = ("target_frame", "source_frame")
_TRANSFORM = "geometry_msgs/msg/TransformStamped"
_MARKERS = "visualization_msgs/"
"""What RViz shows; it removes the slash."""
_IMAGES = ("sensor_msgs/msg/CameraInfo", "sensor_msgs/msg/CompressedImage", "sensor_msgs/msg/Image")
"""What mostly is processed and shown without a transform."""
_POSES = ("nav_msgs/", "geometry_msgs/")
"""What mostly RViz shows; AMCL removes the slash of its initial pose, too."""
_MOVING = ("nav2_", "goal_pose", "moveit", "move_group")
"""Words of files with goals for Nav2 and MoveIt, which transform poses and paths."""
_CODE = (
    "from geometry_msgs.msg import TransformStamped\n\n\n"
    "def make(buffer, time):\n"
    "    transform = buffer.lookup_transform({}, 'base', time)\n"
    "    sent = TransformStamped(child_frame_id={})\n"
    "    sent.header.frame_id = {}\n"
    "    return transform, sent\n"
)
_LOOKUP = (
    "import rclpy\n\n\ndef look(buffer, time):\n"
    "    return buffer.lookup_transform(target_frame='{}', source_frame='a', time=time)\n"
)
_OTHERS = (
    "from sensor_msgs.msg import LaserScan\nfrom team_msgs.msg import Goal\n\n\n"
    "def make():\n"
    "    scan = LaserScan()\n    scan.header.frame_id = {}\n"
    "    goal = Goal()\n    goal.header.frame_id = {}\n"
    "    return scan, goal\n"
)
_MARKER = (
    "from visualization_msgs.msg import Marker\n\n\n"
    "def make():\n    marker = Marker()\n    marker.header.frame_id = '{}'\n    return marker\n"
)
_CAMERA = (
    "from cv_bridge import CvBridge\nfrom sensor_msgs.msg import CameraInfo\n\n\n"
    "def make(pixels):\n"
    "    image = CvBridge().cv2_to_imgmsg(pixels, 'bgr8')\n"
    "    image.header.frame_id = frame = '{}'\n"
    "    camera = CameraInfo()\n    camera.header.frame_id = frame\n"
    "    return image, camera\n"
)
_POSE = (
    "from geometry_msgs.msg import PoseStamped\nfrom rclpy.node import Node\n\n\n"
    "class Planner(Node):\n"
    "    def send(self):\n"
    "        publisher = self.create_publisher(PoseStamped, '{}', 1)\n"
    "        pose = PoseStamped()\n        pose.header.frame_id = '/map'\n"
    "        publisher.publish(pose)\n"
)
_UNKNOWN = "a message of a type that is not known"
_OF_UNKNOWN = (
    "from motor_driver_msgs.msg import State\n\n\n"
    "def state():\n    message = State()\n    message.header.frame_id = '{}'\n"
    "    return message\n"
)


class FrameWithSlash(MessageRule):
    """A frame name starts with a slash.

    A warning in transforms, where tf2 removes the slash, in markers, poses, paths and maps, where
    RViz and AMCL remove it, unless they are for Nav2 or MoveIt, and in images, camera information
    and messages of packages outside ROS, whose frames may never be looked up.

    **Why.** Every lookup of the frame fails: ``Invalid argument "/base_link" passed to
    lookupTransform ... frame_ids cannot start with a '/'``.

    **Fix.** Remove the slash.

    **Source.** ``tf2/src/buffer_core.cpp``; https://wiki.ros.org/tf2/Migration.
    """

    code = "MS007"
    name = "frame-with-slash"
    other_severities = {
        Severity.WARNING: "it is in a transform, in an image, in a marker, pose or path for "
        "RViz, or in a message of a package outside ROS"
    }
    examples = (
        Example("frames without a slash", {"node.py": _CODE.format("'map'", "'base'", "'map'")}),
        Example(
            "slashes in a test", {"test/test_a.py": _CODE.format("'/map'", "'/base'", "'/map'")}
        ),
        Example(
            "frames with a slash in lookups and transforms",
            {"node.py": _CODE.format("'/map'", '"/base"', "'/map'")},
            Report(
                "5:41",
                "frame '/map' starts with '/': tf2 rejects it; remove the slash",
                fix="Remove the slash",
            ),
            Report(
                "6:44",
                "frame '/base' starts with '/': tf2 knows the frame without it; remove the slash",
                fix="Remove the slash",
                severity=Severity.WARNING,
            ),
            Report(
                "7:28",
                "frame '/map' starts with '/': tf2 knows the frame without it; remove the slash",
                fix="Remove the slash",
                severity=Severity.WARNING,
            ),
            fixed={"node.py": _CODE.format("'map'", '"base"', "'map'")},
        ),
        Example(
            "slash in a lookup, in a file without message imports",
            {"node.py": _LOOKUP.format("/map")},
            Report(
                "5:49",
                "frame '/map' starts with '/': tf2 rejects it; remove the slash",
                fix="Remove the slash",
            ),
            fixed={"node.py": _LOOKUP.format("map")},
        ),
        Example(
            "slash in the header of a ROS message and of a workspace message",
            {"node.py": _OTHERS.format("'/laser'", "'/world'")},
            Report(
                "7:28",
                "frame '/laser' starts with '/': tf2 rejects it; remove the slash",
                fix="Remove the slash",
            ),
            Report(
                "9:28",
                "frame '/world' starts with '/': tf2 rejects it where the frame is "
                "looked up; remove the slash",
                fix="Remove the slash",
                severity=Severity.WARNING,
            ),
            neighbors={
                "team_msgs": {
                    "package.xml": "<package><name>team_msgs</name></package>",
                    "msg/Goal.msg": "std_msgs/Header header\n",
                }
            },
            fixed={"node.py": _OTHERS.format("'laser'", "'world'")},
        ),
        Example(
            "slash in the frame of a marker",
            {"node.py": _MARKER.format("/world")},
            Report(
                "6:30",
                "frame '/world' starts with '/': tf2 rejects it where the frame is "
                "looked up; remove the slash",
                fix="Remove the slash",
                severity=Severity.WARNING,
            ),
            fixed={"node.py": _MARKER.format("world")},
        ),
        Example(
            "slash in the frames of an image and of its camera",
            {"node.py": _CAMERA.format("/camera")},
            Report(
                "7:37",
                "frame '/camera' starts with '/': tf2 rejects it where the frame is "
                "looked up; remove the slash",
                fix="Remove the slash",
                severity=Severity.WARNING,
            ),
            Report(
                "9:30",
                "frame '/camera' starts with '/': tf2 rejects it where the frame is "
                "looked up; remove the slash",
                severity=Severity.WARNING,
            ),
            fixed={"node.py": _CAMERA.format("camera")},
        ),
        Example(
            "slash in the frame of a pose for RViz, and of one for Nav2",
            {
                "show.py": _POSE.format("pose"),
                "drive.py": _POSE.format("goal_pose"),
            },
            Report(
                "drive.py:9:32",
                "frame '/map' starts with '/': tf2 rejects it; remove the slash",
                fix="Remove the slash",
            ),
            Report(
                "show.py:9:32",
                "frame '/map' starts with '/': tf2 rejects it where the frame is "
                "looked up; remove the slash",
                fix="Remove the slash",
                severity=Severity.WARNING,
            ),
            fixed={
                "show.py": _POSE.format("pose").replace("/map", "map"),
                "drive.py": _POSE.format("goal_pose").replace("/map", "map"),
            },
        ),
        Example(
            "slash in the frame of an unknown message type",
            {"node.py": "import rclpy\n" + _OF_UNKNOWN.format("/world")},
            Report(
                "7:31",
                "frame '/world' starts with '/': tf2 rejects it where the frame is "
                "looked up; remove the slash",
                fix="Remove the slash",
                severity=Severity.WARNING,
            ),
            fixed={"node.py": "import rclpy\n" + _OF_UNKNOWN.format("world")},
        ),
    )

    def paths(self, package: Package) -> Sequence[str]:
        """Return the files that use messages or may look up transforms."""
        return [*dict.fromkeys([*super().paths(package), *rclpy_paths(package)])]

    def check_file(self, types: MessageTypes) -> Iterator[Diagnostic]:
        # Frames that a test makes up as input are never looked up.
        for node, owner in () if types.module.in_tests else _frames(types):
            value = types.file.evaluator.evaluate(node)
            if not (isinstance(value, str) and value.startswith("/")):
                continue
            fix = None
            start, _ = types.module.span(node)
            text = types.module.text(node)
            if isinstance(node, ast.Constant) and text[:2] in {"'/", '"/'} and value != "/":
                edit = Edit(types.module.path, start + 1, start + 2, "")
                fix = Fix("Remove the slash", (edit,))
            severity = Severity.ERROR
            effect = "tf2 rejects it"
            if owner == _TRANSFORM:
                severity, effect = Severity.WARNING, "tf2 knows the frame without it"
            elif owner and _may_only_be_shown(types, owner):
                severity, effect = Severity.WARNING, "tf2 rejects it where the frame is looked up"
            message = f"frame {value!r} starts with '/': {effect}; remove the slash"
            yield self.report(types.module.location(node), message, fix, severity=severity)


def _may_only_be_shown(types: MessageTypes, message: str) -> bool:
    """Return whether the readers of a message may all remove the slash, or never use the frame."""
    if message.partition("/")[0] not in ROS_PACKAGES:
        return True
    is_pose = message.startswith(_POSES) and not types.module.mentions(*_MOVING)
    return is_pose or message.startswith((_MARKERS, *_IMAGES))


def _frames(types: MessageTypes) -> Iterator[tuple[ast.expr, str]]:
    """Yield the expressions used as frames, with their message if any."""
    for name in _FIELDS:
        for store in types.file.evaluator.stores(name):
            # ``self.frame_id`` is an attribute of the node, not of a message.
            if store.value is not None and store.class_ is None:
                yield store.value, _message(types, store.node.value)
    for call in types.module.walk(ast.Call):
        if isinstance(call.func, ast.Attribute) and call.func.attr in _LOOKUPS:
            yield from ((argument, "") for argument in call.args[:2])
            yield from ((word.value, "") for word in call.keywords if word.arg in _FRAMES)
        elif call.keywords and (class_ := types.class_of(call.func)):
            yield from ((word.value, class_.name) for word in call.keywords if word.arg in _FIELDS)


def _message(types: MessageTypes, node: ast.expr) -> str:
    """Return the type of the message of a frame, or ``_UNKNOWN``."""
    if isinstance(node, ast.Attribute) and node.attr == "header":
        node = node.value
    message = types.type_of(node)
    return message.name if message else _UNKNOWN
