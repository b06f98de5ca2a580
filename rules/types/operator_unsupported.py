"""TY006: operators support their operands."""

from __future__ import annotations

import ast
import re
from collections.abc import Sequence

from scaffold.api import Diagnostic, Example, TypeRule
from scaffold.api.types import MARK, TypeFinding, class_in, full_name, in_words, is_certain

from ._operands import are_sure

_ARRAY_OF_NUMPY = f"ndarray{MARK}numpy"
_NODE = (
    "from rclpy.duration import Duration\nfrom rclpy.node import Node\n\n\n"
    "class Ticker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('ticker')\n"
    "        self.start = self.get_clock().now()\n\n"
    "    def tick(self):\n"
    "        return self.get_clock().now() - self.start > {}\n"
)
_SCAN = (
    "import numpy\nfrom sensor_msgs.msg import LaserScan\n\n\n"
    "def far(scan: LaserScan):\n"
    "    scan = LaserScan()\n"
    "    ranges = scan.ranges\n"
    "    is_far = {0} > 0.5\n"
    "    return is_far, {0} * 0.1\n"
)
_SPEED = (
    "import math\n\nimport rclpy\n\n\n"
    "def show():\n    node = rclpy.create_node('show')\n    speed = math.hypot(1.0, 2.0)\n"
    "    node.get_logger().info({})\n    node.get_logger().info({})\n"
)
_TABLE = (
    "import rclpy\n\n\ndef entry(name):\n    return {'name': name, 'state': 'new'}\n\n\n"
    "def show():\n    node = rclpy.create_node('show')\n    table = entry('a')\n"
    "    table['score'] = 3\n    table['score'] -= 1\n    node.get_logger().info(str(table))\n"
)
_LEVEL = (
    "from std_msgs.msg import String\n\n\ndef is_high(node):\n    msg = String()\n    return {}\n"
)
_INSTEAD = {
    "builtin_interfaces.msg.Time": "convert it with rclpy.time.Time.from_msg(...)",
    "builtin_interfaces.msg.Duration": "convert it with rclpy.duration.Duration.from_msg(...)",
    "rcl_interfaces.msg.ParameterValue": "use get_parameter(...).value",
    "rclpy.parameter.Parameter": "append .value",
}
_ARRAY = re.compile(r"array\[\w+\]")
_NUMBERS = frozenset({"an int", "a float"})
_PLAIN = frozenset({"a str", "bytes", "a list", "a tuple", "a dict", "a set", *_NUMBERS})
_TIMES = frozenset({"rclpy.time.Time", "rclpy.duration.Duration"})
_PORT = (
    "import serial\nfrom rclpy.node import Node\n\n\n"
    "class Port(Node):\n"
    "    def read(self):\n"
    "        line = serial.Serial('/dev/ttyUSB0', 9600).readline()\n"
    "        self.get_logger().info('got ' + {0})\n"
    "        return 'OK' in {0}\n"
)


class OperatorUnsupported(TypeRule):
    """An operator does not support a ROS object, or combines a str and a number.

    **Why.** ``TypeError: '>' not supported between instances of 'Duration' and 'float'``, or
    ``can only concatenate str (not "float") to str``, or ``ValueError: The truth value of an array
    with more than one element is ambiguous``.

    **Fix.** Convert one side: ``elapsed > Duration(seconds=1.0)``. Format numbers with an
    f-string.

    **Source.** The operators that the classes of ROS 2 Jazzy and of Python define.
    """

    code = "TY006"
    name = "operator-unsupported"
    kinds = frozenset({"unsupported-operator", "unsupported-bool-conversion"})
    examples = (
        Example(
            "arrays as conditions, and their elements",
            {
                "scan.py": "import numpy as np\nfrom sensor_msgs.msg import LaserScan\n\n\n"
                "def is_near(msg: LaserScan):\n"
                "    scan = LaserScan(ranges=[1.0, 2.0])\n"
                "    ranges = np.array(scan.ranges)\n"
                "    if (ranges < 0.5).any() and ranges.size and ranges[0] < ranges[1]:\n"
                "        return ranges[0.1 < ranges < 2.0]\n"
                "    front = ranges[1:2] < 0.5\n"
                "    if not front:\n"
                "        return None\n"
                "    return 'near' if ranges > 1.0 else 'far'\n"
            },
            "9:23: an array with several elements is neither true nor false: ValueError; write "
            "two comparisons with & between them",
            "11:8: an array with several elements is neither true nor false: ValueError; use "
            ".any(), .all() or .size",
            "13:22: an array with several elements is neither true nor false: ValueError; use "
            ".any(), .all() or .size",
        ),
        Example(
            "parameters, and the times of messages, in computations",
            {
                "late.py": "from builtin_interfaces.msg import Duration\n"
                "from rcl_interfaces.msg import ParameterValue\nfrom rclpy.node import Node\n"
                "from std_msgs.msg import Header\n\n\n"
                "class Late(Node):\n"
                "    def tick(self):\n"
                "        now = self.get_clock().now()\n"
                "        if now > Header().stamp + 1.0 or Duration(sec=1) > 0.5:\n"
                "            return self.get_parameter('rate') * 2\n"
                "        return ParameterValue(double_value=1.0) / 2.0\n"
            },
            "10:18: '+' does not work on a builtin_interfaces.msg.Time and a float: TypeError; "
            "convert it with rclpy.time.Time.from_msg(...)",
            "10:42: '>' does not work on a builtin_interfaces.msg.Duration and a float: "
            "TypeError; convert it with rclpy.duration.Duration.from_msg(...)",
            "11:20: '*' does not work on an rclpy.parameter.Parameter and an int: TypeError; "
            "append .value",
            "12:16: '/' does not work on an rcl_interfaces.msg.ParameterValue and a float: "
            "TypeError; use get_parameter(...).value",
        ),
        Example(
            "number next to a Time in a dictionary",
            {
                "goals.py": "from rclpy.node import Node\n\n\n"
                "class Goals(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('goals')\n"
                "        self.goals = {}\n\n"
                "    def add(self, key):\n"
                "        if key in self.goals:\n"
                "            self.goals[key]['tries'] += 1\n"
                "            self.goals[key]['last'] = self.get_clock().now()\n"
                "        else:\n"
                "            self.goals[key] = {'tries': 1, 'last': self.get_clock().now()}\n"
            },
        ),
        Example(
            "the plain alternative to a parameter, which is returned as it is",
            {
                "speed.py": "from rclpy.node import Node\n\n\n"
                "class Speed(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('speed')\n"
                "        self.factor = self.get_parameter_or('factor', 5.0)\n\n"
                "    def scale(self, speed: float) -> float:\n"
                "        return speed / self.factor\n"
            },
        ),
        Example(
            "Duration and Time added to attributes that are initially None or a number",
            {
                "pace.py": "from rclpy.clock import Clock\nfrom rclpy.duration import Duration\n"
                "from rclpy.time import Time\n\n\n"
                "class Pace:\n"
                "    def __init__(self):\n"
                "        self.next = None\n"
                "        self.last = 0\n\n"
                "    def start(self):\n"
                "        self.next = Clock().now()\n"
                "        self.last = Clock().now()\n\n"
                "    def go(self):\n"
                "        self.next += Duration(seconds=1.0)\n"
                "        self.last += Duration(seconds=1.0)\n"
                "        self.next += Time(seconds=1.0)\n"
            },
            "18:9: '+=' does not work on an rclpy.time.Time: TypeError; use Duration(seconds=...)",
        ),
        Example(
            "comparison of two durations", {"ticker.py": _NODE.format("Duration(seconds=1.0)")}
        ),
        Example(
            "comparison of a Duration and a float",
            {"ticker.py": _NODE.format("1.0")},
            "11:16: '>' does not work on an rclpy.duration.Duration and a float: TypeError; use "
            "Duration(seconds=...), or compare .nanoseconds",
        ),
        Example(
            "comparisons of a Duration and parameters",
            {
                "watch.py": "from rclpy.node import Node\n\n\n"
                "class Watch(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('watch')\n"
                "        self.limit = self.declare_parameter('limit', 1.5).value\n"
                "        self.declare_parameters('', [('name', 'a'), ('hold', 0.5), ('any', 1)])\n"
                "        self.last = self.get_clock().now()\n\n"
                "    def seconds(self):\n"
                "        if self.get_parameter('name').value:\n"
                "            seconds = 2 * self.get_parameter('hold').value\n"
                "        else:\n"
                "            seconds = 0.5\n"
                "        return seconds\n\n"
                "    def tick(self):\n"
                "        age = self.get_clock().now() - self.last\n"
                "        is_old = age > self.limit or age > self.seconds()\n"
                "        return is_old and age > self.get_parameter(\n"
                "            'any').value\n",
            },
            "20:18: '>' does not work on an rclpy.duration.Duration and a float: TypeError; use "
            "Duration(seconds=...), or compare .nanoseconds",
            "20:38: '>' does not work on an rclpy.duration.Duration and a float: TypeError; use "
            "Duration(seconds=...), or compare .nanoseconds",
            "21:27: '>' does not work on an rclpy.duration.Duration and an int: TypeError; use "
            "Duration(seconds=...), or compare .nanoseconds",
        ),
        Example(
            "comparisons of a Duration and parameters whose types are not certain",
            {
                "watch.py": "from rclpy.node import Node\n\n\n"
                "class Watch(Node):\n"
                "    def __init__(self, other):\n"
                "        super().__init__('watch')\n"
                "        self.other = other\n"
                "        self.declare_parameter('limit', None)\n"
                "        self.declare_parameter('hold', 1 if other else 0.5)\n"
                "        self.declare_parameter('name', '' if other is None else 0.5)\n"
                "        self.last = self.get_clock().now()\n\n"
                "    def declare_one(self):\n"
                "        self.declare_parameter('sum', 0)\n\n"
                "    def declare_other(self):\n"
                "        self.declare_parameter('sum', 0.5)\n\n"
                "    def tick(self):\n"
                "        age = self.get_clock().now() - self.last\n"
                "        is_old = age > self.get_parameter('limit').value\n"
                "        is_old = is_old or age > self.get_parameter('hold').value\n"
                "        is_old = is_old or age > self.get_parameter('sum').value\n"
                "        is_old = is_old or age > self.get_parameter('name').value\n"
                "        return is_old or age > self.other.get_parameter('sum').value\n",
                "free.py": "from rcl_interfaces.msg import ParameterDescriptor\n"
                "from rclpy.node import Node\n\n\n"
                "class Free(Node):\n"
                "    def tick(self):\n"
                "        free = ParameterDescriptor(dynamic_typing=True)\n"
                "        self.declare_parameter('sum', 0.5, free)\n"
                "        return self.get_clock().now() > self.get_parameter('sum').value\n",
            },
        ),
        Example(
            "float added to a Time",
            {
                "ticker.py": _NODE.format("Duration(seconds=1.0)").replace(
                    "get_clock().now()\n\n", "get_clock().now() + 5.0\n\n"
                )
            },
            "8:22: '+' does not work on an rclpy.time.Time and a float: TypeError; use "
            "Duration(seconds=...)",
        ),
        Example(
            "scan ranges converted to a NumPy array",
            {"scan.py": _SCAN.format("numpy.array(ranges)")},
        ),
        Example(
            "scan ranges compared with and multiplied by a number",
            {"scan.py": _SCAN.format("ranges")},
            "8:14: '>' does not work on an array.array and a float: TypeError; use "
            "numpy.array(...)",
            "9:20: '*' does not work on an array.array and a float: TypeError; use "
            "numpy.array(...)",
        ),
        Example(
            "scan ranges passed by a lambda, compared with a number",
            {
                "near.py": "from rclpy.node import Node\n"
                "from sensor_msgs.msg import LaserScan\n\n\n"
                "def near(ranges, limit):\n    return ranges < limit\n\n\n"
                "class Near(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('near')\n"
                "        self.create_subscription(LaserScan, 'a', lambda x: near(x.ranges, 1), 1)\n"
            },
            "6:12: '<' does not work on an array.array and an int: TypeError; use numpy.array(...)",
        ),
        Example(
            "numbers converted to str, str converted to a number",
            {
                "speed.py": _SPEED.format("'speed ' + str(speed)", "str(2) + ' m'"),
                "level.py": _LEVEL.format("float(msg.data) > 3.0"),
                "table.py": _TABLE,
            },
        ),
        Example(
            "str and number concatenated",
            {"speed.py": _SPEED.format("'speed ' + speed", "2 + ' m'")},
            "9:28: '+' cannot join a str and a float: TypeError; use an f-string",
            "10:28: '+' cannot join an int and a str: TypeError; use an f-string",
        ),
        Example(
            "list assigned to an attribute that may be a property",
            {
                "state.py": "import rclpy\nfrom vehicle import State\n\nrclpy.init()\n"
                "state = State()\nstate.array = [3.0, 4.0]\nstate.array += 0.5\n"
            },
        ),
        Example(
            "bytes of a serial port, decoded",
            {"port.py": _PORT.format("line.decode()")},
        ),
        Example(
            "bytes of a serial port, not decoded",
            {"port.py": _PORT.format("line")},
            "8:32: '+' does not work on a str and bytes: TypeError; decode() the bytes first",
            "9:16: 'in' does not work on a str and bytes: TypeError; decode() the bytes first",
        ),
        Example(
            "str in a dataclass field with an incorrect annotation",
            {
                "held.py": "from dataclasses import dataclass\n\n"
                "from std_msgs.msg import String\n\n\n"
                "@dataclass\nclass Held:\n    is_held: bool\n    name: String\n\n\n"
                "held = Held(False, '')\n\n\n"
                "def show():\n    print('holding ' + held.name)\n"
            },
        ),
        Example(
            "`/` on strings, `+` on a tuple and a list",
            {
                "load.py": "from ament_index_python.packages import get_package_share_directory\n"
                "from rclpy.node import Node\n\nBASE = (1, 2)\n\n\n"
                "def load(node: Node, name):\n"
                "    share = get_package_share_directory('rover')\n"
                "    node.get_logger().info(share + '/' + name)\n"
                "    return share / 'config' / name, BASE + [3]\n"
            },
            "10:12: '/' does not work on two strs: TypeError; use os.path.join(...)",
            "10:37: '+' does not work on a tuple and a list: TypeError",
        ),
        Example(
            "a number of a table with numbers and strings, kept in an attribute",
            {
                "flight.py": "import rclpy\nfrom rclpy.node import Node\n\n"
                "STEPS = [{'mode': 'up', 't': 10}, {'mode': 'up', 'x': 0.0, 't': 5}]\n\n\n"
                "class Flight(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('flight')\n"
                "        self.index = 0\n"
                "        self.left = STEPS[0]['t']\n\n"
                "    def tick(self):\n"
                "        if self.left == 0:\n"
                "            self.index += 1\n"
                "            self.left = STEPS[self.index]['t']\n"
                "        self.left -= 1\n"
            },
        ),
        Example(
            "Path in an instance attribute whose class attribute is a str",
            {
                "builder.py": "from pathlib import Path\n\n"
                "from ament_index_python import get_package_share_directory\n"
                "from launch_param_builder import ParameterBuilder\n\n\n"
                "class Builder(ParameterBuilder):\n"
                "    share = ''\n    file = ''\n\n"
                "    def __init__(self):\n"
                "        self.share = Path(get_package_share_directory('rover'))\n"
                "        self.file = Path('robot.urdf')\n\n"
                "    def path(self):\n        return self.share / self.file\n"
            },
        ),
        Example(
            "comparison of a str and a number",
            {"level.py": _LEVEL.format("msg.data > 3")},
            "6:12: '>' does not work on a str and an int: TypeError; use float(...)",
        ),
    )

    def judge(self, finding: TypeFinding) -> Diagnostic | None:
        is_truth = finding.kind == "unsupported-bool-conversion"
        return self._judge_truth(finding) if is_truth else self._judge_operator(finding)

    def _judge_truth(self, finding: TypeFinding) -> Diagnostic | None:
        array = rf"(?:None \| )?{_ARRAY_OF_NUMPY}(?: \| None)?"
        is_array = finding.match(rf"Boolean .* type `{array}`") is not None
        return self.report(finding, _truth_problem(finding)) if is_array else None

    def _judge_operator(self, finding: TypeFinding) -> Diagnostic | None:
        matched = finding.match(
            r"Operator `(?P<operator>[^`]+)` is not supported between (?:two )?objects of type "
            r"`(?P<left>[^`]+)`(?: and `(?P<right>[^`]+)`)?"
        ) or finding.match(
            r"Unary operator `(?P<operator>[^`]+)` is not supported for object of type "
            r"`(?P<left>.+)`"
        )
        if matched is None:
            return None
        types = [matched["left"], matched.groupdict().get("right") or matched["left"]]
        classes = [class_in(type_) for type_ in types]
        operator = matched["operator"]
        if _ARRAY.fullmatch(types[0]) is not None and is_certain(types[1]):
            message = f"{operator!r} does not work on an array.array and {in_words(types[1])}"
            return self.report(finding, f"{message}: TypeError; use numpy.array(...)")
        words = [*map(in_words, types)]
        if "a str" in words and not {*_NUMBERS, "bytes"}.isdisjoint(words):
            is_sure = "bytes" in words or are_sure(finding)
            return self.report(finding, _on_text(operator, words)) if is_sure else None
        if _PLAIN.issuperset(words):
            return self.report(finding, _on_plain(operator, words)) if are_sure(finding) else None
        is_initial = types[0] == "None" and finding.node(ast.AugAssign) is not None
        if is_initial or not any(classes) or not all(map(is_certain, types)):
            return None
        pair = " and ".join(dict.fromkeys(map(in_words, types)))
        hints = [_replacement(full_name(class_), operator) for class_ in classes if class_]
        hint = next(filter(None, hints), "")
        message = f"{operator!r} does not work on {pair}: TypeError"
        return self.report(finding, f"{message}; {hint}" if hint else message)


def _truth_problem(finding: TypeFinding) -> str:
    """Return the problem with a condition that is an array."""
    node = finding.innermost
    message = "an array with several elements is neither true nor false: ValueError"
    if isinstance(node, ast.Compare) and len(node.ops) > 1:
        return f"{message}; write two comparisons with & between them"
    return f"{message}; use .any(), .all() or .size"


def _on_text(operator: str, words: Sequence[str]) -> str:
    """Return the message about an operator between a text and a number or bytes."""
    if "bytes" in words:
        problem = f"{operator!r} does not work on {words[0]} and {words[1]}: TypeError"
        return f"{problem}; decode() the bytes first"
    if operator == "+":
        return f"'+' cannot join {words[0]} and {words[1]}: TypeError; use an f-string"
    return f"{operator!r} does not work on {words[0]} and {words[1]}: TypeError; use float(...)"


def _on_plain(operator: str, words: Sequence[str]) -> str:
    """Return the message about an operator between texts, containers and numbers."""
    pair = f"two {words[0].partition(' ')[2]}s" if words[0] == words[1] else " and ".join(words)
    hint = "; use os.path.join(...)" if (operator, pair) == ("/", "two strs") else ""
    return f"{operator!r} does not work on {pair}: TypeError{hint}"


def _replacement(class_: str, operator: str) -> str:
    """Return the replacement for an operator on an object of a class."""
    if class_ not in _TIMES:
        return _INSTEAD.get(class_, "")
    compares = operator in {"<", "<=", ">", ">="}
    return f"use Duration(seconds=...){', or compare .nanoseconds' if compares else ''}"
