"""MS006: values fit the fields they are given to."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, MessageRule, Report
from scaffold.api.messages import MessageTypes, Misfits

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
_RIGHT = ("20.0 + self.count", "[0.1] * 9", "min(self.count, 255)", "True", "f'{self.count}'")


class FieldValueUnfit(MessageRule):
    """A field of a message is given a value that its type cannot hold.

    **Why.** Python messages of ROS 2 Jazzy are not checked: the node runs, and subscribers get
    ``False`` for ``1``, ``5e-324`` for the int ``1`` in a float field, ``44`` for 300 in a uint8.
    Other values end in an error that does not name the field.

    **Fix.** Convert the value, or keep it in its range: ``float(x)``, ``bool(x)``,
    ``min(x, 255)``. With ``ROS_PYTHON_CHECK_FIELDS=1`` rclpy finds such values when it runs.

    **Source.** https://github.com/ros2/rosidl_python/pull/194; ``rosidl_generator_py``,
    ``resource/_msg_support.c.em``.
    """

    code = "MS006"
    name = "field-value-unfit"
    examples = (
        Example("values of their types", {"talker.py": _CODE.format(*_RIGHT)}),
        Example(
            "a counter of what somebody presses",
            {
                "talker.py": _CODE.replace("create_timer(0.5, self.talk)", "on_press(self.talk)")
                .format(*_RIGHT)
                .replace("min(self.count, 255)", "self.count")
            },
        ),
        Example(
            "text for a float, 8 of 9 elements, a counter in 8 bits, an int for a bool, a number",
            {"talker.py": _CODE.format("'20'", "[0.1] * 8", "250 + self.count", "1", "self.count")},
            reports=(
                Report(
                    "talker.py:13:31",
                    "'temperature' of sensor_msgs/msg/Temperature is float64, but '20' is a str",
                ),
                Report(
                    "talker.py:15:38",
                    "'orientation_covariance' of sensor_msgs/msg/Imu is float64[9], but "
                    "[0.1] * 8 has 8 elements, not 9",
                ),
                Report(
                    "talker.py:17:22",
                    "'data' of std_msgs/msg/UInt8 is uint8, but self.count grows "
                    "without end in line 18: uint8 holds 0 to 255",
                ),
                Report("talker.py:19:26", "'data' of std_msgs/msg/Bool is bool, but 1 is an int"),
                Report(
                    "talker.py:19:42",
                    "'data' of std_msgs/msg/String is string, but self.count is an int",
                ),
            ),
        ),
        Example(
            "fields of others, times, texts in bytes, a method, a parameter",
            {
                "talker.py": "from rclpy.node import Node\n"
                "from std_msgs.msg import Float64, Header, Int32, String\n\n\n"
                "class Talker(Node):\n"
                "    def talk(self):\n"
                "        count = Int32()\n"
                "        one = Float64(data=count.data)\n"
                "        two = Float64(data=float(count.data))\n"
                "        text = String(data='a'.upper().encode())\n"
                "        header = Header()\n"
                "        header.stamp.sec = self.get_clock().now().nanoseconds\n"
                "        header.stamp = self.get_clock().now().nanoseconds\n"
                "        header.stamp = self.get_clock().now().to_msg\n"
                "        text.data = self.get_parameter('text')\n"
                "        return one, two, text\n",
            },
            reports=(
                Report(
                    "talker.py:8:28",
                    "'data' of std_msgs/msg/Float64 is float64, but count.data is an int",
                ),
                Report(
                    "talker.py:10:28",
                    "'data' of std_msgs/msg/String is string, but 'a'.upper().encode() is bytes",
                ),
                Report(
                    "talker.py:12:28",
                    "'sec' of builtin_interfaces/msg/Time is int32, but "
                    "self.get_clock().now().nano... is about 2e+18: int32 holds "
                    "-2147483648 to 2147483647",
                ),
                Report(
                    "talker.py:13:24",
                    "'stamp' of std_msgs/msg/Header is builtin_interfaces/Time, but "
                    "self.get_clock().now().nano... is an int",
                ),
                Report(
                    "talker.py:14:24",
                    "'stamp' of std_msgs/msg/Header is builtin_interfaces/Time, but "
                    "to_msg is a method that is not called here: to_msg()",
                ),
                Report(
                    "talker.py:15:21",
                    "'data' of std_msgs/msg/String is string, but "
                    "self.get_parameter('text') is a Parameter: its value is meant",
                ),
            ),
        ),
        Example(
            "a table for a row",
            {
                "talker.py": "import numpy as np\nfrom sensor_msgs.msg import Imu\n\n"
                "imu = Imu()\n"
                "imu.orientation_covariance = np.eye(3).flatten()\n"
                "imu.orientation_covariance = np.eye(3)\n"
                "imu.orientation_covariance = np.array([[0.1, 0.0, 0.0]] * 3)\n"
                "imu.orientation_covariance = np.zeros((3, 3))\n"
                "imu.orientation_covariance = np.zeros(9)\n"
            },
            reports=(
                Report(
                    "talker.py:6:30",
                    "'orientation_covariance' of sensor_msgs/msg/Imu is float64[9], but "
                    "np.eye(3) has rows and columns, which are not read as one row; "
                    "append .flatten()",
                ),
                Report(
                    "talker.py:7:30",
                    "'orientation_covariance' of sensor_msgs/msg/Imu is float64[9], but "
                    "np.array([[0.1, 0.0, 0.0]] ... has rows and columns, which are not "
                    "read as one row; append .flatten()",
                ),
                Report(
                    "talker.py:8:30",
                    "'orientation_covariance' of sensor_msgs/msg/Imu is float64[9], but "
                    "np.zeros((3, 3)) has rows and columns, which are not read as one "
                    "row; append .flatten()",
                ),
            ),
        ),
        Example(
            "an int for a float, another message, a single number for an array, out of range",
            {
                "talker.py": "from geometry_msgs.msg import Pose, Twist, Vector3\n"
                "from std_msgs.msg import Int8, Float32MultiArray\n\n"
                "twist = Twist()\n"
                "twist.linear.x = 1\n"
                "pose = Pose(position=Vector3())\n"
                "numbers = Float32MultiArray(data=0.5)\n"
                "small = Int8(data=-129)\n"
            },
            reports=(
                Report(
                    "talker.py:5:18", "'x' of geometry_msgs/msg/Vector3 is float64, but 1 is an int"
                ),
                Report(
                    "talker.py:6:22",
                    "'position' of geometry_msgs/msg/Pose is geometry_msgs/Point, but "
                    "Vector3() is a geometry_msgs/msg/Vector3",
                ),
                Report(
                    "talker.py:7:34",
                    "'data' of std_msgs/msg/Float32MultiArray is float32[], but 0.5 is "
                    "a float, not a list",
                ),
                Report(
                    "talker.py:8:19",
                    "'data' of std_msgs/msg/Int8 is int8, but -129 is out of range: "
                    "int8 holds -128 to 127",
                ),
            ),
        ),
    )

    def check_file(self, types: MessageTypes) -> Iterator[Diagnostic]:
        misfits = Misfits(types)
        for item in types.assigned:
            said = misfits.misfit(item)
            if said:
                field = f"{item.field.name!r} of {item.owner.name}"
                message = f"{field} is {item.field.type}, but {said}"
                yield self.report(types.module.location(item.value), message)
