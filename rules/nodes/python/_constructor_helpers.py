"""Methods that a constructor calls before it sets the attributes that they use."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api.python import FunctionNode, conditions_on, is_handled
from scaffold.api.rclpy import NODE, NodeClass, RclpyFile, has


def too_early(file: RclpyFile, node: NodeClass) -> Iterator[tuple[ast.Call, str]]:
    """Yield the calls of own methods that are too early, with the missing attribute."""
    if node.constructor is None or not _is_known(file, node) or file.module.mentions("setattr("):
        return
    for call in file.calls_in(node.constructor):
        if not isinstance(file.module.parent(call), ast.Expr | ast.Assign):
            continue
        method = _own_method(file, node, call)
        if method is None or conditions_on(file.module, call) or _is_in_block(file, call):
            continue
        if is_handled(file.module, call, "AttributeError"):
            continue
        for used in file.module.below(method, ast.Attribute):
            message = _missing(file, node, call, used)
            if message and file.function_of(used) is method and _is_always_used(file, used):
                yield call, message
                break


def _is_known(file: RclpyFile, node: NodeClass) -> bool:
    """Return whether all base classes up to rclpy's Node are in the file."""
    owner: NodeClass | None = node
    while owner is not None:
        if owner.file is not file or len(owner.node.bases) != 1:
            return False
        owner = owner.base
    return True


def _own_method(file: RclpyFile, node: NodeClass, call: ast.Call) -> FunctionNode | None:
    """Return the method of the class, or of a base class in the file, that a call runs."""
    match call.func:
        case ast.Attribute(value=ast.Name() as owner, attr=name):
            if file.evaluator.self_class(owner) is node.node:
                method = node.method(name)
                return None if method is None or method.decorator_list else method
    return None


def _is_in_block(file: RclpyFile, call: ast.Call) -> bool:
    return any(isinstance(parent, ast.For | ast.While) for parent in file.module.parents(call))


def _missing(file: RclpyFile, node: NodeClass, call: ast.Call, used: ast.Attribute) -> str:
    """Return why an attribute is missing when a method is called; empty if it exists."""
    is_bound = used.attr in file.module.index.bindings(node.node)
    if not isinstance(used.ctx, ast.Load) or not _is_of_self(used) or is_bound:
        return ""
    begin = node.super_init
    line_of_base = begin.lineno if begin is not None and call.lineno < begin.lineno else 0
    name = call.func.attr if isinstance(call.func, ast.Attribute) else ""
    if node.method(used.attr) is None and has(NODE, used.attr):
        is_called = file.module.call_with(used) is not None
        where = f"before super().__init__() in line {line_of_base}: AttributeError"
        return f"{name}() uses self.{used.attr}() {where}" if line_of_base and is_called else ""
    stores = file.evaluator.stores(used.attr)
    setters = {file.function_of(store.node) for store in stores}
    line = 0
    if setters == {node.constructor}:
        line = min(store.node.lineno for store in stores)
    elif setters == {_base_constructor(node)}:
        line = line_of_base
    where = f"which is set later, in line {line}: AttributeError"
    return f"{name}() uses self.{used.attr}, {where}" if call.lineno < line else ""


def _base_constructor(node: NodeClass) -> FunctionNode | None:
    return node.base.constructor if node.base is not None else None


def _is_of_self(used: ast.Attribute) -> bool:
    return isinstance(used.value, ast.Name) and used.value.id == "self"


def _is_always_used(file: RclpyFile, used: ast.Attribute) -> bool:
    """Return whether a method uses an attribute unconditionally, without checking it."""
    quoted = (f"'{used.attr}'", f'"{used.attr}"')
    if file.module.mentions(*quoted) or _in_loop(file, used) or conditions_on(file.module, used):
        return False
    return not is_handled(file.module, used, "AttributeError")


def _in_loop(file: RclpyFile, used: ast.Attribute) -> bool:
    return any(
        isinstance(parent, ast.For | ast.While | ast.comprehension | ast.Lambda)
        for parent in file.module.parents(used)
    )
