"""ND081: parameters are constructed and declared in a form that rclpy accepts."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from itertools import chain

from scaffold.api import Diagnostic, Effect, Example, RclpyRule
from scaffold.api.python import UNKNOWN, is_handled
from scaffold.api.rclpy import DESCRIPTOR, PARAMETER, Parameter, RclpyFile, is_of_node, message_made

_RANGES = ("floating_point_range", "integer_range")
_NODE = (
    "from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor\n"
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n    def __init__(self):\n        super().__init__('talker')\n"
    "        self.declare_parameter({}, 1.0, {})\n"
    "        self.declare_parameters('', [('mode', 'slow'{}), ('gain', 1.0)])\n"
)
_TEXT = "ParameterDescriptor(description='Hz')"
_RANGE = "FloatingPointRange(from_value=0.0, to_value=9.0)"
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
_NODE_MADE = (
    "from rclpy.node import Node\nfrom rclpy.parameter import Parameter\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.declare_parameters('', [{}])\n"
    "        self.set_parameters({})\n"
)
_RIGHT = ("('rate', 1.0)", "[Parameter('rate', Parameter.Type.DOUBLE, 2.0)]")


class ParameterDeclaredWrongly(RclpyRule):
    """A parameter is constructed or declared with invalid arguments.

    **Why.** ``ValueError: Type '2' and value ... do not agree``, ``TypeError: Third element ... is
    not a ParameterDescriptor``, ``TypeError: Invalid parameter tuple length``, ``TypeError:
    'FloatingPointRange' object is not subscriptable``.

    **Fix.** Write ``Parameter('rate', Parameter.Type.DOUBLE, 2.0)`` and
    ``ParameterDescriptor(description=...)``, pass a list of pairs to ``declare_parameters``, and a
    range as a list with one item.

    **Source.** ``rclpy/parameter.py``; ``rclpy/node.py``, ``declare_parameters``;
    ``ParameterDescriptor.msg``.
    """

    code = "ND081"
    name = "parameter-declared-wrongly"
    effect = Effect.STOPS_START
    examples = (
        Example("a descriptor", {"talker.py": _NODE.format("'rate'", _TEXT, f", {_TEXT}")}),
        Example(
            "names out of a list",
            {
                "talker.py": "from rclpy.node import Node\n"
                "from rclpy.parameter import Parameter\n\n"
                "NAMES = ['a', 'b', 'c', 'd']\n\n\nclass Talker(Node):\n"
                "    def __init__(self):\n        super().__init__('talker')\n"
                "        types = [(name, Parameter.Type.DOUBLE) for name in NAMES]\n"
                "        self.declare_parameters('', types)\n"
            },
        ),
        Example(
            "a str for the descriptor; four values",
            {"talker.py": _NODE.format("'rate'", "'Hz'", f", {_TEXT}, True")},
            "8:45: expected a ParameterDescriptor, not 'Hz': TypeError",
            "9:38: expected name, default and descriptor, but this has 4 values: TypeError",
        ),
        Example(
            "a range that is not a list; the descriptor class",
            {
                "talker.py": _NODE.format(
                    "'rate'",
                    f"ParameterDescriptor(floating_point_range={_RANGE})",
                    ", ParameterDescriptor",
                )
            },
            "8:45: floating_point_range must be a list with one range, not a range: TypeError",
            "9:55: expected a ParameterDescriptor object, not the class: TypeError",
        ),
        Example(
            "a class that is not a node",
            {
                "state.py": "import rclpy\nfrom yasmin import State\n\n\n"
                "class Wait(State):\n    def __init__(self):\n"
                "        self.declare_parameter('topic', 'what to wait for', 'chatter')\n"
            },
        ),
        Example(
            "a number as the descriptor",
            {"talker.py": _NODE.format("1.0", "None", "")},
            "8:32: the parameter name must be a str, not 1.0: TypeError",
        ),
        Example("pairs; a type with a value", {"talker.py": _NODE_MADE.format(*_RIGHT)}),
        Example(
            "no pairs; a type without a value",
            {
                "talker.py": _NODE_MADE.format(
                    "'rate', 1.0", "[Parameter('a', Parameter.Type.STRING)]"
                )
            },
            "8:38: expected a pair ('name', default): TypeError",
            "9:45: type without a value: ValueError",
        ),
        Example(
            "a name in parentheses, which is no tuple",
            {
                "talker.py": _NODE_MADE.format(
                    "('rate', 1.0)], parameters=[('rate', 1.0), ('mode')",
                    _RIGHT[1],
                ).replace("'', [('rate', 1.0)], ", "namespace='', ")
            },
            "8:75: expected a pair ('name', default): TypeError",
        ),
        Example(
            "constructed with a value instead of the type; with a different type",
            {
                "talker.py": _NODE_MADE.format(
                    "('rate', 1.0)",
                    "[Parameter('rate', 2.0), Parameter('rate', Parameter.Type.DOUBLE, 'a')]",
                )
            },
            "9:48: the second argument is the type: TypeError; write value=...",
            "9:95: type is Parameter.Type.DOUBLE, but the value is a str: ValueError",
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        yield from self._check_declared(file)
        yield from self._check_made(file)

    def _check_declared(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for parameter in (p for p in file.parameters if is_of_node(file, p)):
            for node, problem in _problems(file, parameter):
                if not is_handled(file.module, parameter.call, problem.rpartition(": ")[2]):
                    yield self.report(file.module.location(node), problem)

    def _check_made(self, file: RclpyFile) -> Iterator[Diagnostic]:
        made = (_made(file, call) for call in file.module.calls_of(PARAMETER, "rclpy.Parameter"))
        for node, problem in (*chain.from_iterable(made), *_without_default(file)):
            yield self.report(file.module.location(node), problem)


_VALUES = 3
"""Of a parameter: name, default and descriptor."""


def _problems(file: RclpyFile, parameter: Parameter) -> Iterator[tuple[ast.expr, str]]:
    name = file.evaluator.evaluate(parameter.name_node)
    if (
        parameter.name_node is not None
        and name is not UNKNOWN
        and (not name or type(name) is not str)
    ):
        yield parameter.name_node, f"the parameter name must be a str, not {name!r}: TypeError"
        return
    entry = file.module.parent(parameter.name_node) if parameter.name_node is not None else None
    if isinstance(entry, ast.Tuple | ast.List) and _is_listed(file, entry):
        count = len(entry.elts)
        yield (
            entry,
            f"expected name, default and descriptor, but this has {count} values: TypeError",
        )
    if parameter.descriptor_node is not None:
        problem = _descriptor_problem(file, parameter, parameter.descriptor_node)
        if problem:
            yield parameter.descriptor_node, problem


def _is_listed(file: RclpyFile, entry: ast.Tuple | ast.List) -> bool:
    """Return whether a list of parameters has an entry with too many values."""
    is_entry = isinstance(file.module.parent(entry), ast.List | ast.Tuple)
    return is_entry and len(entry.elts) > _VALUES


def _descriptor_problem(file: RclpyFile, parameter: Parameter, node: ast.expr) -> str:
    value = file.evaluator.evaluate(node)
    is_listed = "parameters" in parameter.arguments
    if value is not UNKNOWN and (value is not None or is_listed):
        return f"expected a ParameterDescriptor, not {value!r}: TypeError"
    if file.module.qualified_name(node) == DESCRIPTOR:
        return "expected a ParameterDescriptor object, not the class: TypeError"
    fields = message_made(file.evaluator, node, DESCRIPTOR) or {}
    for name in _RANGES:
        made = file.evaluator.single_value(fields[name]) if name in fields else None
        func = file.module.qualified_name(made.func) if isinstance(made, ast.Call) else None
        if func is not None and func.startswith("rcl_interfaces.msg."):
            return f"{name} must be a list with one range, not a range: TypeError"
    return ""


def _without_default(file: RclpyFile) -> Iterator[tuple[ast.AST, str]]:
    """Yield the first parameter of each list that has no default."""
    for call, called in file.module.method_calls("declare_parameters"):
        words = {word.arg: word.value for word in call.keywords}
        listed = call.args[1] if len(call.args) > 1 else words.get("parameters")
        if isinstance(listed, ast.List) and file.owner_of(called.value) is not None:
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
