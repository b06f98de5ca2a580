"""Whether a program ever executes the publishing calls of a publisher."""

from __future__ import annotations

import ast
from collections.abc import Collection, Iterable, Iterator
from enum import Enum

from scaffold.model.programs.publishing import publish_calls, ticks_always
from scaffold.model.python.scopes import FunctionNode
from scaffold.model.rclpy.entities import Publisher, Timer
from scaffold.model.rclpy.file import RclpyFile

_MAX_DEPTH = 5
"""The maximum number of functions between the start of a program and a publishing call."""
_CONDITIONS = (
    ast.If | ast.IfExp | ast.For | ast.AsyncFor | ast.ExceptHandler | ast.match_case | ast.Lambda
)
_COMPREHENSIONS = ast.ListComp | ast.SetComp | ast.DictComp | ast.GeneratorExp


class Reach(Enum):
    """Whether a place in the source is executed."""

    ALWAYS = "always"
    PERHAPS = "perhaps"
    NEVER = "never"


def _strongest(reaches: Iterable[Reach]) -> Reach:
    """Return the strongest reach of several places."""
    reached = set(reaches)
    order = (Reach.ALWAYS, Reach.PERHAPS)
    return next((item for item in order if item in reached), Reach.NEVER)


class PublishReach:
    """The executed publishing calls of one file.

    Args:
        file: The file.
        starts: Its functions run at the start: ``main`` and the functions it calls.
        alone: Whether no other file calls into this one.
    """

    def __init__(self, file: RclpyFile, starts: Collection[FunctionNode], *, alone: bool) -> None:
        self._file = file
        self._module = file.module
        self._starts = starts
        self._alone = alone

    def of(self, publisher: Publisher) -> Reach:
        """Return whether a publisher publishes at all."""
        calls = publish_calls(self._file, publisher)
        if calls is None:
            return Reach.PERHAPS
        return _strongest(self._reach_of_call(call, _MAX_DEPTH) for call in calls)

    def _reach_of_call(self, call: ast.Call, depth: int) -> Reach:
        for parent in self._module.parents(call):
            if isinstance(parent, ast.FunctionDef | ast.AsyncFunctionDef):
                break
            if isinstance(parent, _CONDITIONS | _COMPREHENSIONS):
                if parent is self._module.main_guard_node:
                    continue
                return Reach.PERHAPS
        function = self._module.enclosing_function(call)
        if function is None:
            return Reach.ALWAYS
        if self._is_behind_spin(function, call):
            return Reach.PERHAPS
        leaving = self._leaving_statements(function, call)
        if any(self._module.parent(node) is function for node in leaving):
            return Reach.NEVER
        return Reach.PERHAPS if leaving else self._reach_of_function(function, depth)

    def _reach_of_function(self, function: FunctionNode, depth: int) -> Reach:
        if function in self._starts or function.name == "__init__":
            return Reach.ALWAYS
        if not depth:
            return Reach.PERHAPS
        calls = list(self._calls_of(function))
        reached = {self._reach_of_call(call, depth - 1) for call in calls}
        passed = 0
        for entity, callback in self._file.callbacks:
            if callback.function is function:
                passed += 1
                ticks = isinstance(entity, Timer) and ticks_always(self._file, entity)
                reached.add(Reach.ALWAYS if ticks else Reach.PERHAPS)
        if not self._alone or self._mentions(function) > len(calls) + passed:
            reached.add(Reach.PERHAPS)
        return _strongest(reached)

    def _is_behind_spin(self, function: FunctionNode, call: ast.Call) -> bool:
        """Return whether a function spins forever before a call."""
        return any(
            spin.name.rpartition(".")[2] == "spin"
            and spin.function is function
            and spin.call.lineno < call.lineno
            for spin in self._file.spin_calls
        )

    def _mentions(self, function: FunctionNode) -> int:
        """Count all uses of the name of a function."""
        return sum(node.attr == function.name for node in self._module.walk(ast.Attribute)) + sum(
            node.id == function.name for node in self._module.walk(ast.Name)
        )

    def _calls_of(self, function: FunctionNode) -> Iterator[ast.Call]:
        for call in self._module.walk(ast.Call):
            if self._file.callback(call.func).function is function:
                yield call

    def _leaving_statements(self, function: FunctionNode, call: ast.Call) -> list[ast.AST]:
        """Return the statements that may leave a function before a call."""
        nodes: list[ast.Return | ast.Raise | ast.Yield | ast.Await] = [
            *self._module.walk(ast.Return),
            *self._module.walk(ast.Raise),
            *self._module.walk(ast.Yield),
            *self._module.walk(ast.Await),
        ]
        return [
            node
            for node in nodes
            if node.lineno <= call.lineno and self._module.enclosing_function(node) is function
        ]
