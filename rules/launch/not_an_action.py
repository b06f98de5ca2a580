"""LF048: lists of actions hold actions."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, LaunchRule, Report
from scaffold.api.launch import NODES, LaunchFile, describe, entities

_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch.actions import RegisterEventHandler\n"
    "from launch.event_handlers import OnProcessExit\n"
    "from launch.substitutions import LaunchConfiguration\nfrom launch_ros.actions import Node\n"
    "\n\ndef generate_launch_description():\n"
    "    name = LaunchConfiguration('name', default='a')\n"
    "    node = Node(package='talker', executable='node', name=name)\n"
    "    handler = OnProcessExit(target_action=node, on_exit=[])\n"
    "    return LaunchDescription([{}])\n"
)


_ALONE = frozenset({"this is a list", "this is a tuple", "this is a function", "this is None"})
"""What a handler takes instead of a list."""


class NotAnAction(LaunchRule):
    """A list of actions contains something else.

    **Why.** ``ros2 launch`` stops: ``'list' object has no attribute 'describe_sub_entities'``;
    the same with ``'LaunchConfiguration'``, ``'OnProcessExit'`` or ``'NoneType'``.

    **Fix.** ``*nodes`` for the items of a list; ``RegisterEventHandler(...)`` around a handler,
    ``IncludeLaunchDescription(...)`` around a source; nothing for substitutions, which belong to
    where they are used.

    **Source.** ``launch/launch_description_entity.py``; ``launch/utilities``.
    """

    code = "LF048"
    name = "not-an-action"
    examples = (
        Example(
            "actions",
            {"launch/a.launch.py": _LAUNCH.format("*[node], RegisterEventHandler(handler)")},
        ),
        Example(
            "a list, a substitution, a handler",
            {"launch/a.launch.py": _LAUNCH.format("[node],\n name,\n handler")},
            Report(
                "12:31", "this is a list, but LaunchDescription takes actions: unpack it with *"
            ),
            Report("13:2", "this is a LaunchConfiguration, but LaunchDescription takes actions"),
            Report(
                "14:2",
                "this is the handler OnProcessExit, but LaunchDescription takes "
                "actions: wrap it in RegisterEventHandler(...)",
            ),
        ),
        Example(
            "a text, a class, None",
            {"launch/a.launch.py": _LAUNCH.format("'node',\n Node,\n None")},
            Report("12:31", "this is a string, but LaunchDescription takes actions"),
            Report("13:2", "this is a class, but LaunchDescription takes actions: call it"),
            Report("14:2", "this is None, but LaunchDescription takes actions"),
        ),
        Example(
            "an event for what happens at the end of a node",
            {
                "launch/a.launch.py": "from launch.events import Shutdown\n"
                + _LAUNCH.format("node").replace("name=name", "on_exit=Shutdown()")
            },
            Report(
                "11:62",
                "this is an event, but 'on_exit' of Node takes actions: wrap it in "
                "EmitEvent(event=...)",
            ),
        ),
        Example(
            "an event, a source, a node in a container",
            {
                "launch/a.launch.py": "from launch.events import Shutdown\n"
                "from launch.launch_description_sources import AnyLaunchDescriptionSource\n"
                "from launch_ros.actions import ComposableNodeContainer\n"
                + _LAUNCH.format(
                    "Shutdown(),\n AnyLaunchDescriptionSource('a'),\n"
                    " ComposableNodeContainer(name='a', "
                    "namespace='', package='b', executable='c',\n"
                    "  composable_node_descriptions=[node])"
                )
            },
            Report(
                "15:31",
                "this is an event, but LaunchDescription takes actions: wrap it in "
                "EmitEvent(event=...)",
            ),
            Report(
                "16:2",
                "this is an AnyLaunchDescriptionSource, but LaunchDescription takes "
                "actions: wrap it in IncludeLaunchDescription(...)",
            ),
            Report("18:33", "this is a Node, but a container takes ComposableNode"),
        ),
    )

    def check_file(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        for item in entities(launch):
            what = describe(launch, item.node)
            if what and not (item.is_alone and what in _ALONE):
                message = f"{what}, but {item.taker} takes actions{_hint(what)}"
                yield self.report(launch.location(item.node), message)
        for call in launch.calls:
            listed = call.given.get("composable_node_descriptions")
            for node in listed.elts if isinstance(listed, ast.List) else ():
                view = launch.call_of(node)
                if view is not None and view.kind in NODES:
                    message = f"this is a {view.kind}, but a container takes ComposableNode"
                    yield self.report(launch.location(node), message)


def _hint(what: str) -> str:
    """Return what to write instead."""
    if what == "this is a list":
        return ": unpack it with *"
    if what == "this is an event":
        return ": wrap it in EmitEvent(event=...)"
    if "handler" in what:
        return ": wrap it in RegisterEventHandler(...)"
    if "Source" in what:
        return ": wrap it in IncludeLaunchDescription(...)"
    if "class" in what or "function" in what:
        return ": call it"
    return ""
