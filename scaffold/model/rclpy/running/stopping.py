"""Code that runs only during the shutdown of a node."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from scaffold.model.python.module import PythonModule

_ENDS = frozenset({"shutdown", "try_shutdown"})


def only_while_stopping(module: PythonModule, node: ast.AST) -> bool:
    """Return whether code comes after ``rclpy.spin()`` in a program that runs until it is stopped.

    A program that shuts rclpy down itself, in a callback, continues to work there; one whose
    constructor does so fails.
    """
    return _is_after_spin(module, node) and not _ends_itself(module, node)


def _is_after_spin(module: PythonModule, node: ast.AST) -> bool:
    child = node
    for parent in module.parents(node):
        field = module.index.place(child)[0]
        block = getattr(parent, field or "", None)
        if isinstance(block, list) and child in block:
            before = block[: block.index(child)]
            if isinstance(parent, ast.Try) and field == "finalbody":
                before = [*parent.body, *before]
            if _spins(module, before):
                return True
        if isinstance(parent, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda):
            return False
        child = parent
    return False


def _spins(module: PythonModule, statements: Sequence[ast.AST]) -> bool:
    return any(_is_spin(module, call) for item in statements for call in _calls(item))


def _calls(statement: ast.AST) -> Iterator[ast.Call]:
    """Yield the calls that a statement certainly makes."""
    match statement:
        case ast.Expr(value=ast.Call() as call):
            yield call
        case ast.Try(body=body) | ast.With(body=body):
            for item in body:
                yield from _calls(item)


def _is_spin(module: PythonModule, call: ast.Call) -> bool:
    if "rclpy.spin" in module.qualified_names(call.func):
        return True
    return isinstance(call.func, ast.Attribute) and call.func.attr == "spin" and not call.args


def _ends_itself(module: PythonModule, node: ast.AST) -> bool:
    function = module.enclosing_function(node)
    return any(
        (where := module.enclosing_function(call)) not in {None, function}
        and getattr(where, "name", "") != "__init__"
        for call, _ in module.method_calls(*_ENDS)
    )
