"""ND095: fields of ParameterValue are read, not the message itself."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Report
from scaffold.api.rclpy import ParameterRead, RclpyFile, stands_for_value

_NODE = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.declare_parameter('rate', 2.0)\n"
    "        period = 1.0 / self.get_parameter('rate').get_parameter_value(){}\n"
    "        self.create_timer(period, self.tick)\n\n"
    "    def tick(self):\n        pass\n"
)


class ParameterMessageUsed(RclpyRule):
    """A ParameterValue message is used as if it were the value of the parameter.

    **Why.** ``TypeError: unsupported operand type(s) for /: 'float' and 'ParameterValue'``.

    **Fix.** Read the field of the type, such as ``.double_value``, or write
    ``self.get_parameter('rate').value``.

    **Source.** ``rclpy/parameter.py``; ``rcl_interfaces/msg/ParameterValue.msg``.
    """

    code = "ND095"
    name = "parameter-message-used"
    examples = (
        Example("a field", {"talker.py": _NODE.format(".double_value")}),
        Example(
            "used in arithmetic",
            {"talker.py": _NODE.format("")},
            Report("8:24", "get_parameter_value() returns a message, not the value; use .value"),
        ),
        Example(
            "compared",
            {"talker.py": _NODE.format(" > 1.0").replace("1.0 / ", "")},
            Report("8:18", "get_parameter_value() returns a message, not the value; use .value"),
        ),
        Example(
            "used as a period",
            {"talker.py": _NODE.format("").replace("1.0 / ", "")},
            Report("9:27", "get_parameter_value() returns a message, not the value; use .value"),
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for read in file.parameter_reads:
            used = _used_as_number(file, read)
            if used is not None:
                message = "get_parameter_value() returns a message, not the value; use .value"
                yield self.report(file.module.location(used), message)


def _used_as_number(file: RclpyFile, read: ParameterRead) -> ast.AST | None:
    """Return where the message is used as a number, or as the period of a timer."""
    attribute = file.module.parent(read.call)
    call = file.module.parent(attribute) if isinstance(attribute, ast.Attribute) else None
    if not isinstance(attribute, ast.Attribute) or attribute.attr != "get_parameter_value":
        return None
    if not isinstance(call, ast.Call):
        return None
    for timer in file.timers:
        period = timer.argument("timer_period_sec")
        if period is not None and file.evaluator.single_value(period.node) is call:
            return period.node
    return call if stands_for_value(file, call) else None
