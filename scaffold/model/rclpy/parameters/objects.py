"""Expressions that are rclpy Parameter objects, and their parameters."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from scaffold.model.python.evaluation.given_arguments import arguments_for
from scaffold.model.rclpy.entities import parameter_type
from scaffold.model.remembered import remembered
from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from scaffold.model.package import Package
    from scaffold.model.python.scopes import FunctionNode
    from scaffold.model.rclpy.entities import Entity
    from scaffold.model.rclpy.file import RclpyFile
    from scaffold.model.rclpy.nodes import NodeDefinition

_PARAMETER = "rclpy.parameter.Parameter"
FIELDS = frozenset(
    {"bool_value", "integer_value", "double_value", "string_value", "byte_array_value"}
    | {"bool_array_value", "integer_array_value", "double_array_value", "string_array_value"}
)
"""The value fields of ParameterValue."""
CALLBACKS = (
    "add_on_set_parameters_callback",
    "add_post_set_parameters_callback",
    "add_pre_set_parameters_callback",
)
"""The methods of a node that register a callback with a list of parameters."""
_NAMED = ("describe_parameter", "get_parameter_type", "set_descriptor", "undeclare_parameter")
_LISTED = ("describe_parameters", "get_parameter_types", "get_parameters")


def is_of_node(file: RclpyFile, created: Entity) -> bool:
    """Return whether a method is called on a node, as known or by the name of the object."""
    if created.owner is not None:
        return True
    func = file.method_of(created.call)
    receiver = func.value if func is not None else None
    if isinstance(receiver, ast.Attribute):
        return receiver.attr.lstrip("_") == "node"
    return isinstance(receiver, ast.Name) and receiver.id.lstrip("_") == "node"


def is_parameter_list(file: RclpyFile, node: ast.expr) -> bool:
    """Return whether an expression is certainly a list of rclpy parameters."""
    made = file.evaluator.single_value(node)
    match made:
        case ast.Call(func=ast.Attribute(attr="get_parameters", value=receiver)):
            return file.owner_of(receiver) is not None
    argument = file.parameter_of(made)
    return argument is not None and argument in callback_arguments(file)


def is_listed_parameter(file: RclpyFile, node: ast.expr) -> bool:
    """Return whether an expression is an item of such a list: in a loop, or by index."""
    if isinstance(node, ast.Subscript):
        is_number = type(file.evaluator.evaluate(node.slice)) is int
        return is_number and is_parameter_list(file, node.value)
    if not isinstance(node, ast.Name):
        return False
    loops = [file.module.parent(binding.node) for binding in file.module.index.bindings_of(node)]
    return bool(loops) and all(
        isinstance(loop, ast.For | ast.comprehension)
        and isinstance(loop.target, ast.Name)
        and is_parameter_list(file, loop.iter)
        for loop in loops
    )


@remembered
def callback_arguments(file: RclpyFile) -> dict[ast.arg, FunctionNode | ast.Lambda]:
    """Return the functions that rclpy calls with a list of parameters, by argument."""
    result: dict[ast.arg, FunctionNode | ast.Lambda] = {}
    for method in CALLBACKS:
        for call, _ in file.module.method_calls(method):
            if not call.args:
                continue
            callback = file.callback(call.args[0])
            if callback.function is None or callback.is_partial or callback.is_called:
                continue
            arguments = callback.function.args
            names = [*arguments.posonlyargs, *arguments.args][int(callback.is_bound) :]
            if names:
                result[names[0]] = callback.function
    return result


def name_asked(file: RclpyFile, node: ast.AST, variable: str) -> str | None:
    """Return the certain name of a parameter at a node: ``if parameter.name == 'rate':``."""
    child = node
    for parent in file.module.parents(node):
        tests: list[ast.expr] = []
        if isinstance(parent, ast.BoolOp) and isinstance(parent.op, ast.And):
            tests = [item for item in parent.values if item is not child]
        elif isinstance(parent, ast.If) and file.module.index.place(child)[0] == "body":
            tests = [parent.test]
            if isinstance(parent.test, ast.BoolOp) and isinstance(parent.test.op, ast.And):
                tests = parent.test.values
        for test in tests:
            match test:
                case ast.Compare(
                    left=ast.Attribute(attr="name", value=ast.Name(id=name)),
                    ops=[ast.Eq()],
                    comparators=[ast.Constant(value=str() as text)],
                ) if name == variable:
                    return text
        if isinstance(parent, ast.FunctionDef | ast.AsyncFunctionDef | ast.For):
            return None
        child = parent
    return None


class ParameterMade(NamedTuple):
    """A ``Parameter(...)`` that is passed to a node to be set."""

    call: ast.Call
    """The call that sets it."""
    node: ast.expr
    name: str
    type: str | None
    """``double``, ``not_set`` ...; ``None`` if unknown."""
    value: object


def parameters_set(file: RclpyFile) -> Iterator[tuple[NodeDefinition, ParameterMade]]:
    """Yield the parameters that a file sets on known nodes, one by one."""
    for method in ("set_parameters", "set_parameters_atomically"):
        for call, attribute in file.module.method_calls(method):
            owner = file.owner_of(attribute.value) if call.args else None
            for item in file.evaluator.elements(call.args[0]).items if owner else ():
                made = _parameter_made(file, call, item.node)
                if made is not None and owner is not None:
                    yield owner, made


def _parameter_made(file: RclpyFile, setting: ast.Call, node: ast.expr) -> ParameterMade | None:
    """Parse ``Parameter('rate', Parameter.Type.DOUBLE, 1.0)``."""
    call = file.evaluator.single_value(node)
    if not isinstance(call, ast.Call):
        return None
    if file.module.qualified_name(call.func) not in {"rclpy.Parameter", _PARAMETER}:
        return None
    given = dict(zip(("name", "type_", "value"), call.args, strict=False))
    given.update({word.arg: word.value for word in call.keywords if word.arg is not None})
    name = file.evaluator.text(given.get("name"))
    if not isinstance(name, str) or any(word.arg is None for word in call.keywords):
        return None
    value = file.evaluator.evaluate(given["value"]) if "value" in given else None
    kind = "not_set" if value is None else parameter_type(value)
    if "type_" in given:
        full = file.module.qualified_name(given["type_"]) or ""
        kind = full.rpartition(".Type.")[2].lower() if ".Type." in full else None
    return ParameterMade(setting, node, name, kind, value)


class NameUsed(NamedTuple):
    """The name of a parameter that must exist."""

    owner: NodeDefinition
    call: ast.Call
    node: ast.expr
    name: str


def names_used(file: RclpyFile) -> Iterator[NameUsed]:
    """Yield the parameters that a file describes, undeclares, sets, or gets in a list."""
    for method in (*_NAMED, *_LISTED):
        for call, attribute in file.module.method_calls(method):
            owner = file.owner_of(attribute.value)
            if owner is not None:
                given = call.args[:1]
                if method in _LISTED and given:
                    given = [item.node for item in file.evaluator.elements(given[0]).items]
                yield from _texts(file, owner, call, given)
    for owner, made in parameters_set(file):
        yield NameUsed(owner, made.call, made.node, made.name)
    for read in file.parameter_reads:
        name = read.argument("name")
        if read.owner is not None and read.method == "get_parameter" and name is not None:
            nodes = _looped(file, name.node)
            if isinstance(name.node, ast.Name):
                nodes += _passed(file, name.node)
            yield from _texts(file, read.owner, read.call, nodes)


def names_used_by(package: Package, owner: NodeDefinition) -> Sequence[NameUsed]:
    """Return the result of `names_used` for one node; a file is analyzed once for all nodes."""

    def by_owner() -> dict[NodeDefinition, list[NameUsed]]:
        result: dict[NodeDefinition, list[NameUsed]] = {}
        for used in names_used(owner.file):
            result.setdefault(used.owner, []).append(used)
        return result

    return package.remember(("names_used", owner.file), by_owner).get(owner, ())


def _texts(
    file: RclpyFile, owner: NodeDefinition, call: ast.Call, nodes: list[ast.expr]
) -> Iterator[NameUsed]:
    for node in nodes:
        name = file.evaluator.text(node)
        if isinstance(name, str):
            yield NameUsed(owner, call, node, name)


def _looped(file: RclpyFile, node: ast.expr) -> list[ast.expr]:
    """Return the values of a name in a loop over a literal list."""
    bound = file.module.index.only_node(node)
    loop = file.module.parent(bound) if bound is not None else None
    if not isinstance(loop, ast.For | ast.comprehension):
        return []
    is_plain = isinstance(loop.target, ast.Name) and isinstance(loop.iter, ast.List | ast.Tuple)
    return list(loop.iter.elts) if is_plain and isinstance(loop.iter, ast.List | ast.Tuple) else []


def _passed(file: RclpyFile, name: ast.Name) -> Iterator[ast.expr]:
    """Yield the arguments for a parameter of a method in the calls of that method by its class."""
    for value in arguments_for(file.module, name):
        match file.module.parent(value):
            case ast.Call(func=ast.Attribute(value=ast.Name(id="self"))):
                yield value
