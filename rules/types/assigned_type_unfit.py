"""TY007: fields of messages are set to values of their types."""

from __future__ import annotations

from scaffold.api import Diagnostic, Example, Report, Severity, TypeRule
from scaffold.api.types import (
    MARKED,
    TypeFinding,
    class_in,
    class_itself,
    elements_misfit,
    full_name,
    is_certain_misfit,
    short_name,
    unlike,
)

from ._arguments import when_sent

_CONVERTED = ("rclpy.time.Time", "rclpy.duration.Duration")
"""Types that tf2 converts, so that such a message need not be published."""
_NODE = (
    "from geometry_msgs.msg import Vector3\nfrom visualization_msgs.msg import Marker\n\n\n"
    "def dot() -> Marker:\n"
    "    marker = Marker()\n"
    "    marker.scale = {}\n"
    "    return marker\n"
)

_TRAIL = (
    "from geometry_msgs.msg import PoseStamped\nfrom nav_msgs.msg import Path\n"
    "from rclpy.node import Node\n\n\n"
    "class Trail(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('trail')\n"
    "        self.trail = []\n"
    "        self.create_subscription(PoseStamped, 'pose', self.on_pose, 10)\n\n"
    "    def on_pose(self, pose):\n"
    "        self.trail.append({})\n"
    "        path = Path()\n"
    "        path.poses = self.trail\n"
    "        return path\n"
)


class AssignedTypeUnfit(TypeRule):
    """A field of a message is set to a value of another type.

    **Why.** ROS 2 Jazzy does not check types on assignment: publishing the message raises an
    error that does not name the field, or sends another value.

    **Fix.** Assign a value of the field's type, which ``ros2-scaffold interfaces`` shows. With
    ``ROS_PYTHON_CHECK_FIELDS=1``, the assignment itself raises an ``AssertionError``.

    **Source.** ``rosidl_generator_py``, ``resource/_msg.py.em``.
    """

    code = "TY007"
    name = "assigned-type-unfit"
    other_severities = {
        Severity.WARNING: "the value is an rclpy Time in a file that uses tf2, or another message "
        "with the same fields, which is sent correctly"
    }
    kinds = frozenset({"invalid-assignment"})
    examples = (
        Example(
            "NumPy array as an orientation",
            {
                "turn.py": "from geometry_msgs.msg import Pose\n"
                "from scipy.spatial.transform import Rotation\n\n"
                "pose = Pose()\n"
                "pose.orientation = Rotation.from_euler('z', 1.0).as_quat()\n"
            },
            "5:20: 'orientation' of geometry_msgs.msg.Pose is a geometry_msgs.msg.Quaternion, not "
            "a numpy.ndarray: it cannot be published",
        ),
        Example(
            "value of the correct type", {"dots.py": _NODE.format("Vector3(x=0.1, y=0.1, z=0.1)")}
        ),
        Example(
            "float instead of a Vector3",
            {"dots.py": _NODE.format("0.1")},
            "7:20: 'scale' of visualization_msgs.msg.Marker is a geometry_msgs.msg.Vector3, not a "
            "float: it cannot be published",
        ),
        Example(
            "Point instead of a Vector3, which has the same fields",
            {"dots.py": _NODE.format("Marker().pose.position")},
            Report(
                "7:20",
                "'scale' of visualization_msgs.msg.Marker is a "
                "geometry_msgs.msg.Vector3, not a geometry_msgs.msg.Point",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "tuple element used after a check of the first element",
            {
                "run.py": "from std_msgs.msg import Int32\n\n"
                "steps = [('move', (0.0, 0.4))]  # ('lift', 2)\n"
                "lift = Int32()\n"
                "if steps[0][0] == 'lift':\n"
                "    lift.data = steps[0][1]\n"
            },
        ),
        Example(
            "tuple assigned to an integer field",
            {
                "run.py": "from std_msgs.msg import Int32\n\n"
                "steps = [('move', (0.0, 0.4))]\n"
                "lift = Int32()\n"
                "if steps:\n"
                "    lift.data = steps[0][1]\n"
            },
            "6:17: 'data' of std_msgs.msg.Int32 is an int, not a tuple: it cannot be published",
        ),
        Example(
            "int in a bool field and str in a float field, passed as arguments",
            {
                "led.py": "from geometry_msgs.msg import Vector3\n"
                "from std_msgs.msg import Bool\n\n\n"
                "def switch(led: int, place: str):\n"
                "    flag = Bool()\n"
                "    flag.data = led\n"
                "    point = Vector3()\n"
                "    point.x = place\n"
                "    return flag, point\n\n\n"
                "switch(1, '0.5')\n"
            },
            "7:17: 'data' of std_msgs.msg.Bool is a bool, not an int: False is sent ('led' comes "
            "from line 13)",
            "9:15: 'x' of geometry_msgs.msg.Vector3 is a float, not a str: another number is sent "
            "('place' comes from line 13)",
        ),
        Example(
            "float attribute in an array field, rclpy.time.Time from a method as a stamp",
            {
                "joints.py": "from rclpy.node import Node\nfrom sensor_msgs.msg import JointState\n"
                "import math\n\n\n"
                "class Joints(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('joints')\n"
                "        self.angle = 0.0\n\n"
                "    def tick(self):\n"
                "        self.angle = math.fmod(self.angle + 0.1, 6.28)\n"
                "        joints = JointState()\n"
                "        joints.velocity = [self.angle]\n"
                "        joints.position = self.angle\n"
                "        joints.header.stamp = self.stamp()\n"
                "        return joints\n\n"
                "    def stamp(self):\n"
                "        return self.get_clock().now()\n"
            },
            "15:27: 'position' of sensor_msgs.msg.JointState is a list, not a float: it cannot be "
            "published",
            "16:31: 'stamp' of std_msgs.msg.Header is a builtin_interfaces.msg.Time, not an "
            "rclpy.time.Time: it cannot be published",
        ),
        Example(
            "bool from a dictionary with values of different types",
            {
                "flag.py": "from std_msgs.msg import Bool\n\n"
                "TARGETS = [{'speed': 0.2, 'is_on': True}, {'speed': 0.4, 'is_on': False}]\n"
                "for target in TARGETS:\n"
                "    flag = Bool()\n"
                "    flag.data = target['is_on']\n"
            },
        ),
        Example(
            "list of entries of a dictionary with values of different types",
            {
                "show.py": "from sensor_msgs.msg import PointCloud2\n"
                "from visualization_msgs.msg import Marker, MarkerArray\n\n"
                "SEEN = {'left': Marker(), 'right': Marker(), 'all': PointCloud2()}\n"
                "views = MarkerArray()\n"
                "views.markers = [SEEN[side] for side in ('left', 'right')]\n"
            },
        ),
        Example(
            "method instead of its result, in an array field",
            {
                "arm.py": "from rclpy.node import Node\n"
                "from sensor_msgs.msg import JointState\n\n\n"
                "class Arm(Node):\n"
                "    def angles(self):\n"
                "        return [0.0, 1.0]\n\n"
                "    def tick(self):\n"
                "        state = JointState(name=['a', 'b'])\n"
                "        state.velocity = self.angles()\n"
                "        state.position = self.angles\n"
                "        return state\n"
            },
            "12:26: 'position' of sensor_msgs.msg.JointState is a list, not the function "
            "'angles': it cannot be published",
        ),
        Example(
            "constant of a table instead of a message",
            {
                "keep.py": "from lifecycle_msgs.msg import State, Transition\n"
                "from lifecycle_msgs.srv import ChangeState\n\n"
                "NEXT = {\n"
                "    State.PRIMARY_STATE_INACTIVE: Transition.TRANSITION_ACTIVATE,\n"
                "    State.PRIMARY_STATE_UNCONFIGURED: Transition.TRANSITION_CONFIGURE,\n"
                "}\n\n\n"
                "def change(state: State):\n"
                "    request = ChangeState.Request()\n"
                "    request.transition = NEXT[state.id]\n"
                "    return request\n"
            },
            "12:26: 'transition' of lifecycle_msgs.srv.ChangeState.Request is a "
            "lifecycle_msgs.msg.Transition, not an int: it cannot be published",
        ),
        Example("list with the correct message type", {"trail.py": _TRAIL.format("pose")}),
        Example(
            "list with a wrong message type",
            {"trail.py": _TRAIL.format("pose.pose")},
            "15:22: elements of 'poses' must be a geometry_msgs.msg.PoseStamped, not a "
            "geometry_msgs.msg.Pose: it cannot be published",
        ),
        Example(
            "variable that is a message in one branch only",
            {
                "say.py": "from geometry_msgs.msg import Twist\n"
                "from std_msgs.msg import String\n\n\n"
                "def answer(heard: String, is_moving):\n"
                "    words = heard.data.strip()\n"
                "    if not words:\n"
                "        return None\n"
                "    if is_moving:\n"
                "        words = Twist()\n"
                "    said = String()\n"
                "    said.data = words\n"
                "    return said\n"
            },
            "12:17: 'data' of std_msgs.msg.String is a str, not a str or geometry_msgs.msg.Twist: "
            "it cannot be published",
        ),
        Example(
            "rclpy.time.Time as a stamp in a file that imports tf2_ros",
            {
                "look.py": "import tf2_ros\nfrom rclpy.time import Time\n"
                "from std_msgs.msg import Header\n\n\n"
                "def stamped():\n"
                "    header = Header()\n"
                "    header.stamp = Time()\n"
                "    return tf2_ros, header\n"
            },
            Report(
                "8:20",
                "'stamp' of std_msgs.msg.Header is a builtin_interfaces.msg.Time, "
                "not an rclpy.time.Time: it cannot be published",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "class instead of a message",
            {
                "scan.py": "from sensor_msgs.msg import LaserScan\n"
                "from std_msgs.msg import Header\n\n"
                "scan = LaserScan()\nscan.header = Header\n"
            },
            "5:15: 'header' of sensor_msgs.msg.LaserScan is a std_msgs.msg.Header, not the class "
            "'Header': it cannot be published; write Header()",
        ),
        Example(
            "Enum and IntEnum members in an integer field",
            {
                "state.py": "from enum import Enum, IntEnum\n\nfrom std_msgs.msg import UInt8\n\n\n"
                "class State(Enum):\n    IDLE = 0\n\n\n"
                "class Gear(IntEnum):\n    FIRST = 1\n\n\n"
                "state, gear = UInt8(), UInt8()\n"
                "state.data = State.IDLE\n"
                "gear.data = Gear.FIRST\n"
            },
            "15:14: 'data' of std_msgs.msg.UInt8 is an int, not a state.State: it cannot be "
            "published",
        ),
    )

    def judge(self, finding: TypeFinding) -> Diagnostic | None:
        matched = finding.match(
            rf"Invalid assignment to data descriptor attribute `(?P<field>\w+)` on type "
            rf"`(?P<owner>{MARKED})`.*: Expected `(?P<expected>.+)`, found `(?P<given>.+)`"
        )
        if matched is None:
            return None
        expected, given = matched["expected"], matched["given"]
        elements = elements_misfit(expected, given)
        if elements:
            message = f"elements of {matched['field']!r} must be {elements}: it cannot be published"
            return self.report(finding, message)
        if not is_certain_misfit(expected, given):
            return None
        class_ = class_itself(given)
        hint = f"; write {short_name(class_)}()" if class_ else ""
        is_alike = _are_alike(finding, full_name(class_in(expected)), full_name(class_in(given)))
        is_converted = full_name(class_in(given)) in _CONVERTED and finding.module.mentions("tf2")
        outcome = "" if is_alike else f": {when_sent(expected)}{hint}"
        return self.report(
            finding,
            f"{matched['field']!r} of {full_name(matched['owner'])} is "
            f"{unlike(expected, given)}{outcome}",
            severity=Severity.WARNING if is_alike or is_converted else None,
        )


def _are_alike(finding: TypeFinding, *dotted: str) -> bool:
    """Return whether two messages have the same fields, so that one can be sent as the other."""
    definitions = finding.package.workspace.interfaces
    messages = [definitions.find(name.replace(".", "/")) for name in dotted]
    fields = [
        [(field.name, str(field.type)) for field in message.sections[0].fields]
        for message in messages
        if message is not None
    ]
    return len(fields) == len(dotted) and fields[0] == fields[1]
