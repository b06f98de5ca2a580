"""ND018: log messages are strings."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, RclpyRule, Report
from scaffold.api.python import UNKNOWN
from scaffold.api.rclpy import RclpyFile, log_calls

_NODE = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def tick(self):\n"
    "        self.get_logger().info({})\n"
)


class LogMessageNotText(RclpyRule):
    """A logger gets a message that is not a str, or arguments to format.

    **Why.** rclpy does not convert it, nor does Python add a number to a str: ``TypeError`` when
    the line is reached.

    **Fix.** Write ``str(...)`` or an f-string.

    **Source.** ``rclpy/impl/rcutils_logger.py``.
    """

    code = "ND018"
    name = "log-message-not-text"
    examples = (
        Example("a str", {"talker.py": _NODE.format("f'{1}'")}),
        Example(
            "another logger",
            {
                "talker.py": _NODE.format("'%d', 42")
                + "\n    def get_logger(self):\n        return self.log\n"
            },
        ),
        Example(
            "a number",
            {"talker.py": _NODE.format("42")},
            Report("6:32", "log message is not a str: TypeError", fix="convert it to a str"),
            fixed={"talker.py": _NODE.format("str(42)")},
        ),
        Example(
            "arguments to format",
            {"talker.py": _NODE.format("'%d', 42")},
            Report("6:38", "loggers do not format arguments: TypeError; use an f-string"),
        ),
        Example(
            "a number added",
            {"talker.py": _NODE.format("'heard ' + 1")},
            Report("6:32", "a number is added to a str: TypeError; use an f-string"),
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for call in log_calls(file):
            if not call.args:
                continue
            message = call.args[0]
            if isinstance(message, ast.BinOp) and _adds_number(file, message):
                problem = "a number is added to a str: TypeError; use an f-string"
                yield self.report(file.module.location(message), problem)
            if len(call.args) > 1 and not isinstance(message, ast.Starred):
                at = file.module.location(call.args[1])
                yield self.report(at, "loggers do not format arguments: TypeError; use an f-string")
            elif self._is_not_str(file, message):
                start, end = file.module.span(message)
                path = file.module.path
                edits = (Edit(path, start, start, "str("), Edit(path, end, end, ")"))
                at = file.module.location(message)
                problem = "log message is not a str: TypeError"
                yield self.report(at, problem, Fix("convert it to a str", edits))

    def _is_not_str(self, file: RclpyFile, node: ast.expr) -> bool:
        if isinstance(node, ast.List | ast.Tuple | ast.Dict | ast.Set | ast.ListComp):
            return True
        if isinstance(node, ast.Call):
            return file.module.qualified_name(node.func) in {"len", "int", "float", "sum", "list"}
        if isinstance(node, ast.Attribute) and file.is_number(node):
            return True
        value = file.evaluator.evaluate(node)
        return value is not UNKNOWN and isinstance(value, int | float | list | tuple | dict)


def _adds_number(file: RclpyFile, node: ast.BinOp) -> bool:
    if not isinstance(node.op, ast.Add):
        return False
    left = file.evaluator.evaluate(node.left)
    right = file.evaluator.evaluate(node.right)
    is_number = type(right) in {int, float} or (
        isinstance(node.right, ast.Attribute) and file.is_number(node.right)
    )
    return isinstance(left, str) and is_number
