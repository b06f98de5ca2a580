"""ND099: logger levels are severities."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Report
from scaffold.api.python import is_handled, is_known
from scaffold.api.rclpy import RclpyFile, is_of_rclpy

_SEVERITIES = frozenset({0, 10, 20, 30, 40, 50})
_SET = "rclpy.logging.set_logger_level"
_NODE = (
    "from rclpy.logging import LoggingSeverity, set_logger_level\n"
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.get_logger().set_level({0})\n"
    "        set_logger_level('talker', {0})\n"
)


class LogLevelUnusable(RclpyRule):
    """The level of a logger is a str, or a number that is not a severity.

    **Why.** ``ValueError: 'debug' is not a valid LoggingSeverity``.

    **Fix.** ``LoggingSeverity.DEBUG``, from ``rclpy.logging``.

    **Source.** ``rclpy/logging.py``; ``rclpy/impl/rcutils_logger.py``, ``set_level``.
    """

    code = "ND099"
    name = "log-level-unusable"
    examples = (
        Example("a severity", {"talker.py": _NODE.format("LoggingSeverity.DEBUG")}),
        Example("the number of a severity", {"talker.py": _NODE.format("10")}),
        Example(
            "another logger",
            {
                "talker.py": "import rclpy\n\n\nclass Log:\n    def get_logger(self):\n"
                "        return self\n\n    def start(self):\n"
                "        self.get_logger().set_level('debug')\n"
            },
        ),
        Example(
            "a str",
            {"talker.py": _NODE.format("'debug'")},
            Report("8:37", "'debug' is not a LoggingSeverity: ValueError"),
            Report("9:36", "'debug' is not a LoggingSeverity: ValueError"),
        ),
        Example(
            "a number",
            {"talker.py": _NODE.format("1")},
            Report("8:37", "1 is not a LoggingSeverity: ValueError"),
            Report("9:36", "1 is not a LoggingSeverity: ValueError"),
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for call, level in _levels(file):
            value = file.evaluator.evaluate(level)
            is_severity = type(value) is int and value in _SEVERITIES
            if (
                is_known(value)
                and not is_severity
                and not is_handled(file.module, call, "ValueError")
            ):
                message = f"{value!r} is not a LoggingSeverity: ValueError"
                yield self.report(file.module.location(level), message)


def _levels(file: RclpyFile) -> Iterator[tuple[ast.Call, ast.expr]]:
    """Yield the levels that rclpy loggers are set to."""
    for attribute in file.module.index.attributes("set_level"):
        call = file.module.parent(attribute)
        if not isinstance(call, ast.Call) or call.func is not attribute or len(call.args) != 1:
            continue
        if _is_logger(file, file.evaluator.single_value(attribute.value)):
            yield call, call.args[0]
    for call in file.module.walk(ast.Call):
        if file.module.qualified_name(call.func) == _SET and len(call.args) > 1:
            yield call, call.args[1]


def _is_logger(file: RclpyFile, node: ast.expr) -> bool:
    """Return whether an expression gets a logger from a node or from rclpy itself."""
    match node:
        case ast.Call(func=ast.Attribute(value=owner, attr="get_logger") as method):
            is_node = file.owner_of(owner) is not None and is_of_rclpy(file, method)
            return is_node or file.module.qualified_name(method) == "rclpy.logging.get_logger"
        case ast.Call(func=ast.Name() as function):
            return file.module.qualified_name(function) == "rclpy.logging.get_logger"
    return False
