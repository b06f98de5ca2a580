"""MS029: fields are compared with values that they can have."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, MessageRule
from scaffold.api.interfaces import FLOATS, INTEGER_RANGES, TEXTS, FieldType
from scaffold.api.messages import MessageTypes

_NODE = (
    "from diagnostic_msgs.msg import DiagnosticStatus\nfrom nav_msgs.msg import OccupancyGrid\n"
    "from rclpy.node import Node\nfrom std_msgs.msg import Bool, Int32, String\n\n\n"
    "class Watch(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('watch')\n"
    "        self.create_subscription(OccupancyGrid, 'map', self.on_map, 10)\n"
    "        self.create_subscription(DiagnosticStatus, 'status', self.on_status, 10)\n"
    "        self.create_subscription(Bool, 'stop', self.on_stop, 10)\n"
    "        self.create_subscription(Int32, 'mode', self.on_mode, 10)\n\n"
    "    def on_map(self, msg):\n"
    "        return msg.data[0] == {}, [cell for cell in msg.data if cell == {}]\n\n"
    "    def on_status(self, msg):\n"
    "        return msg.level == {}\n\n"
    "    def on_stop(self, msg):\n"
    "        return msg.data == {}\n\n"
    "    def on_mode(self, msg):\n"
    "        return msg.data in {}\n"
)


class ComparisonNeverTrue(MessageRule):
    """A message or field is compared with a value that it never has, or anything with NaN.

    **Why.** ``==`` is always false, without an error: ``'1'`` is not ``1``, a map cell is an int8
    and never 255, ``DiagnosticStatus.level`` is ``bytes``, an action result is not its status, and
    NaN does not even equal itself.

    **Fix.** Compare with a value of the field type, preferably a constant of the message such as
    ``DiagnosticStatus.OK``. To test for NaN, use ``math.isnan(distance)``.

    **Source.** ``ros2 interface show``; https://github.com/ros2/rcl_interfaces/issues/158.
    """

    code = "MS029"
    name = "comparison-never-true"
    examples = (
        Example(
            "comparisons with values of the field type",
            {
                "watch.py": _NODE.format(
                    "-1", "100", "DiagnosticStatus.OK", "True or msg.data == 1", "(1, 2)"
                )
            },
        ),
        Example(
            "values out of range, int instead of bytes, str instead of bool and int",
            {"watch.py": _NODE.format("255", "200", "0", "'true'", "('1', '2')")},
            "16:16: msg.data[0] is of int8, -128 to 127: it never equals 255",
            "16:66: cell is of int8, -128 to 127: it never equals 200",
            "19:16: msg.level is of type bytes, which never equals 0",
            "22:16: msg.data is of type bool, which never equals 'true'",
            "25:16: msg.data is of type int, which never equals '1'",
        ),
        Example(
            "the status of a goal compared with a str",
            {
                "client.py": "from action_msgs.msg import GoalStatus\n"
                "from example_interfaces.action import Fibonacci\n"
                "from rclpy.action import ActionClient\nfrom rclpy.node import Node\n\n\n"
                "class Client(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('client')\n"
                "        self.client = ActionClient(self, Fibonacci, 'count')\n\n"
                "    def on_accepted(self, future):\n"
                "        future.result().get_result_async().add_done_callback(self.on_result)\n\n"
                "    def on_result(self, future):\n"
                "        response = future.result()\n"
                "        print(response.status == GoalStatus.STATUS_SUCCEEDED)\n"
                "        print(response.status == 'SUCCEEDED')\n"
            },
            "18:15: response.status is an int, which never equals 'SUCCEEDED'; use a constant of "
            "GoalStatus",
        ),
        Example(
            "identity of fields with True and None",
            {
                "pad.py": "from rclpy.node import Node\nfrom sensor_msgs.msg import Joy\n"
                "from std_srvs.srv import SetBool\n\n\n"
                "class Pad(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('pad')\n"
                "        self.create_subscription(Joy, 'joy', self.on_joy, 10)\n"
                "        self.create_service(SetBool, 'set', self.on_set)\n\n"
                "    def on_joy(self, msg):\n"
                "        self.held = msg.buttons[0] is True and msg.axes[0] is not None\n\n"
                "    def on_set(self, request, response):\n"
                "        response.success = request.data is True\n"
                "        return response\n"
            },
            "13:21: msg.buttons[0] is of type int, which is never True; use == or the field alone",
        ),
        Example(
            "header compared with a str, number compared with NaN",
            {
                "watch.py": _NODE.format(
                    "100 or msg.header == 'map'",
                    "100 and cell != cell",
                    "DiagnosticStatus.OK",
                    "True",
                    "(float('nan'), 2) or msg.data == NAN",
                )
                + "\n\nNAN = float('nan')\n"
            },
            "16:38: msg.header is a std_msgs/msg/Header, which never equals 'map'",
            "25:49: never true: NaN equals nothing, not even itself; use math.isnan(msg.data)",
        ),
    )

    def check_file(self, types: MessageTypes) -> Iterator[Diagnostic]:
        for node in types.module.walk(ast.Compare):
            if len(node.ops) != 1:
                continue
            left, right = node.left, node.comparators[0]
            problem = _nan_problem(types, node)
            if isinstance(node.ops[0], ast.In | ast.NotIn):
                problems = [_problem(types, left, item) for item in _items(right)]
                problem = problems[0] if problems and all(problems) else ""
            elif isinstance(node.ops[0], ast.Eq | ast.NotEq) and not problem:
                problem = _problem(types, left, right) or _problem(types, right, left)
            elif isinstance(node.ops[0], ast.Is | ast.IsNot):
                problem = _identity_problem(types, left, right)
            if problem:
                yield self.report(types.module.location(node), problem)


def _items(node: ast.expr) -> list[ast.expr]:
    return node.elts if isinstance(node, ast.List | ast.Tuple | ast.Set) else []


def _nan_problem(types: MessageTypes, node: ast.Compare) -> str:
    """Return why a comparison with NaN is useless; empty for other comparisons."""
    if not isinstance(node.ops[0], ast.Eq | ast.NotEq):
        return ""
    for side, other in ((node.left, node.comparators[0]), (node.comparators[0], node.left)):
        is_named = types.module.qualified_name(side) in _NAN
        match types.file.evaluator.single_value(side):
            case ast.Call(func=ast.Name(id="float"), args=[ast.Constant(value=str(text))]):
                is_named = text.strip().lstrip("+-").lower() == "nan"
        if is_named:
            text = types.module.text(other)
            return f"never true: NaN equals nothing, not even itself; use math.isnan({text})"
    return ""


_NAN = frozenset({"math.nan", "numpy.nan", "numpy.NaN", "numpy.NAN"})


def _problem(types: MessageTypes, field: ast.expr, other: ast.expr) -> str:
    """Return why a field never equals a value; empty if it may."""
    value = types.file.evaluator.evaluate(other)
    is_value = isinstance(value, bool | int | float | str) or _is_constant(types, other)
    source = types.file.evaluator.single_value(field)
    message = types.type_of(source) if is_value and isinstance(source, ast.Attribute) else None
    if message is not None:
        text, other_text = types.module.text(field), types.module.text(other)
        return f"{text} is a {message.name}, which never equals {other_text}"
    if isinstance(value, str) and _is_goal_status(types, field):
        text = types.module.text(field)
        return f"{text} is an int, which never equals {value!r}; use a constant of GoalStatus"
    type_ = types.field_type_of(field)
    is_plain = type_ is not None and type_.is_primitive and not type_.is_array
    if type_ is None or not is_plain or not isinstance(value, bool | int | float | str | bytes):
        return ""
    text = types.module.text(field)
    allowed = _allowed(type_)
    if not isinstance(value, allowed):
        kind = allowed[0].__name__
        return f"{text} is of type {kind}, which never equals {value!r}"
    if type_.name in INTEGER_RANGES and isinstance(value, int | float):
        low, high = INTEGER_RANGES[type_.name]
        if not low <= value <= high:
            return f"{text} is of {type_.name}, {low} to {high}: it never equals {value}"
    return ""


def _identity_problem(types: MessageTypes, field: ast.expr, other: ast.expr) -> str:
    """Return why a field is never True or False; empty if it may be."""
    type_ = types.field_type_of(field)
    is_bool = isinstance(other, ast.Constant) and isinstance(other.value, bool)
    if type_ is None or not is_bool or not type_.is_primitive or type_.is_array:
        return ""
    if type_.name == "bool":
        return ""
    kind = _allowed(type_)[0].__name__ if type_.name not in INTEGER_RANGES else "int"
    text, value = types.module.text(field), types.module.text(other)
    return f"{text} is of type {kind}, which is never {value}; use == or the field alone"


def _is_goal_status(types: MessageTypes, node: ast.expr) -> bool:
    """Return whether an expression is the status in the response with the result of a goal."""
    match node:
        case ast.Attribute(attr="status", value=response) if types.module.mentions(
            "get_result_async"
        ):
            match types.file.evaluator.single_value(response):
                case ast.Call(func=ast.Attribute(attr="result"), args=[], keywords=[]):
                    return True
    return False


def _is_constant(types: MessageTypes, node: ast.expr) -> bool:
    """Return whether an expression is a constant of a message: ``GoalStatus.STATUS_SUCCEEDED``."""
    is_named = isinstance(node, ast.Attribute) and node.attr.isupper()
    return is_named and isinstance(node, ast.Attribute) and types.class_of(node.value) is not None


def _allowed(type_: FieldType) -> tuple[type, ...]:
    """Return the Python types that a field may be equal to, its own first."""
    if type_.name == "byte":
        return (bytes,)
    if type_.name in TEXTS:
        return (str,)
    if type_.name in FLOATS:
        return (float, int)
    return (bool, int, float) if type_.name == "bool" else (int, float)
