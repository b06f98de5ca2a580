"""ND069: message stamps are converted to rclpy times before arithmetic."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule
from scaffold.api.python import PythonModule
from scaffold.api.rclpy import RclpyFile, class_of

from ._clocks import NUMBER, clocks_of

_SPANS = frozenset({"rclpy.duration.Duration", "rclpy.time.Time"})
_NODE = (
    "from rclpy.node import Node\nfrom rclpy.time import Time\n"
    "from sensor_msgs.msg import Image\n\n\n"
    "class Viewer(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('viewer')\n"
    "        self.create_subscription(Image, 'image', self.on_image, 10)\n\n"
    "    def on_image(self, msg):\n"
    "        age = self.get_clock().now() - {}\n"
    "        self.age = age\n"
)


class StampComputedWith(RclpyRule):
    """The stamp of a message is used in arithmetic, or the difference of two times as a number.

    **Why.** ``TypeError: unsupported operand type(s) for -: 'Time' and 'Time'``: a message contains
    a ``builtin_interfaces/Time``, which has fields, but no operators. The difference of two times
    of rclpy is a ``Duration``, which cannot be multiplied by a speed. The sum of two fields
    ``nanosec`` reaches a second in half of all cases, and then is not a valid time.

    **Fix.** Use ``Time.from_msg(msg.header.stamp)``, with ``from rclpy.time import Time``; for
    seconds, ``(now - last).nanoseconds / 1e9``.

    **Source.** ``rclpy/time.py``, ``Time.from_msg``; ``builtin_interfaces/msg/Time.msg``.
    """

    code = "ND069"
    name = "stamp-computed-with"
    examples = (
        Example("converted", {"viewer.py": _NODE.format("Time.from_msg(msg.header.stamp)")}),
        Example(
            "nanoseconds of two stamps",
            {
                "viewer.py": _NODE.format("Time()") + "        stamp = msg.header.stamp\n"
                "        stamp.nanosec = stamp.nanosec % 1000 + self.start.nanosec\n"
            },
            "15:25: this sum may reach 1e9 nanoseconds, which is not a valid time; carry the "
            "second over, or add a Duration to Time.from_msg(...)",
        ),
        Example(
            "nanoseconds with the second carried over",
            {
                "viewer.py": _NODE.format("Time()") + "        stamp = msg.header.stamp\n"
                "        stamp.nanosec = stamp.nanosec + self.start.nanosec\n"
                "        if stamp.nanosec >= 1000000000:\n"
                "            stamp.sec += 1\n            stamp.nanosec -= 1000000000\n"
            },
        ),
        Example(
            "its seconds",
            {"viewer.py": _NODE.format("msg.header.stamp").replace("stamp\n", "stamp.sec\n")},
        ),
        Example(
            "not converted",
            {"viewer.py": _NODE.format("msg.header.stamp")},
            "12:15: message stamp is not an rclpy Time: TypeError; use Time.from_msg(...)",
        ),
        Example(
            "two stamps, and a number",
            {
                "viewer.py": _NODE.format("Time()") + "\n    def is_old(self, msg, other):\n"
                "        stamp = msg.header.stamp\n"
                "        return stamp < other.header.stamp or stamp - 0.1\n"
            },
            "17:16: message stamp is not an rclpy Time: TypeError; use Time.from_msg(...)",
            "17:46: message stamp is not an rclpy Time: TypeError; use Time.from_msg(...)",
        ),
        Example(
            "stored in attributes",
            {
                "viewer.py": _NODE.format("self.last") + "        self.last = msg.header.stamp\n\n"
                "    def tick(self):\n"
                "        now = self.get_clock().now().to_msg()\n"
                "        self.is_late = now - self.started > 1\n\n"
                "    def start(self):\n"
                "        self.started = self.get_clock().now()\n"
            },
            "12:15: message stamp is not an rclpy Time: TypeError; use Time.from_msg(...)",
            "18:24: message stamp is not an rclpy Time: TypeError; use Time.from_msg(...)",
        ),
        Example(
            "converted when it is stored",
            {
                "viewer.py": _NODE.format("self.last")
                + "        self.last = Time.from_msg(msg.header.stamp)\n"
            },
        ),
        Example(
            "a header of another class",
            {
                "viewer.py": _NODE.format("Time()") + "\n    def is_old(self, msg, other):\n"
                "        msg.header.stamp = other\n"
                "        return msg.header.stamp - 0.1\n"
            },
        ),
        Example(
            "a duration in seconds",
            {
                "viewer.py": _NODE.format("self.last")
                + "        self.last = self.get_clock().now()\n"
                "        dt = age.nanoseconds / 1e9\n"
                "        self.x += self.speed * dt\n"
            },
        ),
        Example(
            "a duration as a number",
            {
                "viewer.py": _NODE.format("self.last")
                + "        self.last = self.get_clock().now()\n"
                "        self.x += self.speed * age\n"
            },
            "15:32: rclpy Duration is not a number of seconds: TypeError; use .nanoseconds / 1e9",
        ),
        Example(
            "the key to sort messages by",
            {
                "kept.py": "from rclpy.time import Time\n\n\n"
                "def oldest(kept):\n"
                "    kept.sort(key=lambda item: item.header.stamp)\n"
                "    return min(kept, key=lambda item: Time.from_msg(item.header.stamp))\n"
            },
            "5:32: message stamps cannot be compared: TypeError; use Time.from_msg(...)",
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for total in _sums_of_nanoseconds(file.module):
            message = (
                "this sum may reach 1e9 nanoseconds, which is not a valid time; carry the second "
                "over, or add a Duration to Time.from_msg(...)"
            )
            yield self.report(file.module.location(total), message, cause="sum of nanoseconds")
        for span in _scaled_spans(file):
            message = "rclpy Duration is not a number of seconds: TypeError; use .nanoseconds / 1e9"
            yield self.report(file.module.location(span), message, cause="duration as a number")
        if not any(file.module.index.attributes("stamp")):
            return
        for node in [*file.module.walk(ast.BinOp), *file.module.walk(ast.Compare)]:
            if _is_flawed(file, node):
                message = "message stamp is not an rclpy Time: TypeError; use Time.from_msg(...)"
                yield self.report(file.module.location(node), message)
        for call in file.module.walk(ast.Call):
            for word in call.keywords:
                match word:
                    case ast.keyword(
                        arg="key",
                        value=ast.Lambda(
                            body=ast.Attribute(
                                attr="stamp", value=ast.Attribute(attr="header")
                            ) as stamp
                        ),
                    ):
                        message = (
                            "message stamps cannot be compared: TypeError; use Time.from_msg(...)"
                        )
                        yield self.report(file.module.location(stamp), message)


def _sums_of_nanoseconds(module: PythonModule) -> Iterator[ast.expr]:
    """Yield sums with a field ``nanosec`` that another one is set to and that is not used again."""
    for statement in module.walk(ast.Assign):
        match statement:
            case ast.Assign(
                targets=[ast.Attribute(attr="nanosec")],
                value=ast.BinOp(left=left, op=ast.Add(), right=right) as total,
            ) if _is_nanoseconds(left) or _is_nanoseconds(right):
                function = module.enclosing_function(statement)
                around = function if function is not None else module.tree
                read = module.below(around, ast.Attribute)
                inside = {id(part) for part in ast.walk(total)}
                if not any(
                    _is_nanoseconds(part) and id(part) not in inside
                    for part in read
                    if isinstance(part.ctx, ast.Load)
                ):
                    yield total


def _is_nanoseconds(node: ast.AST) -> bool:
    return isinstance(node, ast.Attribute) and node.attr == "nanosec"


def _scaled_spans(file: RclpyFile) -> Iterator[ast.expr]:
    """Yield differences of times that something of unknown type is multiplied by or divided by."""
    for node in file.module.walk(ast.BinOp):
        match node:
            case ast.BinOp(left=left, op=ast.Mult() | ast.Div(), right=ast.Name() as right):
                is_number = isinstance(left, ast.Constant)  # which TY006 reports
                if not is_number and _is_difference_of_times(file, right):
                    yield right


def _is_difference_of_times(file: RclpyFile, node: ast.expr) -> bool:
    match file.evaluator.single_value(node):
        case ast.BinOp(left=left, op=ast.Sub(), right=right):
            clocks = [*clocks_of(file, left).values(), *clocks_of(file, right).values()]
            return None not in clocks and NUMBER not in clocks
    return False


def _is_flawed(file: RclpyFile, node: ast.AST) -> bool:
    match node:
        case ast.BinOp(left=left, op=ast.Add() | ast.Sub(), right=right):
            return _are_stamps(file, left, right)
        case ast.Compare(
            left=left, ops=[ast.Lt() | ast.LtE() | ast.Gt() | ast.GtE()], comparators=[right]
        ):
            return _are_stamps(file, left, right)
    return False


def _are_stamps(file: RclpyFile, *sides: ast.expr) -> bool:
    """Return whether one operand is a message stamp, and the other a stamp, time or number."""
    stamps = [_is_stamp(file, side) for side in sides]
    return any(stamps) and all(
        is_stamp or _is_time_or_number(file, side)
        for is_stamp, side in zip(stamps, sides, strict=True)
    )


def _is_stamp(file: RclpyFile, node: ast.expr) -> bool:
    """Return whether an expression is a time message, also through variables."""
    value = file.evaluator.single_value(node)
    if _is_time_message(file, value):
        return True
    values = file.evaluator.values(value) if isinstance(value, ast.Name | ast.Attribute) else ()
    return bool(values) and all(
        _is_time_message(file, file.evaluator.single_value(other)) for other in values
    )


def _is_time_message(file: RclpyFile, node: ast.expr) -> bool:
    """Return whether it is ``to_msg()``, or the stamp of a header that is not set there."""
    match node:
        case ast.Call(func=ast.Attribute(attr="to_msg", value=time)):
            return class_of(file, time) == "rclpy.time.Time"
        case ast.Attribute(attr="stamp", value=ast.Attribute(attr="header")) as stamp:
            stores = [*file.evaluator.stores("stamp"), *file.evaluator.stores("header")]
            text = f"{file.module.text(stamp)}."
            function = file.module.enclosing_function(stamp)
            return not any(
                text.startswith(f"{file.module.text(x.node)}.")
                for x in stores
                if file.module.enclosing_function(x.node) is function or text.startswith("self.")
            )
    return False


def _is_time_or_number(file: RclpyFile, node: ast.expr) -> bool:
    return class_of(file, node) in _SPANS or type(file.evaluator.evaluate(node)) in {int, float}
