"""ND059: loggers get known options and formatted messages."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from difflib import get_close_matches

from scaffold.api import Diagnostic, Example, RclpyRule, Report
from scaffold.api.rclpy import RclpyFile, is_of_rclpy

_METHODS = frozenset({"debug", "info", "warn", "warning", "error", "fatal"})
_KNOWN = ("throttle_duration_sec", "throttle_time_source_type", "skip_first", "once", "name")
_NODE = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def tell(self, text):\n"
    "        self.get_logger().info({})\n"
)


class LogKeywordUnknown(RclpyRule):
    """A logger gets an unknown option, or a message that is not formatted.

    **Why.** ``TypeError: parameter "throttle" is not one of the recognized logging options``; a
    string without ``f`` is logged with its braces; a str and a number cannot be added.

    **Fix.** ``throttle_duration_sec``, ``skip_first``, ``once``; ``f'...'``.

    **Source.** ``rclpy/impl/rcutils_logger.py``.
    """

    code = "ND059"
    name = "log-keyword-unknown"
    examples = (
        Example(
            "known option", {"talker.py": _NODE.format("f'{text}', throttle_duration_sec=1.0")}
        ),
        Example(
            "an option of another logger",
            {
                "talker.py": _NODE.format("text, internal=True")
                + "\n    def get_logger(self):\n        return self.log\n"
            },
        ),
        Example(
            "unknown option",
            {"talker.py": _NODE.format("text, throttle=1.0")},
            Report(
                "talker.py:6:38",
                "a logger has no option 'throttle': TypeError; did you mean "
                "'throttle_duration_sec'?",
            ),
        ),
        Example(
            "a missing f prefix",
            {"talker.py": _NODE.format("'heard {text}'")},
            Report("talker.py:6:32", "{text} is logged literally: the string has no f prefix"),
        ),
        Example(
            "a number added",
            {"talker.py": _NODE.format("'heard ' + 1")},
            Report("talker.py:6:32", "a number is added to a str: TypeError; use an f-string"),
        ),
    )

    def check_file(self, facts: RclpyFile) -> Iterator[Diagnostic]:
        for attribute in facts.module.index.attributes("get_logger"):
            call = _log_call(facts, attribute)
            if call is not None and is_of_rclpy(facts, attribute):
                yield from self._check(facts, call)

    def _check(self, facts: RclpyFile, call: ast.Call) -> Iterator[Diagnostic]:
        for word in call.keywords:
            if word.arg is None or word.arg in (*_KNOWN, "message"):
                continue
            near = get_close_matches(word.arg, _KNOWN, 1, 0.5)
            hint = f"; did you mean {near[0]!r}?" if near else ""
            message = f"a logger has no option {word.arg!r}: TypeError{hint}"
            yield self.report(facts.module.location(word), message)
        text = call.args[0] if call.args else None
        if isinstance(text, ast.BinOp) and _adds_number(facts, text):
            message = "a number is added to a str: TypeError; use an f-string"
            yield self.report(facts.module.location(text), message)
        if isinstance(text, ast.Constant) and isinstance(text.value, str):
            for name in re.findall(r"\{((?:self\.)?[a-z_]\w*(?:\.\w+)*)(?::[^{}]*)?\}", text.value):
                if _is_bound(facts, text, name.partition(".")[0]):
                    message = f"{{{name}}} is logged literally: the string has no f prefix"
                    yield self.report(facts.module.location(text), message)
                    return


def _log_call(facts: RclpyFile, attribute: ast.Attribute) -> ast.Call | None:
    """Return the logging call on the result of ``get_logger()``."""
    logger = facts.module.parent(attribute)
    method = facts.module.parent(logger) if isinstance(logger, ast.Call) else None
    call = facts.module.parent(method) if isinstance(method, ast.Attribute) else None
    if isinstance(call, ast.Call) and isinstance(method, ast.Attribute) and call.func is method:
        return call if method.attr in _METHODS else None
    return None


def _adds_number(facts: RclpyFile, node: ast.BinOp) -> bool:
    if not isinstance(node.op, ast.Add):
        return False
    left = facts.evaluator.evaluate(node.left)
    right = facts.evaluator.evaluate(node.right)
    is_number = type(right) in {int, float} or (
        isinstance(node.right, ast.Attribute) and facts.is_number(node.right)
    )
    return isinstance(left, str) and is_number


def _is_bound(facts: RclpyFile, at: ast.Constant, name: str) -> bool:
    probe = ast.Name(id=name, ctx=ast.Load())
    for node in facts.module.index.names(name):
        if facts.module.enclosing_function(node) is facts.module.enclosing_function(at):
            probe = node
            break
    else:
        function = facts.module.enclosing_function(at)
        arguments = function.args.args if function else []
        return any(argument.arg == name for argument in arguments)
    return facts.module.index.lookup(probe.id, probe) is not None
