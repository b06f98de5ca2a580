"""TY003: attributes of ROS objects, and of classes in the workspace, exist."""

from __future__ import annotations

import ast
import re
import sys
import typing

from scaffold.api import (
    Diagnostic,
    Edit,
    Example,
    Fix,
    Report,
    Safety,
    Severity,
    TypeRule,
    closest_name,
)
from scaffold.api.distributions import removed_name
from scaffold.api.python import conditions_on
from scaffold.api.rclpy import NODE, has, only_while_stopping
from scaffold.api.types import TypeFinding, class_in

from ._attribute_owners import (
    CONTAINER,
    COROUTINE,
    FUNCTION,
    METHOD,
    TUPLE,
    cause,
    is_of_self,
    known_owner,
    without_none,
)

_NODE = (
    "from rclpy.action import ActionClient\nfrom rclpy.node import Node\n"
    "from example_interfaces.action import Fibonacci\n\n\n"
    "class Asker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('asker')\n"
    "        self.client = ActionClient(self, Fibonacci, 'fibonacci')\n\n"
    "    def stop(self):\n"
    "        self.client.{}()\n"
)
_HINT = (
    "from rclpy.node import Node\n\n\n"
    "class Hinter(Node):\n"
    "    def hint(self):\n"
    "        for logger in [self.get_logger()]:\n"
    "            logger.{}('hello')\n"
)
_HINT_ARGUMENT = (
    "from rclpy.node import Node\n\n\n"
    "class Hinter(Node):\n"
    "    def hint(self):\n"
    "        self.say(self.get_logger())\n\n"
    "    def say(self, logger):\n"
    "        logger.{}('hello')\n"
)
_STATES = (
    "from dataclasses import dataclass, field\n\nfrom geometry_msgs.msg import Pose\n\n\n"
    "@dataclass\nclass State:\n"
    "    pose: Pose = field(default_factory=Pose)\n\n\n"
    "class Keeper:\n"
    "    def __init__(self):\n"
    "        self.states = {{}}\n\n"
    "    def keep(self, name):\n"
    "        self.states[name] = State()\n"
    "        print(self.states[name].{})\n\n"
    "    def show(self):\n"
    "        for state in self.states.values():\n"
    "            print(state.{})\n"
).replace("].{}", "].pose")
_MEMORY = (
    "from std_msgs.msg import String\n\n\n"
    "class Memory:\n"
    "    topic = String()\n\n"
    "    def keep(self, value, weight):\n"
    "        if value is None:\n"
    "            return None\n"
    "        updated = 0.5 * {}\n"
    "        return updated.astype(weight)\n"
)
_HUB = (
    "from rclpy.node import Node\nfrom sensor_msgs.msg import Imu, Range\n\n\n"
    "class Hub(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('hub')\n"
    "        table = {{'imu': (Imu, self.on_imu)}}\n"
    "        self.kept = [\n"
    "            self.create_subscription(kind, topic, callback, 10)\n"
    "            for topic, (kind, callback) in table.items()]\n"
    "        for number, row in enumerate([(Imu, 'tilt', self.on_tilt)]):\n"
    "            self.create_subscription(row[0], row[1], row[2], number)\n"
    "        for row in [{{'type': Range, 'callback': self.on_range}}]:\n"
    "            self.create_subscription(row['type'], 'range', row['callback'], 10)\n"
    "        for kind, name in [(Range, 'on_sonar')]:\n"
    "            self.create_subscription(kind, 'sonar', getattr(self, name), 10)\n\n"
    "    def on_imu(self, msg):\n        print(msg.{})\n\n"
    "    def on_tilt(self, msg):\n        print(msg.{})\n\n"
    "    def on_range(self, msg):\n        print(msg.{})\n\n"
    "    def on_sonar(self, msg):\n        print(msg.{})\n"
)
_HOMING = (
    "from rclpy.node import Node\nfrom std_srvs.srv import Trigger\n\n\n"
    "class Homing(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('homing')\n"
    "        self.client = self.create_client(Trigger, 'home')\n\n"
    "    async def ask(self):\n"
    "        return await self.client.call_async(Trigger.Request())\n\n"
    "    async def home(self):\n"
    "        answer = {}\n"
    "        print(answer.{})\n"
)
_THRUSTERS = (
    "from rclpy.node import Node\nfrom std_msgs.msg import Float64\n\n\n"
    "class Thrusters(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('thrusters')\n"
    "        self.outputs = [0] * 8\n"
    "        for i in range(8):\n"
    "            self.outputs[i] = {}\n\n"
    "    def stop(self):\n"
    "        self.outputs[0].publish(Float64())\n"
    "        for output in self.outputs:\n"
    "            output.publish(Float64())\n"
)
_MODES = (
    "from rclpy.node import Node\nfrom robots.modes import StrEnum\n\n\n"
    "class Mode{}:\n    IDLE = 'idle'\n\n\n"
    "def show(node: Node):\n    node.get_logger().info(Mode.IDLE.value)\n"
)
_ODOMETRY = "class Odometry:\n    def reset(self):\n        self.x = 0.0\n"
_WHEELS = (
    "from .odometry import Odometry\n\n\n"
    "class Wheels(Odometry):\n    def {}(self):\n        self.reset()\n"
)
_RESTART = (
    "from rclpy.node import Node\n\nfrom .odometry import Odometry\n"
    "from .wheels import Wheels\n\n\n"
    "class Drive(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('drive')\n"
    "        self.connect(Wheels, self.on_start)\n\n"
    "    def on_start(self, odometry: Odometry):\n        odometry.restart()\n"
)
_PATH = (
    "from rclpy.node import Node\n\n\n"
    "class Path(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('path')\n"
    "        self.lengths = []\n\n"
    "    def last(self):\n        return self.lengths.size - 1\n"
)
_LINE = (
    "import numpy as np\n\nfrom .path import Path\n\n\n"
    "class Smooth(Path):\n    pass\n\n\n"
    "class Line(Smooth):\n"
    "    def start(self):\n        self.{} = np.zeros(3)\n"
)
_DRIVE = (
    "from rclpy.node import Node\nfrom std_srvs.srv import Trigger\n\n"
    "from .odometry import Odometry\n\n\n"
    "class Drive(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('drive')\n"
    "        self.odometry = Odometry()\n"
    "        self.create_service(Trigger, 'reset', self.on_reset)\n"
    "        self.odometry.{}()\n\n"
    "    def on_reset(self, request, response):\n"
    "        return response\n"
)
_RECORD = "import sqlite3\n\nimport rclpy\n\nrclpy.init()\nprint(sqlite3.version)\n"
_LIMIT = (
    "from rcl_interfaces.msg import SetParametersResult\n"
    "from rclpy.node import Node\n\n\n"
    "class Limit(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('limit')\n"
    "        self.add_on_set_parameters_callback(self.on_set)\n\n"
    "    def on_set(self, parameters):\n"
    "        for parameter in parameters:\n"
    "            if parameter.{} == 3:\n"
    "                self.limit = parameter.value\n"
    "        return SetParametersResult(successful=True)\n"
)
_CERTAIN = 0.85
_OF_ALL_MESSAGES = frozenset({"SLOT_TYPES", "get_fields_and_field_types"})
_BY_NAME = ("attr(", "__dict__", "get_fields_and_field_types", "patch")
"""Text in files that may set attributes by name."""
_IMPORTED = frozenset({*typing.__all__, *sys.stdlib_module_names, "ament_index_python"})
"""Names that ROS modules import for internal use, which the stubs do not show."""
_TIMES = frozenset({"rclpy.time.Time", "rclpy.duration.Duration"})
_SECONDS = frozenset({"sec", "secs", "seconds", "to_sec", "total_seconds"})
_NANOSECONDS = frozenset({"nanosec", "nsec", "nsecs", "nanosecs", "to_nsec"})
"""The names of the parts of a time in other libraries, messages and ROS 1."""
_OF_MOCKS = re.compile(
    r"assert_\w+|await(?:ed|_args|_args_list|_count)|call(?:ed|_args|_args_list|_count)"
    r"|(?:method|mock)_calls|return_value|side_effect|(?:reset|configure|attach)_mock"
)
"""Matches the attributes of ``unittest.mock.AsyncMock``."""
_FEW = 6
"""The maximum number of names in a message."""
_TO_DO = {COROUTINE: "await it", FUNCTION: "call it first", TUPLE: "unpack it first"}
"""The hint for a value that only leads to a ROS object."""

_WATCHDOG = (
    "class Watchdog:\n    def __init__(self, node):\n        self.{}parent = node\n\n"
    "    def feed(self):\n        return self.{}.get_clock()\n"
)
_WATCHED = (
    "from rclpy.node import Node\n\nfrom .watch import Watchdog\n\n\n"
    "def watch(node: Node):\n    return Watchdog(node)\n"
)
_LIMITS = (
    "from dataclasses import dataclass\n\n\n@dataclass\nclass Limits:\n    speed: float = 0.5\n"
)
_LIMITED = (
    "from rclpy.node import Node\n\nfrom .limits import Limits\n\n\n"
    "class Drive(Node):\n"
    "    def __init__(self, limits=None):\n"
    "        super().__init__('drive')\n"
    "        self.limits = {}\n"
    "        self.create_timer(1.0, self.tick)\n\n"
    "    def tick(self):\n        return self.limits.{}\n\n\n"
    "def main():\n    return Drive()\n"
)


class AttributeMissing(TypeRule):
    """Code uses an attribute that an object, a class or a module does not have.

    The class belongs to ROS or to another module of the workspace.

    **Why.** The line fails when it runs: ``AttributeError: 'Future' object has no attribute
    'accepted'``.

    **Fix.** Use an attribute that the class defines; call ``result()`` on a future first.

    **Source.** The classes of ROS 2 Jazzy and their annotations; the code of the workspace.
    """

    code = "TY003"
    name = "attribute-missing"
    other_severities = {Severity.WARNING: "it only fails while the node shuts down"}
    kinds = frozenset({"missing-attribute"})
    examples = (
        Example(
            "entry added to a dictionary in a list",
            {
                "zones.py": "from rclpy.node import Node\n\n\n"
                "class Zones(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('zones')\n"
                "        self.zones = [{'wave': {'height': 0}}, {'wave': {'height': 1}}]\n\n"
                "    def add(self, index, entry):\n"
                "        self.zones[index]['entries'] = {'height': entry}\n\n"
                "    def save(self):\n"
                "        for zone in self.zones:\n"
                "            zone['wave']['height'] = zone['entries']['height'].get()\n"
            },
        ),
        Example(
            "return value of wait_for_message() used as the message",
            {
                "once.py": "from rclpy.wait_for_message import wait_for_message\n"
                "from sensor_msgs.msg import CameraInfo\n\n\n"
                "def width(node):\n"
                "    info = wait_for_message(CameraInfo, node, 'camera_info')\n"
                "    return info.width\n"
            },
            "7:12: a tuple has no 'width': AttributeError; unpack it first",
        ),
        Example(
            "subscription callback that another library calls as well",
            {
                "base.py": "from rclpy.node import Node\n"
                "from std_msgs.msg import String\n\n\n"
                "class Base(Node):\n"
                "    def __init__(self, port):\n"
                "        super().__init__('base')\n"
                "        port.found += self.send\n"
                "        self.create_subscription(String, 'corrections', self.send, 10)\n\n"
                "    def send(self, found):\n        print(found.serialize())\n"
            },
        ),
        Example(
            "get_logger stored without calling it",
            {
                "idle.py": "from rclpy.node import Node\n\n\n"
                "class Idle(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('idle')\n"
                "        self.log = self.get_logger\n"
                "        self.create_timer(1.0, self.tick)\n\n"
                "    def tick(self):\n        self.log.info('still idle')\n"
            },
            "11:9: a function has no 'info': AttributeError; call it first",
        ),
        Example(
            "NumPy array used as a quaternion and as a list",
            {
                "heading.py": "import numpy as np\n"
                "from geometry_msgs.msg import Quaternion\n"
                "from tf_transformations import quaternion_from_euler\n\n"
                "q = quaternion_from_euler(0.0, 0.0, 1.0)\n"
                "message = Quaternion()\n"
                "message.x = q.x\nmessage.y = q[1]\n"
                "turns = np.array([q[2]])\nturns.append(q[3])\nturns.sort()\n"
            },
            "7:13: numpy.ndarray has no 'x': AttributeError",
            "10:1: numpy.ndarray has no 'append': AttributeError",
        ),
        Example(
            "ROS 1 attributes of a Duration, in code and in an f-string",
            {
                "age.py": "from rclpy.node import Node\nfrom rclpy.time import Time\n"
                "from std_msgs.msg import Header\n\n\n"
                "class Age(Node):\n"
                "    def show(self, header: Header):\n"
                "        age = self.get_clock().now() - Time.from_msg(header.stamp)\n"
                "        if age.nanoseconds < 5e9 and age.to_sec() < 5.0:\n"
                "            self.get_logger().info(f'{age.seconds:.1f} s, {age.nanosec} ns')\n"
            },
            "9:38: rclpy.duration.Duration has no 'to_sec': AttributeError; write .nanoseconds / "
            "1e9",
            "10:39: rclpy.duration.Duration has no 'seconds': AttributeError; write .nanoseconds "
            "/ 1e9",
            "10:60: rclpy.duration.Duration has no 'nanosec': AttributeError; write .nanoseconds",
        ),
        Example(
            "ROS 1 field in a file that imports rospy",
            {
                "cloud.py": "import os\n\nfrom std_msgs.msg import Header\n\n"
                "VERSION = int(os.environ.get('VERSION_OF_ROS', '2'))\n"
                "if VERSION == 1:\n    import rospy\nelse:\n    import rclpy\n\n\n"
                "def number(header: Header):\n"
                "    if VERSION != 1:\n        return 0\n    return header.seq\n"
            },
        ),
        Example(
            "argument that the only call of the class leaves out, so that others are shifted",
            {
                "talker.py": "from rclpy.node import Node\n\n\n"
                "class Text:\n"
                "    def __init__(self, node, size):\n"
                "        self.node = node\n"
                "        self.size = size\n\n"
                "    def say(self):\n"
                "        self.node.get_logger().info('hello')\n\n\n"
                "class Talker(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('talker')\n"
                "        size = self.get_parameter('size').get_parameter_value()\n"
                "        self.size = size.integer_value\n"
                "        self.text = Text(self.size)\n"
            },
        ),
        Example(
            "dictionary key used as an attribute",
            {
                "lamps.py": "from rclpy.node import Node\nfrom std_msgs.msg import Bool\n\n\n"
                "class Lamps(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('lamps')\n"
                "        self.outputs = {'red': self.create_publisher(Bool, 'red', 10)}\n\n"
                "    def blink(self):\n"
                "        self.outputs['red'].publish(Bool(data=True))\n"
                "        self.outputs.red.publish(Bool(data=True))\n"
            },
            "12:9: a dict has no 'red': AttributeError; write ['red']",
        ),
        Example("existing attribute", {"asker.py": _NODE.format("destroy")}),
        Example(
            "unknown attribute of a node in a function of another module",
            {
                "package.xml": "<package><name>arm</name></package>\n",
                "arm/util.py": "def title(node, prefix=''):\n    return prefix + node.name()\n",
                "arm/main.py": "from rclpy.node import Node\n\nfrom .util import title\n\n\n"
                "class Arm(Node):\n    def __init__(self):\n        super().__init__('arm')\n"
                "        print(title(self))\n\n\nArm()\n",
            },
            "arm/util.py:2:21: Arm has no 'name': AttributeError ('node' comes from line 9 of "
            "arm/main.py)",
        ),
        Example(
            "Node.executor replaced with another object, which ND013 reports",
            {
                "miner.py": "from concurrent.futures import ThreadPoolExecutor\n\n"
                "from rclpy.node import Node\n\n\n"
                "class Miner(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('miner')\n"
                "        self.executor = ThreadPoolExecutor(max_workers=10)\n\n"
                "    def on_request(self, msg):\n"
                "        self.executor.submit(print, msg)\n"
            },
        ),
        Example(
            "hasattr() check before the use",
            {
                "asker.py": _NODE.format("halt").replace(
                    "stop(self):\n", "stop(self):\n        assert hasattr(self.client, 'halt')\n"
                )
            },
        ),
        Example(
            "method with an incorrect annotation that is also passed as a callback",
            {
                "turn.py": "from geometry_msgs.msg import Quaternion\n"
                "from rclpy.node import Node\nfrom sensor_msgs.msg import Imu\n\n\n"
                "class Turner(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('turner')\n"
                "        self.kinds.add(Quaternion, self.to_yaw)\n"
                "        self.create_subscription(Quaternion, 'q', self.on_turn, 10)\n\n"
                "    def on_turn(self, message):\n"
                "        self.to_yaw(message)\n"
                "        map(self.to_roll, [message])\n\n"
                "    def to_yaw(self, q: Imu):\n"
                "        return q.z * q.w\n\n"
                "    def to_roll(self, q: Imu):\n"
                "        return q.x * q.w\n"
            },
        ),
        Example(
            "name that a module imports but does not define",
            {"kinds.py": "import rclpy.node\n\nOnSet = rclpy.node.Callable[[list], None]\n"},
        ),
        Example(
            "unknown attribute of a Parameter in a parameter callback",
            {"limit.py": _LIMIT.format("type")},
            Report(
                "12:16",
                "rclpy.parameter.Parameter has no 'type': AttributeError; did you mean 'type_'?",
                fix="Replace with 'type_'",
            ),
            fixed={"limit.py": _LIMIT.format("type_")},
        ),
        Example(
            "unknown field of a transform returned by a method",
            {
                "finder.py": "from rclpy.node import Node\nfrom rclpy.time import Time\n"
                "from tf2_ros import Buffer, TransformException\n\n\n"
                "class Finder(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('finder')\n"
                "        self.buffer = Buffer()\n"
                "        self.create_timer(1.0, self.tell)\n\n"
                "    def where(self):\n"
                "        try:\n"
                "            return self.buffer.lookup_transform('map', 'base_link', Time())\n"
                "        except TransformException:\n"
                "            return None\n\n"
                "    def tell(self):\n"
                "        found = self.where()\n"
                "        if found is not None:\n"
                "            self.at = found.transform.translation\n"
                "            self.at = found.position\n"
            },
            "22:23: geometry_msgs.msg.TransformStamped has no 'position': AttributeError; it has "
            "child_frame_id, header, transform",
        ),
        Example(
            "serialized message read from a bag",
            {
                "read.py": "from geometry_msgs.msg import Twist\n"
                "from rosbag2_py import SequentialReader\n\n\n"
                "def read():\n"
                "    last = Twist()\n"
                "    reader = SequentialReader()\n"
                "    while reader.has_next():\n"
                "        topic, data, stamp = reader.read_next()\n"
                "        print(topic, stamp, last.linear.x, data.linear.x)\n"
            },
            "10:44: bytes has no 'linear': AttributeError",
        ),
        Example(
            "client from a dictionary, used after a check of its kind",
            {
                "asker.py": _NODE.format("destroy") + "\n    def wait(self, task):\n"
                "        self.kinds = {1: {'a': {'client': self.client, 'kind': 'action'}}}\n"
                "        for name, item in self.kinds[1].items():\n"
                "            if item['kind'] == 'action':\n"
                "                item['client'].wait_for_server()\n"
                "            elif item['kind'] == 'service':\n"
                "                item['client'].wait_for_service()\n"
            },
        ),
        Example(
            "Windows-only module after a check of os.name",
            {
                "keys.py": "import os\n\nimport rclpy\n\nrclpy.init()\n"
                "if os.name == 'nt':\n    import msvcrt\n\n    print(msvcrt.getch())\n"
            },
        ),
        Example(
            "attribute that a later Python version removed",
            {"record.py": _RECORD},
        ),
        Example(
            "attribute that Python removed",
            {"record.py": _RECORD},
            "6:7: sqlite3 has no 'version': AttributeError",
            distro="lyrical",
        ),
        Example(
            "action feedback callback annotated with the action",
            {
                "asker.py": _NODE.format("destroy")
                + "\n    def feedback(self, message: Fibonacci):\n"
                "        print(message.feedback)\n"
            },
        ),
        Example(
            "action feedback callback annotated with the feedback",
            {
                "asker.py": _NODE.format("destroy")
                + "\n    def feedback(self, message: Fibonacci.Feedback):\n"
                "        print(message.feedback)\n"
            },
        ),
        Example(
            "attributes of launch entities",
            {
                "names.py": "from launch import LaunchDescription\n\n"
                "names = [action.name for action in LaunchDescription().entities]\n"
            },
        ),
        Example(
            "methods that annotate self as Node",
            {
                "listener.py": "from rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
                "class Listener(Node):\n"
                "    def __init__(self: Node):\n"
                "        super().__init__('listener')\n"
                "        self.heard = []\n"
                "        self.create_subscription(String, 'chatter', self.on_chatter, 10)\n\n"
                "    def on_chatter(self: Node, message: String):\n"
                "        self.heard.append(message.data)\n"
            },
        ),
        Example(
            "future of a thread pool",
            {
                "asker.py": _NODE.format("destroy") + "\n    def ask(self, pool):\n"
                "        pool.submit(self.stop).add_done_callback(self.on_done)\n\n"
                "    def on_done(self, future):\n"
                "        print(future.running())\n"
            },
        ),
        Example(
            "future used as the goal handle",
            {
                "asker.py": _NODE.format("destroy") + "\n    def ask(self):\n"
                "        future = self.client.send_goal_async(Fibonacci.Goal())\n"
                "        future.add_done_callback(self.on_goal)\n\n"
                "    def on_goal(self, future):\n"
                "        return future.accepted\n"
            },
            "19:16: rclpy.task.Future has no 'accepted': AttributeError; call result() of the "
            "future",
        ),
        Example(
            "unknown fields in callbacks that are functions or methods of other objects",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/hearing.py": "class Hearing:\n"
                "    def hear(self, msg):\n        return msg.text\n\n\n"
                "def answer(request, response):\n    response.ok = True\n    return response\n",
                "rover/node.py": "from rclpy.node import Node\nfrom rover import hearing\n"
                "from rover.hearing import Hearing\nfrom std_msgs.msg import String\n"
                "from std_srvs.srv import Trigger\n\n\n"
                "class Seeing:\n"
                "    def see(self, msg):\n        return msg.image\n\n\n"
                "class Robot(Node):\n"
                "    def start(self):\n"
                "        self.hearing = Hearing()\n"
                "        self.seeing = Seeing()\n"
                "        self.create_subscription(String, 'a', self.hearing.hear, 10)\n"
                "        self.create_subscription(String, 'b', self.seeing.see, 10)\n"
                "        self.create_service(Trigger, 'c', hearing.answer)\n",
            },
            "rover/hearing.py:3:16: std_msgs.msg.String has no 'text': AttributeError; it has "
            "data ('msg' comes from line 17 of rover/node.py)",
            "rover/hearing.py:7:5: std_srvs.srv.Trigger.Response has no 'ok': AttributeError; it "
            "has message, success ('response' comes from line 19 of rover/node.py)",
            "rover/node.py:10:16: std_msgs.msg.String has no 'image': AttributeError; it has data",
        ),
        Example(
            "unknown fields of a message passed to a helper object and to a mixin",
            {
                "limits.py": "from geometry_msgs.msg import TwistStamped\n"
                "from rclpy.node import Node\n\n\n"
                "class Limits:\n"
                "    def apply(self, msg):\n        return msg.linear.x\n\n\n"
                "class Limiting:\n"
                "    def limit(self, msg):\n        return msg.angular.z\n\n\n"
                "class Robot(Limiting, Node):\n"
                "    def drive(self):\n"
                "        self.limits = Limits()\n"
                "        self.limits.apply(TwistStamped())\n"
                "        self.limit(TwistStamped())\n"
            },
            "7:16: geometry_msgs.msg.TwistStamped has no 'linear': AttributeError; it has header, "
            "twist ('msg' comes from line 18)",
            "12:16: geometry_msgs.msg.TwistStamped has no 'angular': AttributeError; it has "
            "header, twist ('msg' comes from line 19)",
        ),
        Example(
            "goal handle used as the goal",
            {
                "server.py": "from example_interfaces.action import Fibonacci\n"
                "from rclpy.action import ActionServer\nfrom rclpy.node import Node\n\n\n"
                "class Server(Node):\n"
                "    def start(self):\n"
                "        ActionServer(self, Fibonacci, 'a', self.execute)\n\n"
                "    def execute(self, goal_handle):\n"
                "        goal = Fibonacci.Goal()\n"
                "        goal.order = goal_handle.order\n"
                "        return goal\n"
            },
            "12:22: rclpy.action.server.ServerGoalHandle has no 'order': AttributeError",
        ),
        Example(
            "future used as the service response",
            {
                "asker.py": "from rclpy.node import Node\nfrom std_srvs.srv import Trigger\n\n\n"
                "class Asker(Node):\n"
                "    def on_ask(self, request, response):\n"
                "        client = self.create_client(Trigger, 'ask')\n"
                "        answer = client.call_async(Trigger.Request())\n"
                "        response.success = answer.success\n"
                "        return response\n"
            },
            "9:28: rclpy.task.Future has no 'success': AttributeError; call result() of the future",
        ),
        Example(
            "future.result without parentheses",
            {
                "asker.py": _NODE.format("destroy") + "\n    def ask(self):\n"
                "        future = self.client.send_goal_async(Fibonacci.Goal())\n"
                "        future.add_done_callback(self.on_goal)\n\n"
                "    def on_goal(self, future):\n"
                "        handle = future.result\n"
                "        return handle.accepted\n"
            },
            "20:16: rclpy.task.Future.result has no 'accepted': AttributeError; write result()",
        ),
        Example(
            "str used as the message it was read from",
            {
                "hear.py": "from rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
                "class Hearer(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('hearer')\n"
                "        self.create_subscription(String, 'talk', self.on_talk, 10)\n\n"
                "    def on_talk(self, message):\n"
                "        self.show(message.data)\n\n"
                "    def show(self, message):\n"
                "        self.get_logger().info(message.data)\n"
            },
            "14:32: a str has no 'data': AttributeError ('message' comes from line 11)",
        ),
        Example(
            "unknown attribute of a goal handle",
            {
                "asker.py": _NODE.format("destroy") + "\n    def ask(self):\n"
                "        self.handle_of_goal = None\n"
                "        future = self.client.send_goal_async(Fibonacci.Goal())\n"
                "        future.add_done_callback(self.on_goal)\n\n"
                "    def on_goal(self, future):\n"
                "        self.handle_of_goal = future.result()\n"
                "        if self.handle_of_goal.accepted:\n"
                "            return self.handle_of_goal.was_refused\n"
            },
            "22:20: rclpy.action.client.ClientGoalHandle has no 'was_refused': AttributeError",
        ),
        Example(
            "unknown method of a timer that is initially None",
            {
                "asker.py": _NODE.format("destroy").replace(
                    "'fibonacci')\n",
                    "'fibonacci')\n        self.timer = None\n        self.pause = None\n",
                )
                + "        self.timer = self.create_timer(1.0, self.stop)\n"
                "        self.timer.cancel()\n        self.timer.shutdown()\n"
                "        self.pause.start()\n"
            },
            "17:9: rclpy.timer.Timer has no 'shutdown': AttributeError",
        ),
        Example(
            "ROS 1 method of an action client",
            {"asker.py": _NODE.format("cancel_all_goals")},
            "12:9: rclpy.action.client.ActionClient has no 'cancel_all_goals': AttributeError",
        ),
        Example(
            "unknown attribute after rclpy.spin()",
            {
                "talk.py": "import rclpy\nfrom rclpy.node import Node\n\n\ndef main():\n"
                "    rclpy.init()\n    rclpy.spin(Node('talker'))\n    rclpy.stop_all()\n"
            },
            Report("8:5", "rclpy has no 'stop_all': AttributeError", severity=Severity.WARNING),
        ),
        Example(
            "misspelled method of a class from another module",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/odometry.py": _ODOMETRY,
                "rover/drive.py": _DRIVE.format("restart"),
                "rover/good.py": _DRIVE.format("reset"),
            },
            Report(
                "rover/drive.py:12:9",
                "Odometry has no 'restart': AttributeError; did you mean 'reset'?",
                unsafe_fix="Replace with 'reset'",
            ),
        ),
        Example(
            "class that sets attributes with setattr()",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/odometry.py": _ODOMETRY + "        setattr(self, 'restart', self.reset)\n",
                "rover/drive.py": _DRIVE.format("restart"),
            },
        ),
        Example(
            "class with a decorator that may add attributes",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/odometry.py": "from dataclasses_json import dataclass_json\n\n\n"
                "@dataclass_json\n# with from_json() and to_json()\n" + _ODOMETRY,
                "rover/drive.py": _DRIVE.format("restart"),
            },
        ),
        Example(
            "mock instead of a node in a test",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/counter.py": "import rclpy.node\nimport std_msgs.msg\n\n\n"
                "class Counter:\n"
                "    def __init__(self, node: rclpy.node.Node):\n"
                "        self.publisher = node.create_publisher(std_msgs.msg.Int32, 'count', 10)\n"
                "\n\ndef main():\n    rclpy.init()\n"
                "    node = rclpy.node.Node('counter')\n    Counter(node)\n"
                "    rclpy.spin(node)\n",
                "test/test_counter.py": "import unittest\nfrom unittest.mock import Mock\n\n"
                "import rclpy.node\nimport rover.counter\n\n\n"
                "class TestCounter(unittest.TestCase):\n"
                "    def setUp(self):\n"
                "        self.counter = rover.counter.Counter(Mock(rclpy.node.Node))\n\n"
                "    def test_count(self):\n"
                "        self.assertEqual(self.counter.publisher.publish.call_count, 0)\n",
            },
        ),
        Example(
            "method that only a subclass of the annotated return type defines",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/odometry.py": _ODOMETRY
                + "\n\nclass Wheels(Odometry):\n    def restart(self):\n        self.reset()\n\n\n"
                "def make() -> Odometry:\n    return Wheels()\n",
                "rover/drive.py": _DRIVE.format("restart")
                .replace("import Odometry", "import make")
                .replace("Odometry()", "make()"),
            },
        ),
        Example(
            "attribute of self in a class of the workspace",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/watch.py": _WATCHDOG.format("", "node"),
                "rover/drive.py": _WATCHED,
            },
            "rover/watch.py:6:16: Watchdog has no 'node': AttributeError",
        ),
        Example(
            "attribute that the class sharing a mixin has",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/watch.py": _WATCHDOG.format("", "node")
                + "\n\nclass Guard(Watchdog, dict):\n    node = None\n",
                "rover/drive.py": _WATCHED.replace("Watchdog", "Guard"),
            },
        ),
        Example(
            "method without self that is called through its class",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/watch.py": "class Watchdog:\n    def __init__(self, node):\n"
                "        self.count = 0\n\n    def feed(msg):\n        return msg.header\n",
                "rover/drive.py": _WATCHED,
            },
        ),
        Example(
            "attribute of the object that replaces None",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/limits.py": _LIMITS,
                "rover/drive.py": _LIMITED.format("limits or Limits()", "max_speed"),
            },
            Report(
                "rover/drive.py:13:16",
                "Limits has no 'max_speed': AttributeError; did you mean 'speed'?",
                unsafe_fix="Replace with 'speed'",
            ),
        ),
        Example(
            "attribute of an object that a caller passes instead",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/limits.py": _LIMITS,
                "rover/drive.py": _LIMITED.format("limits or Limits()", "max_speed").replace(
                    "Drive()", "Drive(load())"
                ),
            },
        ),
        Example(
            "attribute of what a fixture yields",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/limits.py": _LIMITS,
                "test/test_limits.py": "import pytest\nfrom std_msgs.msg import Float64\n\n"
                "from rover.limits import Limits\n\n\n"
                "@pytest.fixture\ndef limits():\n    yield Limits()\n\n\n"
                "def test_speed(limits):\n    assert limits.speed == Float64().data\n"
                "    assert limits.max_speed\n\n\n"
                "@pytest.mark.parametrize('limits', [1, 2])\ndef test_others(limits):\n"
                "    assert limits.real\n",
            },
            Report(
                "test/test_limits.py:14:12",
                "Limits has no 'max_speed': AttributeError; did you mean 'speed'?",
                unsafe_fix="Replace with 'speed'",
            ),
        ),
        Example(
            "client of a node that a parameter is",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/asking.py": "class Asking:\n"
                "    def __init__(self, node, srv_type):\n"
                "        self.label = node.label\n"
                "        self.client = node.create_client(srv_type, 'arm')\n\n"
                "    def ask(self, **fields):\n"
                "        return self.client.call_async(self.client.srv_type.Request(**fields))\n",
                "rover/arm.py": "from rclpy.node import Node\nfrom std_srvs.srv import Trigger\n\n"
                "from .asking import Asking\n\n\n"
                "class Arm(Node):\n    def __init__(self):\n"
                "        super().__init__('arm')\n"
                "        self.asking = Asking(self, Trigger)\n\n"
                "    def move(self):\n        return self.asking.ask().success\n",
            },
            "rover/arm.py:13:16: rclpy.task.Future has no 'success': AttributeError; call "
            "result() of the future",
        ),
        Example(
            "attributes set by other modules",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/odometry.py": _ODOMETRY,
                "rover/drive.py": _DRIVE.format("restart").replace(
                    "        self.odometry.restart()\n",
                    "        print(self.odometry.y, self.odometry.z, self.odometry.yaw)\n",
                ),
                "rover/bags.py": "def replay(odometry, poses):\n"
                "    for odometry.y in poses:\n"
                "        odometry.z, odometry.x = 0.0, 1.0\n"
                "    setattr(odometry, 'yaw', 0.0)\n",
            },
        ),
        Example(
            "attribute set by another package",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/odometry.py": _ODOMETRY,
                "rover/drive.py": _DRIVE.format("restart"),
            },
            neighbors={
                "mission": {
                    "package.xml": "<package><name>mission</name></package>\n",
                    "mission.py": "from rover.drive import Drive\n\n"
                    "drive = Drive()\ndrive.odometry.restart = drive.odometry.reset\n",
                }
            },
        ),
        Example(
            "NAME__DEFAULT constant for the default of a message field",
            {
                "package.xml": "<package><name>rover</name>"
                "<export><build_type>ament_cmake</build_type></export></package>\n",
                "CMakeLists.txt": "project(rover)\n"
                'rosidl_generate_interfaces(${PROJECT_NAME} "msg/Address.msg")\n',
                "msg/Address.msg": "string name 'none'\n",
                "address.py": "import rclpy\nfrom rover.msg import Address\n\n"
                "rclpy.init()\nprint(Address.NAME__DEFAULT)\n",
            },
        ),
        Example(
            "class whose __new__() returns other objects",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/odometry.py": _ODOMETRY
                + "\n    def __new__(cls):\n        return cls.KINDS['wheels']()\n",
                "rover/drive.py": _DRIVE.format("restart"),
            },
        ),
        Example(
            "fields of messages that callbacks in tables get",
            {"hub.py": _HUB.format("linear_acceleration", "header", "range", "range")},
        ),
        Example(
            "unknown fields of messages that callbacks in tables get",
            {"hub.py": _HUB.format("gyro", "euler", "meters", "data")},
            "20:15: sensor_msgs.msg.Imu has no 'gyro': AttributeError",
            "23:15: sensor_msgs.msg.Imu has no 'euler': AttributeError",
            "26:15: sensor_msgs.msg.Range has no 'meters': AttributeError",
            "29:15: sensor_msgs.msg.Range has no 'data': AttributeError",
        ),
        Example(
            "unknown field of a message",
            {
                "say.py": "from std_msgs.msg import String\n\n"
                "message = String()\nmessage.text = 'hello'\n"
            },
            "4:1: std_msgs.msg.String has no 'text': AttributeError; it has data",
        ),
        Example(
            "generated metaclass of a message, and a name that its module does not have",
            {
                "say.py": "import std_msgs.msg\n\n"
                "print(std_msgs.msg._string.Metaclass_String, std_msgs.msg._string.Words)\n"
            },
            "3:46: std_msgs.msg._string has no 'Words': AttributeError; it has Metaclass_String, "
            "String",
        ),
        Example(
            "coroutine that is awaited, coroutine that is closed",
            {
                "home.py": _HOMING.format("await self.ask()", "success")
                + "        waiting = self.ask()\n        waiting.close()\n"
            },
        ),
        Example(
            "instance attribute of a different type than the class attribute",
            {
                "talker.py": "from launch_param_builder import ParameterBuilder\n"
                "from std_msgs.msg import String\n\n\n"
                "class Talker(ParameterBuilder):\n"
                "    output = ''\n\n"
                "    def __init__(self, node):\n"
                "        self.output = node.create_publisher(String, 'talk', 10)\n\n"
                "    def talk(self):\n        self.output.publish(String())\n"
            },
        ),
        Example(
            "publishers in place of numbers that only reserve space",
            {"thrusters.py": _THRUSTERS.format("self.create_publisher(Float64, f'thrust_{i}', 1)")},
        ),
        Example(
            "element of a list of numbers",
            {"thrusters.py": _THRUSTERS.format("1")},
            "13:9: an int has no 'publish': AttributeError",
            "15:13: an int has no 'publish': AttributeError",
        ),
        Example(
            "value of an enum of a library that is not installed",
            {"modes.py": _MODES.format("(StrEnum)")},
        ),
        Example(
            "value of a constant",
            {"modes.py": _MODES.format("")},
            "10:28: a str has no 'value': AttributeError",
        ),
        Example(
            "method of a recording",
            {
                "play.py": "from rosbag2_py import SequentialReader\n\n"
                "reader = SequentialReader()\nreader.open_uri('recording')\nreader.close()\n"
            },
        ),
        Example(
            "attribute that a subclass sets to another object",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/path.py": _PATH,
                "rover/line.py": _LINE.format("lengths"),
            },
        ),
        Example(
            "attribute that no subclass sets",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/path.py": _PATH,
                "rover/line.py": _LINE.format("weights"),
            },
            "rover/path.py:10:16: a list has no 'size': AttributeError",
        ),
        Example(
            "method of all derived classes of an annotated base that nothing creates",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/odometry.py": _ODOMETRY,
                "rover/wheels.py": _WHEELS.format("restart"),
                "rover/drive.py": _RESTART,
            },
        ),
        Example(
            "method of all derived classes of a base that only its own file creates",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/odometry.py": _ODOMETRY + "\n\ndef make():\n    return Odometry()\n",
                "rover/wheels.py": _WHEELS.format("restart"),
                "rover/drive.py": _RESTART,
            },
        ),
        Example(
            "method of a derived class, of an object of the base",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/odometry.py": _ODOMETRY,
                "rover/wheels.py": _WHEELS.format("restart"),
                "rover/drive.py": _RESTART.replace("odometry: Odometry", "number").replace(
                    "odometry.restart", "Odometry().restart"
                ),
            },
            Report(
                "rover/drive.py:13:9",
                "Odometry has no 'restart': AttributeError; did you mean 'reset'?",
                unsafe_fix="Replace with 'reset'",
            ),
        ),
        Example(
            "method that neither an annotated base nor its derived class has",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/odometry.py": _ODOMETRY,
                "rover/wheels.py": _WHEELS.format("stop"),
                "rover/drive.py": _RESTART,
            },
            Report(
                "rover/drive.py:13:9",
                "Odometry has no 'restart': AttributeError; did you mean 'reset'?",
                unsafe_fix="Replace with 'reset'",
            ),
        ),
        Example(
            "existing field of a message in a dictionary of dataclasses",
            {"keep.py": _STATES.format("pose.position")},
        ),
        Example(
            "unknown field of a message in a dictionary of dataclasses",
            {"keep.py": _STATES.format("pose.pose")},
            "21:19: geometry_msgs.msg.Pose has no 'pose': AttributeError; it has orientation, "
            "position",
        ),
        Example(
            "text in place of a node that most callers hand on",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/fail.py": "from rclpy.node import Node\n\n\n"
                "def fail(node, *text):\n    node.get_logger().error(str(text))\n\n\n"
                "def fail_late(node, text):\n    fail(node, text)\n",
                "rover/drive.py": "from rclpy.node import Node\n"
                "from rover.fail import fail\n\n\n"
                "def drive(node):\n    fail(node, 'too fast')\n\n\n"
                "def stop():\n    fail('too slow')\n",
            },
            "rover/fail.py:5:5: a str has no 'get_logger': AttributeError ('node' comes from line "
            "10 of rover/drive.py)",
        ),
        Example(
            "private attribute of a base class",
            {
                "file.py": "from launch_ros.parameter_descriptions import ParameterFile\n\n\n"
                "class Spaced(ParameterFile):\n"
                "    def path(self):\n        return self._ParameterFile__param_file\n\n\n"
                "print(Spaced('a.yaml').path())\n"
            },
        ),
        Example(
            "product with a value that may be an array",
            {"keep.py": _MEMORY.format("value")},
        ),
        Example(
            "product of floats",
            {"keep.py": _MEMORY.format("float(value)")},
            "11:16: a float has no 'astype': AttributeError",
        ),
        Example(
            "coroutine that is not awaited",
            {"home.py": _HOMING.format("self.ask()", "success")},
            "15:15: a coroutine has no 'success': AttributeError; await it",
        ),
        Example(
            "method removed in this distribution",
            {"hint.py": _HINT.format("warn")},
            Report(
                "7:13",
                "rclpy.impl.rcutils_logger.RcutilsLogger.warn was removed in Lyrical: "
                "AttributeError; use warning (rclpy 1456)",
                fix="Replace with 'warning'",
            ),
            fixed={"hint.py": _HINT.format("warning")},
            distro="lyrical",
        ),
        Example(
            "argument of a method in files with tabs and with Windows line ends",
            {
                "tabs.py": _HINT_ARGUMENT.replace("    ", "\t").format("debu"),
                "windows.py": _HINT_ARGUMENT.replace("\n", "\r\n").format("debu"),
            },
            Report(
                "tabs.py:9:3",
                "rclpy.impl.rcutils_logger.RcutilsLogger has no 'debu': "
                "AttributeError; did you mean 'debug'? ('logger' comes from line 6)",
                fix="Replace with 'debug'",
            ),
            Report(
                "windows.py:9:9",
                "rclpy.impl.rcutils_logger.RcutilsLogger has no 'debu': "
                "AttributeError; did you mean 'debug'? ('logger' comes from line 6)",
                fix="Replace with 'debug'",
            ),
            fixed={
                "tabs.py": _HINT_ARGUMENT.replace("    ", "\t").format("debug"),
                "windows.py": _HINT_ARGUMENT.replace("\n", "\r\n").format("debug"),
            },
        ),
        Example(
            "after a check whether the node has set an attribute, or whether its base has one",
            {
                "beacon.py": "from rclpy.node import Node\nfrom std_msgs.msg import Empty\n\n\n"
                "class Beacon(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('beacon')\n"
                "        self.output = self.create_publisher(Empty, 'beacon', 10)\n\n"
                "    def tick(self):\n"
                "        if not hasattr(self, 'last'):\n"
                "            self.last = self.get_clock().time()\n"
                "        if getattr(self, 'last', None) is not None:\n"
                "            self.output.emit(Empty())\n"
                "        if hasattr(self, 'get_topic_names'):\n"
                "            self.output.send(Empty())\n"
            },
            "12:25: rclpy.clock.Clock has no 'time': AttributeError; it has clock_type, "
            "create_jump_callback, handle, now, sleep_for, sleep_until",
            "14:13: rclpy.publisher.Publisher has no 'emit': AttributeError",
        ),
        Example(
            "class with incomplete type stubs",
            {
                "turn.py": "from scipy.spatial.transform import Rotation\n"
                "from serial import Serial\n\n"
                "back = Rotation.inv(Rotation.identity())\n"
                "print(back.apply([1, 0, 0]), Serial.BAUDRATES, Serial().is_open)\n"
            },
        ),
    )

    def judge(self, finding: TypeFinding) -> Diagnostic | None:
        matched = finding.match(
            r"(?:Object of type|Class|Module) `(?P<of>.+)` has no "
            r"(?:attribute|member) `(?P<name>\w+)`"
        ) or finding.match(r"Unresolved attribute `(?P<name>\w+)` on type `(?P<of>.+)`")
        node = finding.node(ast.Attribute)
        if matched is None or node is None:
            return None
        name, owner = matched["name"], without_none(matched["of"])
        is_imported = finding.message.startswith("Module") and name in _IMPORTED
        is_named = _is_named(finding, name, owner)
        is_entry = is_named and owner.startswith("dict[")
        is_known = is_named and CONTAINER.match(owner) is None
        is_known = is_known or _may_be_of_mock(finding, name)
        is_inside = is_of_self(finding, node)
        is_mangled = "__" in name.strip("_")  # a private attribute of a base class
        is_hidden = name.startswith("_") and (is_mangled or not is_inside)
        if is_hidden or is_imported or is_known or _is_chosen(finding, node):
            return None
        object_ = known_owner(finding, node, owner)
        if object_ is None:
            return None
        shown, names = object_
        method = shown.rpartition(".")[2] if METHOD.fullmatch(owner) else ""
        hint = f"; write [{name!r}]" if is_entry else _replacement(shown, name, method)
        closest = "" if hint else closest_name(finding.package, name, names - {name}, 0.6)
        if closest:
            hint = f"; did you mean {closest!r}?"
        names -= _OF_ALL_MESSAGES
        if not hint and not is_inside and len(names) <= _FEW:
            hint = f"; it has {', '.join(sorted(names))}" if names else ""
        message = f"{shown} has no {name!r}: AttributeError{hint}"
        change = removed_name(f"{shown}.{name}")
        if change is not None:
            message = f"{shown}.{name} {change.state}: AttributeError; "
            message += f"{change.instead(change.use)} ({change.source})"
            closest = change.use if change.has_replacement else ""
        fix = _fix(finding, node, closest, is_sure=change is not None) if closest else None
        is_late = only_while_stopping(finding.module, node)
        severity = Severity.WARNING if is_late else Severity.ERROR
        is_of_node = is_inside and has(NODE, name)
        common = f"base of {shown} in {finding.path}" if is_of_node else cause(shown)
        return self.report(finding, message, fix, severity=severity, cause=common)


def _is_named(finding: TypeFinding, name: str, owner: str) -> bool:
    """Return whether a string in the file is the name of the attribute, as for ``setattr``."""
    text = finding.module.source.text
    if re.search(rf"""['"]{name}['"]""", text) is None:
        return False
    is_of_library = bool(class_in(owner))
    return not is_of_library or finding.module.mentions(*_BY_NAME)


def _replacement(shown: str, name: str, method: str) -> str:
    """Return the replacement, if it is not another name of the same object."""
    if method:
        return f"; write {method}()"
    if shown in _TO_DO:
        return f"; {_TO_DO[shown]}"
    if shown == "rclpy.task.Future":
        return "; call result() of the future"
    if shown in _TIMES and name in _SECONDS:
        return "; write .nanoseconds / 1e9"
    return "; write .nanoseconds" if shown in _TIMES and name in _NANOSECONDS else ""


def _may_be_of_mock(finding: TypeFinding, name: str) -> bool:
    """Return whether a test may replace the annotated object with a mock."""
    return _OF_MOCKS.fullmatch(name) is not None and "mock" in finding.module.source.text


def _is_chosen(finding: TypeFinding, node: ast.Attribute) -> bool:
    """Return whether a condition on a table determines the type of the object from it."""
    if not isinstance(node.value, ast.Subscript):
        return False
    module = finding.module
    table = module.text(node.value.value)
    return any(
        isinstance(part, ast.Subscript) and module.text(part.value) == table
        for condition in conditions_on(module, node)
        for part in ast.walk(condition)
    )


def _fix(finding: TypeFinding, node: ast.Attribute, closest: str, *, is_sure: bool) -> Fix:
    from difflib import SequenceMatcher

    _, end = finding.module.span(node)
    is_sure = is_sure or SequenceMatcher(None, node.attr, closest).ratio() >= _CERTAIN
    edit = Edit(finding.path, end - len(node.attr), end, closest)
    safety = Safety.SAFE if is_sure else Safety.UNSAFE
    return Fix(f"Replace with {closest!r}", (edit,), safety)
