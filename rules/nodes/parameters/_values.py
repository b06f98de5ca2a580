"""Uses of a Parameter object in place of its value."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from scaffold.api.python import is_none_literal
from scaffold.api.rclpy import PARAMETER, class_of

if TYPE_CHECKING:
    from scaffold.api.rclpy import Entity, RclpyFile

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
_MAX_USES = 200
"""The maximum number of uses of a name, as they are scanned for each stored object."""


def objects_used(file: RclpyFile) -> Iterator[tuple[Entity, ast.AST]]:
    """Yield the calls that pass a Parameter instead of its value, and the first such place."""
    for item in _objects(file):
        use = _use_as_value(file, item.call)
        if use is not None:
            yield item, use


def _use_as_value(file: RclpyFile, call: ast.Call) -> ast.AST | None:
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
    return next((use for use in read if _stands_for_value(file, use)), None)


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
        if read.owner is not None and read.method in {"get_parameter", "get_parameter_or"}:
            yield read
    for parameter in file.parameters:
        if parameter.owner is not None and "name" in parameter.arguments:
            yield parameter


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
