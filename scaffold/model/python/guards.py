"""Whether an exception goes unnoticed: the code expects it, asks first, or never runs."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.model.python.module import PythonModule, last_names

LEAVING = (ast.Return, ast.Raise, ast.Continue, ast.Break)
"""Statements after which the rest of a block is not run."""
_ALL = frozenset({"Exception", "BaseException"})


def is_handled(
    module: PythonModule, node: ast.AST, exception: str, *, is_broad: bool = True
) -> bool:
    """Tell whether an exception raised at a node is caught in its function, or never raised.

    Args:
        module: The file.
        node: Where it is raised.
        exception: The last part of its name, such as ``AttributeError``.
        is_broad: Whether a handler of any exception counts.
    """
    expecting = {exception, *_ALL} if is_broad else {exception}
    child = node
    for parent in module.parents(node):
        if child in module.passed_over or _is_never_evaluated(module, child, parent):
            return True
        if isinstance(parent, ast.Try) and module.index.place(child)[0] == "body":
            for handler in parent.handlers:
                is_any = handler.type is None
                if (is_any and is_broad) or (handler.type and expecting & last_names(handler.type)):
                    return True
        if isinstance(parent, ast.FunctionDef | ast.AsyncFunctionDef):
            return False
        child = parent
    return False


def _is_never_evaluated(module: PythonModule, node: ast.AST, parent: ast.AST) -> bool:
    """Tell whether a node is an annotation in a file where those stay text."""
    match parent:
        case ast.arg(annotation=written) | ast.AnnAssign(annotation=written):
            is_annotation = written is node
        case ast.FunctionDef(returns=written) | ast.AsyncFunctionDef(returns=written):
            is_annotation = written is node
        case _:
            return False
    return is_annotation and any(
        item.module == "__future__" and any(name.name == "annotations" for name in item.names)
        for item in module.imports
    )


def is_guarded_by(module: PythonModule, node: ast.AST, value: ast.expr) -> bool:
    """Tell whether a node runs only if a condition on a value holds: ``if self.topic:``.

    Args:
        module: The file.
        node: What runs.
        value: The expression; a condition asks about it when it holds the same words.
    """
    words = ast.unparse(value)
    child = node
    for parent in module.parents(node):
        if (
            isinstance(parent, ast.If | ast.IfExp | ast.While)
            and child is not parent.test
            and words in module.words_of(parent.test)
        ):
            return True
        if isinstance(parent, ast.FunctionDef | ast.AsyncFunctionDef):
            return False
        child = parent
    return False


def caught_around(module: PythonModule, node: ast.AST) -> frozenset[str]:
    """Return the last parts of the names of what is caught around a node in its function."""
    result: set[str] = set()
    child = node
    for parent in module.parents(node):
        if isinstance(parent, ast.Try) and module.index.place(child)[0] == "body":
            for handler in parent.handlers:
                result |= last_names(handler.type) if handler.type else _ALL
        if isinstance(parent, ast.With):
            for item in parent.items:
                if "suppress" in last_names(item.context_expr):
                    result |= last_names(item.context_expr)
        if isinstance(parent, ast.FunctionDef | ast.AsyncFunctionDef):
            break
        child = parent
    return frozenset(result)


def conditions_on(module: PythonModule, node: ast.AST) -> list[ast.expr]:
    """Return the conditions in its function that decide whether a node is run.

    Those of branches and loops around it, what is ahead of it in ``and``, and the conditions of
    earlier branches that leave.
    """
    result: list[ast.expr] = []
    child = node
    for parent in module.parents(node):
        if isinstance(parent, ast.If | ast.IfExp | ast.While) and child is not parent.test:
            result.append(parent.test)
        if isinstance(parent, ast.BoolOp) and isinstance(child, ast.expr):
            result += parent.values[: parent.values.index(child)]
        result += _left_before(module, child, parent)
        if isinstance(parent, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda):
            break
        child = parent
    return result


def conditions_of_leaving(module: PythonModule, node: ast.AST) -> list[ast.expr]:
    """Return the conditions of branches that leave before a node is reached.

    Args:
        module: The file.
        node: What runs if the branches do not; those of functions around its own count too.
    """
    result: list[ast.expr] = []
    child = node
    for parent in module.parents(node):
        result += _left_before(module, child, parent)
        child = parent
    return result


def _left_before(module: PythonModule, child: ast.AST, parent: ast.AST) -> Iterator[ast.expr]:
    """Yield the conditions of earlier statements in the same block that may leave it."""
    if not isinstance(child, ast.stmt):
        return
    field, number = module.index.place(child)
    block = getattr(parent, field, None)
    for earlier in block[:number] if isinstance(block, list) else ():
        if isinstance(earlier, ast.If) and isinstance(earlier.body[-1], LEAVING):
            yield earlier.test


def is_for_ros1(module: PythonModule, node: ast.AST) -> bool:
    """Tell whether a node runs with ROS 1 only: ``if ROS_VERSION == 1:``."""
    child = node
    for parent in module.parents(node):
        if isinstance(parent, ast.If) and child is not parent.test:
            version = _asks_for_version(parent.test)
            is_body = module.index.place(child)[0] == "body"
            if version is not None and version == ("1" if is_body else "2"):
                return True
        child = parent
    return False


def _asks_for_version(test: ast.expr) -> str | None:
    match test:
        case ast.Compare(left=left, ops=[ast.Eq()], comparators=[ast.Constant(value=value)]):
            return str(value) if "ROS_VERSION" in ast.unparse(left) else None
    return None
