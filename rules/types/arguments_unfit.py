"""TY004: calls have the arguments that functions of ROS, and one's own, take."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Sequence

from scaffold.api import Diagnostic, Edit, Example, Fix, Report, TypeRule, closest_name
from scaffold.api.rclpy import LOG_METHODS, is_of_rclpy, rclpy_file
from scaffold.api.types import (
    MARKED,
    TypeFinding,
    keywords,
    overload_problem,
    parameters,
    short_name,
)

_OLD_KEYWORDS = frozenset({"node_name", "node_namespace", "node_executable"})
"""What launch_ros calls otherwise since Foxy."""
_CALLEE = rf"(?:[a-z]+ )*`(?P<callee>(?:{MARKED}|[^\W\d]\w*)(?:\.\w+)?)`"
_OF_ROS1 = "queue_size"
"""What ROS 1 calls the depth of publishers and subscriptions."""
_UNBOUND = re.compile(r" of function `[^`.]+\.")
"""Matches a method that is called on its class."""
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

    **Why.** ``TypeError: create_timer() missing 1 required positional argument: 'callback'`` as
    soon as the line runs.

    **Fix.** Write the arguments that the function of ROS 2 Jazzy takes.

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
            "a method that a test replaces",
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
            "a method of a logger with another name",
            {"battery.py": _LOG.format("f'voltage {message.voltage}'")},
        ),
        Example(
            "the same called like print",
            {"battery.py": _LOG.format("'voltage', message.voltage")},
            "12:29: info() of a logger takes 1 positional argument, not 2: TypeError",
        ),
        Example(
            "a function with several signatures",
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
            "a name that is imported anew",
            {
                "spawn.py": "from rclpy.node import Node\n"
                "from gz.transport14 import Node\n\n\n"
                "def spawn():\n    return Node()\n"
            },
        ),
        Example(
            "a function that is defined again",
            {
                "spawn.py": "import rclpy\n\n\n"
                "def spawn(name):\n    return rclpy.create_node(name)\n\n\n"
                "def spawn(name, count):\n    return [rclpy.create_node(name)] * count\n\n\n"
                "def main():\n    return spawn('talker', 2)\n"
            },
        ),
        Example("the arguments it takes", {"ticker.py": _NODE.format("0.1, self.tick")}),
        Example(
            "a variable that is a class by default only",
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
            "an entry of a dictionary with classes and functions",
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
            "keywords of an old release, which LF017 reports",
            {
                "launch/a.launch.py": "from launch_ros.actions import LifecycleNode\n\n"
                "driver = LifecycleNode(package='a', executable='b', node_name='c', namespace='')\n"
            },
        ),
        Example(
            "a method of a class",
            {
                "name.py": "from rclpy.node import Node\n\nprint(Node.get_name())\n"
                "Node.get_logger().info('late')\n"
            },
            "3:7: get_name() lacks 'self': TypeError",
            "4:1: get_logger() lacks 'self': TypeError",
        ),
        Example(
            "a function and a class of another module",
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
            "a class whose base makes other objects, in a module of its own",
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
            "one missing",
            {"ticker.py": _NODE.format("0.1")},
            "7:22: create_timer() lacks 'callback': TypeError",
        ),
        Example(
            "one too many",
            {"ticker.py": _NODE.format("0.1, self.tick, None, None, True, False")},
            "7:74: create_timer() takes 5 positional arguments at most, not 6: TypeError",
        ),
        Example(
            "one given twice",
            {"ticker.py": _NODE.format("0.1, self.tick, timer_period_sec=0.2")},
            "7:56: create_timer() gets 'timer_period_sec' twice: TypeError",
        ),
        Example(
            "arguments of rclpy without their names",
            {"server.py": _SERVER.format("", ", 0.1")},
            Report(
                "8:16",
                "init() takes no positional argument, not 1 (as keywords: args, "
                "context, domain_id, signal_handler_options): TypeError",
                fix="pass it as args=",
            ),
            Report(
                "10:27",
                "spin_once() takes 1 positional argument at most, not 2 (as "
                "keywords: executor, timeout_sec): TypeError",
                fix="pass it as timeout_sec=",
            ),
            fixed={"server.py": _SERVER.format("args=", ", timeout_sec=0.1")},
        ),
        Example(
            "the depth as ROS 1 names it",
            {"talker.py": _TALKER.format("queue_size")},
            Report(
                "7:61",
                "create_publisher() has no argument 'queue_size', which is "
                "qos_profile= in ROS 2: TypeError",
                fix="write qos_profile=",
            ),
            fixed={"talker.py": _TALKER.format("qos_profile")},
        ),
        Example(
            "tried, and asked for: an older distribution is kept",
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
            "a failure that a handler of anything hides",
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
            "an unknown one",
            {"ticker.py": _NODE.format("0.1, self.tick, oneshot=True")},
            "7:56: create_timer() has no argument 'oneshot': TypeError",
        ),
    )

    def judge(self, finding: TypeFinding) -> Diagnostic | None:
        if _is_old(finding):
            return None  # LF017 says what its keywords are called today
        if _UNBOUND.search(finding.message) and not _is_of_class(finding):
            return None
        problem = (
            _missing(finding)
            or _too_many(finding)
            or _too_many_to_log(finding)
            or _unknown(finding)
            or _repeated(finding)
            or _of_no_overload(finding)
        )
        if not problem:
            return None
        called = problem.partition("()")[0]
        cause = f"arguments of {called}" if called != problem else ""
        return self.report(finding, f"{problem}: TypeError", _fix(finding), cause=cause)


def _fix(finding: TypeFinding) -> Fix | None:
    """Return the fix that names an argument as the function does, where that is certain."""
    matched = finding.match(rf"Too many positional arguments to {_CALLEE}: .*")
    if matched is not None:
        names = keywords(finding.package, matched["callee"])
        return _as_keyword(finding, names, int("." in matched["callee"]))
    depth = _depth(finding)
    if depth is None or not isinstance(depth.value, ast.Constant):
        return None
    start, _ = finding.module.span(depth)
    edit = Edit(finding.path, start, start + len(_OF_ROS1), "qos_profile")
    return Fix("write qos_profile=", (edit,))


def _as_keyword(finding: TypeFinding, names: Sequence[str], bound: int) -> Fix | None:
    """Return the fix that makes the last positional argument of a call a keyword argument."""
    matched = finding.match(r".*: expected (?P<most>\d+), got .*")
    for call in finding.parents():
        if isinstance(call, ast.Call) and matched is not None:
            is_last = len(call.args) == int(matched["most"]) - bound + 1
            name = _meant(finding, call.args[-1], names) if is_last else ""
            if not name or any(word.arg in {name, None} for word in call.keywords):
                return None
            start, _ = finding.module.span(call.args[-1])
            return Fix(f"pass it as {name}=", (Edit(finding.path, start, start, f"{name}="),))
    return None


def _meant(finding: TypeFinding, node: ast.expr, names: Sequence[str]) -> str:
    """Return the name of the parameter that a value is for; empty if that is not certain."""
    match node:
        case ast.Name(id=name) if name in names:
            return name
        case ast.Constant(value=int() | float()):
            periods = [name for name in names if name.endswith("_sec")]
            return periods[0] if len(periods) == 1 else ""
    is_command_line = finding.module.qualified_name(node) == "sys.argv"
    return "args" if is_command_line and "args" in names else ""


def _depth(finding: TypeFinding) -> ast.keyword | None:
    """Return the keyword that is a depth as ROS 1 names it, in a call without another one."""
    matched = finding.match(rf"Argument `{_OF_ROS1}` does not match any .* of {_CALLEE}")
    call = next((node for node in finding.parents() if isinstance(node, ast.Call)), None)
    if matched is None or call is None:
        return None
    names = parameters(finding.package, matched["callee"])
    given = {*names[: len(call.args)], *(word.arg for word in call.keywords)}
    if "qos_profile" not in names or "qos_profile" in given:
        return None
    return next((word for word in call.keywords if word.arg == _OF_ROS1), None)


def _shown(callee: str) -> str:
    """Return how a call is written: ``create_timer()``, ``TransformListener()``."""
    owner, _, method = callee.rpartition(".")
    name = owner if method in {"__init__", "__new__"} else method
    return f"{short_name(name)}()"


def _missing(finding: TypeFinding) -> str:
    matched = finding.match(
        rf"No arguments? provided for required parameters? (?P<names>.+) of {_CALLEE}"
    )
    if matched is None:
        return ""
    if any(
        overload_problem(finding.package, matched["callee"], call).startswith("takes")
        for call in _calls(finding)
    ):
        return ""  # they may be among those that are too many, which is reported
    if any(word.arg == _OF_ROS1 for call in _calls(finding) for word in call.keywords):
        return ""  # the depth is given, which is reported
    names = [repr(name) for name in re.findall(r"`(\w+)`", matched["names"])]
    return f"{_shown(matched['callee'])} lacks {' and '.join(names)}"


def _calls(finding: TypeFinding) -> Iterator[ast.Call]:
    """Yield the call that a finding is about, or those that start where it does."""
    module, at = finding.module, finding.location
    calls = [call for call in module.walk(ast.Call) if module.location(call)[1:3] == at[1:3]]
    whole = [call for call in calls if module.exact_location(call) == at]
    yield from whole or calls


def _is_old(finding: TypeFinding) -> bool:
    """Tell whether a finding is about a call with keywords that are gone, or its arguments."""
    line = finding.location.line
    return any(
        word.arg in _OLD_KEYWORDS
        for call in finding.module.walk(ast.Call)
        if call.lineno <= line <= (call.end_lineno or line)
        for word in call.keywords
    )


def _is_of_class(finding: TypeFinding) -> bool:
    """Tell whether a method is called on a class by its name.

    A variable may hold an object as well: one that is a class by default, for instance.
    """
    return any(
        isinstance(call.func, ast.Attribute) and finding.module.qualified_name(call.func.value)
        for call in _calls(finding)
    )


def _too_many(finding: TypeFinding) -> str:
    matched = finding.match(
        rf"Too many positional arguments to {_CALLEE}: expected (?P<most>\d+), got (?P<count>\d+)"
    )
    if matched is None:
        return ""
    is_method = "." in matched["callee"]
    most, count = (int(matched[key]) - is_method for key in ("most", "count"))
    arguments = "argument" if most == 1 else "arguments"
    takes = f"{most} positional {arguments} at most" if most else "no positional argument"
    names = keywords(finding.package, matched["callee"])
    hint = f" (as keywords: {', '.join(names)})" if names else ""
    return f"{_shown(matched['callee'])} takes {takes}, not {count}{hint}"


def _too_many_to_log(finding: TypeFinding) -> str:
    """Return what is wrong with the call of an attribute that is a method of a logger."""
    matched = finding.match(r"Too many positional arguments: expected 1, got (?P<count>\d+)")
    call = next((node for node in finding.parents() if isinstance(node, ast.Call)), None)
    if matched is None or call is None:
        return ""
    file = rclpy_file(finding.package, finding.path)
    match file.evaluator.single_value(call.func):
        case ast.Attribute(attr=method, value=logger) if method in LOG_METHODS:
            match file.evaluator.single_value(logger):
                case ast.Call(func=ast.Attribute(attr="get_logger") as made) if is_of_rclpy(
                    file, made
                ):
                    return (
                        f"{method}() of a logger takes 1 positional argument, "
                        f"not {matched['count']}"
                    )
    return ""


def _unknown(finding: TypeFinding) -> str:
    matched = finding.match(
        rf"Argument `(?P<name>\w+)` does not match any known parameter of {_CALLEE}"
    )
    if matched is None:
        return ""
    callee = matched["callee"]
    names = [*parameters(finding.package, callee), *keywords(finding.package, callee)]
    if _depth(finding) is not None:
        return f"{_shown(callee)} has no argument {_OF_ROS1!r}, which is qos_profile= in ROS 2"
    closest = closest_name(finding.package, matched["name"], names, 0.6)
    hint = f" (did you mean {closest!r}?)" if closest else ""
    return f"{_shown(callee)} has no argument {matched['name']!r}{hint}"


def _repeated(finding: TypeFinding) -> str:
    matched = finding.match(rf"Multiple values provided for parameter `(?P<name>\w+)` of {_CALLEE}")
    if matched is None:
        return ""
    return f"{_shown(matched['callee'])} gets {matched['name']!r} twice"


def _of_no_overload(finding: TypeFinding) -> str:
    matched = finding.match(rf"No overload of {_CALLEE} matches arguments")
    call = finding.node(ast.Call)
    if matched is None or call is None:
        return ""
    problem = overload_problem(finding.package, matched["callee"], call)
    return f"{_shown(matched['callee'])} {problem}" if problem else ""
