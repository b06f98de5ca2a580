"""ND060: parameters are constructed and declared in the form of rclpy."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Report
from scaffold.api.python import UNKNOWN
from scaffold.api.rclpy import PARAMETER, RclpyFile

_KINDS = {
    "BOOL": bool,
    "BOOL_ARRAY": list,
    "BYTE_ARRAY": list,
    "DOUBLE": float,
    "DOUBLE_ARRAY": list,
    "INTEGER": int,
    "INTEGER_ARRAY": list,
    "STRING": str,
    "STRING_ARRAY": list,
}
_NODE = (
    "from rclpy.node import Node\nfrom rclpy.parameter import Parameter\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.declare_parameters('', [{}])\n"
    "        self.set_parameters({})\n"
)
_RIGHT = ("('rate', 1.0)", "[Parameter('rate', Parameter.Type.DOUBLE, 2.0)]")


class ParameterMadeWrongly(RclpyRule):
    """A parameter is constructed or declared in a form that rclpy rejects.

    **Why.** ``ValueError: Type '2' and value ... do not agree``, or ``TypeError``.

    **Fix.** ``Parameter('rate', Parameter.Type.DOUBLE, 2.0)``, a list of pairs for
    ``declare_parameters``.

    **Source.** ``rclpy/parameter.py``; ``rclpy/node.py``.
    """

    code = "ND060"
    name = "parameter-made-wrongly"
    examples = (
        Example("pairs, a type with a value", {"talker.py": _NODE.format(*_RIGHT)}),
        Example(
            "no pairs, a type without a value",
            {"talker.py": _NODE.format("'rate', 1.0", "[Parameter('a', Parameter.Type.STRING)]")},
            Report("8:38", "expected a pair ('name', default): TypeError"),
            Report("9:45", "type without a value: ValueError"),
        ),
        Example(
            "a value in place of the type, another type",
            {
                "talker.py": _NODE.format(
                    "('rate', 1.0)",
                    "[Parameter('rate', 2.0), Parameter('rate', Parameter.Type.DOUBLE, 'a')]",
                )
            },
            Report("9:48", "the second argument is the type: TypeError; write value=..."),
            Report("9:95", "type is Parameter.Type.DOUBLE, but the value is a str: ValueError"),
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for call in file.module.walk(ast.Call):
            for node, problem in _problems(file, call):
                yield self.report(file.module.location(node), problem)


def _problems(file: RclpyFile, call: ast.Call) -> Iterator[tuple[ast.AST, str]]:
    name = file.module.qualified_name(call.func) or ""
    if name in {PARAMETER, "rclpy.Parameter"}:
        yield from _made(file, call)
    match call.func:
        case ast.Attribute(attr="declare_parameters", value=owner):
            listed = call.args[1] if len(call.args) > 1 else None
            if isinstance(listed, ast.List) and file.owner_of(owner) is not None:
                for item in listed.elts:
                    if isinstance(item, ast.Constant):
                        yield item, "expected a pair ('name', default): TypeError"
                        break


def _made(file: RclpyFile, call: ast.Call) -> Iterator[tuple[ast.AST, str]]:
    given = dict(zip(("name", "type_", "value"), call.args, strict=False))
    given.update({word.arg: word.value for word in call.keywords if word.arg})
    type_, value = given.get("type_"), given.get("value")
    if type_ is None:
        return
    constant = file.evaluator.evaluate(type_)
    if constant is not UNKNOWN and constant is not None:
        yield type_, "the second argument is the type: TypeError; write value=..."
        return
    kind = _KINDS.get((file.module.qualified_name(type_) or "").rpartition(".Type.")[2])
    if kind is not None and value is None and not any(word.arg is None for word in call.keywords):
        yield type_, "type without a value: ValueError"
    evaluated = file.evaluator.evaluate(value)
    if kind is None or value is None or evaluated is UNKNOWN or evaluated is None:
        return
    if type(evaluated) is not kind and not isinstance(evaluated, tuple):
        word = type(evaluated).__name__
        yield (value, f"type is {file.module.text(type_)}, but the value is a {word}: ValueError")
