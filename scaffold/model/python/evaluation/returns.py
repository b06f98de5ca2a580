"""The values that a function returns, and whether it may return none."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from scaffold.model.python.scopes import FunctionNode
    from scaffold.model.python.syntax_tree import SyntaxTree

_ENDING = frozenset({"exit", "_exit", "quit", "fail"})
"""Functions that do not return."""
_SCOPES = (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda, ast.ClassDef)


def returned(function: FunctionNode) -> Sequence[ast.Return]:
    """Return the ``return`` statements of a function, except those of functions inside."""
    return [node for node in _own_nodes(function) if isinstance(node, ast.Return)]


def plain_function(module: SyntaxTree, func: ast.expr) -> ast.FunctionDef | None:
    """Return the function of the file that an expression refers to, if nothing decorates it."""
    function = module.index.only_node(func)
    if not isinstance(function, ast.FunctionDef) or function.decorator_list:
        return None
    return function


def has_result(function: FunctionNode) -> bool:
    """Return whether a call of the function may return anything other than ``None``."""
    return is_generator(function) or any(node.value for node in returned(function))


def value_set_before(function: FunctionNode, statement: ast.Return) -> ast.expr | None:
    """Return the last value of the returned name, if no branch or loop is in between."""
    name = statement.value.id if isinstance(statement.value, ast.Name) else None
    if name is None or statement not in function.body:
        return None
    for earlier in reversed(function.body[: function.body.index(statement)]):
        match earlier:
            case ast.Assign(targets=[ast.Name(id=target)], value=value) if target == name:
                return value
        if any(_sets(node, name) for node in ast.walk(earlier)):
            return None
    return None


def is_generator(function: FunctionNode) -> bool:
    """Return whether a call of the function returns a generator."""
    return any(isinstance(node, ast.Yield | ast.YieldFrom) for node in _own_nodes(function))


def may_end(function: FunctionNode) -> bool:
    """Return whether the end of the function may be reached, so that it returns ``None``."""
    return _passes(function.body)


def may_end_with_items(function: FunctionNode) -> bool:
    """Return whether the end may be reached if the last argument, a list, is not empty."""
    *before, last = function.body
    names = [arg.arg for arg in function.args.args[-1:]]
    match last:
        case ast.For(iter=ast.Name(id=name), body=body, orelse=[]) if name in names:
            leaves = any(isinstance(node, ast.Break | ast.Continue) for node in ast.walk(last))
            return _passes(before) and (leaves or _passes(body))
    return may_end(function)


def _own_nodes(function: FunctionNode) -> Iterator[ast.AST]:
    pending: list[ast.AST] = list(function.body)
    while pending:
        node = pending.pop()
        yield node
        if not isinstance(node, _SCOPES):
            pending.extend(ast.iter_child_nodes(node))


def _passes(body: Sequence[ast.stmt]) -> bool:
    """Return whether the code after some statements may be reached."""
    return all(_passes_one(statement) for statement in body)


def _passes_one(statement: ast.stmt) -> bool:
    passes = True
    match statement:
        case ast.Return() | ast.Raise() | ast.Continue() | ast.Break():
            passes = False
        case ast.If(body=body, orelse=orelse):
            passes = _passes(body) or _passes(orelse)
        case ast.With(body=body) | ast.AsyncWith(body=body):
            passes = _passes(body)
        case ast.While(test=test) if _holds_until_shutdown(test):
            passes = any(isinstance(node, ast.Break) for node in ast.walk(statement))
        case ast.Try(body=body, handlers=handlers, orelse=orelse, finalbody=final):
            caught = () if _is_safe(body[0]) else handlers
            runs = _passes([*body, *orelse]) or any(_passes(item.body) for item in caught)
            passes = runs and _passes(final)
        case ast.Match(cases=cases):
            is_total = any(
                isinstance(item.pattern, ast.MatchAs) and not item.guard for item in cases
            )
            passes = not is_total or any(_passes(item.body) for item in cases)
        case ast.Expr(value=ast.Call(func=ast.Attribute(attr=name) | ast.Name(id=name))):
            passes = name not in _ENDING
    return passes


def _holds_until_shutdown(test: ast.expr) -> bool:
    """Return whether a condition is always true, or ``rclpy.ok()``."""
    match test:
        case ast.Constant(value=value):
            return bool(value)
        case ast.Call(func=ast.Attribute(attr="ok"), args=[]):
            return True
    return False


def _sets(node: ast.AST, name: str) -> bool:
    return isinstance(node, ast.Name) and node.id == name and not isinstance(node.ctx, ast.Load)


def _is_safe(statement: ast.stmt) -> bool:
    """Return whether a statement returns an expression that cannot raise, such as a constant."""
    match statement:
        case ast.Return(value=None | ast.Constant() | ast.Name()):
            return True
        case ast.Return(value=ast.Attribute(value=ast.Name())):
            return True
    return False
