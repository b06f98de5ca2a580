"""ND019: a log statement has a single severity."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Report
from scaffold.api.rclpy import LOG_METHODS, RclpyFile

_NODE = "from rclpy.node import Node\n\n\nclass Talker(Node):\n    def tick(self, bad):\n{}"
_BRANCHES = (
    "        if bad:\n            self.get_logger().error('bad')\n"
    "        else:\n            self.get_logger().info('good')\n"
)
_CHOICE = (
    "        log = self.get_logger().error if bad else self.get_logger().info\n"
    "        log('done')\n"
)


class LogSeverityVaries(RclpyRule):
    """The same log statement is executed with different severities.

    **Why.** rclpy remembers the severity of each place: ``ValueError: Logger severity cannot be
    changed between calls`` at the second severity.

    **Fix.** Write a separate call for each severity.

    **Source.** ``rclpy/impl/rcutils_logger.py``; rclpy issue 1199.
    """

    code = "ND019"
    name = "log-severity-varies"
    examples = (
        Example("separate calls", {"talker.py": _NODE.format(_BRANCHES)}),
        Example(
            "two names of one severity, and a severity that is chosen once",
            {
                "talker.py": _NODE.format(
                    "        log = self.get_logger()\n"
                    "        warn = log.warning if hasattr(log, 'warning') else log.warn\n"
                    "        warn('done')\n"
                    "\n\nlogger = rclpy.logging.get_logger('a')\n"
                    "log = logger.debug if DEBUG else logger.info\n"
                ),
            },
        ),
        Example(
            "a conditional method",
            {"talker.py": _NODE.format(_CHOICE)},
            Report("6:15", "log statement with two severities: ValueError; write two calls"),
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        module = file.module
        for node in module.walk(ast.IfExp):
            if module.enclosing_function(node) is None:
                continue  # chosen once, for the whole run
            chosen = {self._severity(branch) for branch in (node.body, node.orelse)}
            if None not in chosen and len(chosen) > 1:
                message = "log statement with two severities: ValueError; write two calls"
                yield self.report(module.location(node), message)

    def _severity(self, node: ast.expr) -> str | None:
        match node:
            case ast.Attribute(value=ast.Call(func=ast.Attribute(attr="get_logger"))):
                method = node.attr
            case ast.Attribute(value=ast.Name(id=name)) if "log" in name.lower():
                method = node.attr
            case _:
                return None
        if method not in LOG_METHODS:
            return None
        return "warning" if method == "warn" else method
