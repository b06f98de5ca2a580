"""The functions and classes of Python files, and which of them mention a name."""

from __future__ import annotations

import ast
import itertools
import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

from scaffold.model.facts import fact
from scaffold.model.python.scopes import FunctionNode

if TYPE_CHECKING:
    from scaffold.model.package import Package
    from scaffold.model.python.module import PythonModule

TOP = ""
"""The part of a file that is executed when Python imports it."""
GUARD = "__main__"
"""The part of a file that is executed when Python runs it."""
_CODE = r"[\w.:/-]*\b{0}\b[\w.:/-]*(?:\s*=\s*[\w.:]+)?|[\w.:/-]+\s*=\s*[\w.:]*\b{0}\b"
"""Matches a text that consists of names, such as an entry point."""


@fact
def part_at(package: Package, path: str, line: int) -> str:
    """Return the function, method or class that a line is part of, as a dotted name.

    Raises:
        ViewError: the file cannot be read.
    """
    module = package.module(path)
    guard = module.main_guard_node
    if guard is not None and _covers(guard, line):
        return GUARD
    for outer in _definitions(module.tree):
        if not _covers(outer, line):
            continue
        if isinstance(outer, FunctionNode):
            return outer.name
        for inner in _definitions(outer):
            if isinstance(inner, FunctionNode) and _covers(inner, line):
                return f"{outer.name}.{inner.name}"
        return outer.name if line == outer.lineno else TOP
    return TOP


def nodes_of(module: PythonModule, part: str) -> list[FunctionNode | ast.ClassDef]:
    """Return the definitions of a part; more than one if it is defined again."""
    outer, _, inner = part.partition(".")
    nodes = [node for node in _definitions(module.tree) if node.name == outer]
    if not inner:
        return nodes
    return [item for node in nodes for item in _definitions(node) if item.name == inner]


@fact
def parts_mentioning(package: Package, path: str, part: str) -> frozenset[str]:
    """Return the parts of a file that mention a function, method or class.

    A method is mentioned as an attribute, a function by its name, and both in texts of code.

    Args:
        package: The package.
        path: The file.
        part: The function, method or class of this or another file.

    Raises:
        ViewError: the file cannot be read.
    """
    module = package.module(path)
    return frozenset(
        user for node in _mentioning(module, part) if (user := _part_with(module, node)) is not None
    )


def _mentioning(module: PythonModule, part: str) -> Iterator[ast.AST]:
    owner, _, name = part.rpartition(".")
    attributes = module.index.attributes(name)
    if owner:
        yield from (use for use in attributes if not _is_module(module, use.value))
        yield from (
            use
            for use in module.index.names(name)
            if getattr(module.index.scope_of(use), "name", "") == owner
        )
    else:
        yield from (use for use in attributes if module.text(use.value) != "self")
        yield from (use for use in module.index.names(name) if _is_global(module, use))
        for statement in module.walk(ast.ImportFrom):
            for alias in statement.names:
                is_passed_on = alias.asname is not None or module.path.endswith("__init__.py")
                if alias.name == name and is_passed_on:
                    yield alias
    if module.in_tests:  # which ask for a fixture by its name
        yield from (item for item in module.walk(ast.arg) if item.arg == name)
    code = re.compile(_CODE.format(re.escape(name)))
    for constant in module.walk(ast.Constant):
        text = constant.value
        if not isinstance(text, str) or name not in text:
            continue
        is_docstring = isinstance(module.parent(constant), ast.Expr)
        if not is_docstring and (f"{name}(" in text or code.fullmatch(text)):
            yield constant


def _is_module(module: PythonModule, node: ast.expr) -> bool:
    """Return whether an expression is a module, ``import math``, whose attributes are its own."""
    if not isinstance(node, ast.Name):
        return False
    _, bindings = module.index.lookup(node.id, node) or (None, ())
    names = {
        alias.asname or alias.name.partition(".")[0]
        for statement in module.walk(ast.Import)
        for alias in statement.names
    }
    return bool(bindings) and all(item.kind == "import" for item in bindings) and node.id in names


def _is_global(module: PythonModule, use: ast.Name) -> bool:
    """Return whether a name may be that of a function or class of a module."""
    scope, bindings = module.index.lookup(use.id, use) or (module.tree, ())
    return scope is module.tree or any(item.kind == "import" for item in bindings)


def _part_with(module: PythonModule, node: ast.AST) -> str | None:
    """Return the part in which a node is evaluated; ``None`` if it is never executed.

    Decorators and defaults are evaluated when a function is defined; the bases of a class matter to
    those who use the class.
    """
    parents = [node, *module.parents(node)]
    if not module.passed_over.isdisjoint(parents):
        return None
    if module.main_guard_node in parents:
        return GUARD
    names: list[str] = []
    for child, parent in itertools.pairwise(parents):
        if isinstance(parent, FunctionNode):
            is_in_body = isinstance(child, ast.stmt)
            names = [parent.name] if is_in_body else []
        elif isinstance(parent, ast.ClassDef):
            is_base = child in parent.bases
            names = [parent.name, *names] if names or is_base else []
    return ".".join(names[:2])


def _definitions(node: ast.AST) -> Iterator[FunctionNode | ast.ClassDef]:
    """Yield the functions and classes defined in a module or class, also under conditions."""
    for child in ast.iter_child_nodes(node):
        if isinstance(child, FunctionNode | ast.ClassDef):
            yield child
        elif isinstance(child, ast.If | ast.Try | ast.With):
            yield from _definitions(child)


def _covers(node: ast.stmt, line: int) -> bool:
    return node.lineno <= line <= (node.end_lineno or node.lineno)
