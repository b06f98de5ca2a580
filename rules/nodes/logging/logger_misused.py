"""ND018: loggers get strings and valid levels, and each statement has one severity."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, RclpyRule, Report, Severity
from scaffold.api.python import UNKNOWN, all_conditions, is_handled, is_known
from scaffold.api.rclpy import LOG_METHODS, RclpyFile, is_of_rclpy, log_calls

_NODE = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def tick(self):\n"
    "        self.get_logger().info({})\n"
)
_NODE_SEVERITY = (
    "from rclpy.node import Node\n\n\nclass Talker(Node):\n    def tick(self, bad):\n{}"
)
_BRANCHES = (
    "        if bad:\n            self.get_logger().error('bad')\n"
    "        else:\n            self.get_logger().info('good')\n"
)
_CHOICE = (
    "        log = self.get_logger().error if bad else self.get_logger().info\n"
    "        log('done')\n"
)
_SEVERITIES = frozenset({0, 10, 20, 30, 40, 50})
_SET = "rclpy.logging.set_logger_level"
_NODE_LEVEL = (
    "from rclpy.logging import LoggingSeverity, set_logger_level\n"
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.get_logger().set_level({0})\n"
    "        set_logger_level('talker', {0})\n"
)


class LoggerMisused(RclpyRule):
    """A log statement gets a message that is not a str, an invalid level, or varying severities.

    **Why.** rclpy does not convert messages, and Python does not add a number to a str:
    ``TypeError`` when the line is executed. rclpy stores the severity of each log statement:
    ``ValueError: Logger severity cannot be changed between calls``. Levels are enumeration values:
    ``'debug' is not a valid LoggingSeverity``.

    **Fix.** Write ``str(...)`` or an f-string, a separate call for each severity, and
    ``LoggingSeverity.DEBUG`` from ``rclpy.logging``.

    **Source.** ``rclpy/impl/rcutils_logger.py``; ``rclpy/logging.py``; rclpy issue 1199.
    """

    code = "ND018"
    name = "logger-misused"
    other_severities = {Severity.WARNING: "the message is only evaluated at debug level"}
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
            "a number as message",
            {"talker.py": _NODE.format("42")},
            Report(
                "6:32",
                "log message is not a str: TypeError; convert it",
                fix="Convert the message to a str",
            ),
            fixed={"talker.py": _NODE.format("str(42)")},
        ),
        Example(
            "a number as a debug message",
            {"talker.py": _NODE.format("42").replace(".info(", ".debug(")},
            Report(
                "6:33",
                "log message is not a str: TypeError at debug level; convert it",
                fix="Convert the message to a str",
                severity=Severity.WARNING,
            ),
            fixed={"talker.py": _NODE.format("str(42)").replace(".info(", ".debug(")},
        ),
        Example(
            "arguments to format",
            {"talker.py": _NODE.format("'%d', 42")},
            "6:38: loggers do not format arguments: TypeError; use an f-string",
        ),
        Example(
            "a number added",
            {"talker.py": _NODE.format("'heard ' + 1")},
            "6:32: a number cannot be added to a str: TypeError; use an f-string",
        ),
        Example("a call for each severity", {"talker.py": _NODE_SEVERITY.format(_BRANCHES)}),
        Example(
            "two names for one severity, and a severity that is chosen once",
            {
                "talker.py": _NODE_SEVERITY.format(
                    "        log = self.get_logger()\n"
                    "        warn = log.warning if hasattr(log, 'warning') else log.warn\n"
                    "        warn('done')\n"
                    "\n\nlogger = rclpy.logging.get_logger('a')\n"
                    "log = logger.debug if DEBUG else logger.info\n"
                ),
            },
        ),
        Example(
            "a method that depends on a condition, reached once",
            {
                "talker.py": _NODE_SEVERITY.format(
                    "        if self.done:\n            return\n        self.done = True\n"
                    + _CHOICE
                )
                + "\n    def __init__(self):\n        self.done = False\n"
            },
        ),
        Example(
            "a method that depends on a condition, with a flag that is cleared",
            {
                "talker.py": _NODE_SEVERITY.format(
                    "        if self.done:\n            return\n        self.done = True\n"
                    + _CHOICE
                )
                + "\n    def start(self):\n        self.done = False\n"
            },
            "9:15: log statement with two severities: ValueError; write a separate call for each",
        ),
        Example(
            "a method that depends on a condition",
            {"talker.py": _NODE_SEVERITY.format(_CHOICE)},
            "6:15: log statement with two severities: ValueError; write a separate call for each",
        ),
        Example(
            "a severity for the level", {"talker.py": _NODE_LEVEL.format("LoggingSeverity.DEBUG")}
        ),
        Example("the number of a severity", {"talker.py": _NODE_LEVEL.format("10")}),
        Example(
            "the level of another logger",
            {
                "talker.py": "import rclpy\n\n\nclass Log:\n    def get_logger(self):\n"
                "        return self\n\n    def start(self):\n"
                "        self.get_logger().set_level('debug')\n"
            },
        ),
        Example(
            "a str for the level",
            {"talker.py": _NODE_LEVEL.format("'debug'")},
            "8:37: 'debug' is not a LoggingSeverity: ValueError; use LoggingSeverity.DEBUG or "
            "another level",
            "9:36: 'debug' is not a LoggingSeverity: ValueError; use LoggingSeverity.DEBUG or "
            "another level",
        ),
        Example(
            "a number for the level",
            {"talker.py": _NODE_LEVEL.format("1")},
            "8:37: 1 is not a LoggingSeverity: ValueError; use LoggingSeverity.DEBUG or another "
            "level",
            "9:36: 1 is not a LoggingSeverity: ValueError; use LoggingSeverity.DEBUG or another "
            "level",
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        yield from self._check_message(file)
        yield from self._check_severity(file)
        yield from self._check_level(file)

    def _check_message(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for call in log_calls(file):
            if not call.args:
                continue
            message = call.args[0]
            if isinstance(message, ast.BinOp) and _adds_number(file, message):
                problem = "a number cannot be added to a str: TypeError; use an f-string"
                yield self.report(file.module.location(message), problem)
            if len(call.args) > 1 and not isinstance(message, ast.Starred):
                at = file.module.location(call.args[1])
                yield self.report(at, "loggers do not format arguments: TypeError; use an f-string")
            elif self._is_not_str(file, message):
                start, end = file.module.span(message)
                path = file.module.path
                edits = (Edit(path, start, start, "str("), Edit(path, end, end, ")"))
                at = file.module.location(message)
                is_rare = isinstance(call.func, ast.Attribute) and call.func.attr == "debug"
                when = " at debug level" if is_rare else ""
                yield self.report(
                    at,
                    f"log message is not a str: TypeError{when}; convert it",
                    Fix("Convert the message to a str", edits),
                    severity=Severity.WARNING if is_rare else None,
                )

    def _is_not_str(self, file: RclpyFile, node: ast.expr) -> bool:
        if isinstance(node, ast.List | ast.Tuple | ast.Dict | ast.Set | ast.ListComp):
            return True
        if isinstance(node, ast.Call):
            return file.module.qualified_name(node.func) in {"len", "int", "float", "sum", "list"}
        value = file.evaluator.evaluate(node)
        return value is not UNKNOWN and isinstance(value, int | float | list | tuple | dict)

    def _check_severity(self, file: RclpyFile) -> Iterator[Diagnostic]:
        module = file.module
        for node in module.walk(ast.IfExp):
            if module.enclosing_function(node) is None:
                continue  # chosen once, for the whole run
            chosen = {self._severity(branch) for branch in (node.body, node.orelse)}
            if None not in chosen and len(chosen) > 1 and not _is_reached_once(file, node):
                message = (
                    "log statement with two severities: ValueError; write a separate call for each"
                )
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

    def _check_level(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for call, level in _levels(file):
            value = file.evaluator.evaluate(level)
            is_severity = type(value) is int and value in _SEVERITIES
            if (
                is_known(value)
                and not is_severity
                and not is_handled(file.module, call, "ValueError")
            ):
                message = (
                    f"{value!r} is not a LoggingSeverity: ValueError; use "
                    f"LoggingSeverity.DEBUG or another level"
                )
                yield self.report(file.module.location(level), message)


def _is_reached_once(file: RclpyFile, node: ast.AST) -> bool:
    """Return whether a flag, set for good, lets a node run once: ``if self.done: return``."""
    function = file.module.enclosing_function(node)
    for condition in all_conditions(file.module, node):
        test, blocking = condition.test, not condition.needed
        if isinstance(test, ast.UnaryOp) and isinstance(test.op, ast.Not):
            test, blocking = test.operand, not blocking
        stores = file.evaluator.stores(test.attr) if isinstance(test, ast.Attribute) else ()
        later = [
            (file.function_of(store.node), store.value and file.evaluator.evaluate(store.value))
            for store in stores
            if getattr(file.function_of(store.node), "name", "") != "__init__"
        ]
        is_set = (function, blocking) in later
        if is_set and all(value is blocking for _, value in later):
            return True
    return False


def _adds_number(file: RclpyFile, node: ast.BinOp) -> bool:
    if not isinstance(node.op, ast.Add):
        return False
    left = file.evaluator.evaluate(node.left)
    return isinstance(left, str) and type(file.evaluator.evaluate(node.right)) in {int, float}


def _levels(file: RclpyFile) -> Iterator[tuple[ast.Call, ast.expr]]:
    """Yield the levels that rclpy loggers are set to."""
    for call, method in file.module.method_calls("set_level"):
        logger = file.evaluator.single_value(method.value)
        if len(call.args) == 1 and _is_logger(file, logger):
            yield call, call.args[0]
    for call in file.module.calls_of(_SET):
        if len(call.args) > 1:
            yield call, call.args[1]


def _is_logger(file: RclpyFile, node: ast.expr) -> bool:
    """Return whether an expression returns a logger of a node or of rclpy."""
    match node:
        case ast.Call(func=ast.Attribute(value=owner, attr="get_logger") as method):
            is_node = file.owner_of(owner) is not None and is_of_rclpy(file, method)
            return is_node or file.module.qualified_name(method) == "rclpy.logging.get_logger"
        case ast.Call(func=ast.Name() as function):
            return file.module.qualified_name(function) == "rclpy.logging.get_logger"
    return False
