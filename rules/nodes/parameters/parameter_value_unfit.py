"""ND088: parameter values are used with their declared types."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, RclpyRule, Report, Safety
from scaffold.api.parameters import declared_by
from scaffold.api.python import UNKNOWN, Unknown, argument_of, conditions_on, is_handled
from scaffold.api.rclpy import FIELDS, NodeDefinition, RclpyFile, is_listed_parameter, name_asked

_NUMBERS = ("double", "integer")
_ARITHMETIC = (ast.Add, ast.Sub, ast.Mult, ast.Div, ast.FloorDiv)
_NODE = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n    def __init__(self):\n        super().__init__('talker')\n"
    "        self.declare_parameter('rate', {})\n"
    "        self.rate = self.get_parameter('rate').value\n\n"
    "    def start(self):\n"
    "        self.create_timer(1.0 / self.rate, self.tick)\n\n"
    "    def tick(self):\n        pass\n"
)
_COMPARED = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n    def __init__(self):\n        super().__init__('talker')\n"
    "        self.declare_parameter('on', {})\n"
    "        self.declare_parameter('rate', 1.0)\n"
    "        self.on = self.get_parameter('on').value {}\n"
)
_NO = frozenset({"false", "no", "off", "0"})
_SCALARS: Mapping[str, tuple[type, ...]] = {
    **dict.fromkeys(("bool", "double", "integer"), (bool, int, float)),
    "string": (str,),
}
"""The Python types of values that may equal those of parameters."""
_UNSET = {"bool_value": "False", "double_value": "0.0", "integer_value": "0", "string_value": "''"}
"""The values of fields of other types."""
_NODE_FIELDS = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.declare_parameter('period', 0.2)\n"
    "        self.period = self.get_parameter('period').get_parameter_value().{}\n"
)
_VARIABLES = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.parameter = self.declare_parameter('period', 0.2)\n"
    "        value = self.parameter.get_parameter_value()\n"
    "        self.period = value.{}\n"
)
_GIVING = frozenset({"get_parameter", "get_parameter_or", "declare_parameter"})


class ParameterValueUnfit(RclpyRule):
    """The value of a parameter is read or used with a type that differs from the declaration.

    **Why.** ``TypeError: unsupported operand type(s) for /: 'float' and 'str'``, ``'float' object
    cannot be interpreted as an integer``. A bool never equals ``'true'``: ``==`` is always false,
    without an error. The fields of ParameterValue for other types are always 0, False or empty.

    **Fix.** Declare the parameter with a default of the type that the code needs, and read
    ``.value`` or the field of that type.

    **Source.** ``rclpy/parameter.py``; declared parameters keep their type;
    ``rcl_interfaces/msg/ParameterValue.msg``.
    """

    code = "ND088"
    name = "parameter-value-unfit"
    examples = (
        Example("a number", {"talker.py": _NODE.format("2.0")}),
        Example(
            "converted",
            {
                "talker.py": _NODE.format("'2.0'")
                .replace("self.rate =", "self.rate = float(")
                .replace(".value", ".value)")
            },
        ),
        Example(
            "a str",
            {"talker.py": _NODE.format("'2.0'")},
            "11:27: 'rate' is declared as string, but 1.0 is a number: TypeError",
        ),
        Example(
            "a double in range(), added to a str",
            {
                "talker.py": _NODE.format("2.0")
                + "        for _ in range(self.rate):\n            print('Hz: ' + self.rate)\n"
            },
            "15:24: 'rate' is declared as double, but range() takes integers: TypeError",
            "16:19: 'rate' is declared as double, but 'Hz: ' is a str: TypeError",
        ),
        Example(
            "a bool and a number compared with a str, a str with a number",
            {
                "talker.py": _COMPARED.format("False", "== 'true'")
                + "        return self.get_parameter('rate').value in ('fast', 'slow')\n",
                "other.py": _COMPARED.format("'1'", "!= 1"),
            },
            "other.py:9:19: 'on' is declared as string, which never equals 1",
            "talker.py:9:19: 'on' is declared as bool, which never equals 'true'",
            "talker.py:10:16: 'rate' is declared as double, which never equals 'fast'",
        ),
        Example(
            "values of the types",
            {
                "talker.py": _COMPARED.format("False", "== True")
                + "        return self.get_parameter('rate').value in (1, 2.5)\n",
                "other.py": _COMPARED.format("'1'", "!= '1'"),
                "truth.py": _COMPARED.format("False", "== 1"),
                "both.py": _COMPARED.format("False", "")
                + "        on = self.get_parameter('on').value\n"
                "        return on is True or on == 'true'\n",
            },
        ),
        Example(
            "a parameter of any type",
            {
                "talker.py": _COMPARED.replace(
                    "'on', {}", "'on', False, ParameterDescriptor(dynamic_typing=True)"
                )
                .replace(
                    "from rclpy", "from rcl_interfaces.msg import ParameterDescriptor\nfrom rclpy"
                )
                .format("== 'true'")
            },
        ),
        Example("the field of its type", {"talker.py": _NODE_FIELDS.format("double_value")}),
        Example(
            "another field as a fallback",
            {
                "talker.py": _VARIABLES.format("double_value").replace(
                    "        self.period = value.double_value\n",
                    "        try:\n            self.period = value.double_value\n"
                    "        except AttributeError:\n"
                    "            self.period = value.integer_value\n",
                )
            },
        ),
        Example(
            "another field, if the parameter has its type",
            {
                "talker.py": _VARIABLES.format("double_value")
                + "        self.names = value.string_value if value.type == 4 else None\n"
            },
        ),
        Example(
            "another field",
            {"talker.py": _NODE_FIELDS.format("integer_value")},
            Report(
                "8:23",
                "'period' is declared as double: integer_value is always 0; use double_value",
                unsafe_fix="Read the field of the declared type",
            ),
            fixed={"talker.py": _NODE_FIELDS.format("double_value")},
        ),
        Example(
            "through variables",
            {"talker.py": _VARIABLES.format("string_value")},
            Report(
                "9:23",
                "'period' is declared as double: string_value is always ''; use double_value",
                unsafe_fix="Read the field of the declared type",
            ),
            fixed={"talker.py": _VARIABLES.format("double_value")},
        ),
        Example(
            "a str as a condition",
            {
                "saver.py": "from rclpy.node import Node\n\n\n"
                "class Saver(Node):\n    def __init__(self):\n"
                "        super().__init__('saver')\n"
                "        self.declare_parameter('save', 'false')\n"
                "        self.declare_parameter('folder', '')\n"
                "        self.declare_parameter('names', ['a'])\n"
                "        self.names = self.get_parameter('names').value\n"
                "        self.save = self.get_parameter('save').value\n"
                "        self.folder = self.get_parameter('folder').value\n"
                "        if self.save and self.folder:\n"
                "            self.get_logger().info('saves')\n"
                "        if self.save == 'true' or self.names:\n"
                "            self.get_logger().info('saves')\n"
            },
            "13:12: 'save' is the str 'false', which is always true; declare False",
        ),
    )

    def check_in(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        yield from self._check_fields(package, file)
        if not file.parameter_reads and not file.parameters:
            return
        for node, problem in _problems(package, file):
            if not is_handled(file.module, node, "TypeError"):
                yield self.report(file.module.location(node), problem)
        for comparison in file.module.walk(ast.Compare):
            problem = _never_equal(package, file, comparison)
            if problem:
                yield self.report(file.module.location(comparison), problem)
        for node, problem in _text_conditions(package, file):
            yield self.report(file.module.location(node), problem)

    def _check_fields(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        for name in FIELDS:
            for field in file.module.index.attributes(name):
                read, declared = _read(package, file, field)
                if not declared or field.attr == f"{declared}_value":
                    continue
                parents = file.module.parents(field)
                if any(isinstance(parent, ast.ExceptHandler) for parent in parents):
                    continue  # a fallback
                if _is_of_asked_type(file, field):
                    continue
                unset = _UNSET.get(field.attr, "empty")
                _, end = file.module.span(field)
                edit = Edit(file.module.path, end - len(field.attr), end, f"{declared}_value")
                message = f"{read!r} is declared as {declared}: {field.attr} is always {unset}; "
                message += f"use {declared}_value"
                fix = Fix("Read the field of the declared type", (edit,), Safety.UNSAFE)
                yield self.report(file.module.location(field), message, fix)


def _is_of_asked_type(file: RclpyFile, field: ast.Attribute) -> bool:
    """Return whether a field is only read if the parameter has some type."""
    return any(
        isinstance(part, ast.Attribute) and part.attr in {"type", "type_"}
        for condition in conditions_on(file.module, field)
        for part in ast.walk(condition)
    )


def _problems(package: Package, file: RclpyFile) -> Iterator[tuple[ast.expr, str]]:
    for operation in file.module.walk(ast.BinOp):
        if isinstance(operation.op, _ARITHMETIC):
            for operand, other in (
                (operation.left, operation.right),
                (operation.right, operation.left),
            ):
                problem = _operand(package, file, operation.op, operand, other)
                if problem:
                    yield operation, problem
    yield from _ranges(package, file)


def _ranges(package: Package, file: RclpyFile) -> Iterator[tuple[ast.expr, str]]:
    """Yield the arguments of ``range`` that are not integers."""
    for call in file.module.walk(ast.Call):
        if isinstance(call.func, ast.Name) and call.func.id == "range":
            for given in call.args:
                name, kind = _declared(package, file, given)
                if kind in {"double", "string"}:
                    yield (
                        given,
                        f"{name!r} is declared as {kind}, but range() takes integers: TypeError",
                    )


def _operand(
    package: Package, file: RclpyFile, operator: ast.operator, operand: ast.expr, other: ast.expr
) -> str:
    """Return the message for arithmetic with the value of a parameter."""
    value = file.evaluator.evaluate(other)
    is_number = type(value) in {int, float}
    if not is_number and not isinstance(value, str):
        return ""
    name, kind = _declared(package, file, operand)
    if kind == "string" and is_number:
        is_repeated = isinstance(operator, ast.Mult) and type(value) is int
        problem = f"{name!r} is declared as string, but {value} is a number: TypeError"
        return "" if is_repeated else problem
    if kind in _NUMBERS and isinstance(value, str) and isinstance(operator, ast.Add):
        return f"{name!r} is declared as {kind}, but {value!r} is a str: TypeError"
    return ""


def _text_conditions(package: Package, file: RclpyFile) -> Iterator[tuple[ast.expr, str]]:
    """Yield conditions on a string parameter with a default such as ``'false'``."""
    branches: list[ast.If | ast.IfExp] = [*file.module.walk(ast.If), *file.module.walk(ast.IfExp)]
    for branch in branches:
        test = branch.test.operand if isinstance(branch.test, ast.UnaryOp) else branch.test
        for node in test.values if isinstance(test, ast.BoolOp) else [test]:
            name, kind = _declared(package, file, node) if _is_value(node) else ("", "")
            defaults = [item.default for item in file.parameters if item.name == name]
            text = defaults[0] if kind == "string" and len(defaults) == 1 else None
            if isinstance(text, str) and text.lower() in _NO:
                yield node, f"{name!r} is the str {text!r}, which is always true; declare False"


def _is_value(node: ast.expr) -> bool:
    return isinstance(node, ast.Name | ast.Attribute)


def _never_equal(package: Package, file: RclpyFile, comparison: ast.Compare) -> str:
    """Return the message for comparing the value of a parameter with another type."""
    match comparison:
        case ast.Compare(left=left, ops=[ast.Eq() | ast.NotEq()], comparators=[right]):
            pairs = [(left, [right]), (right, [left])]
        case ast.Compare(
            left=left,
            ops=[ast.In() | ast.NotIn()],
            comparators=[ast.List(elts=items) | ast.Tuple(elts=items) | ast.Set(elts=items)],
        ):
            pairs = [(left, items)]
        case _:
            return ""
    for asked, others in pairs:
        values = [file.evaluator.evaluate(other) for other in others]
        if not values or not all(isinstance(x, bool | int | float | str) for x in values):
            continue
        name, kind = _declared(package, file, asked)
        allowed = _SCALARS.get(kind)
        is_fit = not allowed or any(isinstance(value, allowed) for value in values)
        if not is_fit and not _is_alternative(file, comparison, asked):
            return f"{name!r} is declared as {kind}, which never equals {values[0]!r}"
    return ""


def _is_alternative(file: RclpyFile, comparison: ast.Compare, asked: ast.expr) -> bool:
    """Return whether the value is also compared in another way: ``x or x == 'true'``."""
    parent = file.module.parent(comparison)
    if not isinstance(parent, ast.BoolOp):
        return False
    others = [value for value in parent.values if value is not comparison]
    return any(file.module.text(asked) in file.module.text(other) for other in others)


def _declared(package: Package, file: RclpyFile, node: ast.expr) -> tuple[str, str]:
    """Return the name and declared type of the parameter of which an expression is the value."""
    match file.evaluator.single_value(node):
        case ast.Attribute(attr="value", value=parameter):
            owner, name = _parameter_read(file, parameter)
            if owner is not None and isinstance(name, str):
                return name, declared_by(owner, package).types.get(name) or ""
    return "", ""


def _read(package: Package, file: RclpyFile, field: ast.Attribute) -> tuple[str, str]:
    """Return name and declared type of the parameter that a field is read from.

    Both are empty if that is not certain.
    """
    match file.evaluator.single_value(field.value):
        case ast.Call(func=ast.Attribute(attr="get_parameter_value", value=parameter)):
            owner, name = _parameter_read(file, parameter)
            if isinstance(parameter, ast.Name) and is_listed_parameter(file, parameter):
                class_ = file.module.enclosing_class(field)
                owner = file.node_class(class_) if class_ is not None else None
                name = name_asked(file, field, parameter.id) or UNKNOWN
            if owner is not None and isinstance(name, str):
                declared = declared_by(owner, package)
                return name, declared.types.get(name) or ""
    return "", ""


def _parameter_read(file: RclpyFile, node: ast.expr) -> tuple[NodeDefinition | None, str | Unknown]:
    """Return the node and the name of the parameter of a Parameter object.

    Such as ``self.get_parameter('rate')``, also through a variable or an attribute.

    Returns:
        Node and name; ``None`` and ``UNKNOWN`` if the expression is no such call.
    """
    made = file.evaluator.single_value(node)
    if not isinstance(made, ast.Call):
        return None, UNKNOWN
    func = file.method_of(made)
    if func is None or func.attr not in _GIVING:
        return None, UNKNOWN
    named = argument_of(made, "name", 0)
    name = file.evaluator.text(named) if named is not None else UNKNOWN
    return file.owner_of(func.value), name
