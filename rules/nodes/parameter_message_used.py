"""ND095: fields of ParameterValue are read, not the message itself."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Report
from scaffold.api.rclpy import RclpyFile, use_as_value

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
            "its field, through a variable",
            {
                "talker.py": _NODE.format("\n        period = 1.0 / value.double_value").replace(
                    "period = 1.0 / self.get_parameter('rate')",
                    "value = self.get_parameter('rate')",
                    1,
                )
            },
        ),
        Example(
            "used through a variable, and an attribute",
            {
                "talker.py": _NODE.format("\n        period = 1.0 / value").replace(
                    "period = 1.0 / self.get_parameter('rate')",
                    "parameter = self.get_parameter('rate')\n"
                    "        self.rate = parameter.get_parameter_value()\n"
                    "        value = parameter",
                    1,
                )
                + "        self.limit = self.rate * 2\n"
            },
            Report("11:24", "get_parameter_value() returns a message, not the value; use .value"),
            Report("16:22", "get_parameter_value() returns a message, not the value; use .value"),
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
        reads = {item.call for item in (*file.parameter_reads, *file.parameters)}
        for attribute in file.module.index.attributes("get_parameter_value"):
            call = file.module.parent(attribute)
            is_of_node = file.evaluator.single_value(attribute.value) in reads
            if not isinstance(call, ast.Call) or call.func is not attribute or not is_of_node:
                continue
            used = _used_as_number(file, call)
            if used is not None:
                message = "get_parameter_value() returns a message, not the value; use .value"
                yield self.report(file.module.location(used), message)


def _used_as_number(file: RclpyFile, call: ast.Call) -> ast.AST | None:
    """Return where the message is used as a number, or as the period of a timer."""
    for timer in file.timers:
        period = timer.argument("timer_period_sec")
        if period is not None and file.evaluator.single_value(period.node) is call:
            return period.node
    return use_as_value(file, call)
