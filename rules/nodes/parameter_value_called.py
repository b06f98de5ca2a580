"""ND097: the value of a parameter is read, not called."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Report
from scaffold.api.rclpy import FIELDS, PARAMETER, RclpyFile, class_of

_NODE = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.declare_parameter('rate', 2.0)\n"
    "        self.rate = self.get_parameter('rate').{}\n"
)


class ParameterValueCalled(RclpyRule):
    """The value of a parameter is called as if it were a method.

    **Why.** ``TypeError: 'float' object is not callable``.

    **Fix.** Remove the parentheses: ``self.get_parameter('rate').value``.

    **Source.** ``rclpy/parameter.py``; ``rcl_interfaces/msg/ParameterValue.msg``.
    """

    code = "ND097"
    name = "parameter-value-called"
    examples = (
        Example("the value", {"talker.py": _NODE.format("value")}),
        Example(
            "called",
            {"talker.py": _NODE.format("value()")},
            Report(
                "8:21", "'value' is a property of Parameter, not a method: TypeError; remove the ()"
            ),
        ),
        Example(
            "a field of the message",
            {"talker.py": _NODE.format("get_parameter_value().double_value()")},
            Report("8:21", "'double_value' is a field, not a method: TypeError; remove the ()"),
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for call in file.module.walk(ast.Call):
            problem = _problem(file, call.func)
            if problem:
                message = f"{problem}: TypeError; remove the ()"
                yield self.report(file.module.location(call), message)


def _problem(file: RclpyFile, called: ast.expr) -> str:
    """Return the problem with calling an expression."""
    match called:
        case ast.Attribute(attr="value", value=owner) if class_of(file, owner) == PARAMETER:
            return "'value' is a property of Parameter, not a method"
        case ast.Attribute(attr=name, value=owner) if name in FIELDS and _is_message(file, owner):
            return f"{name!r} is a field, not a method"
    return ""


def _is_message(file: RclpyFile, node: ast.expr) -> bool:
    """Return whether an expression is the result of ``get_parameter_value()``."""
    match file.evaluator.single_value(node):
        case ast.Call(func=ast.Attribute(attr="get_parameter_value", value=parameter)):
            return class_of(file, parameter) == PARAMETER
    return False
