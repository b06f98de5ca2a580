"""Calls that initialize, spin and shut down rclpy."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from typing import TYPE_CHECKING

from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from scaffold.model.python.scopes import FunctionNode
    from scaffold.model.rclpy.evaluation.evaluator import NodeEvaluator
    from scaffold.source import Location

_RUNS = frozenset({"init", "spin", "spin_once", "spin_until_future_complete"})
_RUNS |= {"shutdown", "try_shutdown"}
_EXECUTORS = frozenset(
    f"rclpy.executors.{kind}Executor" for kind in ("SingleThreaded", "MultiThreaded")
) | {"rclpy.experimental.EventsExecutor"}

_MAX_CALLS = 20


class RclpyCall(NamedTuple):
    """A call that starts, runs or ends rclpy."""

    name: str
    """``init``, ``spin``, ``spin_once``, ``spin_until_future_complete``, ``shutdown``,
    ``try_shutdown``; the methods of an executor have ``executor.`` in front."""
    call: ast.Call
    location: Location
    function: FunctionNode | None
    handlers: frozenset[str]
    """Full names of the exceptions caught around it in the same function."""
    in_finally: bool
    asks_ok: bool
    """Whether it is under ``if rclpy.ok():``."""
    in_with: bool
    """Whether it is, or is inside of, ``with rclpy.init() ...:``."""
    outer_handlers: frozenset[str] = frozenset()
    """The exceptions caught around all calls of its function in the file."""

    @property
    def catches_keyboard_interrupt(self) -> bool:
        """Whether Ctrl-C does not end in a traceback."""
        return not self.handlers.isdisjoint({"KeyboardInterrupt", "BaseException"})


def rclpy_calls(evaluator: NodeEvaluator) -> Iterator[RclpyCall]:
    """Yield the calls that start, run or end rclpy, in the order of the text."""
    outside: _Outside | None = None
    for call in evaluator.module.walk(ast.Call):
        name = _run_name(evaluator, call)
        if name is not None:
            outside = outside or _Outside(evaluator)
            yield _rclpy_call(evaluator, call, name, outside)


def _run_name(evaluator: NodeEvaluator, call: ast.Call) -> str | None:
    for name in evaluator.module.qualified_names(call.func):
        root, _, function = name.rpartition(".")
        if function in _RUNS and root in {"rclpy", "rclpy.utilities"}:
            return function
    func = call.func
    if (
        isinstance(func, ast.Attribute)
        and func.attr in _RUNS
        and _is_executor(evaluator, func.value)
    ):
        return f"executor.{func.attr}"
    return None


def _is_executor(evaluator: NodeEvaluator, node: ast.expr) -> bool:
    value = evaluator.single_value(node)
    if not isinstance(value, ast.Call):
        return False
    return not _EXECUTORS.isdisjoint(evaluator.module.qualified_names(value.func))


def _rclpy_call(
    evaluator: NodeEvaluator, call: ast.Call, name: str, outside: _Outside
) -> RclpyCall:
    in_finally = asks_ok = in_with = False
    child: ast.AST = call
    for parent in evaluator.module.parents(call):
        match parent:
            case ast.FunctionDef() | ast.AsyncFunctionDef() | ast.Lambda():
                break
            case ast.Try() if evaluator.module.index.place(child)[0] == "finalbody":
                in_finally = True
            case ast.If(test=test):
                asks_ok = asks_ok or _asks_ok(evaluator, test)
            case ast.With(items=items):
                in_with = in_with or any(_enters_init(evaluator, item) for item in items)
        child = parent
    return RclpyCall(
        name,
        call,
        evaluator.module.location(call),
        evaluator.module.enclosing_function(call),
        frozenset(_handlers_around(evaluator, call)),
        in_finally,
        asks_ok,
        in_with,
        outside.around(call),
    )


def _handlers_around(evaluator: NodeEvaluator, node: ast.AST) -> set[str]:
    """Return the exceptions caught around a node in its function."""
    handlers: set[str] = set()
    child = node
    for parent in evaluator.module.parents(node):
        match parent:
            case ast.FunctionDef() | ast.AsyncFunctionDef() | ast.Lambda():
                break
            case ast.Try() if evaluator.module.index.place(child)[0] == "body":
                handlers.update(_caught(evaluator, parent))
            case ast.With(items=items):
                handlers.update(*(_suppressed(evaluator, item) for item in items))
        child = parent
    return handlers


class _Outside:
    """The exceptions caught around all calls of the functions of a file."""

    def __init__(self, evaluator: NodeEvaluator) -> None:
        self._evaluator = evaluator
        self._catches: dict[FunctionNode, frozenset[str]] = {}
        self._depth = 0
        self._calls: dict[str, list[ast.Name]] = {}
        for call in evaluator.module.walk(ast.Call):
            if isinstance(call.func, ast.Name):
                self._calls.setdefault(call.func.id, []).append(call.func)

    def around(self, node: ast.AST) -> frozenset[str]:
        """Return the exceptions caught around all calls of a node's function."""
        function = self._evaluator.module.enclosing_function(node)
        if function is None or self._depth > _MAX_CALLS:
            return frozenset()
        if function not in self._catches:
            self._catches[function] = frozenset()  # recursive calls are ignored
            self._depth += 1
            caught = [
                self.around(name) | _handlers_around(self._evaluator, name)
                for name in self._calls.get(function.name, ())
                if self._is_name_of(name, function)
            ]
            self._depth -= 1
            self._catches[function] = frozenset.intersection(*caught) if caught else frozenset()
        return self._catches[function]

    def _is_name_of(self, name: ast.Name, function: FunctionNode) -> bool:
        bindings = self._evaluator.module.index.bindings_of(name)
        return any(binding.node is function for binding in bindings)


def _caught(evaluator: NodeEvaluator, node: ast.Try) -> Iterator[str]:
    for handler in node.handlers:
        if handler.type is None:
            yield "BaseException"
        else:
            yield from _exceptions(evaluator, handler.type)


def _exceptions(evaluator: NodeEvaluator, node: ast.expr) -> Iterator[str]:
    node = evaluator.single_value(node)
    if isinstance(node, ast.Tuple):
        for item in node.elts:
            yield from _exceptions(evaluator, item)
    else:
        yield from evaluator.module.qualified_names(node)


def _suppressed(evaluator: NodeEvaluator, item: ast.withitem) -> Iterator[str]:
    call = item.context_expr
    if not isinstance(call, ast.Call):
        return
    if evaluator.module.qualified_name(call.func) == "contextlib.suppress":
        for arg in call.args:
            yield from _exceptions(evaluator, arg)


def _enters_init(evaluator: NodeEvaluator, item: ast.withitem) -> bool:
    call = item.context_expr
    return isinstance(call, ast.Call) and evaluator.module.qualified_name(call.func) == "rclpy.init"


def _asks_ok(evaluator: NodeEvaluator, test: ast.expr) -> bool:
    return any(
        isinstance(node, ast.Call) and evaluator.module.qualified_name(node.func) == "rclpy.ok"
        for node in ast.walk(test)
    )
