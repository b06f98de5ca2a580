"""The callbacks of a file, and the functions that they call."""

from __future__ import annotations

import ast
from collections.abc import Container, Iterator, Sequence
from itertools import takewhile
from typing import TYPE_CHECKING

from scaffold.model.python.evaluation.returns import returned
from scaffold.model.rclpy.entities import Callback, Entity
from scaffold.model.rclpy.nodes import NodeClass
from scaffold.model.rclpy.tables import column, entries

if TYPE_CHECKING:
    from scaffold.model.python.scopes import FunctionNode
    from scaffold.model.rclpy.file import RclpyFile


def resolve(file: RclpyFile, node: ast.expr) -> Callback:
    """Return the callback of an expression."""
    module = file.module
    if isinstance(node, ast.Call):
        if module.qualified_name(node.func) == "functools.partial" and node.args:
            inner = resolve(file, node.args[0])
            return inner._replace(node=node, is_partial=True)
        return _called(file, node)
    if isinstance(node, ast.Lambda):
        return Callback(node, None, node, module, is_called=False, is_bound=False)
    if isinstance(node, ast.Attribute):
        owner = file.owner_of(node.value)
        method = owner.method(node.attr) if isinstance(owner, NodeClass) else None
        if method is None:
            class_ = file.evaluator.self_class(node.value)
            method = _method_of(file, class_, node.attr) if class_ else None
        is_bound = method is not None and not _is_static_method(method)
        return Callback(node, node.attr, method, module, is_called=False, is_bound=is_bound)
    if isinstance(node, ast.Name):
        function = file.module.index.only_node(node)
        if not isinstance(function, ast.FunctionDef | ast.AsyncFunctionDef):
            function = None
        return Callback(node, node.id, function, module, is_called=False, is_bound=False)
    return Callback(node, None, None, module, is_called=False, is_bound=False)


def _called(file: RclpyFile, node: ast.Call) -> Callback:
    """Return the callback that a call returns, or the call of what should have been passed."""
    inner = resolve(file, node.func)
    made = _made_by(file, inner.function)
    if made is not None:
        name = None if isinstance(made, ast.Lambda) else made.name
        return inner._replace(node=node, name=name, function=made, is_bound=False)
    is_called = inner.function is not None and not _returns_function(inner.function)
    return inner._replace(node=node, is_called=is_called, function=None)


def replaced(node: NodeClass, base: NodeClass) -> Iterator[tuple[Entity, Callback]]:
    """Yield the methods of a class that its base class, in another file, registers."""
    for entity, callback in base.file.callbacks:
        name = callback.name or ""
        method = node.methods.get(name)
        is_own = callback.is_bound and callback.function is base.method(name)
        if method is not None and is_own and not callback.is_called:
            yield entity, callback._replace(node=method, function=method, module=node.file.module)


def worker(file: RclpyFile, callback: Callback) -> Callback:
    """Return the function whose result a callback returns: what a lambda does nothing but call."""
    match callback.function:
        case ast.Lambda(body=ast.Call(func=func)):
            called = resolve(file, func)
            return called if called.function is not None else callback
    return callback


def _method_of(file: RclpyFile, class_: ast.ClassDef, name: str) -> FunctionNode | None:
    for member in file.related_classes(class_):
        for binding in file.module.index.bindings(member).get(name, ()):
            if isinstance(binding.node, ast.FunctionDef | ast.AsyncFunctionDef):
                return binding.node
    return None


def function_of(file: RclpyFile, node: ast.AST) -> FunctionNode | ast.Lambda | None:
    """Return the function whose body contains a node."""
    child = node
    for parent in file.module.parents(node):
        if isinstance(parent, ast.Lambda):
            return parent
        if isinstance(parent, ast.FunctionDef | ast.AsyncFunctionDef) and isinstance(
            child, ast.stmt
        ):
            return parent
        child = parent
    return None


def reached(
    file: RclpyFile, function: FunctionNode | ast.Lambda, skipped: Container[ast.AST] = ()
) -> Sequence[FunctionNode | ast.Lambda]:
    """Return a function and the functions and methods that it calls in the same file.

    Args:
        file: The file.
        function: The function.
        skipped: Functions to skip, with those that only they call.
    """
    result: dict[FunctionNode | ast.Lambda, None] = {}
    pending = [function] if function not in skipped else []
    while pending:
        result.update(dict.fromkeys(pending))
        called = [
            file.callback(call.func).function
            for current in pending
            for call in file.calls_in(current)
        ]
        pending = [
            item
            for item in dict.fromkeys(called)
            if item and item not in result and item not in skipped
        ]
    return [*result]


def _is_static_method(function: FunctionNode) -> bool:
    return any(
        isinstance(decorator, ast.Name) and decorator.id == "staticmethod"
        for decorator in function.decorator_list
    )


def _made_by(
    file: RclpyFile, factory: FunctionNode | ast.Lambda | None
) -> FunctionNode | ast.Lambda | None:
    """Return the function inside of another one that this returns in any case."""
    if not isinstance(factory, ast.FunctionDef) or factory.decorator_list:
        return None
    made = {
        file.module.index.only_node(statement.value)
        if isinstance(statement.value, ast.Name)
        else statement.value
        for statement in returned(factory)
    }
    only = made.pop() if len(made) == 1 else None
    return only if isinstance(only, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda) else None


def _returns_function(function: FunctionNode | ast.Lambda) -> bool:
    """Return whether a function may return another function."""
    if isinstance(function, ast.Lambda):
        return True
    return any(
        isinstance(node, ast.Return) and node.value is not None for node in ast.walk(function)
    )


def alternatives(file: RclpyFile, callback: Callback) -> Sequence[Callback]:
    """Return the possible callbacks of a variable or a condition, or the only one.

    All are passed in the same place and must accept the same arguments.
    """
    if callback.function is not None or callback.is_called:
        return [callback]
    chosen = [resolve(file, node) for node in _chosen_from(file, callback.node)]
    return [item for item in chosen if item.function is not None]


def _chosen_from(file: RclpyFile, node: ast.AST, depth: int = 0) -> Sequence[ast.expr]:
    """Return the alternatives of an expression; empty if unknown."""
    match node:
        case ast.IfExp(body=body, orelse=orelse):
            return [body, orelse]
        case ast.Subscript(value=ast.Name() as row, slice=ast.Constant(value=key)):
            return entries(_chosen_from(file, row, depth), key)
    lookup = file.module.index.lookup(node.id, node) if isinstance(node, ast.Name) else None
    result: list[ast.expr] = []
    for binding in lookup[1] if lookup is not None and not depth else ():
        if binding.kind == "assignment" and binding.value is not None:
            result += _chosen_from(file, binding.value, 1) or [binding.value]
        elif binding.kind in {"loop", "other"}:
            result += column(file.evaluator, binding.node)
    return result


def numbers_taken(callback: Callback) -> range | None:
    """Return the accepted numbers of positional arguments of a callback; ``None`` if unknown.

    Negative if ``partial`` already passes too many.
    """
    function = callback.function
    if function is None or callback.is_called:
        return None
    if not isinstance(function, ast.Lambda) and function.decorator_list:
        return None
    arguments = function.args
    if arguments.vararg is not None or any(
        default is None for default in arguments.kw_defaults if arguments.kwonlyargs
    ):
        return None
    names = [item.arg for item in (*arguments.posonlyargs, *arguments.args)]
    if callback.is_bound and not names:
        return range(-1, 0)  # not even the object that it is bound to
    names = names[int(callback.is_bound) :]
    needed = names[: len(names) - len(arguments.defaults)]
    if callback.is_partial:
        return _left_by_partial(names, needed, _given_before(callback.node))
    return range(len(needed), len(names) + 1)


def _left_by_partial(
    names: Sequence[str], needed: Sequence[str], given: tuple[int, set[str | None]] | None
) -> range | None:
    """Return how many of a function's arguments ``partial`` leaves; negative if it gives more."""
    if given is None:
        return None
    number, by_name = given
    if number > len(names):
        return range(len(names) - number, len(names) - number + 1)
    needed = [name for name in needed[number:] if name not in by_name]
    names = [*takewhile(lambda name: name not in by_name, names[number:])]
    return range(len(needed), len(names) + 1)


def _given_before(node: ast.AST) -> tuple[int, set[str | None]] | None:
    """Return how many arguments ``partial(function, 'left')`` gives, and which ones by name.

    ``None`` if that is not known.
    """
    match node:
        case ast.Call(args=[ast.Name() | ast.Attribute(), *given], keywords=keywords):
            by_name = {word.arg for word in keywords}
            is_known = not any(isinstance(argument, ast.Starred) for argument in given)
            return (len(given), by_name) if is_known and None not in by_name else None
    return None
