"""LF042: actions of a launch file are launched, and only once."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, LaunchRule, Report, Severity
from scaffold.api.launch import (
    FUNCTION,
    HANDLERS,
    NODES,
    Entity,
    LaunchFile,
    entities,
    is_never_used,
    is_unread,
)

from ._late_settings import late_settings

_EXECUTED = frozenset({*NODES, "IncludeLaunchDescription", "ExecuteProcess"})
_ASSIGNED = _EXECUTED | frozenset(
    {"EmitEvent", "GroupAction", "OpaqueFunction", "RegisterEventHandler", "TimerAction"}
)
_LAUNCH = (
    "from launch import LaunchDescription\n"
    "from launch_ros.actions import Node\n\n\n"
    "def generate_launch_description({}):\n"
    "    talker = Node(package='talker', executable='node')\n"
    "    description = LaunchDescription([talker])\n"
    "    {}\n"
    "    return description{}\n"
)
_RIGHT = ("", "description.add_action(Node(package='talker', executable='other'))", "")
_SET = (
    "SetParameter('use_sim_time', True)",
    "Node(package='talker', executable='node')",
)
_PROCESSES = (*NODES, "ExecuteProcess")
_LAUNCH_ONCE = (
    "from launch import LaunchDescription\nfrom launch.actions import RegisterEventHandler\n"
    "from launch.event_handlers import OnProcessExit\nfrom launch_ros.actions import Node\n"
    "\n\ndef generate_launch_description():\n"
    "    first = Node(package='talker', executable='first')\n"
    "    second = Node(package='talker', executable='second')\n"
    "    handler = OnProcessExit(target_action=first, on_exit=[second])\n"
    "    return LaunchDescription([{}RegisterEventHandler(handler)])\n"
)


class ActionNotLaunched(LaunchRule):
    """A launch file does not return an action, returns it twice, or puts a setting after the nodes.

    **Why.** An action that is not in a list is never executed, without an error, even if it is a
    ``target_action``; an action in two lists stops the launch: ``executed more than once``.
    ``SetParameter`` and ``SetRemap`` only apply to nodes that follow them. ``ros2 launch`` calls
    ``generate_launch_description`` without arguments, and ``add_action`` returns ``None``. It is a
    warning if a variable holds the action, which may be used later.

    **Fix.** Put the action in one list; take no arguments; return the LaunchDescription.

    **Source.** ``launch/launch_description.py``; ``launch/actions/execute_local.py``.
    """

    code = "LF042"
    name = "action-not-launched"
    other_severities = {
        Severity.WARNING: "a variable holds the action, or its handler is not launched either"
    }
    examples = (
        Example("complete", {"launch/a.launch.py": _LAUNCH.format(*_RIGHT)}),
        Example(
            "add_action of a class of this package",
            {
                "launch/a.launch.py": _LAUNCH.format(*_RIGHT)
                + "\n\nclass Launcher:\n    def node(self, made):\n"
                "        return self.add_action(made)\n"
            },
        ),
        Example(
            "an argument, an action that is not added",
            {
                "launch/a.launch.py": _LAUNCH.format(
                    "context", "Node(package='talker', executable='node')", ""
                )
            },
            "5:5: `ros2 launch` calls generate_launch_description without arguments: TypeError; "
            "remove the parameters",
            "8:5: Node is not in the LaunchDescription: it is never launched",
        ),
        Example(
            "a decorator that may give the arguments",
            {
                "launch/a.launch.py": _LAUNCH.format("rate", *_RIGHT[1:]).replace(
                    "\n\n\ndef",
                    "\n\nfrom .utilities import with_arguments\n\n\n@with_arguments('rate')\ndef",
                )
            },
        ),
        Example(
            "an action that only a variable holds",
            {
                "launch/a.launch.py": _LAUNCH.format(
                    "", "other = Node(package='talker', executable='node')", ""
                )
            },
            Report(
                "8:13",
                "Node is not in the LaunchDescription: it is never launched",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "settings before and after a node",
            {
                f"launch/{name}.launch.py": "from launch import LaunchDescription\n"
                "from launch_ros.actions import Node, SetParameter\n\n\n"
                "def generate_launch_description():\n    return LaunchDescription([\n"
                f"        {first},\n        {second},\n    ])\n"
                for name, first, second in (("right", *_SET), ("wrong", *_SET[::-1]))
            },
            "launch/wrong.launch.py:8:9: SetParameter comes after all nodes: none of them gets "
            "it; put it first",
        ),
        Example(
            "a list that a function does not return",
            {
                "launch/a.launch.py": "from launch import LaunchDescription\n"
                "from launch.actions import OpaqueFunction\n"
                "from launch_ros.actions import Node\n\n\n"
                "def set_up(context):\n"
                "    nodes = [\n        Node(package='talker', executable='first'),\n"
                "        Node(package='talker', executable='second'),\n    ]\n\n\n"
                "def generate_launch_description():\n"
                "    return LaunchDescription([OpaqueFunction(function=set_up)])\n"
            },
            Report(
                "7:5",
                "nodes is not in the LaunchDescription: its actions are never launched",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "an action whose variable is set again",
            {
                "launch/a.launch.py": _LAUNCH.format("", "", "").replace(
                    "    description",
                    "    talker = Node(package='talker', executable='other')\n    description",
                    1,
                )
            },
            Report(
                "6:14",
                "Node is not in the LaunchDescription: it is never launched",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "an action of a variable outside of functions",
            {
                "launch/a.launch.py": _LAUNCH.format("", "", "").replace(
                    "\n\n\n", "\n\nother = Node(package='talker', executable='other')\n\n\n"
                )
            },
            Report(
                "4:9",
                "Node is not in the LaunchDescription: it is never launched",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "an action that is disabled",
            {
                "launch/a.launch.py": _LAUNCH.format(
                    "", "other = Node(package='talker', executable='node')", ""
                ).replace("([talker])", "([\n        talker,\n        # other,\n    ])")
            },
        ),
        Example(
            "the return value of add_action",
            {"launch/a.launch.py": _LAUNCH.format("", "", ".add_action(talker)")},
            "9:5: add_action() returns None; return the LaunchDescription",
        ),
        Example("launched once", {"launch/a.launch.py": _LAUNCH_ONCE.format("first, ")}),
        Example(
            "launched again in the handler",
            {"launch/a.launch.py": _LAUNCH_ONCE.format("first, second, ")},
            "10:59: second is launched twice: here, and in the LaunchDescription",
        ),
        Example(
            "watched, but not launched",
            {"launch/a.launch.py": _LAUNCH_ONCE.format("")},
            "8:13: a handler watches first, which is not in the LaunchDescription: it is never "
            "launched",
        ),
        Example(
            "watched by a handler that is not launched either",
            {
                "launch/a.launch.py": _LAUNCH_ONCE.format("").replace(
                    "[RegisterEventHandler(handler)]", "[second]"
                )
            },
            Report(
                "8:13",
                "a handler watches first, which is not in the LaunchDescription: it is "
                "never launched",
                severity=Severity.WARNING,
            ),
            "10:59: second is launched twice: here, and in the LaunchDescription",
        ),
    )

    def check_file(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        yield from self._check_returned(launch)
        yield from self._check_once(launch)
        for setting in late_settings(launch):
            message = f"{setting.kind} comes after all nodes: none of them gets it; put it first"
            yield self.report(setting, message)

    def _check_returned(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        function = launch.function
        if function is not None and not function.node.decorator_list:
            arguments = function.node.args
            given = [*arguments.posonlyargs, *arguments.args]
            if len(given) > len(arguments.defaults):
                message = (
                    f"`ros2 launch` calls {FUNCTION} without arguments: TypeError; remove "
                    f"the parameters"
                )
                yield self.report(function, message)
        unread = dict.fromkeys(_unread_list(launch, call.call) for call in launch.calls)
        for variable in unread:
            if variable is not None:
                message = f"{variable.id} is not in the LaunchDescription: its actions are "
                message += "never launched"
                yield self.report(launch.location(variable), message, severity=Severity.WARNING)
        for call in launch.calls:
            is_dropped = isinstance(launch.module.parent(call.call), ast.Expr)
            is_dropped = is_dropped and call.kind in _EXECUTED
            if is_dropped or (call.kind in _ASSIGNED and _is_only_stored(launch, call.call)):
                yield self.report(
                    call,
                    f"{call.kind} is not in the LaunchDescription: it is never launched",
                    severity=Severity.ERROR if is_dropped else Severity.WARNING,
                )
        for statement in launch.module.walk(ast.Return):
            if function is None or (
                launch.module.enclosing_function(statement) is not function.node
            ):
                continue
            match statement.value:
                case ast.Call(func=ast.Attribute(attr="add_action" | "add_entity")):
                    message = "add_action() returns None; return the LaunchDescription"
                    yield self.report(launch.location(statement), message)

    def _check_once(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        if len(launch.find("LaunchDescription")) > 1:
            return  # each may be returned in a different case
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
                is_unused = all(is_never_used(launch, load) for load in loads)
                severity = Severity.WARNING if is_unused else None
                yield self.report(launch.location(made), message, severity=severity)


def _is_only_stored(launch: LaunchFile, node: ast.expr) -> bool:
    """Return whether an action is assigned to a variable that is not read afterwards."""
    return _unread_variable(launch, node) is not None


def _unread_list(launch: LaunchFile, call: ast.Call) -> ast.Name | None:
    """Return the variable of a list with an action, if it is not read afterwards."""
    made, holder = launch.call_of(call), launch.module.parent(call)
    if made is None or made.kind not in _EXECUTED or not isinstance(holder, ast.List):
        return None
    return _unread_variable(launch, holder)


def _unread_variable(launch: LaunchFile, node: ast.expr) -> ast.Name | None:
    """Return the variable that is set to a value and not read afterwards.

    A variable in a comment is disabled on purpose.
    """
    match launch.module.parent(node):
        case ast.Assign(targets=[ast.Name() as variable]):
            pattern = rf"#.*\b{re.escape(variable.id)}\b"
            is_disabled = re.search(pattern, launch.module.source.text)
            return variable if not is_disabled and is_unread(launch, variable) else None
    return None


def _nodes(launch: LaunchFile) -> Iterator[tuple[str, ast.Call, list[ast.Name]]]:
    """Yield the name, call and uses of nodes assigned to a variable with one value."""
    for call in launch.find(*_PROCESSES):
        holder = launch.module.parent(call.call)
        if not isinstance(holder, ast.Assign) or len(holder.targets) != 1:
            continue
        target = holder.targets[0]
        if not isinstance(target, ast.Name):
            continue
        index = launch.module.index
        uses = index.uses_of(target)
        if len(index.bindings_of(target)) != 1 or _repeats(launch, call.call):
            continue
        if len(uses) == len(index.names(target.id)):
            yield target.id, call.call, [use for use in uses if use is not target]


def _repeats(launch: LaunchFile, node: ast.expr) -> bool:
    """Return whether a statement is in a loop or a condition."""
    kinds = (ast.For, ast.While, ast.If, ast.IfExp, ast.Try, ast.Match)
    return any(isinstance(parent, kinds) for parent in launch.module.parents(node))


def _is_target(launch: LaunchFile, node: ast.expr) -> bool:
    parent = launch.module.parent(node)
    return isinstance(parent, ast.keyword) and parent.arg == "target_action"
