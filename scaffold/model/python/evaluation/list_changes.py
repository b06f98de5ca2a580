"""Changes of lists after their creation, such as with ``append``."""

from __future__ import annotations

import ast
from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from scaffold.model.python.syntax_tree import SyntaxTree

CHANGING = frozenset(
    {"append", "extend", "insert", "remove", "pop", "clear", "sort", "reverse"}
    | {"update", "setdefault", "add", "discard", "popitem"}
)
"""The methods that change a list, set or dictionary."""


def list_literal(module: SyntaxTree, node: ast.Name) -> ast.expr | None:
    """Return the first value of a name, if that looks like a list."""
    lookup = module.index.lookup(node.id, node)
    if lookup is None:
        return None
    assigned = [binding for binding in lookup[1] if binding.kind != "annotation"]
    if any(binding.kind not in {"assignment", "augmented"} for binding in assigned):
        return None
    values = [binding.value for binding in assigned if binding.kind == "assignment"]
    literal = values[0] if len(values) == 1 else None
    return literal if literal is not None and _looks_like_list(literal) else None


def changes_of(module: SyntaxTree, node: ast.Name) -> Sequence[ast.Name]:
    """Return the changes of the list in a name."""
    if not any(_is_change(module, name) for name in module.index.names(node.id)):
        return ()
    return [name for name in module.index.uses_of(node) if _is_change(module, name)]


def _is_change(module: SyntaxTree, name: ast.Name) -> bool:
    parent = module.parent(name)
    if isinstance(parent, ast.Call) and name in parent.args:
        return _is_changed_by(module, parent, parent.args.index(name))
    return _is_direct_change(module, name)


def _is_changed_by(module: SyntaxTree, call: ast.Call, place: int) -> bool:
    """Return whether a function of the file changes the list that it is given."""
    function = module.index.only_node(call.func)
    if not isinstance(function, ast.FunctionDef) or place >= len(function.args.args):
        return False
    parameter = function.args.args[place].arg
    names = (name for name in module.below(function, ast.Name) if name.id == parameter)
    return any(_is_direct_change(module, name) for name in names)


def _is_direct_change(module: SyntaxTree, name: ast.Name) -> bool:
    parent = module.parent(name)
    match parent:
        case ast.AugAssign(target=target):
            return target is name
        case ast.Attribute(attr=attr) if attr in CHANGING:
            above = module.parent(parent)
            return isinstance(above, ast.Call) and above.func is parent
        case ast.Subscript(value=value, ctx=ast.Store() | ast.Del()):
            return value is name
        case _:
            return False


def statement_of(module: SyntaxTree, node: ast.AST) -> ast.stmt | None:
    """Return the statement of a node."""
    for parent in (node, *module.parents(node)):
        if isinstance(parent, ast.stmt):
            return parent
    return None


def is_straight(module: SyntaxTree, first: ast.stmt | None, change: ast.Name) -> bool:
    """Return whether a change is in the same block as the first assignment, after it."""
    second = statement_of(module, change)
    if first is None or second is None or second.lineno < first.lineno:
        return False
    return module.parent(first) is module.parent(second) and not isinstance(
        second, ast.For | ast.While | ast.If | ast.With | ast.Try
    )


def _looks_like_list(node: ast.expr) -> bool:
    """Return whether an expression is a list literal, or one with something added."""
    while isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
        if _looks_like_list(node.right):
            return True
        node = node.left
    return isinstance(node, ast.List | ast.ListComp)
