"""Whether code expects an exception."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from scaffold.model.python_module import PythonModule

_ALL = frozenset({"Exception", "BaseException"})


def is_caught(module: PythonModule, node: ast.AST, exception: str) -> bool:
    """Tell whether an exception raised at a node is caught in the same function.

    Args:
        module: The file.
        node: Where it is raised.
        exception: The last part of its name, such as ``AttributeError``.
    """
    child = node
    for parent in module.parents(node):
        if isinstance(parent, ast.Try) and child in parent.body:
            for handler in parent.handlers:
                if handler.type is None or {exception, *_ALL} & _names(handler.type):
                    return True
        if isinstance(parent, ast.FunctionDef | ast.AsyncFunctionDef):
            return False
        child = parent
    return False


def _names(node: ast.expr) -> set[str]:
    """Return the last parts of the names in an expression."""
    found: set[str] = set()
    for part in ast.walk(node):
        if isinstance(part, ast.Name):
            found.add(part.id)
        elif isinstance(part, ast.Attribute):
            found.add(part.attr)
    return found
