"""Results of arithmetic with values of unknown type, which the type checker takes for numbers."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.model.python.module import PythonModule

_MAX_DEPTH = 8
"""The maximum number of names and operators to trace a value through."""


def may_be_of_library(module: PythonModule, value: ast.AST) -> bool:
    """Return whether a value is the result of arithmetic with a value of unknown type.

    For ``2.0 * x``, the type checker knows that an unknown ``x`` may be an array; after
    ``if x is None: return`` it only sees the float.
    """
    return any(
        _is_asked_about(module, operand)
        for operation in _operations(module, value)
        for operand in _operands(operation)
    )


def _operations(module: PythonModule, value: ast.AST, depth: int = 0) -> Iterator[ast.BinOp]:
    """Yield the arithmetic that a value, or an object that it is read from, results from."""
    if depth > _MAX_DEPTH:
        return
    match value:
        case ast.BinOp():
            yield value
        case ast.Attribute(value=inner) | ast.Subscript(value=inner) | ast.Call(func=inner):
            yield from _operations(module, inner, depth + 1)
        case ast.UnaryOp(operand=inner) | ast.Starred(value=inner):
            yield from _operations(module, inner, depth + 1)
        case ast.Name():
            for assigned in _assigned(module, value):
                yield from _operations(module, assigned, depth + 1)


def _assigned(module: PythonModule, name: ast.Name) -> Iterator[ast.expr]:
    """Yield the values of a variable; that of ``x += y`` as an operation."""
    for binding in module.index.bindings_of(name):
        match module.parent(binding.node):
            case ast.Assign(targets=targets, value=value) if binding.node in targets:
                yield value
            case ast.AnnAssign(value=ast.expr() as value):
                yield value
            case ast.AugAssign(op=operator, value=value):
                yield ast.BinOp(value, operator, value)


def _operands(operation: ast.BinOp) -> Iterator[ast.expr]:
    for operand in (operation.left, operation.right):
        inner = operand.operand if isinstance(operand, ast.UnaryOp) else operand
        if isinstance(inner, ast.BinOp):
            yield from _operands(inner)
        else:
            yield inner


def _is_asked_about(module: PythonModule, value: ast.expr) -> bool:
    """Return whether a condition of the same function is about a variable or an attribute."""
    if not isinstance(value, ast.Name | ast.Attribute):
        return False
    function = module.enclosing_function(value) or module.tree
    text = module.text(value)
    return any(
        isinstance(part, type(value)) and module.text(part) == text
        for test in _tests_in(module, function)
        for part in ast.walk(test)
    )


def _tests_in(module: PythonModule, function: ast.AST) -> Iterator[ast.expr]:
    for node in module.below(function, ast.If, ast.While, ast.IfExp, ast.Assert, ast.BoolOp):
        match node:
            case ast.BoolOp(values=values):
                yield from values
            case ast.If(test=test) | ast.While(test=test) | ast.IfExp(test=test):
                yield test
            case ast.Assert(test=test):
                yield test
