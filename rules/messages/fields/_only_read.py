"""Messages that a program never sends, because only their fields are read."""

from __future__ import annotations

import ast

from scaffold.api.python import PythonModule

_FUNCTIONS = frozenset({"atan2", "cos", "float", "hypot", "pow", "print", "sin", "sqrt"})
"""Functions whose result is not the int that they get."""


def is_only_read(module: PythonModule, value: ast.expr) -> bool:
    """Return whether a value is set in a message that a program only computes with.

    The function returns the message, and every caller only reads numbers from it.
    """
    function = module.enclosing_function(value)
    match module.parent(value):
        case ast.Assign(targets=[ast.Attribute() as target]):
            name = _root(target)
        case _:
            return False
    if function is None or name is None or "main" not in module.functions:
        return False
    uses = [node for node in module.walk(ast.Name) if node.id == name]
    uses = [node for node in uses if module.enclosing_function(node) is function]
    returned = [node for node in uses if isinstance(module.parent(node), ast.Return)]
    return (
        bool(returned)
        and all(node in returned or _is_computed(module, node) for node in uses)
        and _do_callers_compute(module, function.name)
    )


def _root(node: ast.expr) -> str | None:
    while isinstance(node, ast.Attribute):
        node = node.value
    return node.id if isinstance(node, ast.Name) else None


def _do_callers_compute(module: PythonModule, function: str) -> bool:
    """Return whether all callers of a method only read numbers from its result."""
    references = [node for node in module.walk(ast.Attribute) if node.attr == function]
    return bool(references) and all(_does_caller_compute(module, node) for node in references)


def _does_caller_compute(module: PythonModule, reference: ast.Attribute) -> bool:
    call = module.call_with(reference)
    if call is None:
        return False
    match module.parent(call):
        case ast.Assign(targets=[ast.Name(id=name)]):
            caller = module.enclosing_function(call)
            uses = [node for node in module.walk(ast.Name) if node.id == name]
            return caller is not None and all(
                _is_computed(module, node)
                for node in uses
                if module.enclosing_function(node) is caller
            )
    return False


def _is_computed(module: PythonModule, name: ast.Name) -> bool:
    """Return whether a name or a field of it is set, or a field is computed with."""
    node: ast.Name | ast.Attribute = name
    parent = module.parent(node)
    while isinstance(parent, ast.Attribute):
        node, parent = parent, module.parent(parent)
    return isinstance(node.ctx, ast.Store) or (node is not name and _computes(module, parent))


def _computes(module: PythonModule, node: ast.AST | None) -> bool:
    """Return whether the result of an expression with an int is not that int."""
    match node:
        case ast.BinOp(left=left, right=right):
            return not any(isinstance(side, ast.Constant) for side in (left, right))
        case ast.Tuple():
            return isinstance(module.parent(node), ast.BinOp)
        case ast.Call(func=ast.Name(id=function)):
            return function in _FUNCTIONS
    return isinstance(node, ast.Compare | ast.FormattedValue)
