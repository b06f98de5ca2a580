"""TY004: calls pass the arguments that functions of ROS and of the workspace expect."""

from __future__ import annotations

import ast

from scaffold.api import Diagnostic, Example, Report, TypeRule
from scaffold.api.types import TypeFinding

from ._call_problems import call_fix, call_problem, outcome

_OLD_KEYWORDS = frozenset({"node_name", "node_namespace", "node_executable"})
"""The keywords that launch_ros renamed in Foxy."""
_NODE = (
    "from rclpy.node import Node\n\n\n"
    "class Ticker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('ticker')\n"
    "        self.timer = self.create_timer({})\n\n"
    "    def tick(self):\n"
    "        pass\n"
)
_SERVER = (
    "import sys\n\nimport rclpy\nfrom rclpy.node import Node\n\n\n"
    "def main():\n"
    "    rclpy.init({}sys.argv)\n"
    "    node = Node('server')\n"
    "    rclpy.spin_once(node{})\n"
)
_TALKER = (
    "from rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
    "class Talker(Node):\n"
    "    def start(self):\n"
    "        self.talker = self.create_publisher(String, 'talk', {}=10)\n"
)
_BUTTON = (
    "from std_msgs.msg import Bool\n\n\n"
    "class Button:\n"
    "    def __init__(self, node, on_press, on_release=None, on_hold=None, is_long=True):\n"
    "        self.on_press = on_press\n"
    "        self.on_release = on_release\n"
    "        self.on_hold = on_hold\n"
    "        self.is_long = is_long\n"
    "        node.create_subscription(Bool, 'button', self.hear, 10)\n\n"
    "    def hear(self, msg):\n"
    "        if msg.data:\n"
    "            self.on_press(msg.data)\n"
    "        elif self.on_release is not None:\n"
    "            self.on_release()\n"
    "        if self.is_long:\n"
    "            self.on_hold(msg.data)\n"
    "        else:\n"
    "            self.on_hold()\n"
)
_PANEL = (
    "import rclpy\nfrom rclpy.node import Node\n\nfrom rover.button import Button\n\n\n"
    "class Panel(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('panel')\n"
    "        self.start = Button(self, self.on_start)\n"
    "        self.stop = Button(self, print, self.on_stop, on_hold=self.on_hold, is_long=False)\n\n"
    "    def on_start(self{}):\n        pass\n\n"
    "    def on_stop(self{}):\n        pass\n\n"
    "    def on_hold(self):\n        pass\n\n\n"
    "def main():\n    rclpy.init()\n    rclpy.spin(Panel())\n"
)
_LOG = (
    "from rclpy.node import Node\nfrom sensor_msgs.msg import BatteryState\n\n\n"
    "class Battery(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('battery')\n"
    "        self.log = self.get_logger().info\n"
    "        self.create_subscription(BatteryState, 'battery', self.on_battery, 10)\n\n"
    "    def on_battery(self, message):\n"
    "        self.log({})\n"
)


class ArgumentsUnfit(TypeRule):
    """A call lacks an argument, or has one too many or an unknown one.

    The function belongs to ROS or to another module of the workspace.

    **Why.** The call fails: ``TypeError: create_timer() missing 1 required positional argument:
    'callback'``.

    **Fix.** Pass the arguments that the function takes in ROS 2 Jazzy.

    **Source.** The signatures of the packages of ROS 2 Jazzy.
    """

    code = "TY004"
    name = "arguments-unfit"
    kinds = frozenset(
        {
            "missing-argument",
            "too-many-positional-arguments",
            "unknown-argument",
            "parameter-already-assigned",
            "positional-only-parameter-as-kwarg",
            "no-matching-overload",
        }
    )
    examples = (
        Example(
            "an argument of ROS 1",
            {
                "server.py": "from example_interfaces.action import Fibonacci\n"
                "from rclpy.action import ActionServer\nfrom rclpy.node import Node\n\n\n"
                "class Server(Node):\n    def __init__(self):\n"
                "        super().__init__('server')\n"
                "        self.server = ActionServer(\n"
                "            self, Fibonacci, 'count', self.run, execute_cb=self.run)\n\n"
                "    def run(self, goal):\n        return Fibonacci.Result()\n",
            },
            "10:49: ActionServer() has no argument 'execute_cb' (did you mean "
            "'execute_callback'?): TypeError",
        ),
        Example(
            "method replaced by a mock in a test",
            {
                "test/test_asker.py": "from unittest.mock import patch\n\n"
                "from rclpy.node import Node\n\n\n"
                "def test_it(monkeypatch):\n"
                "    node = Node('asker')\n"
                "    monkeypatch.setattr(node, 'create_timer', print)\n"
                "    node.create_timer()\n"
                "    with patch.object(node, 'create_client') as client:\n"
                "        node.create_client('reset')\n"
                "        client.assert_called_once()\n"
            },
        ),
        Example(
            "logger called with an f-string",
            {"battery.py": _LOG.format("f'voltage {message.voltage}'")},
        ),
        Example(
            "logger called with several arguments, like print()",
            {"battery.py": _LOG.format("'voltage', message.voltage")},
            "12:29: info() of a logger takes 1 positional argument, not 2: TypeError",
        ),
        Example(
            "overloaded can_transform()",
            {
                "look.py": "from rclpy.time import Time\nfrom tf2_ros.buffer import Buffer\n\n\n"
                "def look(buffer: Buffer):\n"
                "    known = Buffer()\n"
                "    known.can_transform('map', 'base_link', Time())\n"
                "    known.can_transform('map', 'base_link', time=Time())\n"
                "    known.can_transform('map', 'base_link')\n"
                "    known.can_transform('map', 'base_link', Time(), wait=True)\n"
            },
            "9:5: can_transform() lacks 'time': TypeError",
            "10:5: can_transform() has no argument 'wait': TypeError",
        ),
        Example(
            "imported name replaced by a later import",
            {
                "spawn.py": "from rclpy.node import Node\n"
                "from gz.transport14 import Node\n\n\n"
                "def spawn():\n    return Node()\n"
            },
        ),
        Example(
            "method replaced by an attribute of the same name",
            {
                "microphone.py": "from rclpy.node import Node\n\n\n"
                "class Microphone(Node):\n"
                "    def __init__(self, callback=None):\n"
                "        super().__init__('microphone')\n"
                "        self.callback = callback\n\n"
                "    def callback(self, data, count):\n"
                "        self.callback(data)\n"
            },
        ),
        Example(
            "function that is redefined with other parameters",
            {
                "spawn.py": "import rclpy\n\n\n"
                "def spawn(name):\n    return rclpy.create_node(name)\n\n\n"
                "def spawn(name, count):\n    return [rclpy.create_node(name)] * count\n\n\n"
                "def main():\n    return spawn('talker', 2)\n"
            },
        ),
        Example("correct arguments", {"ticker.py": _NODE.format("0.1, self.tick")}),
        Example(
            "class as the default of a parameter",
            {
                "sensor.py": "from rclpy.node import Node\n\n\n"
                "class Sensor:\n"
                "    def __init__(self, node=Node):\n"
                "        self.node = node\n"
                "        self.name = self.node.get_name()\n"
                "        self.time = self.node.get_parameter('time')\n"
            },
        ),
        Example(
            "function from a dictionary that also contains classes",
            {
                "sensors.py": "from sensor_msgs.msg import Image, Imu\n\n\n"
                "class Sensors:\n"
                "    def __init__(self):\n"
                "        self.sensors = {\n"
                "            'camera': {'type': Image, 'show': self.show},\n"
                "            'imu': {'type': Imu, 'show': self.show},\n"
                "        }\n\n"
                "    def show(self, name):\n"
                "        print(self.sensors[name]['show'](name))\n"
            },
        ),
        Example(
            "removed launch_ros keywords, which LF017 reports",
            {
                "launch/a.launch.py": "from launch_ros.actions import LifecycleNode\n\n"
                "driver = LifecycleNode(package='a', executable='b', node_name='c', namespace='')\n"
            },
        ),
        Example(
            "instance method called on the class",
            {
                "name.py": "from rclpy.node import Node\n\nprint(Node.get_name())\n"
                "Node.get_logger().info('late')\n"
            },
            "3:7: get_name() lacks 'self': TypeError",
            "4:1: get_logger() lacks 'self': TypeError",
        ),
        Example(
            "method and constructor from another module",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/paths.py": "class Path:\n    def __init__(self, width):\n"
                "        self.width = width\n\n    def grow(self, by=1.0):\n"
                "        self.width += by\n",
                "rover/plan.py": "from geometry_msgs.msg import Point\n\n"
                "from .paths import Path\n\n"
                "path = Path(2.0)\npath.grow()\npath.grow(2.0, Point())\nwide = Path()\n",
            },
            "rover/plan.py:7:16: grow() takes 1 positional argument at most, not 2: TypeError",
            "rover/plan.py:8:8: Path() lacks 'width': TypeError",
        ),
        Example(
            "constructors of dataclasses and named tuples",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/plane.py": "from dataclasses import dataclass\n"
                "from typing import NamedTuple\n\nfrom .others import Base\n\n\n"
                "class Pose2D(NamedTuple):\n    x: float\n    theta: float\n\n\n"
                "@dataclass\nclass Limits:\n    speed: float = 0.5\n\n\n"
                "@dataclass\nclass Unknown(Base):\n    speed: float = 0.5\n",
                "rover/plan.py": "from geometry_msgs.msg import Point\n\n"
                "from .plane import Limits, Pose2D, Unknown\n\n"
                "points = [Point()]\nposes = [Pose2D(point.x) for point in points]\n"
                "limits = Limits(max_speed=1.0)\nlimits = Limits(0.5)\n"
                "pose = Pose2D(1.0, 2.0, 3.0)\nother = Unknown(max_speed=1.0)\n",
            },
            "rover/plan.py:6:10: Pose2D() lacks 'theta': TypeError",
            "rover/plan.py:7:17: Limits() has no argument 'max_speed': TypeError",
            "rover/plan.py:9:25: Pose2D() takes 2 positional arguments at most, not 3: TypeError",
        ),
        Example(
            "class whose base class defines __new__()",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/later.py": "class Later:\n    def __new__(cls, **values):\n"
                "        return cls.LATER(cls, values)\n",
                "rover/servo.py": "from .later import Later\n\n\nclass Servo(Later):\n"
                "    def __init__(self, bus, angle):\n        self.bus = bus\n",
                "rover/arm.py": "from geometry_msgs.msg import Point\n\n"
                "from .servo import Servo\n\nplace = Point()\nservo = Servo(angle=360)\n",
            },
        ),
        Example(
            "callbacks that an object keeps, one of them depending on another attribute",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/button.py": _BUTTON,
                "rover/panel.py": _PANEL.format(", data", ""),
            },
        ),
        Example(
            "callbacks that an object keeps, without and with too many parameters",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/button.py": _BUTTON,
                "rover/panel.py": _PANEL.format("", ", why"),
            },
            "rover/button.py:14:27: self.on_press() passes 1 argument, but 'on_start' from line "
            "10 of rover/panel.py takes 0: TypeError",
            "rover/button.py:16:13: self.on_release() passes 0 arguments, but 'on_stop' from line "
            "11 of rover/panel.py takes 1: TypeError",
        ),
        Example(
            "missing argument",
            {"ticker.py": _NODE.format("0.1")},
            "7:22: create_timer() lacks 'callback': TypeError",
        ),
        Example(
            "too many positional arguments",
            {"ticker.py": _NODE.format("0.1, self.tick, None, None, True, False")},
            "7:74: create_timer() takes 5 positional arguments at most, not 6: TypeError",
        ),
        Example(
            "argument passed both by position and by keyword",
            {"ticker.py": _NODE.format("0.1, self.tick, timer_period_sec=0.2")},
            "7:56: create_timer() gets 'timer_period_sec' twice: TypeError",
        ),
        Example(
            "keyword-only arguments of rclpy passed by position",
            {"server.py": _SERVER.format("", ", 0.1")},
            Report(
                "8:16",
                "init() takes no positional argument, not 1 (as keywords: args, "
                "context, domain_id, signal_handler_options): TypeError",
                fix="Pass the argument as args=",
            ),
            Report(
                "10:27",
                "spin_once() takes 1 positional argument at most, not 2 (as keywords: "
                "executor, timeout_sec): TypeError",
                fix="Pass the argument as timeout_sec=",
            ),
            fixed={"server.py": _SERVER.format("args=", ", timeout_sec=0.1")},
        ),
        Example(
            "mixin for nodes without a QoS profile; a wrapper of an unknown object",
            {
                "mixins.py": "from std_msgs.msg import Bool\n\n\n"
                "class Stopping:\n"
                "    def listen(self):\n"
                "        self.create_subscription(Bool, 'stop', self.stop)\n\n"
                "    def stop(self, msg):\n        self.pub.publish(msg)\n\n\n"
                "class Starting:\n"
                "    def __init__(self, port):\n        self.port = port\n\n"
                "    def listen(self):\n"
                "        self.port.create_subscription(Bool, 'start')\n"
            },
            "6:9: create_subscription() lacks 'qos_profile': TypeError",
        ),
        Example(
            "ApproximateTimeSynchronizer without slop",
            {
                "pairs.py": "import message_filters\n\n\n"
                "def pairs(left: message_filters.Subscriber):\n"
                "    return message_filters.ApproximateTimeSynchronizer([left], queue_size=10)\n"
            },
            "5:12: ApproximateTimeSynchronizer() lacks 'slop': TypeError",
        ),
        Example(
            "queue_size, the ROS 1 name of the QoS depth",
            {"talker.py": _TALKER.format("queue_size")},
            Report(
                "7:61",
                "create_publisher() has no argument 'queue_size', which is "
                "qos_profile= in ROS 2: TypeError",
                fix="Replace the keyword with qos_profile=",
            ),
            fixed={"talker.py": _TALKER.format("qos_profile")},
        ),
        Example(
            "fallbacks for older distributions: except TypeError, inspect.signature()",
            {
                "server.py": "import inspect\n\nfrom rclpy.node import Node\n"
                "from std_srvs.srv import Trigger\n\n\n"
                "class Server(Node):\n"
                "    def serve(self):\n"
                "        try:\n"
                "            self.create_service(Trigger, 'a', print, introspection=True)\n"
                "        except TypeError:\n"
                "            self.create_service(Trigger, 'a', print)\n"
                "        try:\n"
                "            self.b = self.create_service(Trigger, 'b', print, lazy=True)\n"
                "        except Exception:\n"
                "            self.b = self.create_service(Trigger, 'b', print)\n"
                "        if 'lazy' in inspect.signature(self.create_service).parameters:\n"
                "            self.create_service(Trigger, 'c', print, lazy=True)\n"
            },
        ),
        Example(
            "unknown keyword in a try block with except Exception",
            {
                "server.py": "from rclpy.node import Node\n"
                "from std_srvs.srv import Trigger\n\n\n"
                "class Server(Node):\n"
                "    def serve(self):\n"
                "        try:\n"
                "            self.create_service(Trigger, 'a', print, lazy=True)\n"
                "        except Exception as error:\n"
                "            self.get_logger().error(str(error))\n"
            },
            "8:54: create_service() has no argument 'lazy': TypeError",
        ),
        Example(
            "misspelled field in a message constructor",
            {
                "say.py": "from std_msgs.msg import String\n\n\n"
                "def said(text):\n    return String(dta=text)\n"
            },
            "5:19: String() has no argument 'dta' (did you mean 'data'?): the value is silently "
            "dropped",
        ),
        Example(
            "unknown keyword argument",
            {"ticker.py": _NODE.format("0.1, self.tick, oneshot=True")},
            "7:56: create_timer() has no argument 'oneshot': TypeError",
        ),
        Example(
            "wrong number of arguments for stat.add() in diagnostic tasks",
            {
                "battery.py": "from diagnostic_updater import DiagnosticTask, Updater\n\n\n"
                "class Battery(DiagnosticTask):\n"
                "    def run(self, stat):\n"
                "        stat.summary(b'\\0', 'fine')\n"
                "        stat.add('voltage: 12.1')\n"
                "        return stat\n\n\n"
                "def load(stat):\n    stat.add('load', '0.5', 1)\n    return stat\n\n\n"
                "def report(node):\n"
                "    updater = Updater(node)\n"
                "    updater.add(Battery('battery'))\n"
                "    updater.add('load', load)\n"
            },
            "7:9: add() lacks 'val': TypeError",
            "12:29: add() takes 2 positional arguments at most, not 3: TypeError",
        ),
    )

    def judge(self, finding: TypeFinding) -> Diagnostic | None:
        if _is_old(finding):
            return None  # LF017 reports the current keywords
        problem = call_problem(finding)
        if not problem:
            return None
        called = problem.partition("()")[0]
        cause = f"arguments of {called}" if called != problem else ""
        message = f"{problem}: {outcome(finding)}"
        return self.report(finding, message, call_fix(finding), cause=cause)


def _is_old(finding: TypeFinding) -> bool:
    """Return whether a finding is about a call with removed keywords, or its arguments."""
    line = finding.location.line
    return any(
        word.arg in _OLD_KEYWORDS
        for call in finding.module.walk(ast.Call)
        if call.lineno <= line <= (call.end_lineno or line)
        for word in call.keywords
    )
