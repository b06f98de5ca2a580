"""The exceptions that handlers and ``with`` statements catch, by name."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from scaffold.model.python.syntax_tree import SyntaxTree

IMPORT_ERRORS = frozenset({"ImportError", "ModuleNotFoundError", "Exception", "BaseException"})
"""The exceptions that catch a missing import."""
_RAISES = frozenset({"raises", "assertRaises", "assertRaisesRegex", "assertWarns"})
"""Functions of test libraries that expect an exception: ``with pytest.raises(ImportError):``."""
_EXPECT = _RAISES | {"suppress"}


def catches_import_errors(node: ast.Try) -> bool:
    """Return whether a ``try`` has a handler for a failed import."""
    return any(
        handler.type is None or not IMPORT_ERRORS.isdisjoint(last_names(handler.type))
        for handler in node.handlers
    )


def expected_errors(item: ast.withitem) -> set[str]:
    """Return the last parts of the names of exceptions in ``suppress``, ``raises`` and the like."""
    match item.context_expr:
        case ast.Call(args=args) as call if _calls(call, _EXPECT):
            return set().union(*map(last_names, args))
    return set()


def is_tested_to_fail(module: SyntaxTree, node: ast.AST) -> bool:
    """Return whether a test expects that a node fails.

    It may be in a ``with``, in a lambda or in a nested function: ``assertRaises(TypeError, call)``.
    """
    child = node
    for parent in module.parents(node):
        match parent:
            case ast.With(items=items) | ast.AsyncWith(items=items) if child in parent.body:
                if any(_calls(item.context_expr, _RAISES) for item in items):
                    return True
            case ast.Call() if isinstance(child, ast.Lambda) and _calls(parent, _RAISES):
                return True
            case ast.FunctionDef(name=name) | ast.AsyncFunctionDef(name=name):
                around = module.enclosing_function(parent)
                return around is not None and any(
                    _calls(call, _RAISES)
                    and any(isinstance(item, ast.Name) and item.id == name for item in call.args)
                    for call in module.below(around, ast.Call)
                )
        child = parent
    return False


def _calls(node: ast.expr, names: frozenset[str]) -> bool:
    """Return whether an expression calls a function with one of some names."""
    return isinstance(node, ast.Call) and not names.isdisjoint(last_names(node.func))


def last_name(node: ast.AST) -> str:
    """Return the last part of a name: ``'error'`` for ``socket.error``; empty if it is none."""
    match node:
        case ast.Attribute(attr=name) | ast.Name(id=name):
            return name
    return ""


def last_names(node: ast.expr) -> set[str]:
    """Return the last parts of the names in an expression: ``{'error'}`` for ``socket.error``."""
    result: set[str] = set()
    for part in ast.walk(node):
        if isinstance(part, ast.Name):
            result.add(part.id)
        elif isinstance(part, ast.Attribute):
            result.add(part.attr)
    return result
