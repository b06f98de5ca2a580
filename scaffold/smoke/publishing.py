"""How often a node publishes, and whether it must, as far as its source says so plainly.

Only what is certain counts. A rate is given to a publisher whose every ``publish`` stands,
without a condition, in what timers of a known period call. Silence is a mistake where one of them
stands in what certainly runs, or where none of them can ever be reached.
"""

from __future__ import annotations

import ast
from collections.abc import Collection, Iterable, Iterator
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


class Reach(Enum):
    """Whether a place in the source is run."""

    ALWAYS = "always"
    PERHAPS = "perhaps"
    NEVER = "never"


def _most(found: Iterable[Reach]) -> Reach:
    """Return the most that is said of several places."""
    reached = set(found)
    order = (Reach.ALWAYS, Reach.PERHAPS)
    return next((one for one in order if one in reached), Reach.NEVER)


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
        rates = self._rates_of_calls(self._publish_calls(publisher) or (), _MAX_DEPTH)
        return sum(rates) if rates and all(rates) else None

    def sources(self, publisher: Publisher) -> int:
        """Return of how many timers and calls the rate is made up."""
        return len(self._rates_of_calls(self._publish_calls(publisher) or (), _MAX_DEPTH) or ())

    def reach(self, publisher: Publisher) -> Reach:
        """Return whether a publisher publishes at all."""
        calls = self._publish_calls(publisher)
        if calls is None:
            return Reach.PERHAPS
        return _most(self._reach_of_call(call, _MAX_DEPTH) for call in calls)

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

    def _rates_of_calls(self, calls: Iterable[ast.Call], depth: int) -> list[float] | None:
        """Return the rates that add up to how often calls are made; ``None`` if unknown."""
        total: list[float] = []
        for call in calls:
            rates = self._rates_of_call(call, depth)
            if rates is None:
                return None
            total += rates
        return total

    def _rates_of_call(self, call: ast.Call, depth: int) -> list[float] | None:
        function = self._module.enclosing_function(call)
        if function is None or self._facts.is_conditional(call):
            return None
        if self._leaving(function, call) or not depth:
            return None
        return self._rates_of_function(function, depth)

    def _rates_of_function(self, function: FunctionNode, depth: int) -> list[float] | None:
        """Return how often timers call a function, themselves or through others."""
        total: list[float] = []
        for entity, callback in self._facts.callbacks:
            if callback.function is function:
                rate = self._rate_of_timer(entity) if isinstance(entity, Timer) else None
                if rate is None:
                    return None
                total.append(rate)
        others = self._rates_of_calls(self._calls_of(function), depth - 1)
        return None if others is None else total + others

    def _rate_of_timer(self, timer: Timer) -> float | None:
        period = timer.period
        if not isinstance(period, int | float) or period <= 0 or not self._runs(timer):
            return None
        return 1 / period

    def _runs(self, timer: Timer) -> bool:
        """Tell whether a timer certainly ticks, from the start to the end."""
        if timer.is_conditional or timer.has_unknown_arguments:
            return False
        if timer.argument("clock") or timer.argument("autostart") or self._may_be_held_up(timer):
            return False
        owner = timer.owner
        if isinstance(owner, NodeClass):
            constructor = owner.constructor
            if constructor is None or timer.function not in self._facts.reached(constructor):
                return False
        parents = [self._module.parent(use) for use in self._uses(timer.call)]
        return all(isinstance(p, ast.Attribute) and p.attr not in _CHANGES for p in parents)

    def _may_be_held_up(self, timer: Timer) -> bool:
        """Tell whether a timer is in a callback group that may do anything."""
        group = timer.argument("callback_group")
        if group is None:
            return False
        made = self._facts.evaluator.single_value(group.node)
        names = self._module.qualified_names(made.func) if isinstance(made, ast.Call) else ()
        return not any(name.startswith("rclpy.callback_groups.") for name in names)

    # -- reach

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
        leaving = self._leaving(function, call)
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
        for entity, callback in self._facts.callbacks:
            if callback.function is function:
                passed += 1
                ticks = isinstance(entity, Timer) and self._runs(entity)
                reached.add(Reach.ALWAYS if ticks else Reach.PERHAPS)
        if not self._alone or self._mentions(function) > len(calls) + passed:
            reached.add(Reach.PERHAPS)
        return _most(reached)

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
