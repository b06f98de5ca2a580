"""Calls that initialize, spin and shut down rclpy."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from typing import TYPE_CHECKING

from scaffold.model.rclpy.entities import RclpyCall

if TYPE_CHECKING:
    from scaffold.model.python.scopes import FunctionNode
    from scaffold.model.rclpy.file import RclpyFile

_RUNS = frozenset({"init", "spin", "spin_once", "spin_until_future_complete"})
_RUNS |= {"shutdown", "try_shutdown"}
_EXECUTORS = frozenset(
    f"rclpy.executors.{kind}Executor" for kind in ("SingleThreaded", "MultiThreaded")
) | {"rclpy.experimental.EventsExecutor"}

_MAX_CALLS = 20


def rclpy_calls(file: RclpyFile) -> Iterator[RclpyCall]:
    """Yield the calls that start, run or end rclpy, in the order of the text."""
    outside: _Outside | None = None
    for call in file.module.walk(ast.Call):
        name = _run_name(file, call)
        if name is not None:
            outside = outside or _Outside(file)
            yield _rclpy_call(file, call, name, outside)


def _run_name(file: RclpyFile, call: ast.Call) -> str | None:
    for name in file.module.qualified_names(call.func):
        root, _, function = name.rpartition(".")
        if function in _RUNS and root in {"rclpy", "rclpy.utilities"}:
            return function
    func = call.func
    if isinstance(func, ast.Attribute) and func.attr in _RUNS and _is_executor(file, func.value):
        return f"executor.{func.attr}"
    return None


def _is_executor(file: RclpyFile, node: ast.expr) -> bool:
    value = file.evaluator.single_value(node)
    if value is node and isinstance(node, ast.Name):
        value = _entered(file, node) or node
    if not isinstance(value, ast.Call):
        return False
    return not _EXECUTORS.isdisjoint(file.module.qualified_names(value.func))


def _entered(file: RclpyFile, node: ast.Name) -> ast.expr | None:
    """Return the context manager of ``with ... as name``."""
    for binding in file.module.index.bindings_of(node):
        parent = file.module.parent(binding.node)
        if isinstance(parent, ast.withitem):
            return parent.context_expr
    return None


def _rclpy_call(file: RclpyFile, call: ast.Call, name: str, outside: _Outside) -> RclpyCall:
    in_finally = asks_ok = in_with = False
    child: ast.AST = call
    for parent in file.module.parents(call):
        match parent:
            case ast.FunctionDef() | ast.AsyncFunctionDef() | ast.Lambda():
                break
            case ast.Try() if file.module.index.place(child)[0] == "finalbody":
                in_finally = True
            case ast.If(test=test):
                asks_ok = asks_ok or _asks_ok(file, test)
            case ast.With(items=items):
                in_with = in_with or any(_enters_init(file, item) for item in items)
        child = parent
    return RclpyCall(
        name,
        call,
        file.module.location(call),
        file.module.enclosing_function(call),
        frozenset(_handlers_around(file, call)),
        in_finally,
        asks_ok,
        in_with,
        outside.around(call),
    )


def _handlers_around(file: RclpyFile, node: ast.AST) -> set[str]:
    """Return the exceptions caught around a node in its function."""
    handlers: set[str] = set()
    child = node
    for parent in file.module.parents(node):
        match parent:
            case ast.FunctionDef() | ast.AsyncFunctionDef() | ast.Lambda():
                break
            case ast.Try() if file.module.index.place(child)[0] == "body":
                handlers.update(_caught(file, parent))
            case ast.With(items=items):
                handlers.update(*(_suppressed(file, item) for item in items))
        child = parent
    return handlers


class _Outside:
    """The exceptions caught around all calls of the functions of a file."""

    def __init__(self, file: RclpyFile) -> None:
        self._file = file
        self._catches: dict[FunctionNode, frozenset[str]] = {}
        self._depth = 0
        self._calls: dict[str, list[ast.Name]] = {}
        for call in file.module.walk(ast.Call):
            if isinstance(call.func, ast.Name):
                self._calls.setdefault(call.func.id, []).append(call.func)

    def around(self, node: ast.AST) -> frozenset[str]:
        """Return the exceptions caught around all calls of a node's function."""
        function = self._file.module.enclosing_function(node)
        if function is None or self._depth > _MAX_CALLS:
            return frozenset()
        if function not in self._catches:
            self._catches[function] = frozenset()  # recursive calls are ignored
            self._depth += 1
            caught = [
                self.around(name) | _handlers_around(self._file, name)
                for name in self._calls.get(function.name, ())
                if self._is_name_of(name, function)
            ]
            self._depth -= 1
            self._catches[function] = frozenset.intersection(*caught) if caught else frozenset()
        return self._catches[function]

    def _is_name_of(self, name: ast.Name, function: FunctionNode) -> bool:
        bindings = self._file.module.index.bindings_of(name)
        return any(binding.node is function for binding in bindings)


def _caught(file: RclpyFile, node: ast.Try) -> Iterator[str]:
    for handler in node.handlers:
        if handler.type is None:
            yield "BaseException"
        else:
            yield from _exceptions(file, handler.type)


def _exceptions(file: RclpyFile, node: ast.expr) -> Iterator[str]:
    node = file.evaluator.single_value(node)
    if isinstance(node, ast.Tuple):
        for item in node.elts:
            yield from _exceptions(file, item)
    else:
        yield from file.module.qualified_names(node)


def _suppressed(file: RclpyFile, item: ast.withitem) -> Iterator[str]:
    call = item.context_expr
    if not isinstance(call, ast.Call):
        return
    if file.module.qualified_name(call.func) == "contextlib.suppress":
        for arg in call.args:
            yield from _exceptions(file, arg)


def _enters_init(file: RclpyFile, item: ast.withitem) -> bool:
    call = item.context_expr
    return isinstance(call, ast.Call) and file.module.qualified_name(call.func) == "rclpy.init"


def _asks_ok(file: RclpyFile, test: ast.expr) -> bool:
    return any(
        isinstance(node, ast.Call) and file.module.qualified_name(node.func) == "rclpy.ok"
        for node in ast.walk(test)
    )
