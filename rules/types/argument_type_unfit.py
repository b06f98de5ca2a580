"""TY005: arguments have the types that ROS functions expect."""

from __future__ import annotations

import ast

from scaffold.api import Diagnostic, Example, Report, Severity, TypeRule
from scaffold.api.python import argument_of
from scaffold.api.types import MARKED, TypeFinding, in_words, is_certain, with_article

from ._argument_problems import argument_problem
from ._arguments import TIMEOUTS

_NODE = (
    "import rclpy\nfrom rclpy.duration import Duration\nfrom rclpy.node import Node\n"
    "from rclpy.callback_groups import ReentrantCallbackGroup\n\n\n"
    "class Ticker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('ticker')\n"
    "        self.timer = self.create_timer({}, self.tick, callback_group={})\n\n"
    "    def tick(self):\n"
    "        self.get_clock().sleep_for({})\n"
)
_TIMES = (
    "from builtin_interfaces.msg import Time as Stamp\nfrom rclpy.clock import Clock\n"
    "from rclpy.time import Time\nfrom std_msgs.msg import Header\n\n\n"
    "def wait(seconds):\n"
    "    Clock().sleep_until(Stamp(sec=seconds))\n"
    "    return Header(stamp=Time(seconds=seconds))\n"
)
_SPEAKER = (
    "from rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
    "class Speaker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('speaker')\n"
    "        self.talker = self.create_publisher(String, 'talk', 10)\n"
    "        self.greeting = self.get_parameter('greeting').value\n\n"
    "    def say(self, text):\n"
    "        self.talker.publish(text)\n\n"
    "    def show(self, text):\n"
    "        self.talker.publish(text)\n\n"
    "    def greet(self):\n"
    "        self.say({})\n"
    "        self.show({})\n"
)
_DRIVER = (
    "import serial\nfrom geometry_msgs.msg import Quaternion\n"
    "from tf_transformations import euler_from_quaternion\n\n\n"
    "def drive():\n    q = Quaternion()\n"
    "    serial.Serial('/dev/ttyUSB0').write({})\n"
    "    return euler_from_quaternion({})\n"
)
_RARE = (": debug() fails", ": no argument of this name is declared")
"""The ends of messages about what fails only while debugging, or works with given arguments."""
_RIGHT = ("0.1", "ReentrantCallbackGroup()", "Duration(seconds=1.0)")

_FLEET = (
    "from geometry_msgs.msg import Twist\nfrom rclpy.node import Node\n\n\n"
    "class Fleet(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('fleet')\n"
    "        self.speeds = {{}}\n"
    "        for name in ('left', 'right'):\n"
    "            self.speeds[name] = self.create_publisher(Twist, name, 10)\n\n"
    "    def drive(self):\n"
    "        msg = Twist()\n"
    "        self.speeds['left'].publish({})\n"
)
_TABLE = (
    "from rclpy.node import Node\nfrom std_srvs.srv import Trigger\n\n\n"
    "class Arm(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('arm')\n"
    "        self.add_commands({{'arm': self.on_arm, 'disarm': self.on_disarm}})\n\n"
    "    def add_commands(self, commands):\n"
    "        self.commands = [\n"
    "            self.create_service(Trigger, name, call) for name, call in commands.items()\n"
    "        ]\n\n"
    "    def on_arm(self, request, response):\n        return response\n\n"
    "    def on_disarm(self, {}):\n        return response\n"
)
_HUB = (
    "from rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
    "class Hub(Node):\n"
    "    def __init__(self, topics):\n"
    "        super().__init__('hub')\n"
    "        self.outputs = {name: self.create_publisher(String, name, 10) for name in topics}\n\n"
    "    def send(self, topic, text):\n"
    "        self.outputs[topic].publish(text)\n"
)


class ArgumentTypeUnfit(TypeRule):
    """An argument of a ROS function has the wrong type.

    **Why.** The call fails, at once or when the function uses the argument: ``TypeError: Expected
    <class 'std_msgs.msg._string.String'>, got <class 'str'>``.

    **Fix.** Pass an object of the parameter's type: ``publish(String(data='hello'))``.

    **Source.** The annotations of the packages of ROS 2 Jazzy; the code of pyserial and
    tf_transformations.
    """

    code = "TY005"
    name = "argument-type-unfit"
    other_severities = {
        Severity.WARNING: "the call only logs at debug level, or nothing fails if the user gives a "
        "launch argument"
    }
    kinds = frozenset({"invalid-argument-type", "no-matching-overload"})
    examples = (
        Example(
            "float passed by another package to a method that stores it as text",
            {
                "package.xml": "<package><name>common</name></package>\n",
                "common/__init__.py": "",
                "common/base.py": "from diagnostic_msgs.msg import KeyValue\n"
                "from rclpy.node import Node\n\n\n"
                "class Base(Node):\n    def pair(self, key, value):\n"
                "        return KeyValue(key=key, value=value)\n",
            },
            "common/base.py:7:34: 'value' of diagnostic_msgs.msg.KeyValue is a str, not a float: "
            "it cannot be published",
            neighbors={
                "rover": {
                    "package.xml": "<package><name>rover</name></package>\n",
                    "rover/__init__.py": "",
                    "rover/battery.py": "from sensor_msgs.msg import BatteryState\n\n"
                    "from common.base import Base\n\n\n"
                    "class Battery(Base):\n    def tell(self, msg: BatteryState):\n"
                    "        return self.pair('voltage', msg.voltage)\n\n"
                    "    def watch(self):\n"
                    "        self.create_subscription(BatteryState, 'battery', self.tell, 1)\n",
                }
            },
        ),
        Example(
            "bytes written to a serial port, a list passed to euler_from_quaternion()",
            {"driver.py": _DRIVER.format("b'go'", "[q.x, q.y, q.z, q.w]")},
        ),
        Example(
            "str written to a serial port, Quaternion message passed to euler_from_quaternion()",
            {"driver.py": _DRIVER.format("'go'", "q")},
            "8:41: 'b' of write() must be bytes, not a str: write() fails",
            "9:34: 'quaternion' of euler_from_quaternion() must be a sequence of numbers, not a "
            "geometry_msgs.msg.Quaternion: euler_from_quaternion() fails",
        ),
        Example(
            "a list of actions added at once; a call that lacks an argument",
            {
                "launch/a.launch.py": "from launch import LaunchDescription\n"
                "from launch.actions import LogInfo\n\n\n"
                "def generate_launch_description():\n"
                "    description = LaunchDescription()\n"
                "    description.add_action([LogInfo(msg='a'), LogInfo(msg='b')])\n"
                "    return description\n",
                "record.py": "from rosbag2_py import TopicMetadata\n\n"
                "topic = TopicMetadata('/data', 'std_msgs/msg/String', 'cdr')\n",
            },
            "launch/a.launch.py:7:28: 'action' of add_action() must be a "
            "launch.launch_description_entity.LaunchDescriptionEntity, not a list: the launch "
            "stops when it comes to it",
        ),
        Example(
            "path of an address that may be None, str passed to a method of bytes",
            {
                "upload.py": "import os\nfrom urllib.parse import urlparse\n\nimport rclpy\n\n"
                "rclpy.init()\nplace = urlparse(os.getenv('BUCKET'))\n"
                "print(place.path.strip('/'), b'/'.strip('/'))\n"
            },
            "8:41: strip() of bytes cannot use a str: TypeError; decode() the bytes first",
        ),
        Example(
            "call that a test expects to fail, call that it does not",
            {
                "test/test_driver.py": "import unittest\n\nimport pytest\nimport rclpy\n"
                "import serial\n\n\n"
                "class TestDriver(unittest.TestCase):\n    def test_write(self):\n"
                "        rclpy.init()\n        port = serial.Serial()\n\n"
                "        def write():\n            port.write('go')\n\n"
                "        self.assertRaises(TypeError, write)\n"
                "        self.assertRaises(TypeError, lambda: port.write('go'))\n"
                "        with pytest.raises(TypeError):\n            port.write('go')\n"
                "        port.write('go')\n"
            },
            "20:20: 'b' of write() must be bytes, not a str: write() fails",
        ),
        Example(
            "too many arguments: not reported by this rule",
            {"driver.py": _DRIVER.format("b'go'", "0.0, 0.0, q.z")},
        ),
        Example(
            "Union[int, float] passed to an integer field",
            {
                "limits.py": "from typing import Optional, Union\n\n"
                "from rcl_interfaces.msg import IntegerRange\n\n\n"
                "def limits(low: Optional[Union[int, float]] = None):\n"
                "    if low is not None:\n"
                "        return [IntegerRange(from_value=low, to_value=9)]\n"
                "    return []\n\n\nlimits(0.5)\n"
            },
        ),
        Example(
            "message type from a dictionary with values of different types",
            {
                "listener.py": "from rclpy.node import Node\n"
                "from std_msgs.msg import Int32, String\n\n"
                "THEMES = {\n"
                "    'a': {'topic': 'a', 'type': String},\n"
                "    'b': {'topic': 'b', 'type': Int32},\n}\n\n\n"
                "def listen(node: Node):\n"
                "    for theme in THEMES.values():\n"
                "        node.create_subscription(theme['type'], theme['topic'], print, 10)\n"
            },
        ),
        Example(
            "int passed to a bool parameter",
            {
                "both.py": "from message_filters import ApproximateTimeSynchronizer\n\n\n"
                "def join(first, second):\n"
                "    return ApproximateTimeSynchronizer([first, second], 30, 1, 0)\n"
            },
        ),
        Example(
            "list passed to the logger",
            {
                "talker.py": "from rclpy.node import Node\n\n\nclass Talker(Node):\n"
                "    def show(self, name):\n        words = ['-n', f'{name}']\n"
                "        if name:\n            words.extend(['-v'])\n"
                "        self.get_logger().debug(words)\n        self.get_logger().info(words)\n"
            },
            Report(
                "9:33",
                "'message' of debug() must be a str, not a list: debug() fails",
                severity=Severity.WARNING,
            ),
            "10:32: 'message' of info() must be a str, not a list: info() fails",
        ),
        Example("correct argument types", {"ticker.py": _NODE.format(*_RIGHT)}),
        Example(
            "launch argument description as a tuple of strings",
            {
                "demo.launch.py": "from launch.actions import DeclareLaunchArgument\n\n"
                "MODE = DeclareLaunchArgument('mode', description=('fast,', 'or slow'))\n"
            },
        ),
        Example(
            "goal handle attribute shared by two action servers",
            {
                "mover.py": "from example_interfaces.action import Fibonacci\n"
                "from rclpy.action import ActionServer\nfrom rclpy.node import Node\n"
                "from tf2_msgs.action import LookupTransform\n\n\n"
                "class Mover(Node):\n    def __init__(self):\n        super().__init__('mover')\n"
                "        self.goal = None\n"
                "        ActionServer(self, LookupTransform, 'look', self.run,\n"
                "                     handle_accepted_callback=self.on_look)\n"
                "        ActionServer(self, Fibonacci, 'count', self.run,\n"
                "                     handle_accepted_callback=self.on_count)\n\n"
                "    def on_look(self, goal):\n        self.goal = goal\n\n"
                "    def on_count(self, goal):\n        self.goal = goal\n"
                "        self.goal.publish_feedback(Fibonacci.Feedback())\n\n"
                "    def run(self, goal):\n        goal.succeed()\n        return goal.request\n"
            },
        ),
        Example(
            "wrong type passed through a method of the node",
            {"speaker.py": _SPEAKER.format("String(data='hello')", "'hello'")},
            "15:29: 'msg' of publish() must be a std_msgs.msg.String or bytes, not a str: "
            "publish() fails ('text' comes from line 19)",
        ),
        Example(
            "wrong type passed through a method with an incorrect annotation",
            {
                "speaker.py": _SPEAKER.format("String(data='hello')", "'hello'").replace(
                    "def show(self, text)", "def show(self, text: String)"
                )
            },
            "15:29: 'msg' of publish() must be a std_msgs.msg.String or bytes, not a str: "
            "publish() fails ('text' comes from line 19)",
        ),
        Example(
            "str as the default of a parameter that no caller sets",
            {
                "beat.py": "from rclpy.node import Node\n\n\n"
                "class Beat(Node):\n"
                "    def __init__(self, period='0.5'):\n"
                "        super().__init__('beat')\n"
                "        self.create_timer(period, print)\n\n\n"
                "Beat()\n"
            },
            "7:27: 'timer_period_sec' of create_timer() must be a float, not a str: "
            "create_timer() fails ('period' comes from line 5)",
        ),
        Example(
            "method called with messages and values of unknown type",
            {"speaker.py": _SPEAKER.format("String(data='hello')", "self.greeting")},
        ),
        Example(
            "parameters by prefix, of which a function makes other dictionaries",
            {
                "turn.py": "from geometry_msgs.msg import Quaternion\n"
                "from rclpy.node import Node\n\n\n"
                "class Turner(Node):\n"
                "    def __init__(self, nested):\n"
                "        super().__init__('turner')\n"
                "        self.turns = self.get_parameters_by_prefix('turns')\n"
                "        self.turns = nested(self.turns)\n\n"
                "    def turn(self, name):\n"
                "        return Quaternion(**self.turns[name])\n"
            },
        ),
        Example(
            "tuple of a function unpacked as keywords, header and points swapped",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/turn.py": "import math\n\n\n"
                "def to_tuple(yaw):\n"
                "    return 0.0, 0.0, math.sin(yaw / 2.0), math.cos(yaw / 2.0)\n\n\n"
                "def to_words(yaw):\n"
                "    return {'z': math.sin(yaw / 2.0), 'w': math.cos(yaw / 2.0)}\n",
                "rover/node.py": "from geometry_msgs.msg import Quaternion\n"
                "from sensor_msgs.msg import PointCloud2\n"
                "from sensor_msgs_py import point_cloud2\n\n"
                "from rover.turn import to_tuple, to_words\n\n"
                "ahead = Quaternion(**to_words(0.0))\n"
                "back = Quaternion(**to_tuple(3.1))\n"
                "cloud = PointCloud2()\n"
                "full = point_cloud2.create_cloud_xyz32(cloud.header, [(0.0, 1.0, 2.0)])\n"
                "none = point_cloud2.create_cloud_xyz32([(0.0, 1.0, 2.0)], cloud.header)\n",
            },
            "rover/node.py:8:21: ** needs a dictionary, not a tuple: TypeError",
            "rover/node.py:11:40: 'header' of create_cloud_xyz32() must be a std_msgs.msg.Header, "
            "not a list: create_cloud_xyz32() fails",
            "rover/node.py:11:59: 'points' of create_cloud_xyz32() must be a list, not a "
            "std_msgs.msg.Header: create_cloud_xyz32() fails",
        ),
        Example(
            "isinstance() check before the call",
            {
                "speaker.py": _SPEAKER.format("'hello'", "'hello'").replace(
                    "        self.talker.publish(text)\n",
                    "        if isinstance(text, str):\n            text = String(data=text)\n"
                    "        self.talker.publish(text)\n",
                )
            },
        ),
        Example(
            "header passed instead of its stamp",
            {
                "age.py": "from rclpy.node import Node\nfrom rclpy.time import Time\n"
                "from sensor_msgs.msg import Imu\n\n\n"
                "class Age(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('age')\n"
                "        self.create_subscription(Imu, 'imu', self.on_imu, 10)\n\n"
                "    @staticmethod\n"
                "    def seconds(now, stamp):\n"
                "        return (now - Time.from_msg(stamp)).nanoseconds * 1e-9\n\n"
                "    def on_imu(self, imu: Imu) -> None:\n"
                "        self.age = self.seconds(self.get_clock().now(), imu.header)\n"
            },
            "13:37: 'msg' of from_msg() must be a builtin_interfaces.msg.Time, not a "
            "std_msgs.msg.Header: from_msg() fails ('stamp' comes from line 16)",
        ),
        Example(
            "float and Result published as action feedback",
            {
                "mover.py": "from example_interfaces.action import Fibonacci\n"
                "from rclpy.action import ActionServer\nfrom rclpy.node import Node\n\n\n"
                "class Mover(Node):\n    def __init__(self):\n        super().__init__('mover')\n"
                "        ActionServer(self, Fibonacci, 'count', self.run)\n\n"
                "    def run(self, goal):\n        left = 1.0\n"
                "        step = min(0.5, self.get_parameter('step').value)\n"
                "        while not goal.is_cancel_requested:\n"
                "            left -= step * 0.1\n"
                "            goal.publish_feedback(left)\n"
                "        goal.publish_feedback(Fibonacci.Feedback())\n"
                "        goal.publish_feedback(Fibonacci.Result())\n"
                "        goal.succeed()\n        return Fibonacci.Result()\n"
            },
            "16:35: 'feedback' of publish_feedback() must be an "
            "example_interfaces.action.Fibonacci.Feedback, not a float: publish_feedback() fails",
            "18:31: 'feedback' of publish_feedback() must be an "
            "example_interfaces.action.Fibonacci.Feedback, not an "
            "example_interfaces.action.Fibonacci.Result: publish_feedback() fails",
        ),
        Example(
            "wrong message types passed to publishers, service clients and action clients",
            {
                "talker.py": "from example_interfaces.action import Fibonacci\n"
                "from rclpy.action import ActionClient\n"
                "from rclpy.node import Node\n"
                "from std_msgs.msg import Bool, String\n"
                "from std_srvs.srv import Trigger\n\n\n"
                "class Talker(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('talker')\n"
                "        self.talker = self.create_publisher(String, 'talk', 10)\n"
                "        self.reporter = self.create_client(Trigger, 'report')\n"
                "        self.counter = ActionClient(self, Fibonacci, 'count')\n\n"
                "    def talk(self):\n"
                "        self.talker.publish(String(data='hello'))\n"
                "        self.talker.publish(b'serialized')\n"
                "        self.talker.publish(self.other)\n"
                "        self.reporter.call_async(Trigger.Request())\n"
                "        self.counter.send_goal_async(Fibonacci.Goal(order=3))\n\n"
                "    def fail(self):\n"
                "        self.talker.publish(Bool(data=True))\n"
                "        self.talker.publish('hello')\n"
                "        self.reporter.call_async(Trigger.Response())\n"
                "        self.reporter.call_async(Trigger)\n"
                "        self.counter.send_goal_async(Fibonacci.Goal)\n"
                "        self.counter.send_goal_async(3)\n"
            },
            "23:29: 'msg' of publish() must be a std_msgs.msg.String or bytes, not a "
            "std_msgs.msg.Bool: publish() fails",
            "24:29: 'msg' of publish() must be a std_msgs.msg.String or bytes, not a str: "
            "publish() fails",
            "25:34: 'request' of call_async() must be a std_srvs.srv.Trigger.Request, not a "
            "std_srvs.srv.Trigger.Response: call_async() fails",
            "26:34: 'request' of call_async() must be a std_srvs.srv.Trigger.Request, not the "
            "class 'Trigger': call_async() fails; write Trigger.Request()",
            "27:38: 'goal' of send_goal_async() must be an "
            "example_interfaces.action.Fibonacci.Goal, not the class 'Fibonacci.Goal': "
            "send_goal_async() fails; write Fibonacci.Goal()",
            "28:38: 'goal' of send_goal_async() must be an "
            "example_interfaces.action.Fibonacci.Goal, not an int: send_goal_async() fails",
        ),
        Example(
            "set_parameters() without a list of Parameter objects",
            {
                "talker.py": "from rclpy.node import Node\n"
                "from rclpy.parameter import Parameter\n\n\n"
                "class Talker(Node):\n"
                "    def change(self):\n"
                "        self.set_parameters([Parameter('rate', value=2.0)])\n"
                "        self.set_parameters(Parameter('rate', value=2.0))\n"
                "        self.set_parameters({'rate': 2.0})\n"
                "        self.set_parameters([('rate', 2.0)])\n"
                "        super().__init__('talker', cli_args=[1.0])\n"
            },
            "8:29: 'parameter_list' of set_parameters() must be a list, not an "
            "rclpy.parameter.Parameter: set_parameters() fails",
            "9:29: 'parameter_list' of set_parameters() must be a list, not a dict: "
            "set_parameters() fails",
            "10:29: 'parameter_list' of set_parameters() must be a list of "
            "rclpy.parameter.Parameter, not a list of rclpy.parameter.Parameter or tuple: "
            "set_parameters() fails",
            "11:36: 'cli_args' of Node() must be a list of str, or None, not a list of str or "
            "float: Node() fails",
        ),
        Example(
            "str for a launch option that is only tested for truth",
            {
                "demo.launch.py": "from launch_ros.actions import Node\n\n"
                "NODE = Node(package='demo', executable='talk', emulate_tty='True')\n"
            },
        ),
        Example(
            "launch event handler that returns a list of None",
            {
                "demo.launch.py": "import os\n\nfrom launch.event_handlers import OnShutdown\n\n"
                "FILES = ['a.sdf', 'b.sdf']\n"
                "ENDED = OnShutdown(on_shutdown=lambda event, context: [*map(os.remove, FILES)])\n"
            },
        ),
        Example(
            "launch event handlers that return other values, and a substitution as a name",
            {
                "demo.launch.py": "import subprocess\n\n"
                "from launch.actions import DeclareLaunchArgument\n"
                "from launch.event_handlers import OnProcessExit, OnShutdown\n"
                "from launch.substitutions import LaunchConfiguration\n\n"
                "MODE = DeclareLaunchArgument(LaunchConfiguration('mode'), default_value='a')\n"
                "ENDED = OnShutdown(on_shutdown=lambda event, context: subprocess.run('sync'))\n"
                "LEFT = OnProcessExit(on_exit=lambda event: None)\n"
            },
            Report(
                "7:30",
                "'name' of DeclareLaunchArgument() must be a str, not a "
                "launch.substitutions.launch_configuration.LaunchConfiguration: no "
                "argument of this name is declared",
                severity=Severity.WARNING,
            ),
            "8:20: 'on_shutdown' of OnShutdown() returns a CompletedProcess, not actions or None: "
            "launch fails when it calls the function",
            "9:22: 'on_exit' of OnProcessExit() is called with 2 arguments, but it takes 1: "
            "TypeError",
        ),
        Example(
            "wrong argument types in a launch file",
            {
                "talk.launch.py": "from launch import LaunchDescription\n"
                "from launch.actions import RegisterEventHandler, TimerAction\n"
                "from launch.event_handlers import OnProcessExit\n"
                "from launch_ros.actions import Node\n\n\n"
                "def generate_launch_description():\n"
                "    node = Node(package='a', executable='b', respawn_delay='1')\n"
                "    wait = TimerAction(period=1.0, actions=[node])\n"
                "    ended = OnProcessExit(target_action=wait, on_exit=[])\n"
                "    return LaunchDescription([wait, RegisterEventHandler([ended])])\n"
            },
            "8:46: 'respawn_delay' of Node() must be a float or None, not a str: Node() fails",
            "10:27: 'target_action' of OnProcessExit() must be a "
            "launch.actions.execute_local.ExecuteLocal, function or None, not a "
            "launch.actions.timer_action.TimerAction: OnProcessExit() fails",
            "11:58: 'event_handler' of RegisterEventHandler() must be a "
            "launch.event_handler.BaseEventHandler, not a list: RegisterEventHandler() fails",
        ),
        Example(
            "get_parameter_or() with a plain default for a declared parameter",
            {
                "port.py": "from rclpy.node import Node\n\n"
                "node = Node('port')\nnode.declare_parameter('port', 1)\n"
                "print(node.get_parameter_or('port', 2))\n"
            },
        ),
        Example(
            "wrong message type appended to an array field",
            {
                "way.py": "from geometry_msgs.msg import Pose, PoseStamped\n"
                "from nav_msgs.msg import Path\n\n\n"
                "class Way:\n"
                "    def __init__(self):\n"
                "        self.poses = [PoseStamped()]\n\n"
                "    def path(self):\n"
                "        self.poses.append(Pose())\n"
                "        path = Path()\n"
                "        path.poses.append(PoseStamped())\n"
                "        path.poses.append(Pose())\n"
                "        return path\n"
            },
            "13:27: elements of 'poses' must be a geometry_msgs.msg.PoseStamped, not a "
            "geometry_msgs.msg.Pose: it cannot be published",
        ),
        Example(
            "list with wrong message types passed to a constructor",
            {
                "way.py": "from geometry_msgs.msg import Pose\n"
                "from nav_msgs.msg import Path\n\n\n"
                "def joined(points: list):\n"
                "    poses = [Pose() for _ in points]\n"
                "    return Path(poses=poses)\n"
            },
            "7:17: elements of 'poses' must be a geometry_msgs.msg.PoseStamped, not a "
            "geometry_msgs.msg.Pose: it cannot be published",
        ),
        Example(
            "str instead of a message class, action instead of a matcher function",
            {
                "read.py": "from launch_ros.actions import LifecycleNode\n"
                "from launch_ros.events.lifecycle import ChangeState\n"
                "from rclpy.serialization import deserialize_message\n"
                "from std_msgs.msg import String\n\n\n"
                "def read(data, kinds, reader):\n"
                "    node = LifecycleNode(\n"
                "        name='a', namespace='', package='demo', executable='a')\n"
                "    ChangeState(lifecycle_node_matcher=lambda action: True, transition_id=1)\n"
                "    ChangeState(lifecycle_node_matcher=node, transition_id=1)\n"
                "    deserialize_message(data, kinds['a'])\n"
                "    deserialize_message(data, String)\n"
                "    while reader.has_next():\n"
                "        deserialize_message(data, 'std_msgs/msg/String')\n"
            },
            "11:17: 'lifecycle_node_matcher' of ChangeState() must be a function, not a "
            "launch_ros.actions.lifecycle_node.LifecycleNode: ChangeState() fails",
            "15:35: 'message_type' of deserialize_message() must be a class, not a str: "
            "deserialize_message() fails",
        ),
        Example(
            "synchronized callback that passes CompressedImage to imgmsg_to_cv2()",
            {
                "pair.py": "from cv_bridge import CvBridge\n"
                "from message_filters import Subscriber, TimeSynchronizer\n"
                "from rclpy.node import Node\n"
                "from sensor_msgs.msg import CompressedImage, Image\n\n\n"
                "class Pair(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('pair')\n"
                "        self.bridge = CvBridge()\n"
                "        self.left = Subscriber(self, Image, 'left')\n"
                "        self.right = Subscriber(self, CompressedImage, 'right')\n"
                "        self.pairs = TimeSynchronizer([self.left, self.right], 10)\n"
                "        self.pairs.registerCallback(self.on_pair)\n\n"
                "    def on_pair(self, left, right):\n"
                "        self.bridge.imgmsg_to_cv2(left)\n"
                "        self.bridge.imgmsg_to_cv2(right)\n"
            },
            "18:35: 'img_msg' of imgmsg_to_cv2() must be a sensor_msgs.msg.Image, not a "
            "sensor_msgs.msg.CompressedImage: imgmsg_to_cv2() fails",
        ),
        Example(
            "message passed to json.loads() instead of its data field",
            {
                "orders.py": "import json\n\nfrom rclpy.node import Node\n"
                "from std_msgs.msg import String\n\n\n"
                "class Orders(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('orders')\n"
                "        self.create_subscription(String, 'orders', self.on_order, 10)\n\n"
                "    def on_order(self, msg):\n"
                "        self.order = json.loads(msg)\n"
                "        self.order = json.loads(msg.data)\n"
            },
            "13:33: json.loads() cannot use a std_msgs.msg.String: TypeError; pass its field "
            "'data'",
        ),
        Example(
            "parameter callback with a different annotation",
            {
                "speaker.py": "from rcl_interfaces.msg import Parameter, SetParametersResult\n"
                "from rclpy.node import Node\n\n\n"
                "class Speaker(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('speaker')\n"
                "        self.add_on_set_parameters_callback(self.on_set)\n\n"
                "    def on_set(self, parameters: list[Parameter]) -> SetParametersResult:\n"
                "        return SetParametersResult(successful=bool(parameters))\n"
            },
        ),
        Example(
            "float nanoseconds, which Duration converts to int",
            {
                "period.py": "import rclpy.time\nfrom rclpy.duration import Duration\n\n\n"
                "PERIOD = Duration(seconds=0, nanoseconds=1e9 / 30)\n"
                "TIMEOUT = rclpy.time.Duration(nanoseconds=3e6)\n"
            },
        ),
        Example(
            "keyword arguments unpacked from a dictionary comprehension",
            {
                "read.py": "from sensor_msgs.msg import JoyFeedback\n\n"
                "FIELDS = {'type': int, 'id': int, 'intensity': float}\n\n\n"
                "def read(line):\n"
                "    return JoyFeedback(**{key: kind(line[key]) for key, kind in FIELDS.items()})\n"
            },
        ),
        Example(
            "service clients of different types in a dictionary",
            {
                "reset.py": "from rclpy.node import Node\n"
                "from std_srvs.srv import SetBool, Trigger\n\n\n"
                "class Resetter(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('resetter')\n"
                "        made = []\n"
                "        made.append(self.create_client(Trigger, 'reset'))\n"
                "        self.asked = {'reset': made[-1]}\n"
                "        made.append(self.create_client(SetBool, 'enable'))\n"
                "        self.asked['enable'] = made[-1]\n\n"
                "    def reset(self):\n"
                "        self.asked['reset'].call_async(Trigger.Request())\n"
            },
        ),
        Example(
            "list of nodes passed to add_node()",
            {
                "run.py": "from rclpy.executors import SingleThreadedExecutor\n"
                "from rclpy.node import Node\n\n\n"
                "class Lamp(Node):\n    pass\n\n\n"
                "def run():\n"
                "    executor = SingleThreadedExecutor()\n"
                "    lamps = [Lamp('left'), Lamp('right')]\n"
                "    for lamp in lamps:\n        executor.add_node(lamp)\n"
                "    executor.add_node(lamps)\n"
            },
            "14:23: 'node' of add_node() must be an rclpy.node.Node, not a list: add_node() fails",
        ),
        Example(
            "correct message for a publisher in a dictionary",
            {"fleet.py": _FLEET.format("msg")},
        ),
        Example(
            "field of a message published by a publisher in a dictionary",
            {"fleet.py": _FLEET.format("msg.linear")},
            "14:37: 'msg' of publish() must be a geometry_msgs.msg.Twist or bytes, not a "
            "geometry_msgs.msg.Vector3: publish() fails",
        ),
        Example(
            "str as a timer period, class as a callback group, float as a Duration",
            {"ticker.py": _NODE.format("'0.1'", "ReentrantCallbackGroup", "1.0")},
            "10:40: 'timer_period_sec' of create_timer() must be a float, not a str: "
            "create_timer() fails",
            "10:58: 'callback_group' of create_timer() must be an "
            "rclpy.callback_groups.CallbackGroup or None, not the class 'ReentrantCallbackGroup': "
            "create_timer() fails; write ReentrantCallbackGroup()",
            "13:36: 'rel_time' of sleep_for() must be an rclpy.duration.Duration, not a float: "
            "sleep_for() fails; write Duration(seconds=...)",
        ),
        Example(
            "float as the timeout of transform()",
            {
                "look.py": "import tf2_geometry_msgs\nfrom geometry_msgs.msg import PointStamped\n"
                "from tf2_ros import Buffer\n\n\n"
                "def look(buffer: Buffer):\n"
                "    buffer = Buffer()\n"
                "    return buffer.transform(PointStamped(), 'map', timeout=0.5)\n"
            },
            "8:60: 'timeout' of transform() must be a rclpy.duration.Duration, not a float: "
            "transform() fails; write Duration(seconds=...)",
        ),
        Example(
            "rclpy.time.Time and builtin_interfaces.msg.Time mixed up",
            {"age.py": _TIMES},
            "8:25: 'until' of sleep_until() must be an rclpy.time.Time, not a "
            "builtin_interfaces.msg.Time: sleep_until() fails; write "
            "rclpy.time.Time.from_msg(...)",
            "9:19: 'stamp' of std_msgs.msg.Header is a builtin_interfaces.msg.Time, not an "
            "rclpy.time.Time: it cannot be published; write .to_msg()",
        ),
        Example(
            "publisher whose message type depends on a condition",
            {
                "shooter.py": "from rclpy.node import Node\n"
                "from std_msgs.msg import Empty, Float32\n"
                "\n\nclass Shooter(Node):\n"
                "    def __init__(self, in_simulation):\n"
                "        super().__init__('shooter')\n"
                "        self.in_simulation = in_simulation\n"
                "        if in_simulation:\n"
                "            self.publisher = self.create_publisher(Empty, 'shoot', 10)\n"
                "        else:\n"
                "            self.publisher = self.create_publisher(Float32, 'shoot', 10)\n\n"
                "    def shoot(self):\n"
                "        if self.in_simulation:\n"
                "            self.publisher.publish(Empty())\n"
                "        else:\n"
                "            self.publisher.publish(Float32(data=1.0))\n"
            },
        ),
        Example(
            "wrong message for one of the publishers in a dictionary",
            {
                "state.py": "from rclpy.node import Node\n"
                "from std_msgs.msg import Bool, String\n\n\n"
                "class State(Node):\n"
                "    def start(self):\n"
                "        self.pubs = {\n"
                "            'state': self.create_publisher(String, 'state', 10),\n"
                "            'alarm': self.create_publisher(Bool, 'alarm', 10),\n"
                "        }\n"
                "        self.pubs['state'].publish(String())\n"
                "        self.pubs['state'].publish(Bool())\n"
            },
            "12:36: 'msg' of publish() must be a std_msgs.msg.String or bytes, not a "
            "std_msgs.msg.Bool: publish() fails",
        ),
        Example(
            "object that is not a node passed to TransformListener; a mixin of a node",
            {
                "frames.py": "from rclpy.node import Node\n"
                "from tf2_ros import Buffer, TransformListener\n\n\n"
                "class Frames:\n"
                "    def __init__(self, node):\n"
                "        self.buffer = Buffer()\n"
                "        self.listener = TransformListener(self.buffer, self)\n\n\n"
                "class Finding:\n"
                "    def listen(self):\n"
                "        self.listener = TransformListener(Buffer(), self)\n\n\n"
                "class Robot(Finding, Node):\n"
                "    def find(self):\n"
                "        self.frames = Frames(self)\n"
            },
            "8:56: 'node' of TransformListener() must be an rclpy.node.Node, not a frames.Frames: "
            "TransformListener() fails",
        ),
        Example(
            "Duration as the default of a parameter",
            {
                "pacer.py": "from rclpy.duration import Duration\nfrom rclpy.node import Node\n\n\n"
                "class Pacer(Node):\n"
                "    def declare(self):\n"
                "        self.declare_parameter('period', Duration(seconds=1.0))\n"
                "        self.declare_parameter('names', ['a', 'b'])\n"
            },
            "7:42: 'value' of declare_parameter() cannot be an rclpy.duration.Duration: "
            "declare_parameter() fails",
        ),
        Example(
            "callback from another module without a parameter",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/hearing.py": "def hear():\n    pass\n\n\ndef listen(msg):\n    return msg\n",
                "rover/node.py": "from rclpy.node import Node\n"
                "from rover.hearing import hear, listen\n"
                "from std_msgs.msg import Bool\n\n\n"
                "class Robot(Node):\n"
                "    def start(self):\n"
                "        self.create_subscription(Bool, 'a', hear, 10)\n"
                "        self.create_subscription(Bool, 'b', listen, 10)\n",
            },
            "rover/node.py:8:45: create_subscription() calls the function 'hear' with 1 or 2 "
            "arguments, but it takes 0: TypeError",
        ),
        Example(
            "Duration passed to time.sleep()",
            {
                "pacer.py": "import time\n\nfrom rclpy.duration import Duration\n\n\n"
                "class Pacer:\n"
                "    def __init__(self):\n"
                "        self.period = Duration(seconds=0.1)\n\n"
                "    def wait(self):\n"
                "        time.sleep(self.period)\n"
                "        time.sleep(self.period.nanoseconds / 1e9)\n"
            },
            "11:20: time.sleep() cannot use an rclpy.duration.Duration: TypeError; use "
            ".nanoseconds / 1e9",
        ),
        Example(
            "diagnostic task without the status parameter",
            {
                "wheels.py": "from diagnostic_updater import Updater\n"
                "from rclpy.node import Node\n\n\n"
                "class Wheels(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('wheels')\n"
                "        self.updater = Updater(self)\n"
                "        self.updater.add('left', self.check)\n"
                "        self.updater.add('right', self.look)\n"
                "        self.updater.add('all', self.see)\n\n"
                "    def check(self, stat):\n        return stat\n\n"
                "    def look(self):\n        return self.updater\n\n"
                "    def see(self, *stats):\n        return stats[0]\n"
            },
            "10:35: add() calls the function 'look' with 1 argument, but it takes 0: TypeError",
        ),
        Example(
            "str separator for bytes.split()",
            {
                "port.py": "import serial\nfrom rclpy.node import Node\n\n\n"
                "class Port(Node):\n"
                "    def fields(self):\n"
                "        line = serial.Serial('/dev/ttyUSB0', 9600).readline()\n"
                "        return line.split(',') if line.decode() else []\n"
            },
            "8:27: split() of bytes cannot use a str: TypeError; decode() the bytes first",
        ),
        Example(
            "PoseStamped sent as a transform, Image passed to cv2_to_imgmsg()",
            {
                "odom.py": "from dataclasses import dataclass\n\n"
                "from geometry_msgs.msg import PoseStamped\n"
                "from tf2_ros import TransformBroadcaster\n\n\n"
                "@dataclass\nclass Outputs:\n"
                "    tf: TransformBroadcaster\n    frame: str = 'odom'\n\n\n"
                "def send(node):\n"
                "    outputs = Outputs(TransformBroadcaster(node))\n"
                "    outputs.tf.sendTransform(PoseStamped())\n",
                "gray.py": "from cv_bridge import CvBridge\nfrom sensor_msgs.msg import Image\n\n\n"
                "def gray():\n"
                "    image = CvBridge().imgmsg_to_cv2(Image(), 'mono8')\n"
                "    return CvBridge().cv2_to_imgmsg(Image()), CvBridge().cv2_to_imgmsg(image)\n",
            },
            "gray.py:7:37: 'cvim' of cv2_to_imgmsg() must be a numpy.ndarray, not a "
            "sensor_msgs.msg.Image: cv2_to_imgmsg() fails",
            "odom.py:15:30: 'transform' of sendTransform() must be a "
            "geometry_msgs.msg.TransformStamped or list, not a geometry_msgs.msg.PoseStamped: "
            "sendTransform() fails",
        ),
        Example(
            "dict passed to declare_parameters(), bytes in a str field",
            {
                "lines.py": "import serial\nfrom rclpy.node import Node\n"
                "from std_msgs.msg import Int32, String\n\nDEFAULTS = {'a': 1, 'b': 'c'}\n\n\n"
                "class Lines(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('lines')\n"
                "        self.declare_parameters('', DEFAULTS)\n"
                "        self.declare_parameters('', list(DEFAULTS.items()))\n"
                "        self.port = serial.Serial('/dev/ttyUSB0')\n\n"
                "    def read(self):\n"
                "        line = self.port.readline()\n"
                "        found = {'at': len(line), 'part': len(line) / 2}\n"
                "        return String(data=line) if line else Int32(data=found['at'])\n"
            },
            "11:37: 'parameters' of declare_parameters() must be a list, not a dict: "
            "declare_parameters() fails",
            "18:23: 'data' of std_msgs.msg.String is a str, not bytes: it cannot be published",
        ),
        Example(
            "service callbacks from a dictionary", {"arm.py": _TABLE.format("request, response")}
        ),
        Example(
            "service callback from a dictionary without the request parameter",
            {"arm.py": _TABLE.format("response")},
            "12:48: the callback of create_service() gets 2; one of these functions takes 1: "
            "TypeError when it is called",
        ),
        Example(
            "exception object passed to the logger",
            {
                "driver.py": "from rclpy.node import Node\n\n\n"
                "class Driver(Node):\n"
                "    def read(self, port):\n"
                "        try:\n            port.read()\n"
                "        except OSError as error:\n"
                "            self.get_logger().warning(str(error))\n"
                "        except Exception as error:\n"
                "            self.get_logger().error(error)\n"
            },
            "11:37: 'message' of error() must be a str, not an Exception: error() fails",
        ),
        Example(
            "module variable that is initially None",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/state.py": "from rclpy.node import Node\n\nnode = None\n",
                "rover/main.py": "import rclpy\n\nfrom . import state\n\n"
                "state.node = state.Node('rover')\nrclpy.spin(state.node)\n",
            },
        ),
        Example(
            "str passed to an inherited method that publishes it",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/hub.py": _HUB,
                "rover/speaker.py": "from rover.hub import Hub\n\n\nclass Speaker(Hub):\n"
                "    def tick(self):\n        self.send('say', 'hello')\n",
            },
            "rover/hub.py:11:37: 'msg' of publish() must be a std_msgs.msg.String or bytes, not a "
            "str: publish() fails ('text' comes from line 6 of rover/speaker.py)",
        ),
        Example(
            "publishers of one name in two classes, of a node that each class gets",
            {
                "lamps.py": "from rclpy.node import Node\n"
                "from std_msgs.msg import Bool, String\n\n\n"
                "class Lamp:\n"
                "    def __init__(self, node):\n"
                "        self._node = node\n"
                "        self.start()\n\n"
                "    def start(self):\n"
                "        self.output = self._node.create_publisher(Bool, 'lamp', 10)\n"
                "        self.output.publish(True)\n"
                "        self._node.count_lamps()\n\n\n"
                "class Text:\n"
                "    def __init__(\n"
                "        self,\n"
                "        node: Node,\n"
                "    ):\n"
                "        self.node = node\n"
                "        self.output = self.node.create_publisher(String, 'text', 10)\n\n"
                "    def show(self):\n"
                "        self.output.publish(String())\n"
                "        self.output.publish(Bool())\n"
            },
            "12:29: 'msg' of publish() must be a std_msgs.msg.Bool or bytes, not a bool: "
            "publish() fails",
            "26:29: 'msg' of publish() must be a std_msgs.msg.String or bytes, not a "
            "std_msgs.msg.Bool: publish() fails",
        ),
    )

    def judge(self, finding: TypeFinding) -> Diagnostic | None:
        if finding.kind == "no-matching-overload":
            return self._judge_overload(finding)
        unpacked = finding.match(r"Argument expression after \*\* .*: Found `(?P<type>[^`]+)`")
        if unpacked is not None:
            if not is_certain(unpacked["type"]):
                return None
            given = in_words(unpacked["type"])
            return self.report(finding, f"** needs a dictionary, not {given}: TypeError")
        problem = argument_problem(finding)
        severity = Severity.WARNING if problem.endswith(_RARE) else None
        return self.report(finding, problem, severity=severity) if problem else None

    def _judge_overload(self, finding: TypeFinding) -> Diagnostic | None:
        """Judge a timeout: the type checker does not name the argument of a wrong type."""
        call = finding.node(ast.Call)
        matched = finding.match(rf"No overload of .*`{MARKED}\.(?P<name>\w+)` matches arguments")
        if call is None or matched is None or matched["name"] not in TIMEOUTS:
            return None
        value = argument_of(call, "timeout", TIMEOUTS[matched["name"]])
        if not (isinstance(value, ast.Constant) and type(value.value) in {int, float}):
            return None
        name, kind = matched["name"], with_article(type(value.value).__name__)
        return self.report(
            finding.module.location(value),
            f"'timeout' of {name}() must be a rclpy.duration.Duration, not {kind}: {name}() fails; "
            "write Duration(seconds=...)",
        )
