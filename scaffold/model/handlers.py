"""Whether code expects an exception."""

from __future__ import annotations

import ast

from scaffold.model.python_module import PythonModule, last_names

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
                if handler.type is None or {exception, *_ALL} & last_names(handler.type):
                    return True
        if isinstance(parent, ast.FunctionDef | ast.AsyncFunctionDef):
            return False
        child = parent
    return False
