"""The order in which a launch file executes actions, and the values they read."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

from scaffold.api.launch import NODES, LaunchCall, LaunchFile, function_of

if TYPE_CHECKING:
    from scaffold.api.python import FunctionNode

_AT_ONCE = (
    *NODES,
    *("DeclareLaunchArgument", "ExecuteProcess", "IncludeLaunchDescription", "LogInfo"),
    *("PushRosNamespace", "SetEnvironmentVariable", "SetParameter", "SetRemap"),
)
"""Actions that read their values when they are executed."""
_HARMLESS = ("RegisterEventHandler", "TimerAction")
"""Actions without effects of their own."""
_MAY_SET = ("IncludeLaunchDescription", "OpaqueFunction")
"""Actions after which any configuration may be set."""
_MAX_DEPTH = 6


class Step(NamedTuple):
    """An action of the list, in the order of execution."""

    action: LaunchCall
    reads: tuple[LaunchCall, ...]
    """The launch configurations that it reads when executed."""


def steps(launch: LaunchFile) -> list[Step] | None:
    """Return the actions of the only LaunchDescription, up to one that may set anything.

    Returns:
        ``None`` if the order is unknown: several descriptions, or actions added in
        loops and branches.
    """
    descriptions = launch.find("LaunchDescription")
    function = launch.function
    if len(descriptions) != 1 or function is None:
        return None
    nodes = _items(launch, descriptions[0], function.node)
    return None if nodes is None else [_step(launch, call) for call in _calls(launch, nodes)]


def _calls(launch: LaunchFile, nodes: list[ast.expr]) -> Iterator[LaunchCall]:
    """Yield the actions up to an unknown one, or one that may set configurations."""
    for node in nodes:
        call = launch.call_of(node)
        if call is None or call.kind not in (*_AT_ONCE, *_HARMLESS, *_MAY_SET):
            return
        yield call
        if call.kind in _MAY_SET:
            return


def later_declarations(launch: LaunchFile, steps: list[Step]) -> dict[str, int]:
    """Return the positions of the declarations by name, if all are known."""
    result: dict[str, int] = {}
    places = {step.action.call: index for index, step in enumerate(steps)}
    for name, call in launch.declared.items():
        if "condition" not in call.given:
            result[name] = places.get(call.call, len(steps))
    return result


def _items(
    launch: LaunchFile, description: LaunchCall, function: FunctionNode
) -> list[ast.expr] | None:
    listed = description.given.get("initial_entities")
    if listed is not None and not isinstance(listed, ast.List):
        return None
    items = list(listed.elts) if listed is not None else []
    holder = launch.module.parent(description.call)
    if isinstance(holder, ast.Return):
        return items
    if not isinstance(holder, ast.Assign) or not isinstance(holder.targets[0], ast.Name):
        return None
    added = [
        (call, item)
        for call, _ in launch.module.method_calls("add_action", "add_entity")
        for item in call.args[:1]
    ]
    for call, item in added:
        statement = launch.module.parent(call)
        if statement is None or launch.module.parent(statement) is not function:
            return None
        items.append(item)
    return items


def _step(launch: LaunchFile, call: LaunchCall) -> Step:
    if call.kind in _HARMLESS:
        return Step(call, ())
    if call.kind == "OpaqueFunction":
        return Step(call, tuple(_performed(launch, call)) if "condition" not in call.given else ())
    parts = [call.given["condition"]] if "condition" in call.given else list(call.given.values())
    read = [item for part in parts for item in _configurations_in(launch, part, 0)]
    return Step(call, tuple(read))


def _performed(launch: LaunchFile, call: LaunchCall) -> Iterator[LaunchCall]:
    """Yield the configurations that a function always reads."""
    function = function_of(launch, call.given.get("function"))
    for statement in function.body if function is not None else ():
        if not isinstance(statement, ast.Assign | ast.Expr):
            return
        if isinstance(statement, ast.Assign) and isinstance(statement.targets[0], ast.Subscript):
            return  # it may set a configuration
        match statement.value:
            case ast.Call(func=ast.Attribute(value=holder, attr="perform")):
                yield from _configurations_in(launch, holder, 0)


def _configurations_in(launch: LaunchFile, node: ast.expr, depth: int) -> Iterator[LaunchCall]:
    """Yield the launch configurations without a default in an expression, through names."""
    for part in ast.walk(node):
        if isinstance(part, ast.Call):
            call = launch.call_of(part)
            is_read = call is not None and call.kind == "LaunchConfiguration"
            if is_read and call is not None and "default" not in call.given and not call.is_open:
                yield call
        elif isinstance(part, ast.Name) and depth < _MAX_DEPTH:
            value = launch.module.index.only_value(part)
            if value is not None:
                yield from _configurations_in(launch, value, depth + 1)
