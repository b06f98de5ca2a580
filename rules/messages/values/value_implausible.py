"""MS026: values of messages have the unit and range in their definitions."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping

from scaffold.api import Diagnostic, Example, MessageRule, Report, Severity
from scaffold.api.messages import MessageTypes
from scaffold.api.python import returned

from . import _angles, _components, _constants, _fractions, _images, _limits, _matrices

_NODE = (
    "from rclpy.node import Node\nfrom sensor_msgs.msg import BatteryState, Image\n"
    "from geometry_msgs.msg import Quaternion\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.yaw = 0.0\n\n"
    "    def fill(self, width):\n"
    "        battery = BatteryState()\n"
    "        battery.percentage = {}\n"
    "        image = Image()\n"
    "        image.width = width\n"
    "        image.encoding = '{}'\n"
    "        image.step = {}\n"
    "        return battery, image, Quaternion(z={}, w=1.0)\n"
)
_GOOD = ("0.8", "bgr8", "3 * width", "0.0")
_TURN = 6.3
_RANGES: Mapping[tuple[str, str], tuple[float, float, str]] = {
    ("sensor_msgs/msg/BatteryState", "percentage"): (0, 1, "a fraction from 0 to 1"),
    ("sensor_msgs/msg/RelativeHumidity", "relative_humidity"): (0, 1, "a fraction from 0 to 1"),
    ("sensor_msgs/msg/LaserScan", "angle_min"): (-_TURN, _TURN, "in radians"),
    ("sensor_msgs/msg/LaserScan", "angle_max"): (-_TURN, _TURN, "in radians"),
    ("sensor_msgs/msg/LaserScan", "angle_increment"): (-_TURN, _TURN, "in radians"),
    ("sensor_msgs/msg/Range", "field_of_view"): (0, _TURN, "in radians"),
    ("sensor_msgs/msg/NavSatFix", "latitude"): (-90, 90, "in degrees from -90 to 90"),
    ("sensor_msgs/msg/NavSatFix", "longitude"): (-180, 180, "in degrees from -180 to 180"),
    ("vision_msgs/msg/ObjectHypothesis", "score"): (0, 1, "a fraction from 0 to 1"),
    ("builtin_interfaces/msg/Time", "nanosec"): (0, 999_999_999, "less than a second"),
    ("builtin_interfaces/msg/Duration", "nanosec"): (0, 999_999_999, "less than a second"),
    **{("std_msgs/msg/ColorRGBA", name): (0, 1, "a fraction from 0 to 1") for name in "rgba"},
    **{("geometry_msgs/msg/Quaternion", name): (-1, 1, "between -1 and 1") for name in "xyzw"},
}
"""From the comments of the definitions."""
_SHARES = frozenset(key for key, (low, high, _) in _RANGES.items() if (low, high) == (0, 1))
_PERCENT = 100
_OF_ZEROS = "a quaternion of zeros is not a rotation; write w=1.0 for the identity"


class ValueImplausible(MessageRule):
    """A message field gets a value that contradicts its unit or definition.

    **Why.** The message is published without an error, but the battery shows 8000 %, the robot
    spins, or a color is white. cv_bridge rejects unknown encodings: ``Unrecognized image encoding
    [BGR8]``.

    **Fix.** Use the unit that the definition documents: ``ros2 interface show
    sensor_msgs/msg/BatteryState``. The quaternion of a yaw is ``z=sin(yaw / 2)``,
    ``w=cos(yaw / 2)``.

    **Source.** The definitions in common_interfaces; ``sensor_msgs/image_encodings.hpp``; REP 103.
    """

    code = "MS026"
    name = "value-implausible"
    other_severities = {
        Severity.WARNING: "the value is out of range, or an encoding that other programs may "
        "accept, or a quaternion of zeros is in a marker or in a message of a package outside ROS"
    }
    examples = (
        Example(
            "a lower limit above the upper one",
            {
                f"{name}.py": "from sensor_msgs.msg import LaserScan\n\n"
                f"scan = LaserScan()\nscan.range_min = {low}\nscan.range_max = {high}\n"
                for name, low, high in (("right", 0.1, 12.0), ("wrong", 12.0, 0.1))
            },
            "wrong.py:4:18: range_min 12 is greater than range_max 0.1: all readings are invalid",
        ),
        Example(
            "yaw as the first and as the last argument of quaternion_from_euler()",
            {
                "turn.py": "from geometry_msgs.msg import Quaternion\n"
                "from tf_transformations import quaternion_from_euler\n\n\n"
                "def turned(yaw, roll):\n"
                "    quaternion_from_euler(0.0, 0.0, yaw)\n"
                "    quaternion_from_euler(roll, 0.0, 0.0)\n"
                "    x, y, z, w = quaternion_from_euler(yaw, 0.0, 0.0)\n"
                "    return Quaternion(x=x, y=y, z=z, w=w)\n"
            },
            "8:40: the first argument of quaternion_from_euler() is roll; write (0, 0, yaw)",
        ),
        Example(
            "values out of range",
            {
                "fix.py": "from builtin_interfaces.msg import Duration\n"
                "from geometry_msgs.msg import Quaternion\n"
                "from sensor_msgs.msg import NavSatFix\n\n\n"
                "def fix():\n"
                "    where = NavSatFix(latitude=4807.038, longitude=1131.0)\n"
                "    return where, Duration(nanosec=1500000000), Quaternion(z=90.0, w=1.0)\n",
            },
            Report(
                "7:32",
                "latitude is in degrees from -90 to 90, not 4807.038",
                severity=Severity.WARNING,
            ),
            Report(
                "7:52",
                "longitude is in degrees from -180 to 180, not 1131",
                severity=Severity.WARNING,
            ),
            Report(
                "8:36", "nanosec is less than a second, not 1500000000", severity=Severity.WARNING
            ),
            Report("8:62", "z is between -1 and 1, not 90", severity=Severity.WARNING),
        ),
        Example("plausible values", {"talker.py": _NODE.format(*_GOOD)}),
        Example(
            "constants of another field",
            {
                "talker.py": _NODE.format(*_GOOD).replace(
                    "        image =",
                    "        battery.power_supply_status = BatteryState.POWER_SUPPLY_HEALTH_GOOD\n"
                    "        if battery.power_supply_health == "
                    "BatteryState.POWER_SUPPLY_STATUS_FULL:\n            return None\n"
                    "        battery.power_supply_health = BatteryState.POWER_SUPPLY_HEALTH_GOOD\n"
                    "        image =",
                    1,
                )
            },
            "14:39: BatteryState.POWER_SUPPLY_HEALTH_GOOD is a value of power_supply_health, not "
            "of power_supply_status",
            "15:43: BatteryState.POWER_SUPPLY_STATUS_FULL is a value of power_supply_status, not "
            "of power_supply_health",
        ),
        Example(
            "battery percentage multiplied by 100 in a method",
            {
                "talker.py": _NODE.format("self.charge()", *_GOOD[1:])
                + "\n    def charge(self):\n        return 100.0 * self.volts / 12.0\n"
            },
            Report(
                "13:30",
                "percentage is a fraction from 0 to 1, not a percentage; remove the factor 100",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "percentage above 1, encoding in capitals, wrong step, yaw as z of a quaternion",
            {"talker.py": _NODE.format("80.0", "BGR8", "width", "self.yaw")},
            Report(
                "13:30", "percentage is a fraction from 0 to 1, not 80", severity=Severity.WARNING
            ),
            "16:26: unknown encoding 'BGR8': cv_bridge raises an error; write 'bgr8'",
            "17:22: step is in bytes: a row of 'bgr8' has 3 * width",
            "18:45: z of a quaternion is not an angle; write z=sin(self.yaw / 2.0) and "
            "w=cos(self.yaw / 2.0)",
        ),
        Example(
            "percentage multiplied by 100, color component of 255, custom encoding",
            {
                "talker.py": _NODE.format("100.0 * width", "h264", *_GOOD[2:]),
                "b.py": "from std_msgs.msg import ColorRGBA\n\n\n"
                "def white():\n    return ColorRGBA(r=255.0, a=1.0)\n",
            },
            Report("b.py:5:24", "r is a fraction from 0 to 1, not 255", severity=Severity.WARNING),
            Report(
                "talker.py:13:30",
                "percentage is a fraction from 0 to 1, not a percentage; remove the factor 100",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "unknown encodings passed to cv_bridge",
            {
                "b.py": "from cv_bridge import CvBridge\nfrom sensor_msgs.msg import Image\n\n\n"
                "def convert(image: Image):\n"
                "    bridge = CvBridge()\n"
                "    frame = bridge.imgmsg_to_cv2(image, desired_encoding='BGR8')\n"
                "    return bridge.cv2_to_imgmsg(frame, 'bgr')\n",
            },
            "7:58: unknown encoding 'BGR8': CvBridgeError; write 'bgr8'",
            "8:40: unknown encoding 'bgr': CvBridgeError; write 'bgr8'",
        ),
        Example(
            "conversions between yaw and quaternion without the half angle",
            {
                "turn.py": "import math\n\nfrom geometry_msgs.msg import Pose, Quaternion\n\n\n"
                "def turned(yaw):\n"
                "    half_yaw = yaw / 2\n"
                "    yield Quaternion(z=math.sin(half_yaw), w=math.cos(half_yaw))\n"
                "    yield Quaternion(z=math.sin(yaw / 2), w=math.cos(yaw / 2))\n"
                "    yield Quaternion(z=math.sin(yaw), w=math.cos(yaw))\n\n\n"
                "def yaws(pose: Pose):\n"
                "    yaw = 2 * math.atan2(pose.orientation.z, pose.orientation.w)\n"
                "    yaw = math.atan2(pose.orientation.z, pose.orientation.w)\n"
                "    yaw = pose.orientation.z\n"
                "    half = math.atan2(pose.orientation.z, pose.orientation.w)\n"
                "    return yaw, half\n"
            },
            "10:24: a quaternion uses half of the angle; write sin(yaw / 2.0) and cos(yaw / 2.0)",
            "15:11: this is half of the angle; multiply by 2.0",
            "16:11: z of a quaternion is not an angle; write 2.0 * math.atan2(pose.orientation.z, "
            "pose.orientation.w), or euler_from_quaternion()",
        ),
        Example(
            "joint angles sent in the fields of a quaternion",
            {
                "arm.py": "from geometry_msgs.msg import Pose\n\n\n"
                "class Arm:\n"
                "    def move(self, msg: Pose):\n"
                "        self.theta3 = msg.orientation.z\n"
                "        self.theta4 = msg.orientation.w\n"
            },
        ),
        Example(
            "variances written to the first row of a covariance",
            {
                "odom.py": "from nav_msgs.msg import Odometry\n\n\n"
                "def filled():\n"
                "    odometry = Odometry()\n"
                "    for i in range(6):\n"
                "        odometry.pose.covariance[7 * i] = 0.1\n"
                "    for i in range(6):\n"
                "        odometry.twist.covariance[i] = 0.1\n"
                "    covariance = [0.0] * 9\n"
                "    for i in range(3):\n"
                "        covariance[i] = 0.1\n"
                "    for i in range(36):\n"
                "        odometry.twist.covariance[i] = 0.0\n"
                "    return odometry\n"
            },
            "9:9: this fills the first row of the matrix; the variances are on its diagonal: "
            "write [7 * i]",
            "12:9: this fills the first row of the matrix; the variances are on its diagonal: "
            "write [4 * i]",
        ),
        Example(
            "width and height swapped in reshape() and shape",
            {
                "look.py": "import numpy as np\nfrom sensor_msgs.msg import Image\n\n\n"
                "def wrong(image: Image):\n"
                "    data = np.frombuffer(image.data, np.uint8)\n"
                "    return data.reshape(image.width, image.height)\n\n\n"
                "def right(image: Image):\n"
                "    width, height = image.width, image.height\n"
                "    return np.frombuffer(image.data, np.uint8).reshape((height, width))\n\n\n"
                "def sizes(pixels):\n"
                "    height, width = pixels.shape[:2]\n"
                "    w, h, _ = pixels.shape\n"
                "    return height, width, w, h\n\n\n"
                "def turned(image: Image):\n"
                "    data = np.frombuffer(image.data, np.uint8)\n"
                "    return data.reshape((image.width, image.height)).T\n"
            },
            "7:25: an image or a map has rows first: write reshape(image.height, image.width)",
            "17:5: a shape has the height first: write height, width = ....shape[:2]",
        ),
        Example(
            "transposed map, array with the width first, custom message with another layout",
            {
                "explore.py": "import numpy as np\nfrom nav_msgs.msg import OccupancyGrid\n\n\n"
                "class Map:\n"
                "    def __init__(self):\n"
                "        self.map = []\n\n"
                "    def fill(self, grid: OccupancyGrid):\n"
                "        shape = (grid.info.height, grid.info.width)\n"
                "        self.map = np.array(grid.data).reshape(shape).T\n\n"
                "    def size(self, x, y):\n"
                "        part = self.map[x:x + 5, y:y + 5].copy()\n"
                "        w, h = part.shape\n"
                "        return w, h\n\n\n"
                "def own(cells):\n"
                "    return np.array(cells.data).reshape(cells.width, cells.height)\n",
                "wide.py": "import numpy as np\nfrom nav_msgs.msg import MapMetaData\n\n\n"
                "def describe(w):\n    grid = np.zeros((w, 9))\n    info = MapMetaData()\n"
                "    info.width = grid.shape[0]\n    info.height = grid.shape[1]\n",
            },
        ),
        Example(
            "z copied from y, quaternion without w, quaternion of zeros",
            {
                "copy_pose.py": "from geometry_msgs.msg import Pose, PoseStamped, Vector3\n\n\n"
                "def copied(pose: Pose, q):\n"
                "    out = PoseStamped()\n"
                "    out.pose.position.x = pose.position.x\n"
                "    out.pose.position.y = pose.position.y\n"
                "    out.pose.position.z = pose.position.y\n"
                "    turned = out.pose.orientation\n"
                "    turned.x, turned.y, turned.z = q[0], q[1], q[2]\n"
                "    turned.x = q[0]\n"
                "    return out, Vector3(x=q[2], y=-q[0], z=-q[1])\n",
                "grow.py": "import math\n\nfrom geometry_msgs.msg import Pose, Quaternion\n"
                "from visualization_msgs.msg import Marker\n\n\n"
                "def grown(marker: Marker, pose: Pose, size, yaw):\n"
                "    marker.scale.x = size.x\n"
                "    marker.scale.y = size.y\n"
                "    marker.scale.z = size.x\n"
                "    pose.orientation.z = math.sin(yaw / 2)\n"
                "    return Quaternion(x=pose.orientation.x, y=pose.orientation.y,\n"
                "                      z=pose.orientation.z)\n",
                "w.py": "import math\n\nfrom geometry_msgs.msg import Pose, Quaternion\n\n\n"
                "def grown(pose: Pose, yaw):\n"
                "    pose.orientation.z = math.sin(yaw / 2)\n"
                "    q = pose.orientation\n"
                "    q.w = math.cos(yaw / 2)\n"
                "    return Quaternion(z=0.0)\n",
                "zero.py": "from geometry_msgs.msg import PoseStamped, Quaternion\n\n\n"
                "def goal(w):\n"
                "    pose = PoseStamped()\n"
                "    pose.pose.orientation.z = 0.0\n"
                "    pose.pose.orientation.w = 0.0\n"
                "    return pose, Quaternion(x=1.0, w=0.0), Quaternion(w=w)\n",
                "mark.py": "from visualization_msgs.msg import Marker\n\n\n"
                "def mark(marker: Marker):\n    marker.pose.orientation.w = 0.0\n",
                "imu.py": "from sensor_msgs.msg import Imu\n\n\n"
                "def reading():\n"
                "    imu = Imu()\n"
                "    imu.orientation.w = 0.0\n"
                "    imu.orientation_covariance[0] = -1.0\n"
                "    return imu\n",
            },
            "copy_pose.py:8:27: z is copied from pose.position.y, which is for y",
            "grow.py:12:25: w of this quaternion is still 1.0, which is another rotation; set it "
            "as well",
            "zero.py:7:31: a quaternion of zeros is not a rotation; write w=1.0 for the identity",
        ),
        Example(
            "image and camera info with the same stamp and with different stamps",
            {
                f"{name}.py": "from rclpy.node import Node\n"
                "from sensor_msgs.msg import CameraInfo, Image\n\n\n"
                "class Camera(Node):\n"
                "    def fill(self):\n"
                "        image, info = Image(), CameraInfo()\n"
                "        stamp = self.get_clock().now().to_msg()\n"
                f"        image.header.stamp = {stamp}\n"
                f"        info.header.stamp = {stamp}\n"
                "        return image, info\n"
                for name, stamp in {
                    "one": "stamp",
                    "two": "self.get_clock().now().to_msg()",
                }.items()
            },
            "two.py:10:29: camera info needs the stamp of its image: otherwise synchronizers find "
            "no pair; copy it",
        ),
        Example(
            "angular velocity of 90 radians per second",
            {
                "turn.py": "from geometry_msgs.msg import Twist\n\nDEGREES = 90.0\n\n\n"
                "def turns():\n"
                "    slow, fast = Twist(), Twist()\n"
                "    slow.angular.z = 1.57\n    slow.linear.x = 90.0\n"
                "    fast.angular.z = -DEGREES\n    return slow, fast\n"
            },
            "10:22: angular velocities are in radians per second: -DEGREES is implausibly fast; "
            "use math.radians()",
        ),
        Example(
            "nanosec computed with the wrong factor",
            {
                "stamp.py": "from builtin_interfaces.msg import Time\n\n\n"
                "def stamps(now):\n"
                "    whole = int(now)\n"
                "    yield Time(sec=whole, nanosec=int((now - whole) * 1e9))\n"
                "    yield Time(sec=whole, nanosec=int((now - whole) * 1e6))\n"
                "    stamp = Time(sec=whole)\n"
                "    stamp.nanosec = int(now % 1 * 1000)\n"
                "    stamp.nanosec = int(now % 1000 * 1000000)\n"
                "    yield stamp\n"
            },
            "7:55: a second has 1e9 nanoseconds, but this multiplies by 1e6",
            "9:35: a second has 1e9 nanoseconds, but this multiplies by 1000",
        ),
        Example(
            "width and height of a map swapped",
            {
                "map.py": "from nav_msgs.msg import MapMetaData\n\n\n"
                "def describe(grid):\n    info = MapMetaData()\n"
                "    info.width = grid.shape[0]\n    info.height = grid.shape[1]\n"
                "    return info\n\n\n"
                "def turned(grid):\n    info = MapMetaData()\n"
                "    info.width = grid.shape[0]\n    info.height = grid.shape[1]\n"
                "    return info, grid.T\n",
            },
            "6:18: grid.shape[0] is the number of rows, the height; width is grid.shape[1]",
        ),
        Example(
            "percentages from a function of another file, and in sums",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/charge.py": "def charge(volts):\n"
                "    if volts > 12.5:\n"
                "        return 100.0\n"
                "    return 40.0 * (volts - 10.0)\n\n\n"
                "def share(volts):\n"
                "    if volts > 12.5:\n"
                "        return 1.0\n"
                "    return 0.4 * (volts - 10.0)\n",
                "rover/battery.py": "from sensor_msgs.msg import BatteryState, RelativeHumidity\n\n"
                "from rover.charge import charge, share\n\n\n"
                "def read(board):\n"
                "    full = BatteryState(percentage=charge(board.volts))\n"
                "    part = BatteryState(percentage=share(board.volts))\n"
                "    wet = RelativeHumidity(relative_humidity=40.0 + board.offset)\n"
                "    dry = RelativeHumidity(relative_humidity=0.4 + board.offset)\n"
                "    return full, part, wet, dry\n",
            },
            Report(
                "rover/battery.py:7:36",
                "percentage is a fraction from 0 to 1, not a percentage; divide by 100",
                severity=Severity.WARNING,
            ),
            Report(
                "rover/battery.py:9:46",
                "relative_humidity is a fraction from 0 to 1, not a percentage; divide by 100",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "numbers of a condition, and comparisons",
            {
                "show.py": "from rclpy.node import Node\n"
                "from sensor_msgs.msg import BatteryState\n"
                "from std_msgs.msg import ColorRGBA\n\n\n"
                "class Show(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('show')\n"
                "        self.declare_parameter('low', 0.2)\n"
                "        self.create_subscription(BatteryState, 'battery', self.on_state, 10)\n\n"
                "    def on_state(self, msg):\n"
                "        is_low = msg.percentage < self.get_parameter('low').value\n"
                "        is_empty = msg.percentage <= 10.0\n"
                "        is_weak = msg.voltage < 20.0\n"
                "        red = ColorRGBA(r=255.0 if is_low else 0.0, a=1.0)\n"
                "        green = ColorRGBA(g=0.0 if is_low else 1.0, a=1.0)\n"
                "        return red, green, is_empty, is_weak\n",
            },
            Report(
                "14:38",
                "percentage is a fraction from 0 to 1, always less than 10.0",
                severity=Severity.WARNING,
            ),
            Report("16:27", "r is a fraction from 0 to 1, not 255", severity=Severity.WARNING),
        ),
    )

    def check_file(self, types: MessageTypes) -> Iterator[Diagnostic]:
        module = types.module
        if module.in_tests:
            return  # tests, where values may be wrong on purpose
        for part in (_angles, _components, _constants, _fractions, _images, _limits, _matrices):
            for at, message in part.flaws(types):
                yield self.report(module.location(at), message)
        for at, is_used in _components.zero_quaternions(types):
            severity = Severity.ERROR if is_used else Severity.WARNING
            yield self.report(module.location(at), _OF_ZEROS, severity=severity)
        for at, message in _compared(types):
            yield self.report(module.location(at), message, severity=Severity.WARNING)
        for item in (*types.assigned, *types.passed):
            problem = _problem(types, item.owner.name, item.field.name, item.value)
            if problem:
                yield self.report(module.location(item.value), problem, severity=Severity.WARNING)


def _problem(types: MessageTypes, owner: str, name: str, node: ast.expr) -> str:
    """Return why the definition of a field contradicts its value; empty if it does not."""
    key = (owner, name)
    for number in _numbers(types, node) if key in _RANGES else ():
        low, high, meaning = _RANGES[key]
        if not low <= number <= high:
            return f"{name} is {meaning}, not {number:.10g}"
    for source, result in _results(types, node) if key in _SHARES else ():
        if _factors(source, result).count(_PERCENT) == 1 and isinstance(result, ast.BinOp):
            return f"{name} is a fraction from 0 to 1, not a percentage; remove the factor 100"
        if any(map(_is_percentage, _terms(source, result))):
            return f"{name} is a fraction from 0 to 1, not a percentage; divide by 100"
    return ""


def _numbers(types: MessageTypes, node: ast.expr) -> Iterator[float]:
    """Yield the numbers that an expression may be, in either case of a condition."""
    parts = [node.body, node.orelse] if isinstance(node, ast.IfExp) else [node]
    for part in parts:
        value = types.file.evaluator.number(part)
        if isinstance(value, int | float):
            yield value


def _compared(types: MessageTypes) -> Iterator[tuple[ast.expr, str]]:
    """Yield comparisons of a fraction with a number that it never reaches."""
    for node in types.module.walk(ast.Compare):
        for side, other in ((node.left, node.comparators[0]), (node.comparators[0], node.left)):
            is_order = isinstance(node.ops[0], ast.Lt | ast.LtE | ast.Gt | ast.GtE)
            owner = types.type_of(side.value) if isinstance(side, ast.Attribute) else None
            if owner is None or not isinstance(side, ast.Attribute) or not is_order:
                continue
            number = types.file.evaluator.number(other)
            is_far = isinstance(number, int | float) and number > 1
            if is_far and (owner.name, side.attr) in _SHARES and len(node.ops) == 1:
                text = types.module.text(other)
                yield other, f"{side.attr} is a fraction from 0 to 1, always less than {text}"


def _results(types: MessageTypes, node: ast.expr) -> Iterator[tuple[MessageTypes, ast.expr]]:
    """Yield a value, or the results of the function of the package that returns it."""
    node = types.file.evaluator.single_value(node)
    defined = types.file.definition_of(node.func) if isinstance(node, ast.Call) else None
    other = types.of_file(defined[0]) if defined is not None else None
    if defined is None or other is None or not isinstance(defined[1], ast.FunctionDef):
        yield types, node
        return
    for statement in returned(defined[1]):
        if statement.value is not None:
            yield other, other.file.evaluator.single_value(statement.value)


def _is_percentage(value: object) -> bool:
    return isinstance(value, int | float) and 1 < value <= _PERCENT


def _terms(types: MessageTypes, node: ast.expr) -> list[object]:
    """Return the value of an expression, or the known terms of a sum."""
    match node:
        case ast.BinOp(left=left, op=ast.Add(), right=right):
            return [*_terms(types, left), *_terms(types, right)]
    return [types.file.evaluator.evaluate(node)]


def _factors(types: MessageTypes, node: ast.expr) -> list[object]:
    """Return the known factors and divisors of a product."""
    match node:
        case ast.BinOp(left=left, op=ast.Mult() | ast.Div(), right=right):
            return [*_factors(types, left), *_factors(types, right)]
    return [types.file.evaluator.evaluate(node)]
