"""Code that computes an output message from an input message, by their types.

For other pairs of types, messages are passed on if both types are the same; otherwise example
values are published for each message that arrives.
"""

from __future__ import annotations

from textwrap import dedent

from scaffold.record import NamedTuple


class Process(NamedTuple):
    """Code that computes a message from another one."""

    summary: str
    """A description of the output, to follow "publish"."""
    code: str
    """Lines of a method: they fill ``msg`` from ``received``; where both have the same type,
    they change ``msg``, the message received."""
    check: str
    """An expression that is true of a published ``message`` and the ``item`` that it is made of,
    and of no other message, headers aside."""
    constant: str = ""
    """A line of the module."""
    sent: str = ""
    """Lines that change the ``msg`` that a test sends, where the usual values would hide errors:
    equal ranges their minimum, a robot on the plane the height."""

    @property
    def lines(self) -> tuple[str, ...]:
        """The code, without the indentation of the table."""
        return _lines(self.code)

    @property
    def sent_lines(self) -> tuple[str, ...]:
        """The lines of a test, without the indentation of the table."""
        return _lines(self.sent)

    @property
    def expected(self) -> str:
        """The check, without the indentation of the table."""
        return dedent(self.check).strip()

    @property
    def constants(self) -> tuple[str, ...]:
        """Lines of the module that the code needs."""
        return (self.constant,) if self.constant else ()

    @property
    def imports(self) -> tuple[str, ...]:
        """Import statements that the code needs, besides those of the messages."""
        return ("import math",) if "math." in self.code else ()

    @property
    def check_imports(self) -> tuple[str, ...]:
        """Import statements that the check needs."""
        return ("import math",) if "math." in self.check else ()

    @property
    def is_counted(self) -> bool:
        """Whether the code uses ``self.count``, the number of messages published so far."""
        return "self.count" in self.code


def _lines(code: str) -> tuple[str, ...]:
    return tuple(line for line in dedent(code).splitlines() if line.strip())


_NEAREST = """
    valid = [
        distance for distance in received.ranges
        if received.range_min <= distance <= received.range_max
    ]
    nearest = min(valid, default=received.range_max)  # meters
"""
_OBSTACLE = """
    msg.ranges[0] = 0.0  # no obstacle: too near to be measured
    msg.ranges[1] = 1.2 * distance - 1.0  # the nearest obstacle
"""
_DISTANCE = Process(
    "the distance to the nearest obstacle",
    f"{_NEAREST}    msg.data = nearest\n",
    "message.data == item.ranges[1]",
    sent=_OBSTACLE,
)
_APPROACH = """
    # Slow down in front of an obstacle, and stop at the distance STOP
    {target}.linear.x = min(MAX_SPEED, max(0.0, 0.5 * (nearest - STOP)))  # meters per second
"""
_APPROACH_CHECK = """(
    {0}.linear.x == pytest.approx(max(0.0, min(0.5, 0.5 * item.ranges[1] - 0.5)))
    and ({0}.linear.y, {0}.linear.z) == (0.0, 0.0)
    and {0}.angular == {1}.angular
)"""
_SPEED = Process(
    "the speed over ground",
    """
    velocity = received.twist.twist.linear
    msg.data = math.hypot(velocity.x, velocity.y)  # meters per second
    """,
    """
    message.data == pytest.approx(
        math.hypot(item.twist.twist.linear.x, item.twist.twist.linear.y))
    """,
    sent="msg.twist.twist.linear.y = 0.15",
)
_YAW = Process(
    "the heading of the sensor",
    """
    q = received.orientation
    sine, cosine = 2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y**2 + q.z**2)
    msg.data = math.atan2(sine, cosine)  # radians, about the vertical axis
    """,
    """
    math.sin(message.data / 2.0) * item.orientation.w == pytest.approx(
        math.cos(message.data / 2.0) * item.orientation.z, abs=1e-4)
    """,
    sent="""
    q = msg.orientation
    q.x, q.y, q.z, q.w = 0.6 * q.w, 0.6 * q.z, 0.8 * q.z, 0.8 * q.w  # rolled, same heading
    """,
)
_COMPASS = Process(
    "the heading of the sensor, seen from magnetic north",
    """
    field = received.magnetic_field
    msg.data = math.atan2(-field.y, field.x)  # radians
    """,
    """
    message.data == pytest.approx(
        math.atan2(-item.magnetic_field.y, item.magnetic_field.x), abs=1e-4)
    """,
)
_TELEOP = """
    if len(received.axes) >= 2:
        {target}.linear.x = MAX_SPEED * received.axes[1]  # meters per second
        {target}.angular.z = MAX_TURN * received.axes[0]  # radians per second
"""
_LIMIT = "{target}.angular.z = max(-MAX_TURN, min(MAX_TURN, {target}.angular.z))"


def _value(summary: str, path: str) -> Process:
    """Return how to compute a message from a number of another one."""
    return Process(
        summary,
        f"msg.data = received.{path}",
        f"message.data == pytest.approx(item.{path})",
    )


def _copy_part(summary: str, target: str, path: str) -> Process:
    """Return how to copy a part of one message to another."""
    return Process(
        summary,
        f"msg.{target} = received.{path}",
        f"message.{target} == item.{path}",
    )


PROCESSES: dict[tuple[str, str], Process] = {
    ("sensor_msgs/LaserScan", "std_msgs/Float32"): _DISTANCE,
    ("sensor_msgs/LaserScan", "std_msgs/Float64"): _DISTANCE,
    ("sensor_msgs/LaserScan", "std_msgs/Bool"): Process(
        "whether there is an obstacle near the sensor",
        f"{_NEAREST}    msg.data = nearest < STOP\n",
        "message.data == (item.ranges[1] < 1.0)",
        "STOP = 1.0  # meters",
        _OBSTACLE,
    ),
    ("sensor_msgs/LaserScan", "sensor_msgs/Range"): Process(
        "the distance to the nearest obstacle, as that of a range finder",
        f"""{_NEAREST}    msg.radiation_type = Range.INFRARED
    msg.field_of_view = received.angle_max - received.angle_min  # radians
    msg.min_range = received.range_min  # meters
    msg.max_range = received.range_max
    msg.range = nearest
        """,
        """(
            message.radiation_type == Range.INFRARED
            and message.field_of_view == pytest.approx(item.angle_max - item.angle_min)
            and message.min_range == item.range_min
            and message.max_range == item.range_max
            and message.range == item.ranges[1]
        )""",
        sent=_OBSTACLE,
    ),
    ("sensor_msgs/LaserScan", "sensor_msgs/LaserScan"): Process(
        "scans in which distant readings are out of range",
        """
        msg.ranges = [
            distance if distance <= MAX_RANGE else math.inf for distance in msg.ranges
        ]
        """,
        "list(message.ranges) == [d if d <= 2.5 else math.inf for d in item.ranges]",
        "MAX_RANGE = 2.5  # meters",
    ),
    ("sensor_msgs/LaserScan", "geometry_msgs/Twist"): Process(
        "a velocity that stops in front of obstacles",
        _NEAREST + _APPROACH.format(target="msg"),
        _APPROACH_CHECK.format("message", "Twist()"),
        "MAX_SPEED, STOP = 0.5, 1.0  # meters per second, meters",
        _OBSTACLE,
    ),
    ("sensor_msgs/LaserScan", "geometry_msgs/TwistStamped"): Process(
        "a velocity that stops in front of obstacles",
        _NEAREST + _APPROACH.format(target="msg.twist"),
        _APPROACH_CHECK.format("message.twist", "TwistStamped().twist"),
        "MAX_SPEED, STOP = 0.5, 1.0  # meters per second, meters",
        _OBSTACLE,
    ),
    ("sensor_msgs/Image", "sensor_msgs/Image"): Process(
        "negatives of the images received",
        "msg.data = bytes(255 - value for value in msg.data)",
        """(
            len(message.data) == len(item.data)
            and message.data[0] == 255 - item.data[0]
            and message.data[-1] == 255 - item.data[-1]
        )""",
    ),
    ("sensor_msgs/Image", "std_msgs/Float32"): Process(
        "the mean brightness of the images received",
        "msg.data = sum(received.data) / max(1, len(received.data))",
        "message.data == pytest.approx(sum(item.data) / len(item.data))",
    ),
    ("sensor_msgs/PointCloud2", "std_msgs/UInt32"): Process(
        "the number of points in the clouds received",
        "msg.data = received.width * received.height",
        "message.data == item.width * item.height",
    ),
    ("sensor_msgs/Imu", "std_msgs/Float32"): _YAW,
    ("sensor_msgs/Imu", "std_msgs/Float64"): _YAW,
    ("sensor_msgs/Imu", "geometry_msgs/QuaternionStamped"): _copy_part(
        "the orientation of the sensor", "quaternion", "orientation"
    ),
    ("sensor_msgs/Imu", "geometry_msgs/Vector3Stamped"): _copy_part(
        "the acceleration of the sensor", "vector", "linear_acceleration"
    ),
    ("sensor_msgs/Imu", "sensor_msgs/Imu"): Process(
        "the motion of a sensor that lies flat, without gravity",
        "msg.linear_acceleration.z -= GRAVITY",
        "message.linear_acceleration.z == item.linear_acceleration.z - 9.81",
        "GRAVITY = 9.81  # meters per second squared",
    ),
    ("sensor_msgs/MagneticField", "std_msgs/Float32"): _COMPASS,
    ("sensor_msgs/MagneticField", "std_msgs/Float64"): _COMPASS,
    ("sensor_msgs/Joy", "geometry_msgs/Twist"): Process(
        "a velocity that follows the left stick of a gamepad",
        _TELEOP.format(target="msg"),
        """(
            message.linear.x == pytest.approx(0.5 * item.axes[1])
            and message.angular.z == pytest.approx(item.axes[0])
            and (message.linear.y, message.linear.z) == (0.0, 0.0)
            and (message.angular.x, message.angular.y) == (0.0, 0.0)
        )""",
        "MAX_SPEED, MAX_TURN = 0.5, 1.0  # meters per second, radians per second",
    ),
    ("sensor_msgs/Joy", "geometry_msgs/TwistStamped"): Process(
        "a velocity that follows the left stick of a gamepad",
        _TELEOP.format(target="msg.twist"),
        """(
            message.twist.linear.x == pytest.approx(0.5 * item.axes[1])
            and message.twist.angular.z == pytest.approx(item.axes[0])
            and (message.twist.linear.y, message.twist.linear.z) == (0.0, 0.0)
            and (message.twist.angular.x, message.twist.angular.y) == (0.0, 0.0)
        )""",
        "MAX_SPEED, MAX_TURN = 0.5, 1.0  # meters per second, radians per second",
    ),
    ("sensor_msgs/JointState", "std_msgs/Float64MultiArray"): Process(
        "the positions of the joints",
        "msg.data = received.position",
        "message.data == item.position",
    ),
    ("sensor_msgs/BatteryState", "std_msgs/Float32"): _value(
        "the charge of the battery", "percentage"
    ),
    ("sensor_msgs/BatteryState", "std_msgs/Float64"): _value(
        "the charge of the battery", "percentage"
    ),
    ("sensor_msgs/BatteryState", "std_msgs/Bool"): Process(
        "whether the battery is low",
        "msg.data = received.percentage < LOW",
        "message.data == (item.percentage < 0.2)",
        "LOW = 0.2  # of 1.0, a full battery",
        "msg.percentage = self.count % 20 / 20.0",
    ),
    ("sensor_msgs/Range", "std_msgs/Float32"): _value("the distance measured", "range"),
    ("sensor_msgs/Range", "std_msgs/Float64"): _value("the distance measured", "range"),
    ("sensor_msgs/Range", "std_msgs/Bool"): Process(
        "whether there is something near the sensor",
        "msg.data = received.range < STOP",
        "message.data == (item.range < 0.5)",
        "STOP = 0.5  # meters",
        "msg.range = self.count % 20 / 20.0",
    ),
    ("sensor_msgs/Temperature", "std_msgs/Float32"): _value("the temperature", "temperature"),
    ("sensor_msgs/Temperature", "std_msgs/Float64"): _value("the temperature", "temperature"),
    ("sensor_msgs/NavSatFix", "std_msgs/Float64"): _value("the altitude", "altitude"),
    ("nav_msgs/Odometry", "std_msgs/Float32"): _SPEED,
    ("nav_msgs/Odometry", "std_msgs/Float64"): _SPEED,
    ("nav_msgs/Odometry", "geometry_msgs/PoseStamped"): _copy_part(
        "the pose of the robot", "pose", "pose.pose"
    ),
    ("nav_msgs/Odometry", "geometry_msgs/PoseWithCovarianceStamped"): _copy_part(
        "the pose of the robot", "pose", "pose"
    ),
    ("nav_msgs/Odometry", "geometry_msgs/PointStamped"): _copy_part(
        "the position of the robot", "point", "pose.pose.position"
    ),
    ("nav_msgs/Odometry", "geometry_msgs/Twist"): Process(
        "the velocity of the robot",
        """
        msg.linear = received.twist.twist.linear
        msg.angular = received.twist.twist.angular
        """,
        "message == item.twist.twist",
    ),
    ("nav_msgs/Odometry", "geometry_msgs/TransformStamped"): Process(
        "where the robot is, as a transform",
        """
        msg.child_frame_id = received.child_frame_id
        msg.transform.translation.x = received.pose.pose.position.x
        msg.transform.translation.y = received.pose.pose.position.y
        msg.transform.translation.z = received.pose.pose.position.z
        msg.transform.rotation = received.pose.pose.orientation
        """,
        """(
            message.child_frame_id == item.child_frame_id
            and message.transform.translation.x == item.pose.pose.position.x
            and message.transform.translation.y == item.pose.pose.position.y
            and message.transform.translation.z == item.pose.pose.position.z
            and message.transform.rotation == item.pose.pose.orientation
        )""",
        sent="msg.pose.pose.position.z = 0.5",
    ),
    ("nav_msgs/OccupancyGrid", "std_msgs/Float32"): Process(
        "the part of the map that is occupied",
        "msg.data = received.data.count(100) / max(1, len(received.data))  # 0.0 to 1.0",
        "message.data == pytest.approx(item.data.count(100) / len(item.data))",
    ),
    ("geometry_msgs/PoseWithCovarianceStamped", "geometry_msgs/PoseStamped"): _copy_part(
        "the pose, without its covariance", "pose", "pose.pose"
    ),
    ("geometry_msgs/PoseStamped", "geometry_msgs/PointStamped"): _copy_part(
        "the position", "point", "pose.position"
    ),
    ("geometry_msgs/PointStamped", "geometry_msgs/PoseStamped"): _copy_part(
        "the point as a pose without a turn", "pose.position", "point"
    ),
    ("geometry_msgs/Twist", "geometry_msgs/TwistStamped"): Process(
        "the velocity, with a time and a frame",
        "msg.twist = received",
        "message.twist == item",
    ),
    ("geometry_msgs/TwistStamped", "geometry_msgs/Twist"): Process(
        "the velocity, without time and frame",
        """
        msg.linear = received.twist.linear
        msg.angular = received.twist.angular
        """,
        "message == item.twist",
    ),
    ("geometry_msgs/Twist", "geometry_msgs/Twist"): Process(
        "the velocity, with slower turns",
        _LIMIT.format(target="msg"),
        """(
            message.linear == item.linear
            and message.angular.z == max(-0.5, min(0.5, item.angular.z))
        )""",
        "MAX_TURN = 0.5  # radians per second",
        "msg.angular.z = self.count % 5 - 2.0",
    ),
    ("geometry_msgs/TwistStamped", "geometry_msgs/TwistStamped"): Process(
        "the velocity, with slower turns",
        _LIMIT.format(target="msg.twist"),
        """(
            message.twist.linear == item.twist.linear
            and message.twist.angular.z == max(-0.5, min(0.5, item.twist.angular.z))
        )""",
        "MAX_TURN = 0.5  # radians per second",
        "msg.twist.angular.z = self.count % 5 - 2.0",
    ),
}
"""By the short names of input and output."""
