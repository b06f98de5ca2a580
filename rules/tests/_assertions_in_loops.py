"""Tests that only assert in a loop over what was received, which may be nothing; for TS043."""

from __future__ import annotations

import ast
import re

from scaffold.api.python import FunctionNode, PythonModule

from ._collected_messages import appended_lists

_CHECKING = re.compile(r"(?:^|\.)_?(?:assert|check|expect|verify|fail|raises|require|wait)")
"""Matches the names of functions that may fail."""


def loop_over_nothing(module: PythonModule, test: FunctionNode) -> ast.For | None:
    """Return the loop that contains all assertions of a test, if nothing tells that it runs."""
    loops = {
        loop
        for item in module.below(test, ast.Assert)
        for loop in (_outermost(module, item, test),)
    }
    loop = loops.pop() if len(loops) == 1 else None
    if loop is None or any(_may_fail(module, node) for node in ast.walk(test)):
        return None
    return loop if _is_received(module, test, loop) else None


def _outermost(module: PythonModule, node: ast.AST, test: FunctionNode) -> ast.For | None:
    """Return the outermost loop of a test around a node."""
    found = None
    for parent in module.parents(node):
        if parent is test:
            break
        found = parent if isinstance(parent, ast.For) else found
    return found


def _may_fail(module: PythonModule, node: ast.AST) -> bool:
    """Return whether a node besides the assertions may make a test fail."""
    match node:
        case ast.Raise():
            return True
        case ast.Call(func=func):
            return _CHECKING.search(module.text(func)) is not None
    return False


def _is_received(module: PythonModule, test: FunctionNode, loop: ast.For) -> bool:
    """Return whether a loop runs over a list that only a callback fills."""
    name = loop.iter
    if not isinstance(name, ast.Name):
        return False
    uses = [use for use in module.below(test, ast.Name) if use.id == name.id]
    is_plain = all(_is_plain(module, use, loop) for use in uses)
    return is_plain and _is_filled(module, name, module.index.only_value(name))


def _is_plain(module: PythonModule, use: ast.Name, loop: ast.For) -> bool:
    """Return whether a use of a list is its assignment, the loop, or its method ``append``."""
    parent = module.parent(use)
    is_append = isinstance(parent, ast.Attribute) and parent.attr == "append"
    return use is loop.iter or isinstance(use.ctx, ast.Store) or is_append


def _is_filled(module: PythonModule, name: ast.Name, value: ast.expr | None) -> bool:
    """Return whether a variable is an empty list whose method ``append`` is a callback."""
    return isinstance(value, ast.List) and not value.elts and name.id in _appended(module)


def _appended(module: PythonModule) -> set[str]:
    """Return the lists that subscriptions of the file append to."""
    return {name for call in module.walk(ast.Call) for name in appended_lists(call)}
