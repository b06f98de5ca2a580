"""LF049: functions of event handlers take what launch gives them."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, LaunchRule, Report
from scaffold.api.launch import CALLBACKS, HANDLERS, LaunchFile, function_of

_OUTPUTS = ("on_stdin", "on_stdout", "on_stderr")
_LAUNCH = (
    "from launch import LaunchDescription\n"
    "from launch.actions import EmitEvent, RegisterEventHandler\n"
    "from launch.event_handlers import OnProcessExit\nfrom launch.events import Shutdown\n"
    "from launch_ros.actions import Node\n\n\n"
    "def on_exit({}):\n    return [EmitEvent(event=Shutdown())]\n\n\n"
    "def generate_launch_description():\n"
    "    node = Node(package='talker', executable='node')\n"
    "    handler = OnProcessExit(target_action=node, on_exit={})\n"
    "    return LaunchDescription([node, RegisterEventHandler(handler)])\n"
)


class EventHandlerMisused(LaunchRule):
    """An event handler has a function that takes other arguments than launch gives it.

    **Why.** ``ros2 launch`` stops when it happens: ``on_exit() takes 0 positional arguments but 2
    were given``.

    **Fix.** Give a function of event and context (of the event alone in ``OnProcessIO``), without
    calling it.

    **Source.** ``launch/event_handlers/on_action_event_base.py``.
    """

    code = "LF049"
    name = "event-handler-misused"
    examples = (
        Example(
            "a function of event and context",
            {"launch/a.launch.py": _LAUNCH.format("event, context", "on_exit")},
        ),
        Example(
            "a function of nothing",
            {"launch/a.launch.py": _LAUNCH.format("", "on_exit")},
            Report("14:57", "launch calls on_exit with event and context: TypeError"),
        ),
        Example(
            "a lambda of nothing",
            {"launch/a.launch.py": _LAUNCH.format("event, context", "lambda: []")},
            Report("14:57", "launch calls this with event and context: TypeError"),
        ),
        Example(
            "called",
            {"launch/a.launch.py": _LAUNCH.format("event, context", "on_exit()")},
            Report("14:57", "on_exit() is called here: pass the function itself"),
        ),
    )

    def check_file(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        for call in launch.find(*HANDLERS):
            for name, node in call.given.items():
                is_called = name in (*CALLBACKS, *_OUTPUTS)
                count = 1 if name in _OUTPUTS else 2
                problem = _callback_problem(launch, node, count) if is_called else ""
                if problem:
                    yield self.report(launch.location(node), problem)


def _callback_problem(launch: LaunchFile, node: ast.expr, count: int) -> str:
    """Return what is wrong about a function that launch calls with so many arguments."""
    given = "the event" if count == 1 else "event and context"
    if isinstance(node, ast.Lambda):
        return "" if _takes(node.args, count) else f"launch calls this with {given}: TypeError"
    called = isinstance(node, ast.Call) and not (node.args or node.keywords)
    function = function_of(launch, node.func if called and isinstance(node, ast.Call) else node)
    if function is None or function.decorator_list:
        return ""
    if called and not _takes(function.args, 0):
        return f"{function.name}() is called here: pass the function itself"
    if not called and not _takes(function.args, count):
        return f"launch calls {function.name} with {given}: TypeError"
    return ""


def _takes(arguments: ast.arguments, count: int) -> bool:
    """Tell whether a function can be called with so many arguments without names."""
    most = len(arguments.posonlyargs) + len(arguments.args)
    least = most - len(arguments.defaults)
    needed = sum(default is None for default in arguments.kw_defaults)
    return not needed and least <= count and (count <= most or arguments.vararg is not None)
