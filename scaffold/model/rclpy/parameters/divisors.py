"""Parameters that are used as divisors."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING

from scaffold.model.python.conditions.guards import is_handled

if TYPE_CHECKING:
    from scaffold.model.rclpy.file import RclpyFile

_METHODS = frozenset({"get_parameter", "declare_parameter"})
_VALUES = frozenset({"value", "double_value", "integer_value"})
_DEPTH = 6


def divisors(file: RclpyFile) -> frozenset[str]:
    """Return the names of parameters used as divisors without a check."""
    module = file.module
    if not module.mentions(*_METHODS):
        return frozenset()
    compared = {
        module.text(side)
        for compare in module.walk(ast.Compare)
        for side in (compare.left, *compare.comparators)
    }
    result: set[str] = set()
    for node in module.walk(ast.BinOp):
        if not isinstance(node.op, ast.Div | ast.FloorDiv | ast.Mod):
            continue
        name = _parameter(file, node.right)
        if name is None or module.text(node.right) in compared:
            continue
        if not is_handled(module, node, "ZeroDivisionError") and not _is_guarded(file, node):
            result.add(name)
    return frozenset(result)


def _is_guarded(file: RclpyFile, node: ast.BinOp) -> bool:
    """Return whether a condition around a division tests the divisor."""
    text = file.module.text(node.right)
    tests = [
        parent.test
        for parent in file.module.parents(node)
        if isinstance(parent, ast.If | ast.IfExp | ast.While)
    ]
    return any(text in file.module.text(test) for test in tests)


def _parameter(file: RclpyFile, node: ast.expr, depth: int = 0) -> str | None:
    """Return the parameter whose unchanged value an expression is."""
    value = file.evaluator.single_value(node)
    if depth > _DEPTH:
        return None
    match value:
        case ast.Call(func=ast.Name(id="float" | "int"), args=[inner]):
            return _parameter(file, inner, depth + 1)
        case ast.Attribute(value=inner, attr=attr) if attr in _VALUES:
            return _parameter(file, inner, depth + 1)
        case ast.Call(func=ast.Attribute(value=inner, attr="get_parameter_value"), args=[]):
            return _parameter(file, inner, depth + 1)
        case ast.Call(func=ast.Attribute(attr=method), args=[name, *_]) if method in _METHODS:
            text = file.evaluator.evaluate(name)
            return text if isinstance(text, str) else None
    return None
