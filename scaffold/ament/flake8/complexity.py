"""C901: functions with more paths than a package allows, counted as mccabe 0.7.0 does."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence

from scaffold.ament.finding import Finding
from scaffold.ament.flake8.options import Options
from scaffold.ament.python_text.text import PythonText

_Function = (ast.FunctionDef, ast.AsyncFunctionDef)
_Branch = (ast.If, ast.For, ast.AsyncFor, ast.While, ast.Try)


def check(text: PythonText, options: Options) -> Iterator[Finding]:
    """Yield the functions, and the statements outside of them, that branch too often."""
    most = options.max_complexity
    if most < 0 or text.tree is None or not options.reports("C901"):
        return
    counted: dict[str, tuple[int, ast.stmt]] = {}
    _count(text.tree.body, "", counted)
    for name, (complexity, node) in counted.items():
        if complexity > most:
            column = text.column(node.lineno, node.col_offset)
            message = f"'{name}' is too complex ({complexity} paths, {most} allowed)"
            yield Finding("C901", node.lineno, column, message)


def _count(body: Sequence[ast.stmt], outer: str, counted: dict[str, tuple[int, ast.stmt]]) -> None:
    """Count the paths through code outside of functions; the last of a name counts."""
    for node in body:
        if isinstance(node, ast.ClassDef):
            _count(node.body, f"{outer}{node.name}.", counted)
        elif isinstance(node, _Function):
            counted[f"{outer}{node.name}"] = (_inner(node.body) + 1, node)
        elif isinstance(node, _Branch):
            kind = {ast.If: "If", ast.Try: "TryExcept"}.get(type(node), "Loop")
            counted[f"{outer}{kind} {node.lineno}"] = (_paths(node) + 1, node)
        elif isinstance(node, (ast.With, ast.AsyncWith)):
            _count(node.body, outer, counted)


def _inner(body: Sequence[ast.stmt]) -> int:
    """Return the number of paths added by statements."""
    return sum(map(_paths, body))


def _paths(node: ast.stmt) -> int:
    """Return the number of paths added by a statement; mccabe ignores ``finally``."""
    if isinstance(node, (ast.With, ast.AsyncWith)):
        return _inner(node.body)
    if isinstance(node, ast.ClassDef):
        return _inner(node.body)
    if isinstance(node, _Function):
        return 1 + _inner(node.body)
    if not isinstance(node, _Branch):
        return 0
    handlers = node.handlers if isinstance(node, ast.Try) else []
    inside = _inner(node.body) + _inner(node.orelse)
    return 1 + inside + sum(1 + _inner(handler.body) for handler in handlers)
