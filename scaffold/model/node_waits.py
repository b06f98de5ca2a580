"""Which code runs inside of callbacks and constructors, where nothing may block."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from typing import TYPE_CHECKING

from scaffold.model.node_entities import Service, Subscription, Timer
from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from scaffold.model.nodes import NodeFacts
    from scaffold.model.scopes import FunctionNode


class Executed(NamedTuple):
    """A function that a callback or a constructor of a node runs."""

    function: FunctionNode | ast.Lambda
    origin: str
    """What runs it: ``the callback on_timer``, ``the constructor of Talker``."""


def has_more_threads(facts: NodeFacts) -> bool:
    """Tell whether a file names what may run callbacks in another thread."""
    text = facts.module.source.text
    return any(word in text for word in ("MultiThreaded", "Thread(", "threading", "CallbackGroup"))


def in_callbacks(facts: NodeFacts) -> Iterator[Executed]:
    """Yield the functions that callbacks of timers, topics and services run, each once."""
    seen: set[ast.AST] = set()
    for entity, callback in facts.callbacks:
        function = callback.function
        if function is None or not isinstance(entity, Timer | Subscription | Service):
            continue
        for reached in facts.reached(function, seen):
            seen.add(reached)
            if not isinstance(reached, ast.AsyncFunctionDef):
                name = callback.name
                yield Executed(reached, f"the callback {name}" if name else "a callback")


def in_constructors(facts: NodeFacts) -> Iterator[Executed]:
    """Yield the functions that constructors of nodes run, each once."""
    seen: set[ast.AST] = set()
    for node in facts.classes:
        for reached in facts.reached(node.constructor, seen) if node.constructor else ():
            seen.add(reached)
            yield Executed(reached, f"the constructor of {node.name}")
