"""Places where an error with a message is expected: negative tests, and handlers for it."""

from __future__ import annotations

import ast
from collections.abc import Collection

from scaffold.model.python.conditions.handlers import is_tested_to_fail, last_names
from scaffold.model.python.module import PythonModule

_CAUGHT = ("AssertionError", "AttributeError", "TypeError", "ValueError")


def is_error_expected(
    module: PythonModule, node: ast.AST, errors: Collection[str] = _CAUGHT
) -> bool:
    """Return whether an error here is expected: a negative test, or a handler for it.

    Args:
        module: The module.
        node: The place that may raise an error.
        errors: The names of the possible errors.
    """
    return is_tested_to_fail(module, node) or _is_caught(module, node, errors)


def _is_caught(module: PythonModule, node: ast.AST, errors: Collection[str]) -> bool:
    child = node
    for parent in module.parents(node):
        if isinstance(parent, ast.FunctionDef | ast.AsyncFunctionDef):
            return False
        if isinstance(parent, ast.Try) and module.index.place(child)[0] == "body":
            types = [handler.type for handler in parent.handlers if handler.type is not None]
            if any(not last_names(caught).isdisjoint(errors) for caught in types):
                return True
        child = parent
    return False
