"""LF047: lists of actions are lists, and functions and commands fit what launch does with them."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule
from scaffold.model.launch_py import NODES, LaunchCall, LaunchFile
from scaffold.model.returns import returned

_ACTIONS = frozenset(
    {*NODES, "DeclareLaunchArgument", "ExecuteProcess", "GroupAction", "IncludeLaunchDescription"}
    | {"LogInfo", "OpaqueFunction", "RegisterEventHandler", "TimerAction"}
)
_LAUNCH = (
    "from launch import LaunchDescription\n"
    "from launch.actions import GroupAction, OpaqueFunction\n"
    "from launch.substitutions import Command\nfrom launch_ros.actions import Node\n\n\n"
    "def set_up({}):\n"
    "    return {}\n\n\n"
    "def generate_launch_description():\n"
    "    text = Command({})\n"
    "    node = Node(package='talker', executable='node', parameters=[{{'text': text}}])\n"
    "    return LaunchDescription([OpaqueFunction(function=set_up), {}])\n"
)
_FUNCTION = ("context", "[Node(package='a', executable='b')]")
_RIGHT = ("['xacro ', 'a.urdf']", "GroupAction([node])")


class ActionMadeWrongly(Rule):
    """A list of actions, a function or a command is not what launch makes of it.

    **Why.** ``ros2 launch`` stops: ``TypeError: 'Node' object is not iterable`` without the list,
    ``'Node' object is not callable`` where a comma is missing between two actions, ``takes 0
    positional arguments but 1 was given``; parts of a command are joined as they are, so that
    ``xacro`` and its file become one word.

    **Fix.** ``actions=[...]``; a function that takes the context and returns a list; a space at
    the end of ``'xacro '``.

    **Source.** ``launch/actions/opaque_function.py``, ``group_action.py``, ``timer_action.py``,
    ``launch/substitutions/command.py``.
    """

    code = "LF047"
    name = "action-made-wrongly"
    examples = (
        Example("right", {"launch/a.launch.py": _LAUNCH.format(*_FUNCTION, *_RIGHT)}),
        Example(
            "no context, one action, no space, no list",
            {
                "launch/a.launch.py": _LAUNCH.format(
                    "", "Node(package='a', executable='b')", "['xacro', 'a']", "GroupAction(node)"
                )
            },
            at=(*(f"launch/a.launch.py:{line}" for line in (8, 12, 14, 14)),),
        ),
        Example(
            "a missing comma",
            {
                "launch/a.launch.py": _LAUNCH.format(
                    *_FUNCTION, _RIGHT[0], "Node(package='a', executable='b')(node)"
                )
            },
            at=("launch/a.launch.py:14",),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for launch in LaunchFile.of_package(package):
            for call in launch.calls:
                if call.kind in _ACTIONS:
                    yield from self._check_action(launch, call)
                elif call.kind == "Command" and call.call.args:
                    problem = _glued(call.call.args[0])
                    if problem:
                        yield self.report(call, problem)

    def _check_action(self, launch: LaunchFile, call: LaunchCall) -> Iterator[Diagnostic]:
        parent = launch.module.parent(call.call)
        if isinstance(parent, ast.Call) and parent.func is call.call:
            yield self.report(call, f"a {call.kind} is called: a comma is missing behind it")
        if call.kind in {"GroupAction", "TimerAction"}:
            name = "GroupAction" if call.call.args and call.kind == "GroupAction" else ""
            actions = call.call.args[0] if name else call.given.get("actions")
            found = launch.call_of(actions)
            if actions is not None and found is not None and found.kind in _ACTIONS:
                yield self.report(launch.location(actions), f"one {found.kind}: write a list of it")
        elif call.kind == "OpaqueFunction":
            given = call.given.get("function")
            function = (
                launch.module.functions.get(given.id) if isinstance(given, ast.Name) else None
            )
            if function is None or given is None or function.node.decorator_list:
                return
            arguments = function.node.args
            if not arguments.args and not arguments.posonlyargs and arguments.vararg is None:
                message = f"{function.name} takes no arguments; it is given the context: TypeError"
                yield self.report(launch.location(given), message)
            for statement in returned(function.node):
                found = launch.call_of(statement.value)
                if found is not None and found.kind in _ACTIONS:
                    message = f"{function.name} returns one {found.kind}, not a list: TypeError"
                    yield self.report(launch.location(statement), message)


def _glued(node: ast.expr) -> str:
    """Return what is wrong about a command whose first word runs into the next part."""
    if not isinstance(node, ast.List) or len(node.elts) < 2:  # noqa: PLR2004  word and argument
        return ""
    match node.elts[0], node.elts[1]:
        case ast.Constant(value="xacro"), ast.Constant(value=str(second)) if second[:1] == " ":
            return ""
        case ast.Constant(value="xacro"), _:
            return "parts of a command are joined without spaces: write 'xacro '"
    return ""
