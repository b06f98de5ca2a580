"""ND061: objects of rclpy are used as what they are."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule
from scaffold.model.nodes import NodeFacts
from scaffold.model.rclpy_names import class_of

_WHOLE = r"(?!rclpy\.)\w+\.(srv|action)\.[A-Z][A-Za-z0-9]*"
_PRESETS = "rclpy.qos.qos_profile_"
_SPANS = frozenset({"rclpy.duration.Duration", "rclpy.time.Time"})
_NOT_CALLED = frozenset(
    {"rclpy.client.Client", "rclpy.clock.Clock", "rclpy.publisher.Publisher"}
    | {"rclpy.subscription.Subscription", "rclpy.task.Future", "rclpy.timer.Timer"}
)
_NODE = (
    "from rclpy.duration import Duration\nfrom rclpy.node import Node\n"
    "from rclpy.qos import qos_profile_sensor_data\n"
    "from std_msgs.msg import String\nfrom std_srvs.srv import Trigger\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.pub = self.create_publisher(String, 'a', qos_profile_sensor_data{})\n"
    "        self.client = self.create_client(Trigger, 'b')\n"
    "        self.start = self.get_clock().now() - {}\n"
    "        self.client.call_async({}).add_done_callback({})\n\n"
    "    def done(self, future):\n"
    "        self.pub{}(String())\n"
)
_RIGHT = ("", "Duration(seconds=1.0)", "Trigger.Request()", "self.done", ".publish")


class ObjectCalledWrongly(Rule):
    """An object of rclpy is called, made or computed with in a way that it does not allow.

    **Why.** ``TypeError: 'QoSProfile' object is not callable``, ``unsupported operand type(s) for
    -: 'Time' and 'float'``, ``NotImplementedError: Service classes can not be instantiated``.

    **Fix.** ``Duration(seconds=1.0)``, ``Trigger.Request()``, ``add_done_callback(self.done)``,
    ``publisher.publish(message)``.

    **Source.** ``rclpy/duration.py``, ``rclpy/time.py``, ``rclpy/qos.py``, rosidl_generator_py.
    """

    code = "ND061"
    name = "object-called-wrongly"
    examples = (
        Example("right", {"talker.py": _NODE.format(*_RIGHT)}),
        Example(
            "all wrong",
            {"talker.py": _NODE.format("()", "1.0", "Trigger()", "self.done()", "")},
            at=("talker.py:11", "talker.py:13", "talker.py:14", "talker.py:14", "talker.py:17"),
        ),
        Example(
            "a class of a module that is called action",
            {
                "package.xml": "<package><name>talker</name></package>\n",
                "talker/action.py": "class Step:\n    pass\n",
                "talker/node.py": "import rclpy\nfrom talker.action import Step\n\nSTEP = Step()\n",
            },
        ),
        Example(
            "compared with a number",
            {
                "talker.py": _NODE.format(*_RIGHT)
                + "        if self.get_clock().now() - self.get_clock().now() > 5.0:\n"
                "            return\n"
            },
            at=("talker.py:18",),
        ),
        Example(
            "a duration by position",
            {
                "talker.py": _NODE.format(*_RIGHT).replace("seconds=", ""),
            },
            at=("talker.py:13",),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for facts in package.rclpy_files():
            for call in facts.module.walk(ast.Call):
                problem = _problem(facts, call)
                if problem:
                    yield self.report(facts.module.location(call), problem)
            for comparison in facts.module.walk(ast.Compare):
                kind = _compared_with_number(facts, comparison)
                if kind:
                    message = (
                        f"a {kind} and a number cannot be compared: write Duration(seconds=...)"
                    )
                    yield self.report(facts.module.location(comparison), message)
            for sum_ in facts.module.walk(ast.BinOp):
                if _adds_number_to_time(facts, sum_):
                    message = "a Time and a number: TypeError; use Duration(seconds=...)"
                    yield self.report(facts.module.location(sum_), message)


def _problem(facts: NodeFacts, call: ast.Call) -> str:
    name = facts.module.qualified_name(call.func) or ""
    problem = ""
    if name.startswith(_PRESETS):
        problem = f"{name[10:]} is a profile, no function: leave the parentheses out"
    elif name in {"rclpy.duration.Duration", "rclpy.time.Time"} and call.args:
        problem = f"{name.rpartition('.')[2]}() takes keywords only: seconds=..., nanoseconds=..."
    elif re.fullmatch(_WHOLE, name) and facts.interface(call.func):
        part = "Goal" if ".action." in name else "Request"
        kind = name.rpartition(".")[2]
        problem = f"{kind} itself cannot be made: NotImplementedError; write {kind}.{part}()"
    elif isinstance(call.func, ast.Attribute | ast.Name) and not name:
        class_ = class_of(facts, call.func) or ""
        if class_ in _NOT_CALLED:
            problem = f"a {class_.rpartition('.')[2]} cannot be called itself: TypeError"
    match call:
        case ast.Call(func=ast.Attribute(attr="add_done_callback"), args=[ast.Call() as given]):
            callback = facts.callback(given)
            if callback.is_called and not callback.is_partial:
                problem = f"{callback.name}() is called here: pass the function itself"
    return problem


def _adds_number_to_time(facts: NodeFacts, sum_: ast.BinOp) -> bool:
    is_number = type(facts.evaluator.evaluate(sum_.right)) in {int, float}
    if not is_number or not isinstance(sum_.op, ast.Add | ast.Sub):
        return False
    return class_of(facts, sum_.left) == "rclpy.time.Time"


def _compared_with_number(facts: NodeFacts, comparison: ast.Compare) -> str:
    """Return what is compared with a number, if it is a time or a duration."""
    left, others = comparison.left, comparison.comparators
    is_number = type(facts.evaluator.evaluate(others[0])) in {int, float}
    if not is_number or not isinstance(comparison.ops[0], ast.Lt | ast.LtE | ast.Gt | ast.GtE):
        return ""
    value = facts.evaluator.single_value(left)
    if isinstance(value, ast.BinOp) and isinstance(value.op, ast.Sub):
        both = {class_of(facts, value.left), class_of(facts, value.right)}
        return "Duration" if both == {"rclpy.time.Time"} else ""
    name = class_of(facts, value) or ""
    return name.rpartition(".")[2] if name in _SPANS else ""
