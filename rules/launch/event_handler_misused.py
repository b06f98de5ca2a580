"""LF049: event handlers watch processes, and call functions as launch does."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, LaunchRule, Report
from scaffold.api.launch import ACTIONS, CALLBACKS, HANDLERS, LaunchCall, LaunchFile, function_of

_OF_PROCESSES = ("OnProcessExit", "OnProcessIO", "OnProcessStart")
_NO_PROCESSES = frozenset(
    {"DeclareLaunchArgument", "GroupAction", "IncludeLaunchDescription", "LogInfo"}
    | {"LoadComposableNodes", "OpaqueFunction", "RegisterEventHandler", "TimerAction"}
)
_OUTPUTS = ("on_stdin", "on_stdout", "on_stderr")
_LAUNCH = (
    "from launch import LaunchDescription\n"
    "from launch.actions import EmitEvent, RegisterEventHandler, Shutdown, TimerAction\n"
    "from launch.event_handlers import OnProcessExit\nfrom launch.events import Shutdown as End\n"
    "from launch_ros.actions import Node\n\n\n"
    "def on_exit({}):\n    return [EmitEvent(event={}())]\n\n\n"
    "def generate_launch_description():\n"
    "    node = Node(package='talker', executable='node')\n"
    "    timer = TimerAction(period=1.0, actions=[node])\n"
    "    handler = OnProcessExit(target_action={}, on_exit=on_exit)\n"
    "    return LaunchDescription([timer, RegisterEventHandler({})])\n"
)


class EventHandlerMisused(LaunchRule):
    """An event handler watches what is not a process, or calls a function with wrong arguments.

    **Why.** ``ros2 launch`` stops: ``action_matcher must be an 'ExecuteLocal' instance or a
    callable``, or later, when it happens: ``on_exit() takes 0 positional arguments but 2 were
    given``.

    **Fix.** Give the node itself; a function of event and context (of the event alone in
    ``OnProcessIO``), without calling it; ``launch.events.Shutdown`` to ``EmitEvent``.

    **Source.** ``launch/event_handlers/on_action_event_base.py``, ``launch/actions/emit_event.py``.
    """

    code = "LF049"
    name = "event-handler-misused"
    examples = (
        Example(
            "a node, a function of two arguments, an event",
            {"launch/a.launch.py": _LAUNCH.format("event, context", "End", "node", "handler")},
        ),
        Example(
            "no argument, an action, a timer, a list",
            {"launch/a.launch.py": _LAUNCH.format("", "Shutdown", "timer", "[handler]")},
            Report("9:29", "EmitEvent takes an event of launch.events, not the action Shutdown"),
            Report("15:43", "OnProcessExit watches processes, but TimerAction starts none itself"),
            Report("15:58", "launch calls on_exit with event and context: TypeError"),
            Report("16:59", "RegisterEventHandler takes one handler, not a list of them"),
        ),
        Example(
            "a name, an action, functions",
            {
                "launch/a.launch.py": _LAUNCH.format("event, context", "End", "'node'", "timer"),
                "launch/b.launch.py": _LAUNCH.format(
                    "event, context", "End", "node", "handler"
                ).replace("on_exit=on_exit", "on_exit=lambda: []"),
                "launch/c.launch.py": _LAUNCH.format(
                    "event, context", "End", "node", "handler"
                ).replace("on_exit=on_exit", "on_exit=on_exit()"),
            },
            Report(
                "launch/a.launch.py:15:43",
                "OnProcessExit watches one action: pass the action itself",
            ),
            Report(
                "launch/a.launch.py:16:59",
                "RegisterEventHandler takes a handler, not the action TimerAction",
            ),
            Report(
                "launch/b.launch.py:15:57", "launch calls this with event and context: TypeError"
            ),
            Report(
                "launch/c.launch.py:15:57", "on_exit() is called here: pass the function itself"
            ),
        ),
    )

    def check_file(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        for call in launch.calls:
            for name, node in call.given.items():
                problem = _problem(launch, call, name, node)
                if problem:
                    yield self.report(launch.location(node), problem)


def _problem(launch: LaunchFile, call: LaunchCall, name: str, node: ast.expr) -> str:
    view = launch.call_of(node)
    kind = view.kind if view is not None else ""
    problem = ""
    if name == "target_action" and call.kind in _OF_PROCESSES:
        value = launch.evaluator.evaluate(node)
        if kind in _NO_PROCESSES:
            problem = f"{call.kind} watches processes, but {kind} starts none itself"
        elif isinstance(value, str | list | tuple) or isinstance(node, ast.List | ast.Tuple):
            problem = f"{call.kind} watches one action: pass the action itself"
    elif name == "event" and call.kind == "EmitEvent" and kind in ACTIONS:
        event = " of launch.events" if kind == "Shutdown" else ""
        problem = f"EmitEvent takes an event{event}, not the action {kind}"
    elif name == "event_handler" and call.kind == "RegisterEventHandler":
        if isinstance(node, ast.List | ast.Tuple):
            problem = "RegisterEventHandler takes one handler, not a list of them"
        elif kind in ACTIONS:
            problem = f"RegisterEventHandler takes a handler, not the action {kind}"
    elif call.kind in HANDLERS and name in (*CALLBACKS, *_OUTPUTS):
        problem = _callback_problem(launch, node, 1 if name in _OUTPUTS else 2)
    return problem


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
