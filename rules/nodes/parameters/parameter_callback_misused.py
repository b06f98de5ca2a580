"""ND084: parameter callbacks take a list, and compare declared names and types."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, RclpyRule, Report, Severity, closest_name
from scaffold.api.parameters import declared_alone, declared_by, has_always
from scaffold.api.python import returned
from scaffold.api.rclpy import (
    CALLBACKS,
    Callback,
    NodeClass,
    RclpyFile,
    callback_arguments,
    is_listed_parameter,
    name_asked,
)

from ._callback_results import RESULT

_TYPES = ("rclpy.parameter.Parameter.Type.", "rclpy.Parameter.Type.")
_NODE = (
    "from rcl_interfaces.msg import SetParametersResult\n"
    "from rclpy.node import Node\nfrom rclpy.parameter import Parameter\n\n\n"
    "class Talker(Node):\n    def __init__(self):\n        super().__init__('talker')\n"
    "        self.declare_parameter('rate', 1.0)\n"
    "        self.add_on_set_parameters_callback(self.on_set)\n\n"
    "    def on_set(self, parameters):\n"
    "        for one in parameters:\n"
    "            if one.name == '{}' and one.type_ == Parameter.Type.{}:\n"
    "                self.rate = one.value\n"
    "        return SetParametersResult(successful=True)\n"
)
_OF_ONE = frozenset({"name", "value", "type_", "get_parameter_value"})
_OF_MAPPINGS = frozenset({"get", "items", "keys", "values"})
_NODE_USE = (
    "from rcl_interfaces.msg import SetParametersResult\nfrom rclpy.node import Node\n\n\n"
    "class Talker(Node):\n    def __init__(self):\n        super().__init__('talker')\n"
    "        self.declare_parameter('rate', 1.0)\n"
    "        self.add_on_set_parameters_callback({})\n\n"
    "    def on_set(self, parameters):\n"
    "        self.rate = parameters{}.value\n"
    "        return SetParametersResult(successful=True)\n"
)


class ParameterCallbackMisused(RclpyRule):
    """A parameter callback is called, misreads its list, or checks for undeclared parameters.

    **Why.** ``TypeError: ('Callback must be callable, got {}', ...)`` at start, ``AttributeError:
    'list' object has no attribute 'value'`` when a parameter is set. Until the callback returns,
    ``get_parameter`` returns the old value. A comparison with a name or type that the node does not
    declare is never true: setting the parameter changes nothing.

    **Fix.** Pass the function, iterate over the list, ``for parameter in parameters:``, and use the
    declared name and type.

    **Source.** ``rclpy/node.py``, ``add_on_set_parameters_callback``,
    ``_set_parameters_atomically_common``: a callback gets only declared parameters; ROS 2
    documentation, "Monitoring for parameter changes".
    """

    code = "ND084"
    name = "parameter-callback-misused"
    other_severities = {Severity.WARNING: "the old value is read"}
    examples = (
        Example("a declared name and type", {"talker.py": _NODE.format("rate", "DOUBLE")}),
        Example(
            "an undeclared name",
            {"talker.py": _NODE.format("rates", "DOUBLE")},
            "14:28: never true: the node declares no parameter 'rates'; did you mean 'rate'?",
        ),
        Example(
            "a type that differs from the declaration",
            {"talker.py": _NODE.format("rate", "INTEGER")},
            "14:52: never true: 'rate' is declared as double, not INTEGER",
        ),
        Example("an item of the list", {"talker.py": _NODE_USE.format("self.on_set", "[0]")}),
        Example(
            "the old value, to compare",
            {
                "talker.py": _NODE_USE.format("self.on_set", "[0]").replace(
                    "        self.rate = parameters[0].value\n",
                    "        for parameter in parameters:\n"
                    "            if parameter.name == 'rate':\n"
                    "                old = self.get_parameter('rate').value\n"
                    "                self.rate = max(old, parameter.value)\n",
                )
            },
        ),
        Example(
            "the old value",
            {
                "talker.py": _NODE_USE.format("self.on_set", "[0]").replace(
                    "        self.rate = parameters[0].value\n",
                    "        for parameter in parameters:\n"
                    "            if parameter.name == 'rate':\n"
                    "                self.rate = self.get_parameter('rate').value\n",
                )
            },
            Report(
                "14:29",
                "the parameter still has its old value here; use the value that the callback gets",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "called",
            {"talker.py": _NODE_USE.format("self.on_set([])", "[0]")},
            "9:45: self.on_set([]) is called here: TypeError; pass the function itself",
        ),
        Example(
            "a str",
            {"talker.py": _NODE_USE.format("'on_set'", "[0]")},
            "9:45: the callback must be a function, but this is a str: TypeError",
        ),
        Example(
            "the list as a parameter, as a dict",
            {
                "attribute.py": _NODE_USE.format("self.on_set", ""),
                "subscript.py": _NODE_USE.format("self.on_set", "['rate']"),
            },
            "attribute.py:12:21: 'parameters' is a list of parameters, without 'value': "
            "AttributeError",
            "subscript.py:12:21: 'parameters' is a list of parameters, not a dict: ['rate'] is a "
            "TypeError",
        ),
        Example(
            "items of a dict, pairs",
            {
                "talker.py": _NODE_USE.format("self.on_set", "[0]").replace(
                    "        return",
                    "        names = list(parameters.keys())\n"
                    "        for name, value in parameters:\n            names.append(name)\n"
                    "        return",
                )
            },
            "13:22: 'parameters' is a list of parameters, not a dict: AttributeError",
            "14:28: 'parameters' is a list of parameters, not of pairs: TypeError",
        ),
        Example(
            "the type of a parameter",
            {
                "tuner.py": "from rcl_interfaces.msg import ParameterType, SetParametersResult\n"
                "from rclpy.node import Node\nfrom rclpy.parameter import Parameter\n\n\n"
                "class Tuner(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('tuner')\n"
                "        self.declare_parameter('gain', 1.0)\n"
                "        self.add_on_set_parameters_callback(self.check)\n\n"
                "    def check(self, parameters):\n"
                "        for item in parameters:\n"
                "            if item.type_ == Parameter.Type.DOUBLE:\n"
                "                continue\n"
                "            if item.type_ != ParameterType.PARAMETER_DOUBLE:\n"
                "                return SetParametersResult(successful=False)\n"
                "            if item.type_.value == 3 or item.type_ == 'double':\n"
                "                continue\n"
                "        return SetParametersResult(successful=True)\n"
            },
            "16:16: never true: type_ is a Parameter.Type, not ParameterType.PARAMETER_DOUBLE; "
            "compare with Parameter.Type.DOUBLE, for instance",
            "18:41: never true: type_ is a Parameter.Type, not 'double'; compare with "
            "Parameter.Type.DOUBLE, for instance",
        ),
    )

    def check_in(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        yield from self._check_comparisons(package, file)
        yield from self._check_use(file)

    def _check_comparisons(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        alone = {node: {str(p.name) for p in own} for node, own in declared_alone(file)}
        for attribute in file.module.index.attributes("name"):
            node = _owner(file, attribute)
            if node is not None and node in alone:
                yield from self._named(package, file, attribute, alone[node])
        for attribute in file.module.index.attributes("type_"):
            node = _owner(file, attribute)
            if node is not None:
                yield from self._typed(package, file, attribute, node)

    def _named(
        self, package: Package, file: RclpyFile, attribute: ast.Attribute, declared: set[str]
    ) -> Iterator[Diagnostic]:
        if not is_listed_parameter(file, attribute.value):
            return
        for item in _names_compared(file, attribute):
            name = item.value if isinstance(item, ast.Constant) else None
            if isinstance(name, str) and name not in declared and not has_always(name):
                closest = closest_name(package, name, declared, 0.7)
                hint = f"; did you mean {closest!r}?" if closest else ""
                message = f"never true: the node declares no parameter {name!r}{hint}"
                yield self.report(file.module.location(item), message)

    def _typed(
        self, package: Package, file: RclpyFile, attribute: ast.Attribute, node: NodeClass
    ) -> Iterator[Diagnostic]:
        match file.module.parent(attribute), attribute.value:
            case ast.Compare(left=left, ops=[ast.Eq() | ast.NotEq()], comparators=[other]), (
                ast.Name(id=variable)
            ):
                full = file.module.qualified_name(other) or ""
                if left is not attribute or not full.startswith(_TYPES):
                    return
                if not is_listed_parameter(file, attribute.value):
                    return
                name = name_asked(file, attribute, variable) or ""
                declared = declared_by(node, package).types.get(name)
                asked = full.rpartition(".")[2]
                if declared in _types_compared(file, attribute, name):
                    return  # the code handles several types
                if declared and declared != asked.lower():
                    message = f"never true: {name!r} is declared as {declared}, not {asked}"
                    yield self.report(file.module.location(other), message)

    def _check_use(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for call, _ in file.module.method_calls(*CALLBACKS):
            problem = _problem(file, call.args[0]) if call.args else ""
            if problem:
                yield self.report(file.module.location(call.args[0]), problem)
        for argument, function in callback_arguments(file).items():
            for read in _old_values(file, function):
                yield self.report(
                    file.module.location(read),
                    "the parameter still has its old value here; use the value that the callback "
                    "gets",
                    severity=Severity.WARNING,
                )
            for compared, problem in _type_comparisons(file, function):
                yield self.report(file.module.location(compared), problem)
            for name in file.module.index.names(argument.arg):
                problem = _list_problem(file, name)
                if problem and file.parameter_of(name) is argument:
                    yield self.report(file.module.location(name), problem)


def _owner(file: RclpyFile, node: ast.AST) -> NodeClass | None:
    class_ = file.module.enclosing_class(node)
    return file.node_class(class_) if class_ is not None else None


def _problem(file: RclpyFile, given: ast.expr) -> str:
    """Return the message for an expression that is not a callback."""
    callback = file.callback(given)
    if isinstance(given, ast.Call) and not callback.is_partial:
        inner = file.callback(given.func)
        if callback.is_called or _gives_results(file, inner):
            return f"{file.module.text(given)} is called here: TypeError; pass the function itself"
    if isinstance(file.evaluator.evaluate(given), str):
        return "the callback must be a function, but this is a str: TypeError"
    return ""


def _gives_results(file: RclpyFile, callback: Callback) -> bool:
    """Return whether a function returns the result of a callback, not a callback."""
    function = callback.function
    if not isinstance(function, ast.FunctionDef):
        return False
    values = [file.evaluator.single_value(x.value) for x in returned(function) if x.value]
    return bool(values) and all(
        isinstance(value, ast.Call) and file.module.qualified_name(value.func) == RESULT
        for value in values
    )


def _old_values(file: RclpyFile, function: ast.AST) -> Iterator[ast.Call]:
    """Yield the reads of the old value of a parameter in a callback with its new value."""
    for branch in file.module.below(function, ast.If):
        match branch.test:
            case ast.Compare(ops=[ast.Eq()], comparators=[ast.Constant(value=str() as name)]):
                for assigned in branch.body:
                    if isinstance(assigned, ast.Assign) and isinstance(
                        assigned.targets[0], ast.Attribute
                    ):
                        yield from _reads(assigned.value, name)


def _reads(node: ast.expr, name: str) -> Iterator[ast.Call]:
    for call in ast.walk(node):
        match call:
            case ast.Call(
                func=ast.Attribute(attr="get_parameter"), args=[ast.Constant(value=read)]
            ):
                if read == name:
                    yield call


def _list_problem(file: RclpyFile, name: ast.Name) -> str:
    """Return the message for a wrong use of the list of parameters."""
    match file.module.parent(name):
        case ast.Attribute(attr=attr) if attr in _OF_ONE:
            return f"{name.id!r} is a list of parameters, without {attr!r}: AttributeError"
        case ast.Attribute(attr=attr) if attr in _OF_MAPPINGS:
            return f"{name.id!r} is a list of parameters, not a dict: AttributeError"
        case ast.For(iter=iterated, target=ast.Tuple()) if iterated is name:
            return f"{name.id!r} is a list of parameters, not of pairs: TypeError"
        case ast.Subscript(value=value, slice=ast.Constant(value=str() as text)) if value is name:
            return f"{name.id!r} is a list of parameters, not a dict: [{text!r}] is a TypeError"
    return ""


def _type_comparisons(file: RclpyFile, function: ast.AST) -> Iterator[tuple[ast.Compare, str]]:
    for compared in file.module.below(function, ast.Compare):
        value = _never_equal(file, compared)
        if value:
            problem = f"never true: type_ is a Parameter.Type, not {value}; compare with "
            yield compared, f"{problem}Parameter.Type.DOUBLE, for instance"


def _never_equal(file: RclpyFile, node: ast.Compare) -> str:
    """Return the number or the name with which the type of a parameter is compared."""
    match node:
        case ast.Compare(
            left=ast.Attribute(attr="type_"), ops=[ast.Eq() | ast.NotEq()], comparators=[value]
        ):
            name = file.module.qualified_name(value) or ""
            is_plain = isinstance(value, ast.Constant) and isinstance(value.value, str | int)
            if is_plain or name.startswith("rcl_interfaces.msg.ParameterType."):
                return file.module.text(value)
    return ""


def _types_compared(file: RclpyFile, attribute: ast.Attribute, name: str) -> set[str]:
    """Return the types with which a function compares the type of one parameter."""
    function = file.module.enclosing_function(attribute)
    result: set[str] = set()
    for other in file.module.index.attributes("type_"):
        if not isinstance(other.value, ast.Name):
            continue
        compared = file.module.parent(other)
        is_same = file.module.enclosing_function(other) is function
        is_same = is_same and name_asked(file, other, other.value.id) == name
        if is_same and isinstance(compared, ast.Compare):
            full = file.module.qualified_name(compared.comparators[0]) or ""
            result.add(full.rpartition(".")[2].lower())
    return result


def _names_compared(file: RclpyFile, attribute: ast.Attribute) -> list[ast.expr]:
    """Return the values that a name is compared with, in order."""
    match file.module.parent(attribute):
        case ast.Compare(left=left, ops=[ast.Eq()], comparators=[other]) if left is attribute:
            return [other]
        case ast.Compare(
            left=left,
            ops=[ast.In()],
            comparators=[ast.List(elts=items) | ast.Tuple(elts=items) | ast.Set(elts=items)],
        ) if left is attribute:
            return items
        case ast.Match(cases=cases):
            patterns = [item.pattern for item in cases]
            return [pattern.value for pattern in patterns if isinstance(pattern, ast.MatchValue)]
    return []
