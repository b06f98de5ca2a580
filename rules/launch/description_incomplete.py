"""LF042: what a launch file makes is launched."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, LaunchRule, Report, Severity
from scaffold.api.launch import FUNCTION, NODES, LaunchFile

_EXECUTED = frozenset({*NODES, "IncludeLaunchDescription", "ExecuteProcess"})
_ASSIGNED = _EXECUTED | {"GroupAction", "OpaqueFunction", "RegisterEventHandler", "TimerAction"}
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


class DescriptionIncomplete(LaunchRule):
    """A launch file makes an action that it does not return, or cannot be asked for what it makes.

    **Why.** An action that is in no list is never executed, without a word; ``ros2 launch`` calls
    ``generate_launch_description`` without arguments, and ``add_action`` returns ``None``. A
    warning where a variable holds the action: it may be kept for later.

    **Fix.** Put the action in the list; take no arguments; return the LaunchDescription.

    **Source.** ``launch/launch_description.py``.
    """

    code = "LF042"
    name = "description-incomplete"
    other_severities = {Severity.WARNING: "a variable holds the action"}
    examples = (
        Example("complete", {"launch/a.launch.py": _LAUNCH.format(*_RIGHT)}),
        Example(
            "add_action of a class of one's own",
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
            Report(
                "5:5",
                "`ros2 launch` calls generate_launch_description without arguments: TypeError",
            ),
            Report("8:5", "this Node is not in the LaunchDescription: it is never launched"),
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
                "this Node is not in the LaunchDescription: it is never launched",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "an action that is switched off",
            {
                "launch/a.launch.py": _LAUNCH.format(
                    "", "other = Node(package='talker', executable='node')", ""
                ).replace("([talker])", "([\n        talker,\n        # other,\n    ])")
            },
        ),
        Example(
            "what add_action returns",
            {"launch/a.launch.py": _LAUNCH.format("", "", ".add_action(talker)")},
            Report("9:5", "add_action() returns nothing: return the LaunchDescription"),
        ),
    )

    def check_file(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        function = launch.function
        if function is not None:
            arguments = function.node.args
            given = [*arguments.posonlyargs, *arguments.args]
            if len(given) > len(arguments.defaults):
                message = f"`ros2 launch` calls {FUNCTION} without arguments: TypeError"
                yield self.report(function, message)
        for call in launch.calls:
            is_dropped = isinstance(launch.module.parent(call.call), ast.Expr)
            is_dropped = is_dropped and call.kind in _EXECUTED
            if is_dropped or (call.kind in _ASSIGNED and _is_never_used(launch, call.call)):
                yield self.report(
                    call,
                    f"this {call.kind} is not in the LaunchDescription: it is never launched",
                    severity=Severity.ERROR if is_dropped else Severity.WARNING,
                )
        for statement in launch.module.walk(ast.Return):
            if function is None or (
                launch.module.enclosing_function(statement) is not function.node
            ):
                continue
            match statement.value:
                case ast.Call(func=ast.Attribute(attr="add_action" | "add_entity")):
                    message = "add_action() returns nothing: return the LaunchDescription"
                    yield self.report(launch.location(statement), message)


def _is_never_used(launch: LaunchFile, call: ast.Call) -> bool:
    """Return whether a call is all that a local variable is for.

    A variable that a comment mentions is switched off on purpose.
    """
    module = launch.module
    match module.parent(call):
        case ast.Assign(targets=[ast.Name() as variable]):
            pass
        case _:
            return False
    if module.enclosing_function(variable) is None or module.mentions("locals()", "vars()"):
        return False
    uses = [use for use in module.index.names(variable.id) if isinstance(use.ctx, ast.Load)]
    pattern = rf"#.*\b{re.escape(variable.id)}\b"
    return not uses and not re.search(pattern, module.source.text)
