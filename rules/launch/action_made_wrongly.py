"""LF047: lists of actions are lists, and the parts of commands have spaces between them."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule
from scaffold.model.launch_py import NODES, LaunchCall, LaunchFile

_ACTIONS = frozenset(
    {*NODES, "DeclareLaunchArgument", "ExecuteProcess", "GroupAction", "IncludeLaunchDescription"}
    | {"LogInfo", "OpaqueFunction", "RegisterEventHandler", "TimerAction"}
)
_SETTERS = ("PushRosNamespace", "PushROSNamespace", "SetParameter", "SetRemap")
_PROGRAMS = frozenset({"bash", "cat", "echo", "gz", "python3", "ros2", "sh", "xacro"})
_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch.actions import GroupAction\n"
    "from launch.substitutions import Command\nfrom launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n"
    "    text = Command({})\n"
    "    node = Node(package='talker', executable='node', parameters=[{{'text': text}}])\n"
    "    return LaunchDescription([{}])\n"
)
_RIGHT = ("['xacro ', 'a.urdf']", "GroupAction([node])")


class ActionMadeWrongly(Rule):
    """A list of actions or a command is not what launch makes of it.

    **Why.** ``ros2 launch`` stops: ``TypeError: 'Node' object is not iterable`` without the list,
    ``'Node' object is not callable`` where a comma is missing between two actions; parts of a
    command are joined as they are, so that ``xacro`` and its file become one word.

    **Fix.** ``actions=[...]``; a space at the end of ``'xacro '``, or ``' '`` behind
    ``FindExecutable(...)``.

    **Source.** ``launch/actions/group_action.py``, ``timer_action.py``,
    ``launch/substitutions/command.py``.
    """

    code = "LF047"
    name = "action-made-wrongly"
    examples = (
        Example("right", {"launch/a.launch.py": _LAUNCH.format(*_RIGHT)}),
        Example(
            "no space, no list",
            {"launch/a.launch.py": _LAUNCH.format("['xacro', 'a']", "GroupAction(node)")},
            at=("launch/a.launch.py:8", "launch/a.launch.py:10"),
        ),
        Example(
            "a missing comma",
            {
                "launch/a.launch.py": _LAUNCH.format(
                    _RIGHT[0], "Node(package='a', executable='b')(node)"
                )
            },
            at=("launch/a.launch.py:10",),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for launch in LaunchFile.of_package(package):
            for call in launch.calls:
                if call.kind in _ACTIONS:
                    yield from self._check_action(launch, call)
                elif call.kind == "Command" and call.call.args:
                    problem = _glued(launch, call.call.args[0])
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
            if call.kind == "GroupAction" and "scoped" not in call.given:
                last = _setting_nothing(launch, actions)
                if last is not None:
                    message = f"nothing follows this {last.kind} in the group: it has no effect"
                    yield self.report(last, message)


def _setting_nothing(launch: LaunchFile, actions: ast.expr | None) -> LaunchCall | None:
    """Return the last action of a group if it sets something for those that follow it."""
    if not isinstance(actions, ast.List) or len(actions.elts) < 2:  # noqa: PLR2004  one before it
        return None
    first, last = launch.call_of(actions.elts[0]), launch.call_of(actions.elts[-1])
    runs = first is not None and first.kind in {*NODES, "IncludeLaunchDescription"}
    return last if runs and last is not None and last.kind in _SETTERS else None


def _glued(launch: LaunchFile, node: ast.expr) -> str:
    """Return what is wrong about a command whose first word runs into the next part."""
    if not isinstance(node, ast.List) or len(node.elts) < 2:  # noqa: PLR2004  word and argument
        return ""
    first, second = node.elts[0], node.elts[1]
    found = launch.call_of(first)
    if found is not None and found.kind == "PathJoinSubstitution":
        parts = found.given.get("substitutions")
        if isinstance(parts, ast.List) and len(parts.elts) == 1:
            found = launch.call_of(parts.elts[0])
    word = first.value if isinstance(first, ast.Constant) else ""
    if found is not None and found.kind == "FindExecutable":
        word = str(launch.text(found, "name"))
    if word not in _PROGRAMS or _begins_with_space(launch, second):
        return ""
    what = f"'{word} '" if isinstance(first, ast.Constant) else "' ' behind it"
    return f"parts of a command are joined without spaces: write {what}"


def _begins_with_space(launch: LaunchFile, node: ast.expr) -> bool:
    """Tell whether a part of a command begins with a space, or may do so."""
    value = launch.evaluator.joined_text(node)
    if isinstance(value, str):
        return value[:1].isspace()
    call = launch.call_of(node)
    paths = {"FindPackageShare", "PathJoinSubstitution", "ThisLaunchFileDir"}
    return call is None or call.kind not in paths | {"LaunchConfiguration"}
