"""Settings for nodes, such as SetParameter, after the last action that could use them."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api.launch import NODES, LaunchCall, LaunchFile

_SETTINGS = frozenset(
    {"PushRosNamespace", "SetParameter", "SetParametersFromFile", "SetRemap", "SetUseSimTime"}
)
_NEUTRAL = frozenset({"DeclareLaunchArgument", "LogInfo", "SetEnvironmentVariable"}) | _SETTINGS
"""Actions that start nothing."""
_LISTS = {"LaunchDescription": "initial_entities", "GroupAction": "actions"}


def late_settings(launch: LaunchFile) -> Iterator[LaunchCall]:
    """Yield the settings in a list that only follow nodes, and that nothing follows."""
    if launch.module.mentions("add_action", "add_entity"):
        return
    for call in launch.find(*_LISTS):
        items = call.given.get(_LISTS[call.kind])
        if isinstance(items, ast.List):
            yield from _late_in(launch, items.elts)


def _late_in(launch: LaunchFile, items: list[ast.expr]) -> Iterator[LaunchCall]:
    late: list[LaunchCall] = []
    while items:
        made = launch.call_of(items[-1])
        if made is None or made.kind not in _NEUTRAL:
            break
        late += [made] if made.kind in _SETTINGS else []
        items = items[:-1]
    if any(_starts_node(launch, item) for item in items):
        yield from reversed(late)


def _starts_node(launch: LaunchFile, item: ast.expr) -> bool:
    """Return whether an item of a list, or one of the list that it unpacks, is a node."""
    value = item.value if isinstance(item, ast.Starred) else item
    if isinstance(value, ast.Name):
        value = launch.module.index.only_value(value) or value
    parts = [value.elt] if isinstance(value, ast.ListComp) else [value]
    parts = value.elts if isinstance(value, ast.List) else parts
    calls = [launch.call_of(part) for part in parts]
    return any(made is not None and made.kind in NODES for made in calls)
