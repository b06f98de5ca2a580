"""ND106: time steps include the fraction of a second."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence

from scaffold.api import Diagnostic, Effect, Example, RclpyRule
from scaffold.api.rclpy import RclpyFile

from ._time_units import unit_problems

_PARTS = ("sec", "nanosec")
_STEPS = frozenset({"dt", "delta_t", "delta_time", "time_delta", "time_step", "timestep", "d_t"})
_WRAPPERS = frozenset({"float", "int", "abs", "max", "min", "round"})
_NODE = (
    "from rclpy.node import Node\nfrom sensor_msgs.msg import Imu\n\n\n"
    "class Odometry(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('odometry')\n"
    "        self.last = None\n"
    "        self.create_subscription(Imu, 'imu', self.on_imu, 10)\n\n"
    "    def on_imu(self, msg):\n"
    "        now = msg.header.stamp\n"
    "        if self.last is not None:\n"
    "            dt = {}\n"
    "            self.yaw += msg.angular_velocity.z * dt\n"
    "        self.last = now\n"
)
_BOTH = "now.sec - self.last.sec + (now.nanosec - self.last.nanosec) / 1e9"


class StepWithoutFraction(RclpyRule):
    """A time is computed from only one of its fields, or used in another unit.

    **Why.** A difference of ``sec`` is 0 within a second and 1 across seconds: integrated values
    jump, and a division raises ``ZeroDivisionError``. ``nanosec`` restarts at 0 with every second:
    its difference is negative then. ``sec + nanosec`` grows by a billion within a second.
    ``nanoseconds > 0.5`` is always true, and a step in milliseconds makes odometry a thousand times
    too large.

    **Fix.** Write ``(Time.from_msg(a) - Time.from_msg(b)).nanoseconds / 1e9``; ``elapsed >
    Duration(seconds=0.5)``; ``Time.from_msg(stamp)``.

    **Source.** ``builtin_interfaces/msg/Time``; ``rclpy/time.py``, ``rclpy/duration.py``.
    """

    code = "ND106"
    name = "step-without-fraction"
    effect = Effect.WRONG_BEHAVIOR
    examples = (
        Example("both parts", {"odometry.py": _NODE.format(_BOTH)}),
        Example(
            "the time of messages in a bag",
            {
                "copy_bag.py": "import time\n\nfrom rclpy.clock import Clock\n"
                "from rosbag2_py import SequentialWriter\n\n\n"
                "def copy(data):\n"
                "    writer = SequentialWriter()\n"
                "    clock = Clock()\n"
                "    writer.write('chatter', data, clock.now().nanoseconds)\n"
                "    writer.write('chatter', data, int(clock.now().nanoseconds / 1e9))\n"
                "    writer.write('chatter', data, int(time.time()))\n"
                "    writer.write('chatter', data, int(time.time() * 1e9))\n"
            },
            "11:35: the time of a message in a bag is all its nanoseconds; write "
            "self.get_clock().now().nanoseconds",
            "12:35: the time of a message in a bag is all its nanoseconds; write "
            "self.get_clock().now().nanoseconds",
        ),
        Example(
            "whole seconds",
            {"odometry.py": _NODE.format("float(now.sec - self.last.sec)")},
            "14:24: time step from 'sec' alone: it has no fraction and is 0 within a second; use "
            "(Time.from_msg(a) - Time.from_msg(b)).nanoseconds / 1e9",
        ),
        Example(
            "whole seconds that are counted",
            {
                "odometry.py": _NODE.format("now.sec - self.last.sec")
                .replace("        self.last = now\n", "")
                .replace("dt\n", "dt\n            if dt > 0:\n                self.last = now\n")
            },
        ),
        Example(
            "whole seconds that are compared with a delay",
            {
                "odometry.py": _NODE.format("now.sec - self.last.sec").replace(
                    "self.yaw += msg.angular_velocity.z * dt", "self.is_late = dt > self.delay"
                )
            },
        ),
        Example(
            "whole seconds in per cent",
            {
                "odometry.py": _NODE.format("1.0").replace(
                    "self.last = now", "self.done = 100 * (now.sec - self.last.sec) / self.limit"
                )
            },
        ),
        Example(
            "nanoseconds",
            {"odometry.py": _NODE.format("(now.nanosec - self.last.nanosec) * 1e-9")},
            "14:19: time step from 'nanosec' alone: it is negative at the end of each second; use "
            "(Time.from_msg(a) - Time.from_msg(b)).nanoseconds / 1e9",
        ),
        Example(
            "the sum of both parts",
            {
                "odometry.py": _NODE.format(
                    "now.sec + now.nanosec / 1e9\n            dt -= now.sec + now.nanosec"
                )
            },
            "15:19: nanoseconds are added to seconds: divide 'nanosec' by 1e9",
        ),
        Example(
            "a wrong factor, or no padding of the nanoseconds",
            {
                "odometry.py": _NODE.format(
                    "now.sec + now.nanosec / 1e9\n"
                    "            in_ms = now.sec * 1000 + now.nanosec // 1_000_000\n"
                    "            fraction = now.nanosec * 1e-6\n"
                    "            late = now.sec + fraction\n"
                    "            late = float(now.sec) + float(now.nanosec) / 10e9\n"
                    "            late = float(f'{now.sec}.{now.nanosec:09}') - in_ms\n"
                    "            late = float(f'{now.sec}.{now.nanosec}')"
                )
            },
            "17:20: 'nanosec' is added in another unit than 'sec': multiply it by 1e-09",
            "18:20: 'nanosec' is added in another unit than 'sec': multiply it by 1e-09",
            "20:26: 'nanosec' has no zeros in front: 5 becomes .5; divide it by 1e9",
        ),
        Example(
            "seconds to wait",
            {
                "odometry.py": _NODE.format(
                    "1.0\n            if now.sec - self.last.sec > 5:\n                return"
                )
            },
        ),
        Example(
            "milliseconds in a speed per second",
            {
                "odometry.py": _NODE.format(
                    "(Time.from_msg(now) - self.last).nanoseconds / 1e6"
                ).replace("from sensor", "from rclpy.time import Time\nfrom sensor")
            },
            "16:50: dt is in milliseconds, a speed is per second: multiply nanoseconds by 1e-9",
        ),
        Example(
            "nanoseconds compared with seconds, and with a whole time",
            {
                "odometry.py": _NODE.format(
                    "1.0\n"
                    "            late = self.get_clock().now().nanoseconds - now.nanosec\n"
                    "            if self.age.nanoseconds > 0.5 or self.age.nanoseconds > 0:\n"
                    "                return late"
                )
            },
            "15:20: 'nanosec' is only the part of a time below a second, 'nanoseconds' is all of "
            "it; use Time.from_msg(stamp).nanoseconds",
            "16:16: nanoseconds are compared with 0.5: divide by 1e9 to compare seconds",
        ),
        Example(
            "a time of whole seconds",
            {
                "odometry.py": _NODE.format(
                    "Time(seconds=now.sec) - Time(seconds=now.sec, nanoseconds=now.nanosec)"
                ).replace("from sensor", "from rclpy.time import Time\nfrom sensor")
            },
            "15:18: the fraction in 'nanosec' is ignored: use Time.from_msg()",
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        if not file.module.mentions(".sec", "seconds_nanoseconds", ".nanosec"):
            return
        if not file.module.in_tests:
            for node, problem in unit_problems(file):
                yield self.report(file.module.location(node), problem)
        for node in file.module.walk(ast.BinOp):
            if not isinstance(node.op, ast.Sub):
                continue
            for part in _PARTS:
                if not (_is_part(file, node.left, part) and _is_part(file, node.right, part)):
                    continue
                if not _needs_other_part(file, node, part):
                    continue
                happens = (
                    "it has no fraction and is 0 within a second"
                    if part == "sec"
                    else "it is negative at the end of each second"
                )
                message = (
                    f"time step from {part!r} alone: {happens}; use "
                    "(Time.from_msg(a) - Time.from_msg(b)).nanoseconds / 1e9"
                )
                yield self.report(file.module.location(node), message)


def _needs_other_part(file: RclpyFile, node: ast.BinOp, part: str) -> bool:
    """Return whether a difference of one part is a time step, which needs both parts."""
    if _has_other_part(file, node, part) or not _is_step(file, node):
        return False
    return part != "sec" or not _is_meant_whole(file, node)


def _is_part(file: RclpyFile, node: ast.expr, part: str) -> bool:
    """Return whether an expression is one part of a time, of any origin."""
    verdicts = [_is_plain_part(file, origin, part) for origin in _origins(file, node)]
    return bool(verdicts) and all(x is not False for x in verdicts) and True in verdicts


def _origins(file: RclpyFile, node: ast.expr) -> Sequence[ast.expr]:
    match node:
        case ast.Call(func=ast.Name(id=name), args=[inner]) if name in _WRAPPERS:
            return _origins(file, inner)
        case ast.Attribute(attr="sec" | "nanosec"):
            return [node]
    origins = file.evaluator.origins(node)
    return origins if len(origins) != 1 or origins[0] is node else _origins(file, origins[0])


def _is_plain_part(file: RclpyFile, node: ast.expr, part: str) -> bool | None:
    """Return whether an expression is one part of a time; ``None`` for an initial value."""
    match node:
        case ast.Call(func=ast.Name(id=name), args=[inner]) if name in _WRAPPERS:
            return _is_plain_part(file, inner, part)
        case ast.Attribute(attr=attribute):
            return attribute == part
        case ast.Subscript(
            value=ast.Call(func=ast.Attribute(attr="seconds_nanoseconds")),
            slice=ast.Constant(value=int(number)),
        ) if number in {0, 1}:
            return _PARTS[number] == part
        case ast.Constant(value=int() | float()):
            return None
    return False


def _has_other_part(file: RclpyFile, node: ast.AST, part: str) -> bool:
    """Return whether the function also uses the other part of the time."""
    function = file.function_of(node) or file.module.tree
    other = _PARTS[1 - _PARTS.index(part)]
    return any(
        attribute.attr in {other, "nanoseconds"}
        for attribute in file.module.below(function, ast.Attribute)
    )


def _is_step(file: RclpyFile, node: ast.expr) -> bool:
    """Return whether a difference is used as a factor, as a divisor, or called a step."""
    parent = file.module.parent(node)
    match parent:
        case ast.Call(func=ast.Name(id=name)) if name in _WRAPPERS:
            return _is_step(file, parent)
        case ast.BinOp(op=ast.Mult(), left=ast.Constant(value=100)):
            return False  # the progress in per cent
        case ast.BinOp(op=ast.Mult() | ast.Div()):
            return True
        case ast.Assign(targets=[ast.Name(id=name) | ast.Attribute(attr=name) as target]):
            return name in _STEPS or any(_is_factor(file, use) for use in _uses(file, target))
    return False


def _is_meant_whole(file: RclpyFile, node: ast.BinOp) -> bool:
    """Return whether whole seconds are enough: only compared, or counted once per second."""
    match file.module.parent(node):
        case ast.Assign(targets=[ast.Name() | ast.Attribute() as target]):
            tests = [file.module.parent(use) for use in _uses(file, target)]
        case _:
            return False
    if all(isinstance(test, ast.Compare) for test in tests):
        return True
    begin = file.module.text(node.right).removesuffix(".sec")
    conditions = [file.module.parent(test) for test in tests if isinstance(test, ast.Compare)]
    return any(
        begin in map(file.module.text, statement.targets)
        for condition in conditions
        for statement in (condition.body if isinstance(condition, ast.If) else ())
        if isinstance(statement, ast.Assign)
    )


def _uses(file: RclpyFile, target: ast.expr) -> Sequence[ast.Name | ast.Attribute]:
    """Return the reads of a variable; of a local one, in its function."""
    if isinstance(target, ast.Attribute):
        uses: Sequence[ast.Name | ast.Attribute] = file.module.index.attributes(target.attr)
    else:
        name = target.id if isinstance(target, ast.Name) else ""
        function = file.module.enclosing_function(target)
        names = file.module.index.names(name)
        uses = [x for x in names if file.module.enclosing_function(x) is function]
    return [use for use in uses if isinstance(use.ctx, ast.Load)]


def _is_factor(file: RclpyFile, use: ast.expr) -> bool:
    parent = file.module.parent(use)
    return isinstance(parent, ast.BinOp) and isinstance(parent.op, ast.Mult | ast.Div)
