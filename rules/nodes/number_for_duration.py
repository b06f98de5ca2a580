"""ND094: arithmetic with rclpy times uses durations, not numbers."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Report
from scaffold.api.rclpy import RclpyFile, class_of

_DURATION = "rclpy.duration.Duration"
_TIME = "rclpy.time.Time"
_ORDERS = (ast.Lt, ast.LtE, ast.Gt, ast.GtE)
_NODE = (
    "from rclpy.duration import Duration\nfrom rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.start = self.get_clock().now() - {}\n\n"
    "    def is_late(self):\n"
    "        return self.get_clock().now() - self.get_clock().now() > {}\n"
)


class NumberForDuration(RclpyRule):
    """A number is used where an rclpy time needs a duration.

    **Why.** ``TypeError: unsupported operand type(s) for -: 'Time' and 'float'``, or ``'>' not
    supported between instances of 'Duration' and 'float'``; ``Duration(1.0)`` takes keywords only.

    **Fix.** ``Duration(seconds=1.0)``.

    **Source.** ``rclpy/duration.py``, ``rclpy/time.py``.
    """

    code = "ND094"
    name = "number-for-duration"
    examples = (
        Example(
            "durations",
            {"talker.py": _NODE.format("Duration(seconds=1.0)", "Duration(seconds=5.0)")},
        ),
        Example(
            "numbers",
            {"talker.py": _NODE.format("1.0", "5.0")},
            Report("8:22", "Time plus or minus a number: TypeError; use Duration(seconds=...)"),
            Report(
                "11:16", "Duration compared with a number: TypeError; use Duration(seconds=...)"
            ),
        ),
        Example(
            "a positional argument",
            {"talker.py": _NODE.format("Duration(1.0)", "Duration(seconds=5.0)")},
            Report("8:47", "Duration() takes only keyword arguments: TypeError; write seconds=..."),
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for node, problem in _problems(file):
            yield self.report(file.module.location(node), problem)


def _problems(file: RclpyFile) -> Iterator[tuple[ast.AST, str]]:
    """Yield expressions with a number instead of a duration, and their messages."""
    for call in file.module.walk(ast.Call):
        name = file.module.qualified_name(call.func)
        if name in {_DURATION, _TIME} and call.args:
            kind = name.rpartition(".")[2]
            yield call, f"{kind}() takes only keyword arguments: TypeError; write seconds=..."
    for comparison in file.module.walk(ast.Compare):
        left, operator, right = comparison.left, comparison.ops[0], comparison.comparators[0]
        if isinstance(operator, _ORDERS) and _is_number(file, right) and _kind(file, left):
            problem = "compared with a number: TypeError; use Duration(seconds=...)"
            yield comparison, f"{_kind(file, left)} {problem}"
    for sum_ in file.module.walk(ast.BinOp):
        is_sum = isinstance(sum_.op, ast.Add | ast.Sub) and _is_number(file, sum_.right)
        if is_sum and class_of(file, sum_.left) == _TIME:
            yield sum_, "Time plus or minus a number: TypeError; use Duration(seconds=...)"


def _is_number(file: RclpyFile, node: ast.expr) -> bool:
    return type(file.evaluator.evaluate(node)) in {int, float}


def _kind(file: RclpyFile, node: ast.expr) -> str:
    """Return ``Time`` or ``Duration`` if an expression certainly is one of them."""
    value = file.evaluator.single_value(node)
    if isinstance(value, ast.BinOp) and isinstance(value.op, ast.Sub):
        both = {class_of(file, value.left), class_of(file, value.right)}
        return "Duration" if both == {_TIME} else ""
    name = class_of(file, value) or ""
    return name.rpartition(".")[2] if name in {_DURATION, _TIME} else ""
