"""The threads that may run callbacks, and mutually exclusive callbacks."""

from __future__ import annotations

import ast
import sys
from collections.abc import Iterator
from typing import TYPE_CHECKING

from scaffold.model.rclpy.nodes import NodeClass
from scaffold.model.remembered import remembered

if TYPE_CHECKING:
    from scaffold.model.python.scopes import FunctionNode
    from scaffold.model.rclpy.entities import Entity
    from scaffold.model.rclpy.file import RclpyFile
    from scaffold.model.rclpy.nodes import NodeDefinition

_GROUPS = "rclpy.callback_groups."
_INTERFACES = frozenset({"msg", "srv", "action"})
_NO_SPINNERS = frozenset({"SingleThreadedExecutor", "ThreadPoolExecutor", "ProcessPoolExecutor"})
_SPINNING = ("thread", "concurrent", "process", "async", "pool", "event", "group", "spin", "scope")
"""Words in the names of libraries that may spin nodes."""


@remembered
def names_other_executor(file: RclpyFile) -> bool:
    """Return whether a file mentions a multithreaded executor."""
    return any(
        name.endswith("Executor") and name not in _NO_SPINNERS for name, _ in _identifiers(file)
    )


def spins_in_one_thread(file: RclpyFile) -> bool:
    """Return whether a file spins its nodes, and runs one callback at a time."""
    if not file.spin_calls or not names_other_executor(file):
        return bool(file.spin_calls)
    # An executor that is not spun does not matter.
    return all(
        call.name == "spin" and len(call.call.args) == 1 and not call.call.keywords
        for call in file.spin_calls
    ) and not spins_elsewhere(file)


def names_callback_group(file: RclpyFile) -> bool:
    """Return whether a file mentions a callback group."""
    return file.module.mentions("CallbackGroup", "callback_group")


@remembered
def spins_elsewhere(file: RclpyFile) -> bool:
    """Return whether a file may spin a node other than with a plain call.

    A thread may spin it, or code in another file. A thread that does not spin is of no
    help to a call that waits for a callback.
    """
    spins = {call.call.func for call in file.spin_calls}
    for name, node in _identifiers(file):
        if "spin" in name.lower() and node not in spins and _may_refer_to_spin(file, name, node):
            return True
    spinning = {file.function_of(call.call) for call in file.spin_calls}
    seen: set[ast.AST] = set()
    for function in _run_by_others(file):
        seen.update(file.reached(function, seen))
    return not spinning.isdisjoint(seen) or _imports_spinner(file)


def share_group(file: RclpyFile, first: Entity, second: Entity) -> bool | None:
    """Return whether callbacks of two entities are mutually exclusive; ``None`` if unknown."""
    groups = _group_of(file, first), _group_of(file, second)
    if None in groups:
        return None
    return groups[0] == groups[1] and groups[0] != "reentrant"


def blocks_others(file: RclpyFile, entity: Entity) -> bool:
    """Return whether a callback of an entity certainly blocks other callbacks of the node.

    They do if one thread runs them all, whatever their groups. With several threads, those of the
    same group wait; that is all of the node unless the code says otherwise.
    """
    group = _group_of(file, entity)
    if spins_in_one_thread(file):
        return True
    if group is None or group == "reentrant":
        return not names_other_executor(file) and not names_callback_group(file)
    others = {other for other, _ in file.callbacks if other.owner is entity.owner} - {entity}
    if group is entity.owner and not names_other_executor(file):
        return True
    return any(_group_of(file, other) == group for other in others)


def _group_of(file: RclpyFile, entity: Entity) -> object:
    """Return an identifier of the callback group of an entity; ``None`` if unknown."""
    if entity.has_unknown_arguments or entity.owner is None:
        return None
    argument = entity.argument("callback_group")
    if argument is None or argument.value is None:
        return entity.owner if _has_default_group(entity.owner) else None
    made = file.evaluator.single_value(argument.node)
    if not isinstance(made, ast.Call):
        return None
    names = file.module.qualified_names(made.func)
    if f"{_GROUPS}ReentrantCallbackGroup" in names:
        return "reentrant"
    return made if f"{_GROUPS}MutuallyExclusiveCallbackGroup" in names else None


def _has_default_group(owner: NodeDefinition) -> bool:
    """Return whether a node has rclpy's own default group, which runs one callback at a time."""
    node = owner
    while True:
        if node.file.module.mentions("default_callback_group"):
            return False
        if not isinstance(node, NodeClass):
            return True
        if len(node.node.bases) != 1 or node.node.keywords or node.node.decorator_list:
            return False
        if node.base is None:
            return True
        node = node.base


def _identifiers(file: RclpyFile) -> Iterator[tuple[str, ast.AST]]:
    for name in file.module.walk(ast.Name):
        if isinstance(name.ctx, ast.Load):
            yield name.id, name
    for attribute in file.module.walk(ast.Attribute):
        if isinstance(attribute.ctx, ast.Load):
            yield attribute.attr, attribute
    for word in file.module.walk(ast.keyword):
        if word.arg:
            yield word.arg, word


def _may_refer_to_spin(file: RclpyFile, name: str, node: ast.AST) -> bool:
    """Return whether an identifier with "spin" may refer to a function that spins."""
    match node:
        case ast.keyword(value=ast.Constant(value=value)):
            return bool(value)
        case ast.keyword():
            return True
        case ast.Attribute() if file.evaluator.stores(name):
            return False
        case ast.Name():
            bound = file.module.index.lookup(name, node)
            if bound and all(x.kind in {"assignment", "augmented", "loop"} for x in bound[1]):
                return False
    is_called = file.module.call_with(node) is not None
    return not (is_called and isinstance(node, ast.expr) and file.callback(node).function)


def _run_by_others(file: RclpyFile) -> Iterator[FunctionNode | ast.Lambda]:
    """Yield the functions that are passed on, decorated, or ``run`` of a thread class."""
    for function in file.module.function_nodes:
        class_ = file.module.parent(function)
        is_run = (
            function.name == "run" and isinstance(class_, ast.ClassDef) and _others(file, class_)
        )
        references: list[ast.Name | ast.Attribute] = [
            *file.module.index.names(function.name),
            *file.module.index.attributes(function.name),
        ]
        if is_run or function.decorator_list or any(_is_passed(file, x) for x in references):
            yield function
    yield from file.module.walk(ast.Lambda)


def _others(file: RclpyFile, class_: ast.ClassDef) -> list[ast.expr]:
    """Return the bases of a class that are not rclpy's Node: one may be a thread."""
    return [base for base in class_.bases if not file.is_node_class(base)]


def _is_passed(file: RclpyFile, node: ast.Name | ast.Attribute) -> bool:
    return isinstance(node.ctx, ast.Load) and file.module.call_with(node) is None


def _imports_spinner(file: RclpyFile) -> bool:
    """Return whether an imported library may spin nodes, judging by its name."""
    for item in file.module.imports:
        if item.level or item.root in sys.stdlib_module_names or item.root == "rclpy":
            continue
        if file.is_own_module(item.module) or not _INTERFACES.isdisjoint(item.module.split(".")):
            continue
        names = (item.module, *(imported.name for imported in item.names))
        if any(word in name.lower() for name in names for word in _SPINNING):
            return True
    return False
