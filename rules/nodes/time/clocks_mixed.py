"""ND105: times that are compared come from the same clock."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping

from scaffold.api import Diagnostic, Example, RclpyRule, Report, Severity
from scaffold.api.python import Condition, all_conditions, is_handled
from scaffold.api.rclpy import RclpyFile

from ._clocks import NUMBER, clocks_of

_NAMES = {
    "ROS_TIME": "the ROS clock",
    "STEADY_TIME": "a steady clock",
    "SYSTEM_TIME": "the system clock",
}
_NODE = (
    "from rclpy.clock import ClockType\nfrom rclpy.node import Node\n"
    "from rclpy.time import Time\n\n\n"
    "class Driver(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('driver')\n"
    "        self.last = {}\n\n"
    "    def tick(self):\n"
    "        {}now = self.get_clock().now()\n"
    "        self.age = now - self.last\n\n"
    "    def on_command(self, msg):\n"
    "        self.last = self.get_clock().now()\n"
)


class ClocksMixed(RclpyRule):
    """Times of different clocks are subtracted or compared, or stamps use the system clock.

    **Why.** ``TypeError: Can't subtract times with different clock types``. ``Time()`` uses the
    system clock, but the clock of a node is a ROS clock, even without simulated time. A number of
    seconds is not an rclpy ``Time``.

    **Fix.** Initialize with ``self.get_clock().now()``, or with
    ``Time(clock_type=ClockType.ROS_TIME)``.

    **Source.** ``rclpy/time.py``, ``Time.__sub__``.
    """

    code = "ND105"
    name = "clocks-mixed"
    other_severities = {Severity.WARNING: "it is a stamp, which is only wrong in simulation"}
    examples = (
        Example(
            "a number that a method returns at first",
            {
                "driver.py": _NODE.format("self.seconds()", "") + "\n    def seconds(self):\n"
                "        return self.get_clock().now().nanoseconds / 1e9\n"
            },
            "13:20: an rclpy Time and a number cannot be subtracted: TypeError; initialize it "
            "with self.get_clock().now()",
        ),
        Example(
            "a steady clock",
            {
                "driver.py": _NODE.format(
                    "Clock(clock_type=ClockType.STEADY_TIME).now()", ""
                ).replace("import ClockType", "import Clock, ClockType")
            },
            "13:20: times of the ROS clock and of a steady clock cannot be subtracted: TypeError; "
            "use Time(clock_type=ClockType.ROS_TIME) or the clock of the node",
        ),
        Example("the same clock", {"driver.py": _NODE.format("self.get_clock().now()", "")}),
        Example(
            "a time of that clock",
            {"driver.py": _NODE.format("Time(clock_type=ClockType.ROS_TIME)", "")},
        ),
        Example(
            "a stamp from the clock of the node, and from another one",
            {
                f"{name}.py": "from rclpy.clock import Clock, ClockType\n"
                "from rclpy.node import Node\n\n\n"
                "class Driver(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('driver')\n"
                f"        self.clock = {clock}\n\n"
                "    def tick(self, msg):\n"
                "        msg.header.stamp = self.clock.now().to_msg()\n"
                for name, clock in {
                    "node": "self.get_clock()",
                    "ros": "Clock(clock_type=ClockType.ROS_TIME)",
                    "system": "Clock()",
                }.items()
            },
            Report(
                "system.py:11:28",
                "the stamp is from the system clock, which does not follow simulated "
                "time; use self.get_clock()",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "initialized with another clock",
            {"driver.py": _NODE.format("Time()", "")},
            "13:20: times of the ROS clock and of the system clock cannot be subtracted: "
            "TypeError; use Time(clock_type=ClockType.ROS_TIME) or the clock of the node",
        ),
        Example(
            "checks first",
            {
                "driver.py": _NODE.format(
                    "Time()", "if not self.last.nanoseconds:\n            return\n        "
                )
            },
        ),
        Example(
            "initialized with a number",
            {
                "driver.py": "import time\n\n" + _NODE.format("time.time()", ""),
                "other.py": _NODE.format("0.0", "if not self.last:\n            return\n        "),
            },
            "driver.py:15:20: an rclpy Time and a number cannot be subtracted: TypeError; "
            "initialize it with self.get_clock().now()",
        ),
        Example(
            "initialized with a number, and a flag that is only set later",
            {
                "stop.py": "import time\n\n"
                + _NODE.format("time.time()", "")
                .replace(
                    "        self.last = time.time()\n",
                    "        self.last = time.time()\n        self.done = False\n",
                )
                .replace("self.age = now - self.last", "self.age = self.done or now - self.last")
                + "        self.done = False\n",
                "go.py": "import time\n\n"
                + _NODE.format("time.time()", "")
                .replace(
                    "        self.last = time.time()\n",
                    "        self.last = time.time()\n        self.going = False\n",
                )
                .replace("self.age = now - self.last", "self.age = self.going and now - self.last")
                + "        self.going = True\n",
            },
            "stop.py:16:33: an rclpy Time and a number cannot be subtracted: TypeError; "
            "initialize it with self.get_clock().now()",
        ),
        Example(
            "a stamp from the system clock",
            {
                "age.py": "from rclpy.clock import Clock\nfrom rclpy.time import Time\n\n\n"
                "def is_old(msg, limit):\n"
                "    stamp = Time.from_msg(msg.header.stamp)\n"
                "    return Clock().now() - stamp > limit\n"
            },
            "7:12: times of the system clock and of the ROS clock cannot be subtracted: "
            "TypeError; use Time(clock_type=ClockType.ROS_TIME) or the clock of the node",
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        if not file.module.mentions("Time(", "Clock(", "get_clock("):
            return
        for stamp in _system_stamps(file):
            message = (
                "the stamp is from the system clock, which does not follow simulated time; use "
                "self.get_clock()"
            )
            yield self.report(file.module.location(stamp), message, severity=Severity.WARNING)
        for node in (*file.module.walk(ast.BinOp), *file.module.walk(ast.Compare)):
            match node:
                case ast.BinOp(left=left, op=ast.Sub() as operator, right=right):
                    pass
                case ast.Compare(left=left, ops=[operator], comparators=[right]):
                    pass
                case _:
                    continue
            pair = _mixed(file, node, left, right)
            if pair is not None and not isinstance(operator, ast.Is | ast.IsNot | ast.In):
                verb = "subtracted" if isinstance(node, ast.BinOp) else "compared"
                if NUMBER not in pair:
                    yield self.report(file.module.location(node), _of_two_clocks(pair, verb))
                elif not isinstance(operator, ast.Eq | ast.NotEq):
                    message = f"an rclpy Time and a number cannot be {verb}: TypeError; "
                    message += "initialize it with self.get_clock().now()"
                    yield self.report(file.module.location(node), message)


def _system_stamps(file: RclpyFile) -> Iterator[ast.expr]:
    """Yield ``Clock().now().to_msg()`` that a node puts into headers."""
    nodes = {node.node for node in file.classes}
    for store in file.evaluator.stores("stamp"):
        match store.value:
            case ast.Call(
                func=ast.Attribute(
                    attr="to_msg", value=ast.Call(func=ast.Attribute(attr="now")) as time
                )
            ):
                is_of_node = any(parent in nodes for parent in file.module.parents(time))
                if is_of_node and {*clocks_of(file, time).values()} == {"SYSTEM_TIME"}:
                    yield store.value


def _of_two_clocks(pair: tuple[str, str], verb: str) -> str:
    first, second = (_NAMES.get(kind, kind) for kind in pair)
    return (
        f"times of {first} and of {second} cannot be {verb}: TypeError; "
        "use Time(clock_type=ClockType.ROS_TIME) or the clock of the node"
    )


def _mixed(
    file: RclpyFile, node: ast.AST, left: ast.expr, right: ast.expr
) -> tuple[str, str] | None:
    """Return the different clocks of two times, if they are certainly combined."""
    sides = clocks_of(file, left), clocks_of(file, right)
    pairs = [(x, y) for x in sides[0].values() for y in sides[1].values()]
    differing = [(x, y) for x, y in pairs if x and y and x != y]
    if not differing or is_handled(file.module, node, "TypeError"):
        return None
    if NUMBER in differing[0] and max(map(len, sides)) == 1:
        return None  # TY006 reports this
    if len(differing) < len(pairs):
        for side, clocks in zip((left, right), sides, strict=True):
            if len({*clocks.values()}) > 1 and not _begins_wrong(file, node, side, clocks):
                return None
    return differing[0]


def _begins_wrong(
    file: RclpyFile, node: ast.AST, side: ast.expr, clocks: Mapping[ast.expr, str | None]
) -> bool:
    """Return whether an attribute may have its initial value in an operation.

    Not if a condition checks it, or an attribute that is set together with it.
    """
    if not isinstance(side, ast.Attribute):
        return False
    first = next(iter(clocks))
    constructor = file.function_of(first)
    if constructor is None or getattr(constructor, "name", "") != "__init__":
        return False
    setters = {file.function_of(store.node) for store in file.evaluator.stores(side.attr)} - {
        constructor
    }
    function = file.function_of(node)
    if function in setters and any(
        store.node.lineno < getattr(node, "lineno", 0)
        for store in file.evaluator.stores(side.attr)
        if file.function_of(store.node) is function
    ):
        return False
    together = {side.attr} | {
        attribute.attr
        for setter in setters
        if setter is not None
        for attribute in file.module.below(setter, ast.Attribute)
        if isinstance(attribute.ctx, ast.Store)
    }
    return not any(
        isinstance(part, ast.Attribute) and part.attr in together
        for condition in all_conditions(file.module, node)
        if not _holds_at_first(file, constructor, condition)
        for part in ast.walk(condition.test)
    )


def _holds_at_first(file: RclpyFile, constructor: ast.AST, condition: Condition) -> bool:
    """Return whether a condition is met by the flag that the constructor sets."""
    test, needed = condition.test, condition.needed
    while isinstance(test, ast.UnaryOp) and isinstance(test.op, ast.Not):
        test, needed = test.operand, not needed
    if not isinstance(test, ast.Attribute):
        return False
    stores = file.evaluator.stores(test.attr)
    first = [store.value for store in stores if file.function_of(store.node) is constructor]
    return len(first) == 1 and file.evaluator.evaluate(first[0]) is needed
