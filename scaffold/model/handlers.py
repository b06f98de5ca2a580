"""Whether an exception goes unnoticed: the code expects it, or never runs."""

from __future__ import annotations

import ast

from scaffold.model.python_module import PythonModule, last_names

_LEAVING = (ast.Return, ast.Raise, ast.Continue, ast.Break)
_ALL = frozenset({"Exception", "BaseException"})


def is_harmless(module: PythonModule, node: ast.AST, exception: str) -> bool:
    """Tell whether an exception raised at a node is caught in its function, or never raised.

    Args:
        module: The file.
        node: Where it is raised.
        exception: The last part of its name, such as ``AttributeError``.
    """
    child = node
    for parent in module.parents(node):
        if _is_passed_over(parent, child):
            return True
        if isinstance(parent, ast.Try) and child in parent.body:
            for handler in parent.handlers:
                if handler.type is None or {exception, *_ALL} & last_names(handler.type):
                    return True
        if isinstance(parent, ast.FunctionDef | ast.AsyncFunctionDef):
            return False
        child = parent
    return False


def _is_passed_over(parent: ast.AST, child: ast.AST) -> bool:
    """Tell whether a statement stands behind one that leaves its block, such as a ``return``."""
    for body in (getattr(parent, "body", None), getattr(parent, "orelse", None)):
        if isinstance(body, list) and child in body:
            return any(isinstance(one, _LEAVING) for one in body[: body.index(child)])
    return False
