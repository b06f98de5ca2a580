"""LF050: every action of a launch file is launched, and only once."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, LaunchRule, Report
from scaffold.api.launch import HANDLERS, NODES, Entity, LaunchFile, entities

_PROCESSES = (*NODES, "ExecuteProcess")
_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch.actions import RegisterEventHandler\n"
    "from launch.event_handlers import OnProcessExit\nfrom launch_ros.actions import Node\n"
    "\n\ndef generate_launch_description():\n"
    "    first = Node(package='talker', executable='first')\n"
    "    second = Node(package='talker', executable='second')\n"
    "    handler = OnProcessExit(target_action=first, on_exit=[second])\n"
    "    return LaunchDescription([{}RegisterEventHandler(handler)])\n"
)


class ActionNotLaunchedOnce(LaunchRule):
    """A node is launched twice, or is only watched and never launched.

    **Why.** One action object is one process: ``ExecuteLocal action 'second-2': executed more than
    once`` stops the launch. A node that is named only as ``target_action`` never starts, and the
    handler never does anything, without a word.

    **Fix.** Put the node into the list, or take it out of the list that is executed later.

    **Source.** ``launch/actions/execute_local.py``.
    """

    code = "LF050"
    name = "action-not-launched-once"
    examples = (
        Example("once", {"launch/a.launch.py": _LAUNCH.format("first, ")}),
        Example(
            "again in the handler",
            {"launch/a.launch.py": _LAUNCH.format("first, second, ")},
            Report("10:59", "second is launched twice: here, and in the LaunchDescription"),
        ),
        Example(
            "watched, but not launched",
            {"launch/a.launch.py": _LAUNCH.format("")},
            Report(
                "8:13",
                "a handler watches first, which is not in the LaunchDescription: it "
                "is never launched",
            ),
        ),
    )

    def check_file(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        if len(launch.find("LaunchDescription")) > 1:
            return  # each may be returned in another case
        items: dict[ast.expr, Entity] = {item.node: item for item in entities(launch)}
        for name, made, loads in _nodes(launch):
            places = [items[load] for load in loads if load in items]
            listed = [place for place in places if place.holder == "LaunchDescription"]
            again = [*(place for place in places if place.holder in HANDLERS), *listed[1:]]
            for use in again if listed else ():
                if not _repeats(launch, use.node):
                    message = f"{name} is launched twice: here, and in the LaunchDescription"
                    yield self.report(launch.location(use.node), message)
            if loads and all(_is_target(launch, load) for load in loads):
                message = (
                    f"a handler watches {name}, which is not in the LaunchDescription: it "
                    "is never launched"
                )
                yield self.report(launch.location(made), message)


def _nodes(launch: LaunchFile) -> Iterator[tuple[str, ast.Call, list[ast.Name]]]:
    """Yield name, call and uses of the nodes that are assigned to a name of one value."""
    for call in launch.find(*_PROCESSES):
        holder = launch.module.parent(call.call)
        if not isinstance(holder, ast.Assign) or len(holder.targets) != 1:
            continue
        target = holder.targets[0]
        if not isinstance(target, ast.Name):
            continue
        lookup = launch.module.index.lookup(target.id, target)
        uses = [use for use in launch.module.index.names(target.id) if use is not target]
        if lookup is None or len(lookup[1]) != 1 or _repeats(launch, call.call):
            continue
        if all(launch.module.index.lookup(use.id, use) == lookup for use in uses):
            yield target.id, call.call, uses


def _repeats(launch: LaunchFile, node: ast.expr) -> bool:
    """Tell whether a statement may be executed several times, or not at all."""
    kinds = (ast.For, ast.While, ast.If, ast.IfExp, ast.Try, ast.Match)
    return any(isinstance(parent, kinds) for parent in launch.module.parents(node))


def _is_target(launch: LaunchFile, node: ast.expr) -> bool:
    parent = launch.module.parent(node)
    return isinstance(parent, ast.keyword) and parent.arg == "target_action"
