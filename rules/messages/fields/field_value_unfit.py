"""MS006: values fit the types of the fields they are assigned to."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, MessageRule, Report, Severity
from scaffold.api.distributions import target
from scaffold.api.interfaces import FLOATS
from scaffold.api.messages import Assigned, MessageTypes, TypeMismatches, rclpy_time
from scaffold.api.python import PythonModule

from ._only_read import is_only_read

_TEST = (
    "from geometry_msgs.msg import Wrench\n\nfrom arm import talker, total\n\n\n"
    "def test_force():\n    wrench = Wrench()\n    wrench.force.x = 3\n    {}\n"
)
_DRIVE = (
    "import rclpy\nfrom geometry_msgs.msg import Twist\nfrom rclpy.node import Node\n\n\n"
    "class Drive(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('drive')\n"
    "        self.last = Twist()\n"
    "        self.publisher = self.create_publisher(Twist, 'cmd_vel', 10)\n"
    "        self.create_timer(0.1, self.tick)\n\n"
    "    def step(self):\n"
    "        step = Twist()\n"
    "        step.linear.x = 2\n"
    "        return step\n\n"
    "    def tick(self):\n"
    "        twist = Twist()\n"
    "        step = self.step()\n"
    "        {}\n"
    "        self.publisher.publish(twist)\n\n\n"
    "def main():\n    rclpy.init()\n    rclpy.spin(Drive())\n"
)
_CODE = (
    "from rclpy.node import Node\n"
    "from sensor_msgs.msg import Imu, Temperature\nfrom std_msgs.msg import Bool, String, UInt8\n"
    "\n\nclass Talker(Node):\n"
    "    def __init__(self):\n"
    "        self.count = 0\n"
    "        self.create_timer(0.5, self.talk)\n\n"
    "    def talk(self):\n"
    "        reading = Temperature()\n"
    "        reading.temperature = {}\n"
    "        imu = Imu()\n"
    "        imu.orientation_covariance = {}\n"
    "        level = UInt8()\n"
    "        level.data = {}\n"
    "        self.count += 1\n"
    "        return Bool(data={}), String(data={})\n"
)
_SCAN = (
    "import numpy as np\nfrom rclpy.node import Node\nfrom sensor_msgs.msg import LaserScan\n"
    "from std_msgs.msg import Float64\n\n\n"
    "class Watch(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('watch')\n"
    "        self.publisher = self.create_publisher(Float64, 'nearest', 10)\n"
    "        self.create_subscription(LaserScan, 'scan', self.on_scan, 10)\n\n"
    "    def on_scan(self, scan):\n"
    "        near = np.array(scan.ranges)[10:20]\n"
    "        self.publisher.publish(Float64(data={}))\n"
    "        self.publisher.publish(Float64(data={}))\n"
    "        message = Float64()\n"
    "        message.data = {}\n"
    "        return message, near\n"
)
_RIGHT = ("20.0 + self.count", "[0.1] * 9", "min(self.count, 255)", "True", "f'{self.count}'")
_FOR_INTS = {"bool": "bool", "float32": "float", "float64": "float"}
_OF_BUFFERS = frozenset({"set_transform", "set_transform_static", "transform"})
_CODE_TIMES = (
    "from rclpy.node import Node\nfrom sensor_msgs.msg import Temperature\n\n\n"
    "class Talker(Node):\n"
    "    def talk(self, other):\n"
    "        reading = Temperature()\n"
    "        reading.header.stamp = self.get_clock().now(){}\n"
    "        other.header.stamp = self.get_clock().now(){}\n"
)


class FieldValueUnfit(MessageRule):
    """A message field is set to a value that its type cannot hold.

    **Why.** ROS 2 Jazzy does not check Python messages: the node runs, and subscribers get
    ``False`` for ``1``, ``5e-324`` for the int ``1`` in a float field, ``44`` for 300 in a uint8.
    Other values raise an error that does not name the field.

    **Fix.** Convert the value, or limit it to the range: ``float(x)``, ``bool(x)``,
    ``min(x, 255)``. With ``ROS_PYTHON_CHECK_FIELDS=1`` such values raise an error at run time.

    **Source.** https://github.com/ros2/rosidl_python/pull/194; ``rosidl_generator_py``,
    ``resource/_msg_support.c.em``.
    """

    code = "MS006"
    name = "field-value-unfit"
    other_severities = {
        Severity.WARNING: "the value is another message with the same fields or the int 0 in a "
        "float field, which are sent correctly, or an int in a float field of a message that is "
        "not sent, or the line is in a branch that never runs",
    }
    examples = (
        Example("values of the correct types", {"talker.py": _CODE.format(*_RIGHT)}),
        Example(
            "array from a parameter whose default is too short",
            {
                "talker.py": _CODE.replace(
                    "        self.count = 0\n",
                    "        self.count = 0\n        self.declare_parameter('scale', [0.0])\n",
                ).format(_RIGHT[0], "self.get_parameter('scale').value", *_RIGHT[2:])
            },
        ),
        Example(
            "covariance from methods that return 36 and 9 elements",
            {
                "pose.py": "from geometry_msgs.msg import PoseWithCovariance\n\n\n"
                "class Poses:\n"
                "    def pose(self):\n"
                "        pose = PoseWithCovariance()\n"
                "        pose.covariance = self.large(0.1)\n"
                "        pose.covariance = self.small(0.1)\n"
                "        return pose\n\n"
                "    def large(self, value):\n"
                "        return [value, *[0.0] * 35]\n\n"
                "    def small(self, value):\n"
                "        return [value, 0.0, 0.0, 0.0, value, 0.0, 0.0, 0.0, value]\n"
            },
        ),
        Example(
            "8-bit counter of button presses",
            {
                "talker.py": _CODE.replace("create_timer(0.5, self.talk)", "on_press(self.talk)")
                .format(*_RIGHT)
                .replace("min(self.count, 255)", "self.count")
            },
        ),
        Example(
            "NumPy results that are floats or converted to float",
            {
                "watch.py": _SCAN.format(
                    "float(np.min(scan.ranges))",
                    "np.mean(np.array(scan.ranges, dtype=np.float64))",
                    "min(scan.ranges)",
                )
            },
        ),
        Example(
            "numpy.float32 results from the ranges of a scan",
            {
                "watch.py": _SCAN.format(
                    "np.min(scan.ranges)", "np.array(scan.ranges).mean()", "np.max(near)"
                )
            },
            "15:45: 'data' of std_msgs/msg/Float64 is float64, but np.min(scan.ranges) is a "
            "numpy.float32, not a float; write float(...)",
            "16:45: 'data' of std_msgs/msg/Float64 is float64, but np.array(scan.ranges).mean() "
            "is a numpy.float32, not a float; write float(...)",
            "18:24: 'data' of std_msgs/msg/Float64 is float64, but np.max(near) is a "
            "numpy.float32, not a float; write float(...)",
        ),
        Example(
            "wrong types, 8 of 9 elements, an 8-bit counter that overflows",
            {"talker.py": _CODE.format("'20'", "[0.1] * 8", "250 + self.count", "1", "self.count")},
            "13:31: 'temperature' of sensor_msgs/msg/Temperature is float64, but '20' is a str",
            "15:38: 'orientation_covariance' of sensor_msgs/msg/Imu is float64[9], but [0.1] * 8 "
            "has 8 elements, not 9",
            "17:22: 'data' of std_msgs/msg/UInt8 is uint8, but self.count grows without bound in "
            "line 18: uint8 holds 0 to 255",
            "19:26: 'data' of std_msgs/msg/Bool is bool, but 1 is an int: subscribers get False; "
            "write bool(...)",
            "19:42: 'data' of std_msgs/msg/String is string, but self.count is an int",
        ),
        Example(
            "int field in a float field, bytes in a string, invalid stamps, Parameter as a value",
            {
                "talker.py": "from rclpy.node import Node\n"
                "from std_msgs.msg import Float64, Header, Int32, String\n\n\n"
                "class Talker(Node):\n"
                "    def talk(self):\n"
                "        count = Int32()\n"
                "        raw = Float64(data=count.data)\n"
                "        scaled = Float64(data=float(count.data))\n"
                "        text = String(data='a'.upper().encode())\n"
                "        header = Header()\n"
                "        header.stamp.sec = self.get_clock().now().nanoseconds\n"
                "        header.stamp = self.get_clock().now().nanoseconds\n"
                "        header.stamp = self.get_clock().now().to_msg\n"
                "        text.data = self.get_parameter('text')\n"
                "        return raw, scaled, text\n"
            },
            "8:28: 'data' of std_msgs/msg/Float64 is float64, but count.data is an int: "
            "subscribers get another number; write float(...)",
            "10:28: 'data' of std_msgs/msg/String is string, but 'a'.upper().encode() is bytes",
            "12:28: 'sec' of builtin_interfaces/msg/Time is int32, but "
            "self.get_clock().now().nano... is about 2e+18: int32 holds -2147483648 to 2147483647",
            "13:24: 'stamp' of std_msgs/msg/Header is builtin_interfaces/Time, but "
            "self.get_clock().now().nano... is an int",
            "14:24: 'stamp' of std_msgs/msg/Header is builtin_interfaces/Time, but 'to_msg' is a "
            "method that is not called; write to_msg()",
            "15:21: 'data' of std_msgs/msg/String is string, but self.get_parameter('text') is a "
            "Parameter; append .value",
        ),
        Example(
            "numpy.float32 and numpy.bool_ instead of float and bool",
            {
                "talker.py": "import numpy as np\n"
                "from std_msgs.msg import Bool, Float32, Float64\n\n"
                "Float32(data=np.float32(0.5))\n"
                "Float64(data=np.float64(0.5))\n"
                "Float64(data=float(np.float32(0.5)))\n"
                "Bool(data=np.any([0, 1]))\n"
                "Bool(data=bool(np.any([0, 1])))\n"
            },
            "4:14: 'data' of std_msgs/msg/Float32 is float32, but np.float32(0.5) is a "
            "numpy.float32, not a float; write float(...)",
            "7:11: 'data' of std_msgs/msg/Bool is bool, but np.any([0, 1]) is a numpy.bool_, not "
            "a bool; write bool(...)",
        ),
        Example(
            "tuple returned by cv2.imencode() instead of the encoded image",
            {
                "talker.py": "import cv2\nfrom sensor_msgs.msg import CompressedImage\n\n\n"
                "def compressed(frame):\n"
                "    image = CompressedImage()\n"
                "    image.data = cv2.imencode('.jpg', frame)[1].tobytes()\n"
                "    image.data = cv2.imencode('.jpg', frame)\n"
                "    return image\n"
            },
            "8:18: 'data' of sensor_msgs/msg/CompressedImage is uint8[], but cv2.imencode('.jpg', "
            "frame) is a tuple of several results, not a list",
        ),
        Example(
            "single message in an array field",
            {
                "talker.py": "from geometry_msgs.msg import PoseStamped\n"
                "from nav_msgs.msg import Path\n\n"
                "pose = PoseStamped()\npath = Path()\n"
                "path.poses = [pose]\npath.poses = pose\n"
            },
            "7:14: 'poses' of nav_msgs/msg/Path is geometry_msgs/PoseStamped[], but pose is one "
            "geometry_msgs/msg/PoseStamped, not a list",
        ),
        Example(
            "missing comma in a list of names",
            {
                "talker.py": "from sensor_msgs.msg import JointState\n\n"
                "JOINTS = ['left_wheel' 'right_wheel', 'arm']\n\n"
                "joints = JointState(name=JOINTS)\n"
                "joints.name = ['left_wheel', 'right_wheel']\n"
                "joints.name = ['the joint with a name '\n               'of several words']\n"
                "joints.name = ['robot/' 'arm', 'robot_'\n               'arm']\n"
            },
            "5:26: 'name' of sensor_msgs/msg/JointState is string[], but 'left_wheel' and "
            "'right_wheel' are one text: missing comma",
        ),
        Example(
            "two-dimensional NumPy arrays in an array field",
            {
                "talker.py": "import numpy as np\nfrom sensor_msgs.msg import Imu\n\n"
                "imu = Imu()\n"
                "imu.orientation_covariance = np.eye(3).flatten()\n"
                "imu.orientation_covariance = np.eye(3)\n"
                "imu.orientation_covariance = np.array([[0.1, 0.0, 0.0]] * 3)\n"
                "imu.orientation_covariance = np.zeros((3, 3))\n"
                "imu.orientation_covariance = np.zeros(9)\n"
            },
            "6:30: 'orientation_covariance' of sensor_msgs/msg/Imu is float64[9], but np.eye(3) "
            "is two-dimensional; append .flatten()",
            "7:30: 'orientation_covariance' of sensor_msgs/msg/Imu is float64[9], but "
            "np.array([[0.1, 0.0, 0.0]] ... is two-dimensional; append .flatten()",
            "8:30: 'orientation_covariance' of sensor_msgs/msg/Imu is float64[9], but "
            "np.zeros((3, 3)) is two-dimensional; append .flatten()",
        ),
        Example(
            "int in a float field, in a test that sends nothing and in one that publishes",
            {
                "test/test_force.py": _TEST.format("assert total(wrench) == 3.0"),
                "test/test_talker.py": _TEST.format("talker.publisher.publish(wrench)"),
            },
            Report(
                "test/test_force.py:8:22",
                "'x' of geometry_msgs/msg/Vector3 is float64, but 3 is an int",
                severity=Severity.WARNING,
            ),
            "test/test_talker.py:8:22: 'x' of geometry_msgs/msg/Vector3 is float64, but 3 is an "
            "int: subscribers get another number; write float(...)",
        ),
        Example(
            "int in a float field of a message that is only read, and of one that is published",
            {
                "drive.py": _DRIVE.format("twist.linear.x = step.linear.x + self.last.linear.x"),
                "send.py": _DRIVE.format("twist = step"),
            },
            Report(
                "drive.py:15:25",
                "'x' of geometry_msgs/msg/Vector3 is float64, but 2 is an int",
                severity=Severity.WARNING,
            ),
            "send.py:15:25: 'x' of geometry_msgs/msg/Vector3 is float64, but 2 is an int: "
            "subscribers get another number; write float(...)",
        ),
        Example(
            "int 0 in a float field, None in a branch that never runs",
            {
                "planner.py": "from geometry_msgs.msg import Twist\n"
                "from nav_msgs.srv import GetPlan\nfrom rclpy.node import Node\n\n\n"
                "class Planner(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('planner')\n"
                "        self.create_service(GetPlan, 'plan', self.plan)\n\n"
                "    def plan(self, request, response):\n"
                "        stop = Twist()\n"
                "        stop.linear.x = 0\n"
                "        goal = request.goal\n"
                "        if goal is None:\n"
                "            response.plan = None\n"
                "            return response\n"
                "        response.plan.poses = [goal]\n"
                "        return response\n"
            },
            Report(
                "13:25",
                "'x' of geometry_msgs/msg/Vector3 is float64, but 0 is an int",
                severity=Severity.WARNING,
            ),
            Report(
                "16:29",
                "'plan' of nav_msgs/srv/GetPlan.Response is nav_msgs/Path, but None is None",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "int in a float field, wrong message, float in an array field, value out of range",
            {
                "talker.py": "from geometry_msgs.msg import Pose, Twist, Vector3\n"
                "from std_msgs.msg import Int8, Float32MultiArray\n\n"
                "twist = Twist()\n"
                "twist.linear.x = 1\n"
                "pose = Pose(position=Vector3())\n"
                "numbers = Float32MultiArray(data=0.5)\n"
                "small = Int8(data=-129)\n"
            },
            "5:18: 'x' of geometry_msgs/msg/Vector3 is float64, but 1 is an int: subscribers get "
            "another number; write float(...)",
            Report(
                "6:22",
                "'position' of geometry_msgs/msg/Pose is geometry_msgs/Point, but "
                "Vector3() is a geometry_msgs/msg/Vector3",
                severity=Severity.WARNING,
            ),
            "7:34: 'data' of std_msgs/msg/Float32MultiArray is float32[], but 0.5 is a float, not "
            "a list",
            "8:19: 'data' of std_msgs/msg/Int8 is int8, but -129 is out of range: int8 holds -128 "
            "to 127",
        ),
        Example(
            "clock time converted with to_msg()",
            {"talker.py": _CODE_TIMES.format(".to_msg()", ".to_msg()")},
        ),
        Example(
            "rclpy Time as the stamp of messages passed to tf2 only",
            {
                "talker.py": "from geometry_msgs.msg import TransformStamped\n"
                "from rclpy.time import Time\nfrom tf2_py import BufferCore\n\n\n"
                "def fill():\n"
                "    transform = TransformStamped()\n"
                "    transform.header.stamp = Time(seconds=1)\n"
                "    BufferCore().set_transform(transform, 'test')\n",
                "ask.py": "from geometry_msgs.msg import Vector3Stamped\n"
                "from rclpy.time import Time\n\n\n"
                "def ask(buffer, vector):\n"
                "    stamped = Vector3Stamped()\n"
                "    stamped.header.frame_id = 'tool0'\n"
                "    stamped.header.stamp = Time()\n"
                "    stamped.vector = vector\n"
                "    return buffer.transform(stamped, 'base')\n",
            },
        ),
        Example(
            "rclpy Time as a stamp, also in the header of an unknown message type",
            {"talker.py": _CODE_TIMES.format("", "")},
            Report(
                "8:32",
                "stamp is a builtin_interfaces/msg/Time, but this is an rclpy Time: "
                "AttributeError when published; append .to_msg()",
                fix="Append .to_msg()",
            ),
            Report(
                "9:30",
                "header.stamp is a builtin_interfaces/msg/Time, but this is an rclpy "
                "Time: AttributeError when published; append .to_msg()",
                fix="Append .to_msg()",
            ),
            fixed={"talker.py": _CODE_TIMES.format(".to_msg()", ".to_msg()")},
        ),
        Example(
            "comprehensions with and without a conversion",
            {
                "sizes.py": "from sensor_msgs.msg import JointState\n"
                "from std_msgs.msg import Int32MultiArray\n\n\n"
                "def sizes(names, angles):\n"
                "    whole = Int32MultiArray(data=[len(name) for name in names])\n"
                "    half = Int32MultiArray(data=[len(name) // 2 for name in names])\n"
                "    third = Int32MultiArray(data=[len(name) / 3 for name in names])\n"
                "    state = JointState(name=[name.strip() for name in names])\n"
                "    state.position = [str(angle) for angle in angles]\n"
                "    state.velocity = [int(angle) for angle in angles]\n"
                "    return whole, half, third, state\n",
            },
            "8:34: 'data' of std_msgs/msg/Int32MultiArray is int32[], but element len(name) / 3 "
            "is a float",
            "10:22: 'position' of sensor_msgs/msg/JointState is float64[], but element str(angle) "
            "is a str",
        ),
        Example(
            "result of a method of another file",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/raster.py": "import numpy as np\n\n\n"
                "class Raster:\n"
                "    def __init__(self):\n"
                "        self.cells = np.zeros((3, 4))\n\n"
                "    def percent(self):\n"
                "        return 100 * np.count_nonzero(self.cells) // self.cells.size\n\n"
                "    def share(self):\n"
                "        return np.count_nonzero(self.cells) / self.cells.size\n",
                "rover/paint.py": "from std_msgs.msg import Float32\n\n"
                "from rover.raster import Raster\n\n"
                "raster = Raster()\n"
                "share = Float32(data=raster.share())\n"
                "percent = Float32(data=raster.percent())\n",
            },
            "rover/paint.py:7:24: 'data' of std_msgs/msg/Float32 is float32, but raster.percent() "
            "is an int: subscribers get another number; write float(...)",
        ),
        Example(
            "int that a function of the package assigns to a float field",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/poses.py": "from geometry_msgs.msg import PoseStamped\n\n\n"
                "def to_pose(frame, x, y=0):\n"
                "    pose = PoseStamped()\n"
                "    pose.header.frame_id = frame\n"
                "    pose.pose.position.x = x\n"
                "    pose.pose.position.y = float(y)\n"
                "    return pose\n",
                "rover/drive.py": "from geometry_msgs.msg import Twist\n"
                "from rclpy.node import Node\n\n"
                "from rover.poses import to_pose\n\n\n"
                "class Drive(Node):\n"
                "    def move(self, speed, turn=0.0, kind='drive', slip=1, lift=2):\n"
                "        twist = Twist()\n"
                "        twist.linear.x = speed\n"
                "        twist.linear.y = slip\n"
                "        twist.linear.z = float(lift)\n"
                "        if kind == 'turn':\n"
                "            twist.angular.z = turn\n"
                "        return twist\n\n"
                "    def tick(self):\n"
                "        self.move(0.5, 1)\n"
                "        self.move(speed=0)\n"
                "        self.move(1)\n"
                "        to_pose('map', 0.5, 1)\n"
                "        return to_pose('map', 2, 1)\n",
            },
            "rover/drive.py:8:56: self.move() assigns this to 'y' of geometry_msgs/msg/Vector3, a "
            "float64, but 1 is an int: subscribers get another number; write float(...)",
            "rover/drive.py:20:19: self.move() assigns this to 'x' of geometry_msgs/msg/Vector3, "
            "a float64, but 1 is an int: subscribers get another number; write float(...)",
            "rover/drive.py:22:31: to_pose() assigns this to 'x' of geometry_msgs/msg/Point, a "
            "float64, but 2 is an int: subscribers get another number; write float(...)",
        ),
    )

    def check_file(self, types: MessageTypes) -> Iterator[Diagnostic]:
        yield from self._check_times(types)
        misfits = TypeMismatches(types)
        for item in types.assigned:
            problem = misfits.misfit(item)
            if problem:
                field = f"{item.field.name!r} of {item.owner.name}"
                message = f"{field} is {item.field.type}, but {problem}"
                is_harmless = (
                    misfits.is_alike(item)
                    or misfits.is_harmless_int(item)
                    or misfits.is_unreachable(item)
                    or (problem.endswith(" is an int") and self._is_only_read(types, item))
                )
                severity = Severity.WARNING if is_harmless else Severity.ERROR
                message += "" if is_harmless else _effect(item.field.type.name, problem)
                yield self.report(types.module.location(item.value), message, severity=severity)

        for item in types.passed:
            yield from self._check_passed(types, misfits, item)

    def _is_only_read(self, types: MessageTypes, item: Assigned) -> bool:
        """Return whether a number is not sent, in a distribution that does not check fields."""
        is_number = item.field.type.name in FLOATS
        is_checked = not target().fact("messages.has_check_fields")
        return is_number and not is_checked and is_only_read(types.module, item.value)

    def _check_passed(
        self, types: MessageTypes, misfits: TypeMismatches, item: Assigned
    ) -> Iterator[Diagnostic]:
        """Judge an argument that a function assigns to a field; TY007 judges other types."""
        problem = misfits.misfit(item) if item.field.type.name in FLOATS else None
        if problem and problem.endswith(" is an int") and not misfits.is_harmless_int(item):
            name = types.module.text(item.holder.func) if isinstance(item.holder, ast.Call) else ""
            field = f"{item.field.name!r} of {item.owner.name}, a {item.field.type}"
            message = f"{name}() assigns this to {field}, but {problem}"
            effect = _effect(item.field.type.name, problem)
            yield self.report(types.module.location(item.value), f"{message}{effect}")

    def _check_times(self, types: MessageTypes) -> Iterator[Diagnostic]:
        for value, field in _times(types):
            kind = rclpy_time(types, value)
            if kind is None or _is_for_buffer(types.module, value):
                continue
            _, end = types.module.span(value)
            fix = None
            if isinstance(value, ast.Call | ast.Name | ast.Attribute):
                edit = Edit(types.module.path, end, end, ".to_msg()")
                fix = Fix("Append .to_msg()", (edit,))
            given = kind.rpartition("/")[2]
            message = (
                f"{field} is a {kind}, but this is an rclpy {given}: "
                "AttributeError when published; append .to_msg()"
            )
            yield self.report(types.module.location(value), message, fix)


def _effect(type_: str, problem: str) -> str:
    """Return the effect of an int in a field for other numbers, and the replacement."""
    instead = _FOR_INTS.get(type_, "") if problem.endswith(" is an int") else ""
    if not instead:
        return ""
    is_sent = target().fact("messages.has_check_fields")
    arrives = "another number" if instead == "float" else "False"
    outcome = f"subscribers get {arrives}" if is_sent else "AssertionError"
    return f": {outcome}; write {instead}(...)"


def _times(types: MessageTypes) -> Iterator[tuple[ast.expr, str]]:
    """Yield the values assigned to time fields, and the names of the fields."""
    headers: set[ast.expr] = set()
    for item in types.assigned:
        headers.add(item.value)
        if item.field.type.package == "builtin_interfaces":
            yield item.value, item.field.name
    for store in types.file.evaluator.stores("stamp"):
        holder = store.node.value
        in_header = isinstance(holder, ast.Attribute) and holder.attr == "header"
        if in_header and store.value is not None and store.value not in headers:
            yield store.value, "header.stamp"


def _is_for_buffer(module: PythonModule, value: ast.expr) -> bool:
    """Return whether the message is only passed to a tf2 buffer, whose C code accepts both."""
    match module.parent(value):
        case ast.Assign(targets=[ast.Attribute(value=ast.Attribute(value=ast.Name(id=name)))]):
            scope = module.index.scope_of(value)
            calls = [
                call
                for call in module.below(scope, ast.Call)
                if any(isinstance(item, ast.Name) and item.id == name for item in call.args)
            ]
            return bool(calls) and all(
                isinstance(call.func, ast.Attribute) and call.func.attr in _OF_BUFFERS
                for call in calls
            )
    return False
