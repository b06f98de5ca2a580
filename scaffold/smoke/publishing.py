"""How often a node publishes, and whether it must, as far as its source says so plainly.

Only what is certain counts. A rate is given to a publisher whose every ``publish`` stands,
without a condition, in what timers of a known period call. Silence is a mistake where one of them
stands in what certainly runs, or where none of them can ever be reached.
"""

from __future__ import annotations

import ast
from collections.abc import Collection, Iterator
from enum import Enum

from scaffold.model.node_entities import Publisher, Timer
from scaffold.model.nodes import NodeClass, NodeFacts
from scaffold.model.scopes import FunctionNode

_MAX_DEPTH = 5
_CHANGES = frozenset({"cancel", "reset", "timer_period_ns"})
"""What makes another timer of a timer."""
_CONDITIONS = (
    ast.If | ast.IfExp | ast.For | ast.AsyncFor | ast.ExceptHandler | ast.match_case | ast.Lambda
)
_COMPREHENSIONS = ast.ListComp | ast.SetComp | ast.DictComp | ast.GeneratorExp


class _Reach(Enum):
    """Whether a place in the source is run."""

    ALWAYS = "always"
    PERHAPS = "perhaps"
    NEVER = "never"


class Publishing:
    """What the publishers of one file do.

    Args:
        facts: The file.
        starts: Its functions that run from the start, ``main`` and what that calls.
        alone: Whether no other file calls into this one.
    """

    def __init__(self, facts: NodeFacts, starts: Collection[FunctionNode], *, alone: bool) -> None:
        self._facts = facts
        self._module = facts.module
        self._starts = starts
        self._alone = alone

    def rate(self, publisher: Publisher) -> float | None:
        """Return how often a publisher publishes, in Hz; ``None`` if that cannot be told."""
        calls = self._publish_calls(publisher)
        rates = [self._rate_of_call(call, _MAX_DEPTH) for call in calls or ()]
        known = [rate for rate in rates if rate is not None]
        return sum(known) if known and len(known) == len(rates) and all(known) else None

    def is_certain(self, publisher: Publisher) -> bool:
        """Tell whether silence is a mistake."""
        calls = self._publish_calls(publisher)
        if calls is None:
            return False
        reached = {self._reach_of_call(call, _MAX_DEPTH) for call in calls}
        return _Reach.ALWAYS in reached or reached <= {_Reach.NEVER}

    def _publish_calls(self, publisher: Publisher) -> list[ast.Call] | None:
        """Return where it publishes; ``None`` when it is handed to code that is not seen."""
        found: list[ast.Call] = []
        for use in self._uses(publisher.call):
            attribute = self._module.parent(use)
            if not isinstance(attribute, ast.Attribute):
                return None
            call = self._module.parent(attribute)
            if attribute.attr == "publish":
                if not isinstance(call, ast.Call) or call.func is not attribute:
                    return None
                found.append(call)
        return found

    def _uses(self, made: ast.Call) -> Iterator[ast.expr]:
        """Yield where something that a call has made is used by the name it was given."""
        names: list[ast.Attribute | ast.Name] = [
            *self._module.walk(ast.Attribute),
            *self._module.walk(ast.Name),
        ]
        for node in names:
            is_read = isinstance(node.ctx, ast.Load)
            if is_read and self._facts.evaluator.single_value(node) is made:
                yield node

    # -- rates

    def _rate_of_call(self, call: ast.Call, depth: int) -> float | None:
        """Return how often a call is made."""
        function = self._module.enclosing_function(call)
        if function is None or self._facts.is_conditional(call):
            return None
        if self._leaving(function, call):
            return None
        return self._rate_of_function(function, depth)

    def _rate_of_function(self, function: FunctionNode, depth: int) -> float | None:
        """Return how often timers call a function, themselves or through others."""
        if not depth:
            return None
        rates: list[float | None] = [
            self._rate_of_timer(entity) if isinstance(entity, Timer) else None
            for entity, callback in self._facts.callbacks
            if callback.function is function
        ]
        rates += [self._rate_of_call(call, depth - 1) for call in self._calls_of(function)]
        known = [rate for rate in rates if rate is not None]
        return sum(known) if len(known) == len(rates) else None

    def _rate_of_timer(self, timer: Timer) -> float | None:
        period = timer.period
        if not isinstance(period, int | float) or period <= 0 or not self._runs(timer):
            return None
        return 1 / period

    def _runs(self, timer: Timer) -> bool:
        """Tell whether a timer certainly ticks, from the start to the end."""
        if timer.is_conditional or timer.has_unknown_arguments:
            return False
        if timer.argument("clock") or timer.argument("autostart"):
            return False
        owner = timer.owner
        if isinstance(owner, NodeClass):
            constructor = owner.constructor
            if constructor is None or timer.function not in self._facts.reached(constructor):
                return False
        parents = [self._module.parent(use) for use in self._uses(timer.call)]
        return all(isinstance(p, ast.Attribute) and p.attr not in _CHANGES for p in parents)

    # -- reach

    def _reach_of_call(self, call: ast.Call, depth: int) -> _Reach:
        for parent in self._module.parents(call):
            if isinstance(parent, ast.FunctionDef | ast.AsyncFunctionDef):
                break
            if isinstance(parent, _CONDITIONS | _COMPREHENSIONS):
                if parent is self._module.main_guard_node:
                    continue
                return _Reach.PERHAPS
        function = self._module.enclosing_function(call)
        if function is None:
            return _Reach.ALWAYS
        leaving = self._leaving(function, call)
        if any(self._module.parent(node) is function for node in leaving):
            return _Reach.NEVER
        return _Reach.PERHAPS if leaving else self._reach_of_function(function, depth)

    def _reach_of_function(self, function: FunctionNode, depth: int) -> _Reach:
        if function in self._starts or function.name == "__init__":
            return _Reach.ALWAYS
        if not depth:
            return _Reach.PERHAPS
        calls = list(self._calls_of(function))
        reached = {self._reach_of_call(call, depth - 1) for call in calls}
        passed = 0
        for entity, callback in self._facts.callbacks:
            if callback.function is function:
                passed += 1
                ticks = isinstance(entity, Timer) and self._runs(entity)
                reached.add(_Reach.ALWAYS if ticks else _Reach.PERHAPS)
        if not self._alone or self._mentions(function) > len(calls) + passed:
            reached.add(_Reach.PERHAPS)
        for reach in (_Reach.ALWAYS, _Reach.PERHAPS):
            if reach in reached:
                return reach
        return _Reach.NEVER

    def _mentions(self, function: FunctionNode) -> int:
        """Count where the name of a function is used in any way."""
        return sum(node.attr == function.name for node in self._module.walk(ast.Attribute)) + sum(
            node.id == function.name for node in self._module.walk(ast.Name)
        )

    # -- both

    def _calls_of(self, function: FunctionNode) -> Iterator[ast.Call]:
        for call in self._module.walk(ast.Call):
            if self._facts.callback(call.func).function is function:
                yield call

    def _leaving(self, function: FunctionNode, call: ast.Call) -> list[ast.AST]:
        """Return the statements that may leave a function before it makes a call."""
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
