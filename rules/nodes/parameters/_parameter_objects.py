"""Uses of a Parameter object in place of its value."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from scaffold.api import fact
from scaffold.api.python import is_none_literal, last_name
from scaffold.api.rclpy import FIELDS, PARAMETER, class_of

if TYPE_CHECKING:
    from scaffold.api import Package
    from scaffold.api.python import FunctionNode, PythonModule
    from scaffold.api.rclpy import Entity, ParameterRead, RclpyFile

_BUILTINS = frozenset(
    {"abs", "bool", "dict", "enumerate", "float", "int", "len", "list", "max", "min", "open"}
    | {"range", "round", "set", "sorted", "str", "sum", "tuple"}
)
_FUNCTIONS = ("math.", "os.path.", "time.sleep")
_POSITIONS = {
    "create_client": (1,),
    "create_publisher": (1, 2),
    "create_rate": (0,),
    "create_service": (1,),
    "create_subscription": (1, 3),
    "create_timer": (0,),
}
"""The arguments of node methods that are names and numbers."""
_PARAMETERS = frozenset({PARAMETER, "rclpy.Parameter"})
_OF_OBJECT = frozenset({"get_parameter_value", "to_parameter_msg"})
"""The methods of a Parameter."""
_MAX_USES = 200
"""The maximum number of uses of a name, as they are scanned for each stored object."""


def objects_used(package: Package, file: RclpyFile) -> Iterator[tuple[Entity, ast.AST]]:
    """Yield the calls that pass a Parameter instead of its value, and the first such place."""
    for item in _objects(file):
        use = _use_as_value(package, file, item.call)
        if use is not None:
            yield item, use


def fields_read(file: RclpyFile, parameter: object) -> Sequence[str]:
    """Return the fields of ``get_parameter_value()`` that are read of a parameter, if only these.

    Args:
        file: The file.
        parameter: The name of the parameter.
    """
    fields = set()
    for read in file.parameter_reads:
        if read.name == parameter:
            fields |= {_field_read(file, use) for use in _objects_of(file, read.call)}
    return sorted(fields) if "" not in fields else ()


def _objects_of(file: RclpyFile, call: ast.Call) -> Sequence[ast.AST]:
    """Return the call, or the uses of the variable or the attribute that holds its result."""
    if not isinstance(file.module.parent(call), ast.Assign):
        return [call]
    attribute, variable = file.stored_in(call)
    uses = _uses(file, call, variable, attribute)
    return [use for use in uses if isinstance(use.ctx, ast.Load)] or [call]


def _field_read(file: RclpyFile, parameter: ast.AST) -> str:
    """Return the field in ``parameter.get_parameter_value().field``; empty for other uses."""
    method = file.module.parent(parameter)
    called = file.module.parent(method) if method is not None else None
    field = file.module.parent(called) if called is not None else None
    match method, called, field:
        case ast.Attribute(attr="get_parameter_value"), ast.Call(), ast.Attribute(attr=name):
            return name if name in FIELDS else ""
    return ""


def _use_as_value(package: Package, file: RclpyFile, call: ast.Call) -> ast.AST | None:
    """Return a place where the object returned by a call is used as a value."""
    if _stands_for_value(file, call):
        return call
    attribute, variable = file.stored_in(call)
    if variable is None and attribute is None:
        return None
    uses = _uses(file, call, variable, attribute)
    stored = [use for use in uses if isinstance(use.ctx, ast.Store)]
    if len(stored) > 1 or len(uses) > _MAX_USES:
        return None
    read = [use for use in uses if isinstance(use.ctx, ast.Load)]
    if any(isinstance(file.module.parent(use), ast.Attribute) for use in read):
        return None
    if any(_is_passed_as_object(package, file, use) for use in read):
        return None
    return next((use for use in read if _stands_for_value(file, use)), None)


def _is_passed_as_object(package: Package, file: RclpyFile, use: ast.expr) -> bool:
    """Return whether an object is passed to a function of the package that takes a Parameter."""
    call = file.module.parent(use)
    if not isinstance(call, ast.Call) or use not in call.args:
        return False
    return last_name(call.func) in _functions_of_objects(package)


@fact
def _functions_of_objects(package: Package) -> frozenset[str]:
    """Return the names of the functions of a package that take a Parameter, not its value."""
    return frozenset(
        function.name
        for module in package.modules(mentioning=["arameter"])
        for function in module.function_nodes
        if any(_is_object(module, function, argument) for argument in function.args.args)
    )


def _is_object(module: PythonModule, function: FunctionNode, argument: ast.arg) -> bool:
    """Return whether an argument is annotated as a Parameter, or its methods are called."""
    annotation = argument.annotation
    if annotation is not None and module.qualified_name(annotation) in _PARAMETERS:
        return True
    return any(
        item.attr in _OF_OBJECT
        and isinstance(item.value, ast.Name)
        and item.value.id == argument.arg
        for item in module.below(function, ast.Attribute)
    )


def _uses(
    file: RclpyFile, call: ast.Call, variable: str | None, attribute: str | None
) -> Sequence[ast.Name | ast.Attribute]:
    """Return the uses of the object returned by a call, in its function or class."""
    module = file.module
    class_ = module.enclosing_class(call) if attribute is not None else None
    if attribute is not None and class_ is not None:
        return [
            item
            for item in module.index.attributes(attribute)
            if isinstance(item.value, ast.Name)
            and item.value.id == "self"
            and module.enclosing_class(item) is class_
        ]
    function = module.enclosing_function(call)
    names = module.index.names(variable) if variable is not None else ()
    return [name for name in names if function is None or function in module.parents(name)]


def _objects(file: RclpyFile) -> Iterator[Entity]:
    """Yield the calls that return a Parameter."""
    for read in file.parameter_reads:
        is_object = read.method == "get_parameter" or (
            read.method == "get_parameter_or" and not _may_return_alternative(file, read)
        )
        if read.owner is not None and is_object:
            yield read
    for parameter in file.parameters:
        if parameter.owner is not None and "name" in parameter.arguments:
            yield parameter


def _may_return_alternative(file: RclpyFile, read: ParameterRead) -> bool:
    """Return whether ``get_parameter_or(name, value)`` returns its second argument."""
    alternatives = [*read.call.args[1:], *(word.value for word in read.call.keywords)]
    return bool(alternatives) and read.name not in {other.name for other in file.parameters}


def _stands_for_value(file: RclpyFile, node: ast.AST) -> bool:
    """Return whether a node is in a place where only the value makes sense."""
    parent = file.module.parent(node)
    used = False
    match parent:
        case ast.BinOp(op=op, right=right):
            used = not (isinstance(op, ast.Mod) and right is node)
        case ast.Compare(left=left, ops=ops, comparators=others):
            is_first = left is node and not isinstance(ops[0], ast.Is | ast.IsNot)
            other = others[0] if left is node else left
            is_same = class_of(file, other) == PARAMETER
            used = (is_first or node in others[:1]) and not is_same and not is_none_literal(other)
        case ast.If(test=test) | ast.While(test=test) | ast.IfExp(test=test):
            used = test is node
        case ast.Subscript(value=value):
            used = value is node
        case ast.For(iter=iterated) | ast.comprehension(iter=iterated):
            used = iterated is node
        case ast.UnaryOp() | ast.BoolOp() | ast.FormattedValue():
            used = True
        case ast.Call(func=func) if node in parent.args:
            name = file.module.qualified_name(func) or ""
            positions = _POSITIONS.get(func.attr, ()) if isinstance(func, ast.Attribute) else ()
            is_builtin = isinstance(func, ast.Name) and func.id in _BUILTINS
            used = is_builtin or name.startswith(_FUNCTIONS)
            used = used or parent.args.index(node) in positions
    return used
