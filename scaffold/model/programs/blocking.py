"""Waiting for what the waiting thread itself would have to do."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from scaffold.model.programs.entry_points import Execution, files_of, run_of, starts_of
from scaffold.model.rclpy.entities import Service, Subscription, Timer
from scaffold.model.rclpy.nodes import NodeClass
from scaffold.record import NamedTuple
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package
    from scaffold.model.python.scopes import FunctionNode
    from scaffold.model.rclpy.file import RclpyFile


class Executed(NamedTuple):
    """A function that a callback or a constructor of a node runs."""

    function: FunctionNode | ast.Lambda
    origin: str
    """What runs it: ``the callback on_timer``, ``the constructor of Talker``."""


def has_more_threads(file: RclpyFile) -> bool:
    """Tell whether a file names what may run callbacks in another thread."""
    text = file.module.source.text
    return any(word in text for word in ("MultiThreaded", "Thread(", "threading", "CallbackGroup"))


def in_callbacks(file: RclpyFile) -> Iterator[Executed]:
    """Yield the functions that callbacks of timers, topics and services run, each once."""
    seen: set[ast.AST] = set()
    for entity, callback in file.callbacks:
        function = callback.function
        if function is None or not isinstance(entity, Timer | Subscription | Service):
            continue
        for reached in file.reached(function, seen):
            seen.add(reached)
            if not isinstance(reached, ast.AsyncFunctionDef):
                name = callback.name
                yield Executed(reached, f"callback {name!r}" if name else "a callback")


def in_constructors(file: RclpyFile) -> Iterator[Executed]:
    """Yield the functions that constructors of nodes run, each once."""
    seen: set[ast.AST] = set()
    for node in file.classes:
        for reached in file.reached(node.constructor, seen) if node.constructor else ():
            seen.add(reached)
            yield Executed(reached, f"the constructor of {node.name}")


_OTHER_THREADS = ("thread", "concurrent", "process", "asyncio", "pool", "event", "group", "spin")


class Wait(NamedTuple):
    """A call that waits for a callback, and runs in the only thread that could run it."""

    facts: RclpyFile
    call: ast.Call
    where: str
    """What the thread does: ``is blocked in this call``, ``is in callback 'tick'``."""


def waits_alone(
    package: Package, method: str, is_wait: Callable[[RclpyFile, ast.Call], bool]
) -> Iterator[Wait]:
    """Yield the calls of a method in programs where nothing else can end them, each once.

    Args:
        package: The package.
        method: The name of the method.
        is_wait: Tells whether a call of that name is one that waits.
    """
    seen: set[ast.Call] = set()
    for start in starts_of(package):
        try:
            run = run_of(package, start)
        except ViewError:
            continue
        if run.facts.module.in_tests:
            continue
        for wait in _waits(run, method):
            if wait.call in seen or not is_wait(run.facts, wait.call):
                continue
            if not any(map(_may_spin, files_of(package, start.path))):
                seen.add(wait.call)
                yield wait


def _waits(run: Execution, method: str) -> Iterator[Wait]:
    """Yield the calls of a method that the main thread makes, itself or in a callback."""
    facts = run.facts
    calls = [facts.module.parent(node) for node in facts.module.index.attributes(method)]
    places = _places(run) if calls else {}
    for call in calls:
        if isinstance(call, ast.Call):
            where = places.get(facts.function_of(call) or facts.module)
            if where is not None or call in run.calls:
                yield Wait(facts, call, where or "is blocked in this call")


def _places(run: Execution) -> dict[object, str]:
    """Return the functions that the main thread runs, with what it does in them."""
    facts = run.facts
    functions: list[object] = [*run.functions]
    classes: set[ast.ClassDef] = set()
    for _, owner in run.nodes():
        if isinstance(owner, NodeClass) and owner.facts is facts:
            classes.update(facts.related_classes(owner.node))
            functions += facts.reached(owner.constructor) if owner.constructor else ()
    places = dict.fromkeys(functions, "is blocked in this call")
    for executed in in_callbacks(facts):
        class_ = facts.module.enclosing_class(executed.function)
        if class_ is None or class_ in classes:
            places.setdefault(executed.function, f"is in {executed.origin}")
    return places


def _may_spin(file: RclpyFile) -> bool:
    """Tell whether a file may spin a node in another thread, or step by step."""
    for call in file.spin_calls:
        if call.name.rpartition(".")[2] != "spin":
            return True
    known = {call.call.func for call in file.spin_calls}
    names = [name.id for name in file.module.walk(ast.Name) if name not in known]
    names += [name.attr for name in file.module.walk(ast.Attribute) if name not in known]
    names += [word.arg for word in file.module.walk(ast.keyword) if word.arg]
    names = [name.lower() for name in names if name != "SingleThreadedExecutor"]
    if any(word in name for name in names for word in _OTHER_THREADS):
        return True
    return any(item.root in {"threading", "asyncio", "_thread"} for item in file.module.imports)
