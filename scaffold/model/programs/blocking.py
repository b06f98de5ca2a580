"""Calls that block on work that only the blocked thread could do."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

from scaffold.model.package import mentions
from scaffold.model.programs.entry_points import (
    Execution,
    entry_points_of,
    execution_of,
    imported_files,
)
from scaffold.model.programs.threads import (
    blocks_others,
    names_callback_group,
    names_other_executor,
    spins_elsewhere,
    spins_in_one_thread,
)
from scaffold.model.python.evaluation.returns import may_end
from scaffold.model.rclpy.entities import (
    ActionClient,
    ActionServer,
    Client,
    Service,
    Subscription,
    Synchronizer,
    Timer,
)
from scaffold.model.rclpy.nodes import NodeClass
from scaffold.model.remembered import remembered
from scaffold.record import NamedTuple
from scaffold.source import Location, ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package
    from scaffold.model.python.scopes import FunctionNode
    from scaffold.model.rclpy.entities import Callback, Entity
    from scaffold.model.rclpy.file import RclpyFile


class Executed(NamedTuple):
    """A function called by a callback or a constructor of a node."""

    function: FunctionNode | ast.Lambda
    origin: str
    """The caller: ``the callback on_timer``, ``the constructor of Talker``."""
    entity: Entity | None
    """The entity of the callback; ``None`` for a constructor."""

    @property
    def is_task(self) -> bool:
        """Whether it belongs to no callback group, so that it runs in parallel to all others."""
        return isinstance(self.entity, ActionServer | ActionClient | Client)


def may_run_meanwhile(file: RclpyFile, executed: Executed) -> bool:
    """Return whether callbacks of a node may run in parallel to its callback or constructor."""
    if executed.is_task:
        return not spins_in_one_thread(file)
    if names_other_executor(file):
        return True
    return names_callback_group(file) if executed.entity else spins_elsewhere(file)


def blocks_node(file: RclpyFile, executed: Executed) -> bool:
    """Return whether no other callback of a node runs during its callback or constructor."""
    if executed.is_task:
        return spins_in_one_thread(file)
    if executed.entity is None:
        return not spins_elsewhere(file)
    return blocks_others(file, executed.entity)


@remembered
def in_callbacks(file: RclpyFile) -> Sequence[Executed]:
    """Return the functions called by callbacks of timers, topics and services, each once."""
    called = _callbacks_of(file, (Timer, Subscription, Synchronizer, Service))
    return tuple(_reached(file, called, set()))


@remembered
def in_tasks(file: RclpyFile) -> Sequence[Executed]:
    """Return the functions that execute goals, or are called when a future is done, each once.

    The executor runs them as tasks, which belong to no callback group.
    """
    seen: set[ast.AST] = set()
    return (
        *_reached(file, _callbacks_of(file, (ActionServer,)), seen),
        *_reached(file, _done_callbacks(file), seen),
    )


def _callbacks_of(
    file: RclpyFile, kinds: tuple[type[Entity], ...]
) -> Iterator[tuple[Entity, Callback]]:
    return ((entity, callback) for entity, callback in file.callbacks if isinstance(entity, kinds))


def _done_callbacks(file: RclpyFile) -> Iterator[tuple[Entity, Callback]]:
    """Yield the done callbacks of futures, with the clients."""
    for call, method in file.module.method_calls("add_done_callback"):
        client = client_of(file, method.value) if len(call.args) == 1 else None
        if client is not None:
            yield client, file.callback(call.args[0])


def client_of(file: RclpyFile, future: ast.expr) -> Entity | None:
    """Return the client of a future; ``None`` if unknown."""
    match file.evaluator.single_value(future):
        case ast.Call(func=ast.Attribute(attr="get_result_async" | "cancel_goal_async")):
            return file.action_clients[0] if len(file.action_clients) == 1 else None
        case ast.Call(func=ast.Attribute(value=client)):
            return client_at(file, client)
    return None


def client_at(file: RclpyFile, node: ast.expr) -> Entity | None:
    """Return the client that an expression refers to; ``None`` if unknown."""
    made = file.evaluator.single_value(node)
    return next((x for x in (*file.clients, *file.action_clients) if x.call is made), None)


def _reached(
    file: RclpyFile, called: Iterable[tuple[Entity, Callback]], seen: set[ast.AST]
) -> Iterator[Executed]:
    """Yield callbacks and the functions they call, without those seen before."""
    for entity, callback in called:
        for function in file.reached(callback.function, seen) if callback.function else ():
            seen.add(function)
            if not isinstance(function, ast.AsyncFunctionDef):
                name = callback.name
                origin = f"callback {name!r}" if name else "a callback"
                yield Executed(function, origin, entity)


@remembered
def in_constructors(file: RclpyFile) -> Sequence[Executed]:
    """Return the functions called by constructors of nodes, each once."""
    result: list[Executed] = []
    seen: set[ast.AST] = set()
    for node in file.classes:
        for reached in file.reached(node.constructor, seen) if node.constructor else ():
            seen.add(reached)
            result.append(Executed(reached, f"the constructor of {node.name}", None))
    return result


@remembered
def in_helpers(file: RclpyFile) -> Sequence[Executed]:
    """Return the functions run by constructors of classes that get a node, each once.

    Whether the node is spun meanwhile is not known.
    """
    return tuple(_find_in_helpers(file))


def _find_in_helpers(file: RclpyFile) -> Iterator[Executed]:
    seen: set[ast.AST] = set()
    for name, class_ in file.module.classes.items():
        bindings = file.module.index.bindings(class_.node).get("__init__", ())
        constructor = bindings[0].node if len(bindings) == 1 else None
        if class_.node.bases or not isinstance(constructor, ast.FunctionDef):
            continue
        if any(argument.arg.rpartition("_")[2] == "node" for argument in constructor.args.args):
            for reached in file.reached(constructor, seen):
                seen.add(reached)
                yield Executed(reached, f"the constructor of {name}", None)


class Phases(NamedTuple):
    """The functions of a file by phase; a function may be in both."""

    constructing: frozenset[ast.AST]
    """Functions run during the construction of nodes."""
    running: frozenset[ast.AST]
    """Run by callbacks."""


def phases_of(file: RclpyFile) -> Phases:
    """Return the functions run by constructors of nodes, and those run by callbacks."""
    callbacks = (*in_callbacks(file), *in_tasks(file))
    return Phases(
        frozenset(executed.function for executed in (*in_constructors(file), *in_helpers(file))),
        frozenset(executed.function for executed in callbacks),
    )


_BLOCKED = "is blocked in this call"


class _Wait(NamedTuple):
    call: ast.Call
    where: str
    in_callback: bool


Waits = tuple[tuple[Location, str], ...]
"""Calls that wait for a callback in the only thread that could run it.

With the state of the thread: ``is blocked in this call``, ``is in callback 'tick'``."""


def waits_alone(
    package: Package, method: str, waits_of: Callable[[Package, str, str | None], Waits]
) -> Iterator[tuple[Location, str]]:
    """Yield the calls of a method that block forever in programs, each once.

    Args:
        package: The package.
        method: The name of the method.
        waits_of: A fact: the result of `waits_in` for a program.
    """
    seen: set[Location] = set()
    for start in entry_points_of(package):
        try:
            if not mentions(package, start.path, method):
                continue
            waits = waits_of(package, start.path, start.function)
        except ViewError:
            continue
        for at, where in waits:
            if at not in seen:
                seen.add(at)
                yield at, where


def waits_in(
    package: Package,
    program: tuple[str, str | None],
    method: str,
    is_wait: Callable[[RclpyFile, ast.Call], bool],
) -> Waits:
    """Return the calls of a method that block forever in a program.

    Args:
        package: The package.
        program: The file and the entry function; raises ViewError if it cannot be parsed.
        method: The name of the method.
        is_wait: Tells whether a call with that name blocks.
    """
    run = execution_of(package, *program)
    module = run.file.module
    if module.in_tests:
        return ()
    waits = [wait for wait in _waits(run, method) if is_wait(run.file, wait.call)]
    files = imported_files(package, module.path) if waits else ()
    if any(map(_has_threads, files)) and any(map(_spins_step_by_step, files)):
        return ()
    return tuple(
        (module.location(wait.call), wait.where)
        for wait in waits
        if not any(_may_end(file, wait) for file in files)
    )


def _waits(run: Execution, method: str) -> Iterator[_Wait]:
    """Yield the calls of a method in the main thread, directly or in a callback."""
    file = run.file
    calls = [file.module.parent(node) for node in file.module.index.attributes(method)]
    places = _places(run) if calls else {}
    for call in calls:
        if isinstance(call, ast.Call):
            where = places.get(file.function_of(call) or file.module)
            is_reached = where is not None or call in run.calls
            if is_reached and not _is_after_loop(file, call):
                yield _Wait(call, where or _BLOCKED, where not in {None, _BLOCKED})


def _is_after_loop(file: RclpyFile, call: ast.Call) -> bool:
    """Return whether a function called before loops until rclpy is shut down; none waits then."""
    function = file.module.enclosing_function(call)
    calls = file.module.below(function, ast.Call) if function is not None else ()
    return any(
        isinstance(other.func, ast.Attribute | ast.Name)
        and other.lineno < call.lineno
        and _never_ends(file, other.func)
        for other in calls
    )


def _never_ends(file: RclpyFile, func: ast.Attribute | ast.Name) -> bool:
    name = func.attr if isinstance(func, ast.Attribute) else func.id
    functions = [node for node in file.module.walk(ast.FunctionDef) if node.name == name]
    if len(functions) != 1 or may_end(functions[0]):
        return False
    return not any(file.module.below(functions[0], ast.Return, ast.Raise))


def _places(run: Execution) -> dict[object, str]:
    """Return the functions run by the main thread, with its state in them."""
    file = run.file
    functions: list[object] = [*run.functions]
    classes: set[ast.ClassDef] = set()
    for _, owner in run.nodes():
        if isinstance(owner, NodeClass) and owner.file is file:
            classes.update(file.related_classes(owner.node))
            functions += file.reached(owner.constructor) if owner.constructor else ()
    places = dict.fromkeys(functions, _BLOCKED)
    for executed in in_callbacks(file):
        class_ = file.module.enclosing_class(executed.function)
        if class_ is None or class_ in classes:
            places.setdefault(executed.function, f"is in {executed.origin}")
    return places


def _spins_step_by_step(file: RclpyFile) -> bool:
    return any(call.name.rpartition(".")[2] != "spin" for call in file.spin_calls)


def _has_threads(file: RclpyFile) -> bool:
    """Return whether a file may run code in other threads, or in tasks."""
    return file.module.mentions("hread", "oncurrent", "xecutor(", "rocess(", "asyncio", "trio")


def _may_end(file: RclpyFile, wait: _Wait) -> bool:
    """Return whether a file may have code that ends a wait."""
    return spins_elsewhere(file) or (wait.in_callback and names_other_executor(file))
