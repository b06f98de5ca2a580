"""Where pyflakes and ruff disagree on how a name is used: F401, F823 and F841."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.ament.finding import Finding
from scaffold.ament.python_text.text import PythonText
from scaffold.model.python.scopes import FunctionNode

Function = (ast.FunctionDef, ast.AsyncFunctionDef)
_Inner = (*Function, ast.Lambda, ast.ClassDef, ast.ListComp, ast.SetComp, ast.DictComp)
_Conditional = (ast.If, ast.While)


def used_by_alias(text: PythonText) -> set[tuple[int, str]]:
    """Return the lines and modules of imports that pyflakes counts as used by an alias.

    ``import a`` counts as used where ``import a as b`` is, both at the top of the file.
    """
    if " as " not in text.text or text.tree is None:
        return set()
    imports = [
        (node.lineno, alias)
        for node in text.tree.body
        if isinstance(node, ast.Import)
        for alias in node.names
        if "." not in alias.name
    ]
    aliases = {alias.asname: alias.name for _, alias in imports if alias.asname != alias.name}
    used = {
        aliases[node.id]
        for node in text.nodes(ast.Name)
        if node.id in aliases and isinstance(node.ctx, ast.Load)
    }
    return {(line, item.name) for line, item in imports if not item.asname and item.name in used}


def at_last_use(text: PythonText, finding: Finding) -> Finding:
    """Move F823 from the first use of a local name to the last one before it is set."""
    name = finding.message.partition("`")[2].partition("`")[0]
    around = [
        node
        for node in text.functions
        if node.lineno <= finding.line <= (node.end_lineno or node.lineno)
    ]
    for function in reversed(around):
        last: ast.Name | None = None
        for node in _in_order(function.body):
            if not isinstance(node, ast.Name) or node.id != name:
                continue
            if isinstance(node.ctx, ast.Load):
                last = node
            elif last is not None:
                column = text.column(last.lineno, last.col_offset)
                return finding._replace(line=last.lineno, column=column, end_line=0, end_column=0)
    return finding


def read_after_rebinding(text: PythonText) -> set[tuple[int, str]]:
    """Return the handlers, by line and name, whose exception is assigned again and then read.

    To pyflakes that is one variable, to ruff the exception itself is not used.
    """
    result: set[tuple[int, str]] = set()
    for handler in text.nodes(ast.ExceptHandler):
        if handler.name is None:
            continue
        uses: set[type[ast.expr_context]] = set()
        pending: list[ast.AST] = list(handler.body)
        while pending:
            node = pending.pop()
            if isinstance(node, ast.Name) and node.id == handler.name:
                uses.add(type(node.ctx))
            if not isinstance(node, (*Function, ast.Lambda)):
                pending.extend(ast.iter_child_nodes(node))
        if {ast.Store, ast.Load} <= uses:
            result.add((handler.lineno, handler.name))
    return result


def deleted_unused(text: PythonText) -> Iterator[Finding]:
    """Yield F841 for what is set, never read, and deleted where that may not happen.

    To ruff the deletion is a use.
    """
    uncertain: dict[FunctionNode, set[str]] = {}
    certain: dict[FunctionNode, set[str]] = {}
    for name, is_certain, parents in deletions(text):
        scope = next((parent for parent in parents if isinstance(parent, _Inner)), None)
        if isinstance(scope, Function):
            (certain if is_certain else uncertain).setdefault(scope, set()).add(name.id)
    for function, deleted in uncertain.items():
        yield from _never_read(text, function, deleted - certain.get(function, set()))


def deletions(text: PythonText) -> Iterator[tuple[ast.Name, bool, list[ast.AST]]]:
    """Yield each name that ``del`` deletes, whether it certainly does, and the nodes around it."""
    for name in text.nodes(ast.Name):
        if isinstance(name.ctx, ast.Del):
            parents = [*text.parents(name)]
            yield name, not any(isinstance(parent, _Conditional) for parent in parents), parents


def _never_read(text: PythonText, function: FunctionNode, deleted: set[str]) -> Iterator[Finding]:
    for node in ast.walk(function):
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load):
            deleted -= {node.id} if node.id != "locals" else deleted
        elif isinstance(node, (ast.Global, ast.Nonlocal)):
            deleted.difference_update(node.names)
    places = {
        target.id: target
        for node in _in_order(function.body)
        if isinstance(node, ast.Assign)
        for target in node.targets
        if isinstance(target, ast.Name) and target.id in deleted
    }
    for name, place in places.items():
        column = text.column(place.lineno, place.col_offset)
        message = f"local variable `{name}` is assigned to but never used"
        yield Finding("F841", place.lineno, column, message)


def _in_order(body: list[ast.stmt]) -> Iterator[ast.AST]:
    """Yield what runs in a function itself, values before the names that they are given."""
    pending: list[ast.AST] = list(reversed(body))
    while pending:
        node = pending.pop()
        yield node
        if isinstance(node, _Inner):
            continue
        children = list(ast.iter_child_nodes(node))
        if isinstance(node, (ast.Assign, ast.AnnAssign, ast.NamedExpr)):
            children.sort(key=lambda child: child is not node.value)
        elif isinstance(node, (ast.For, ast.AsyncFor)):
            children.sort(key=lambda child: child is not node.iter)
        pending.extend(reversed(children))
