"""Flags that record whether an optional import succeeded."""

from __future__ import annotations

import ast
from collections import defaultdict
from collections.abc import Iterator, Sequence

from scaffold.model.python.conditions.guards import Condition
from scaffold.model.python.conditions.handlers import catches_import_errors
from scaffold.model.python.module import PythonModule
from scaffold.model.python.scopes import Binding


def asks_which_release(module: PythonModule, condition: Condition, package: str) -> bool:
    """Return whether a condition tests the release of a package by an import.

    The handler of the import has another one from the same package, or the conditional code
    runs only after the handler.

    Args:
        module: The file.
        condition: The condition and its required value.
        package: The top-level package.
    """
    for attempt in _attempts(module, condition.test):
        if not _imports(attempt.body, package):
            continue
        if any(_imports(handler.body, package) for handler in attempt.handlers):
            return True
        if any(_is_said_by_failure(module, attempt, name) for name in _required_names(condition)):
            return True
    return False


def _attempts(module: PythonModule, test: ast.expr) -> Iterator[ast.Try]:
    """Yield the ``try`` statements with an import that bind a name in a condition."""
    for name in ast.walk(test):
        for binding in _bindings(module, name):
            for parent in module.parents(binding.node):
                if isinstance(parent, ast.Try) and catches_import_errors(parent):
                    yield parent


def _bindings(module: PythonModule, name: ast.AST) -> Sequence[Binding]:
    return module.index.bindings_of(name)


def _imports(body: Sequence[ast.stmt], package: str) -> bool:
    """Return whether statements import from a package."""
    for statement in body:
        match statement:
            case ast.ImportFrom(module=str(name), level=0):
                names = [name]
            case ast.Import(names=aliases):
                names = [alias.name for alias in aliases]
            case _:
                continue
        if any(name.partition(".")[0] == package for name in names):
            return True
    return False


def _required_names(condition: Condition) -> Iterator[Condition]:
    """Yield the names in a condition that must be true, or false, for it to hold."""
    needed = condition.needed
    match condition.test:
        case ast.Name():
            yield condition
        case ast.UnaryOp(op=ast.Not(), operand=operand):
            yield from _required_names(Condition(operand, not needed))
        case ast.BoolOp(op=op, values=values) if isinstance(op, ast.And) is needed:
            for value in values:
                yield from _required_names(Condition(value, needed))
        case ast.Compare(
            left=ast.Name() as name,
            ops=[ast.Is() | ast.IsNot() | ast.Eq() | ast.NotEq() as operator],
            comparators=[ast.Constant(value=None | True | False as value)],
        ):
            is_equal = isinstance(operator, ast.Is | ast.Eq) is needed
            yield Condition(name, bool(value) is is_equal)


def _is_said_by_failure(module: PythonModule, attempt: ast.Try, name: Condition) -> bool:
    """Return whether a name has its required value only after a failed import."""
    by_field: defaultdict[str, set[bool | None]] = defaultdict(set)
    for binding in _bindings(module, name.test):
        field = _field_in(module, attempt, binding.node)
        by_field["body" if field == "orelse" else field].add(_truth_of(binding))
    failed = by_field["handlers"] or by_field[""]
    return failed == {name.needed} and by_field["body"] == {not name.needed}


def _field_in(module: PythonModule, attempt: ast.Try, node: ast.AST) -> str:
    """Return the part of a ``try`` that a node is in; empty outside."""
    child = node
    for parent in module.parents(node):
        if parent is attempt:
            return (
                "handlers" if isinstance(child, ast.ExceptHandler) else module.index.place(child)[0]
            )
        child = parent
    return ""


def _truth_of(binding: Binding) -> bool | None:
    match binding.value:
        case ast.Constant(value=value):
            return bool(value)
    return True if binding.kind in {"import", "function", "class"} else None
