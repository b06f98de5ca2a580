"""F824: ``global`` and ``nonlocal`` for names that the function never assigns."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.ament import linters
from scaffold.ament.finding import Finding
from scaffold.ament.python_text.text import PythonText

_BINDING = (
    ast.Name,
    ast.FunctionDef,
    ast.AsyncFunctionDef,
    ast.ClassDef,
    ast.Import,
    ast.ImportFrom,
    ast.ExceptHandler,
    ast.MatchAs,
    ast.MatchStar,
    ast.MatchMapping,
)


def check(text: PythonText) -> Iterator[Finding]:
    """Yield the statements without effect; pyflakes reports them from 3.3 on."""
    if text.index is None or not linters.of_target().since("pyflakes", 3, 3):
        return
    nodes: list[ast.Global | ast.Nonlocal] = [*text.nodes(ast.Global), *text.nodes(ast.Nonlocal)]
    for node in nodes:
        scope = text.index.scope_of(node)
        if isinstance(scope, ast.Module):
            continue
        bound = {
            name
            for item in text.index.below(scope, *_BINDING)
            if item is not scope and text.index.scope_of(item) is scope
            for name in _bound_names(item)
        }
        word = "global" if isinstance(node, ast.Global) else "nonlocal"
        for name in node.names:
            if name not in bound:
                column = text.column(node.lineno, node.col_offset)
                message = f"'{word} {name}' has no effect: the name is never assigned here"
                yield Finding("F824", node.lineno, column, message)


def _bound_names(node: ast.AST) -> Iterator[str]:
    if isinstance(node, ast.Name):
        yield from () if isinstance(node.ctx, ast.Load) else (node.id,)
    elif isinstance(node, (ast.Import, ast.ImportFrom)):
        yield from (item.asname or item.name.partition(".")[0] for item in node.names)
    elif isinstance(node, ast.MatchMapping):
        yield node.rest or ""
    else:
        yield getattr(node, "name", None) or ""
