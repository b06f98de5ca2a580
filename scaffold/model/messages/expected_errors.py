"""Places where an error with a message is expected: negative tests, and handlers for it."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.model.python.module import PythonModule

_CAUGHT = frozenset({"AttributeError", "TypeError", "AssertionError", "ValueError"})
_RAISES = frozenset({"raises", "assertRaises", "assertRaisesRegex"})
"""Functions of test libraries that expect an error."""


def is_error_expected(module: PythonModule, node: ast.AST) -> bool:
    """Tell whether an error here is expected: a negative test, or a handler for it."""
    child = node
    for parent in module.parents(node):
        if isinstance(parent, ast.FunctionDef | ast.AsyncFunctionDef):
            return False
        if isinstance(parent, ast.Try) and module.index.place(child)[0] == "body":
            caught = {
                name
                for handler in parent.handlers
                if handler.type is not None
                for name in _last_names(handler.type)
            }
            if caught & _CAUGHT:
                return True
        if isinstance(parent, ast.With | ast.Call) and _expects_error(parent):
            return True
        child = parent
    return False


def _last_names(node: ast.expr) -> Iterator[str]:
    for part in node.elts if isinstance(node, ast.Tuple) else [node]:
        if isinstance(part, ast.Name):
            yield part.id
        elif isinstance(part, ast.Attribute):
            yield part.attr


def _expects_error(node: ast.With | ast.Call) -> bool:
    """Tell whether a ``with`` or a call such as ``assertRaises`` expects an error."""
    calls = [item.context_expr for item in node.items] if isinstance(node, ast.With) else [node]
    return any(
        isinstance(call, ast.Call) and not _RAISES.isdisjoint(_last_names(call.func))
        for call in calls
    )
