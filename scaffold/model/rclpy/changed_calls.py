"""Calls whose meaning differs between the source and the target distribution."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold import distributions
from scaffold.changes import Change, of_kind
from scaffold.model.python.conditions.distribution_branches import is_run
from scaffold.model.python.conditions.guards import caught_around, has_fallback
from scaffold.model.python.evaluation.given_arguments import argument_of
from scaffold.model.python.evaluation.values import is_none_literal
from scaffold.model.python.module import PythonModule
from scaffold.model.rclpy.api import class_of
from scaffold.model.rclpy.changed_names import ChangedUse, is_asked_for
from scaffold.model.rclpy.file import RclpyFile

_ABOVE = {"TimeoutError": "OSError"}
"""The class above an error."""


def changed_calls(module: PythonModule) -> Iterator[ChangedUse]:
    """Yield the calls with another meaning on the target than on the source distribution.

    Calls that run on only one of them are skipped.
    """
    changes = [change for change in of_kind("call") if change.is_changed]
    words = (name.rpartition(".")[2] for change in changes for name in change.names)
    if not changes or not module.mentions(*words):
        return
    file = RclpyFile(module)
    for call in module.walk(ast.Call):
        called = _names_of_callee(file, call)
        for change in changes:
            name = next((name for name in change.names if name in called), "")
            if name and _is_meant(file, call, change) and _runs_on_both(module, call, name):
                at = module.location(call.func)
                yield ChangedUse(change, at, change.names[0].rpartition(".")[2], "")


def _names_of_callee(file: RclpyFile, call: ast.Call) -> set[str]:
    names = set(file.module.qualified_names(call.func))
    match call.func:
        case ast.Attribute(attr="__init__", value=ast.Call(func=ast.Name(id="super"), args=[])):
            parents = file.module.parents(call)
            class_def = next((item for item in parents if isinstance(item, ast.ClassDef)), None)
            for base in class_def.bases if class_def is not None else ():
                names |= file.module.qualified_names(base)
    if isinstance(call.func, ast.Attribute):
        class_ = class_of(file, call.func.value)
        if class_ is not None:
            names.add(f"{class_}.{call.func.attr}")
    return names


def _is_meant(file: RclpyFile, call: ast.Call, change: Change) -> bool:
    """Return whether a call has the changed arguments, and is not prepared for the change."""
    if any(word.arg is None for word in call.keywords) or _is_ready(file.module, call, change):
        return False
    if change.without and argument_of(call, change.without) is not None:
        return False
    if not change.having:
        return True
    value = argument_of(call, change.having, change.position)
    return value is not None and _is_meant_value(file, value, change)


def _is_meant_value(file: RclpyFile, value: ast.expr, change: Change) -> bool:
    if change.is_of_node:
        return _is_of_node(file, value)
    if change.value:
        return file.module.text(value) == change.value
    return not is_none_literal(file.evaluator.single_value(value))


def _is_ready(module: PythonModule, call: ast.Call, change: Change) -> bool:
    if change.unless and module.mentions(change.unless):
        return True
    return bool(change.raises) and _is_caught(module, call, change.raises)


def _is_caught(module: PythonModule, call: ast.Call, error: str) -> bool:
    """Return whether code continues after an error of a call as without one."""
    if not caught_around(module, call).isdisjoint({error, _ABOVE.get(error, error)}):
        return True
    return has_fallback(module, call, is_rare=True)


def _is_of_node(file: RclpyFile, value: ast.expr) -> bool:
    """Return whether an expression is a node, or a method of one."""
    node = value.value if isinstance(value, ast.Attribute) else value
    return file.owner_of(node) is not None


def _runs_on_both(module: PythonModule, call: ast.Call, name: str) -> bool:
    """Return whether a call runs on both the target and the source distribution."""
    if is_asked_for(module, call, name):
        return False
    origin = distributions.origin() or distributions.target()
    for distribution in (distributions.target(), origin):
        with distributions.targeting(distribution, distributions.origin(), distributions.kept()):
            if not is_run(module, module.location(call)):
                return False
    return True
