"""LF057: functions that launch calls have the expected parameters and return value."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, LaunchRule
from scaffold.api.launch import ACTIONS, CALLBACKS, HANDLERS, LaunchCall, LaunchFile, function_of
from scaffold.api.python import returned

from ._signatures import misfit_of_context

_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch.actions import OpaqueFunction\n\n\n"
    "def set_up({}):\n    return []\n\n\n"
    "def generate_launch_description():\n"
    "    return LaunchDescription([OpaqueFunction(function=set_up{})])\n"
)
_RETURNS = (
    "from launch import LaunchDescription\nfrom launch.actions import OpaqueFunction\n"
    "from launch_ros.actions import Node\n\n\n"
    "def set_up(context):\n    node = Node(package='a', executable='b')\n    return {}\n\n\n"
    "def generate_launch_description():\n"
    "    return LaunchDescription([OpaqueFunction(function=set_up)])\n"
)


def _launch(takes: str, given: str) -> dict[str, str]:
    return {"launch/a.launch.py": _LAUNCH.format(takes, given)}


_OUTPUTS = ("on_stdin", "on_stdout", "on_stderr")
_LAUNCH_HANDLERS = (
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


class LaunchFunctionUnfit(LaunchRule):
    """The function of an OpaqueFunction or event handler has wrong parameters or returns no list.

    **Why.** ``ros2 launch`` stops when it calls the function: ``set_up() takes 0 positional
    arguments but 1 was given``, ``missing 1 required positional argument``; ``'list' object is not
    callable`` if the function is called instead of passed, ``'Node' object is not iterable`` if it
    returns a single action.

    **Fix.** Pass ``function=set_up`` with ``def set_up(context, ...)``, further arguments in
    ``args=[...]`` and ``kwargs={...}``, and ``return [node]``. Event handlers pass event and
    context, ``OnProcessIO`` only the event.

    **Source.** ``launch/actions/opaque_function.py``;
    ``launch/event_handlers/on_action_event_base.py``.
    """

    code = "LF057"
    name = "launch-function-unfit"
    examples = (
        Example(
            "context and further arguments",
            {
                "launch/a.launch.py": _LAUNCH.format("context", ""),
                "launch/b.launch.py": _LAUNCH.format(
                    "context, a, *, b", ", args=[1], kwargs={'b': 2}"
                ),
            },
        ),
        Example(
            "no context",
            _launch("", ""),
            "10:55: set_up takes no arguments; it is given the context: TypeError",
        ),
        Example(
            "a parameter that is never passed",
            _launch("context, a", ""),
            "10:55: set_up takes 'a', which args=[...] does not give: TypeError",
        ),
        Example(
            "too many arguments; an unknown one",
            {
                "launch/a.launch.py": _LAUNCH.format("context", ", args=[1, 2]"),
                "launch/b.launch.py": _LAUNCH.format("context", ", kwargs={'speed': 2}"),
            },
            "launch/a.launch.py:10:55: set_up is given context and 2 more, and takes 1 in all: "
            "TypeError",
            "launch/b.launch.py:10:55: set_up takes no 'speed', which kwargs={...} gives: "
            "TypeError",
        ),
        Example(
            "a string instead of a list of arguments",
            _launch("context, a", ", args='fast'"),
            "10:55: set_up gets the string as single characters; args=... must be a list",
        ),
        Example(
            "called",
            _launch("", "()"),
            "10:31: set_up() is called here; pass the function itself",
        ),
        Example("a list returned", {"launch/a.launch.py": _RETURNS.format("[node]")}),
        Example(
            "one action returned",
            {"launch/a.launch.py": _RETURNS.format("node")},
            "8:5: set_up returns a single Node, not a list: TypeError",
        ),
        Example(
            "a description returned",
            {"launch/a.launch.py": _RETURNS.format("LaunchDescription([node])")},
            "8:5: set_up returns a single LaunchDescription, not a list: TypeError",
        ),
        Example(
            "an event handler with event and context",
            {"launch/a.launch.py": _LAUNCH_HANDLERS.format("event, context", "on_exit")},
        ),
        Example(
            "an event handler that takes nothing",
            {"launch/a.launch.py": _LAUNCH_HANDLERS.format("", "on_exit")},
            "14:57: launch calls on_exit with event and context: TypeError",
        ),
        Example(
            "a handler of the output of a process, which gets no context",
            {
                "launch/a.launch.py": _LAUNCH_HANDLERS.format("event, context", "on_exit")
                .replace("OnProcessExit", "OnProcessIO")
                .replace("on_exit=", "on_stdout=")
            },
            "14:57: launch calls on_exit with the event: TypeError",
        ),
        Example(
            "a lambda that takes nothing",
            {"launch/a.launch.py": _LAUNCH_HANDLERS.format("event, context", "lambda: []")},
            "14:57: launch calls this with event and context: TypeError",
        ),
        Example(
            "an event handler that is called",
            {"launch/a.launch.py": _LAUNCH_HANDLERS.format("event, context", "on_exit()")},
            "14:57: on_exit() is called here; pass the function itself",
        ),
    )

    def check_file(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        yield from self._check_opaque(launch)
        yield from self._check_handlers(launch)

    def _check_opaque(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        for call in launch.find("OpaqueFunction"):
            given = call.given.get("function") or next(iter(call.call.args), None)
            if given is None:
                continue
            if _is_call_of_own(launch, given):
                message = f"{launch.module.text(given)} is called here; pass the function itself"
                yield self.report(call, message)
            function = function_of(launch, given)
            if function is None or function.decorator_list:
                continue
            problem = _problem(call, function.args)
            if problem:
                yield self.report(launch.location(given), f"{function.name} {problem}")
        yield from self._check_returns(launch)

    def _check_returns(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        given = [call.given.get("function") for call in launch.find("OpaqueFunction")]
        for function in dict.fromkeys(function_of(launch, node) for node in given):
            if function is None or function.decorator_list:
                continue
            for statement in returned(function):
                made = launch.call_of(statement.value)
                if made is not None and made.kind in {*ACTIONS, "LaunchDescription"}:
                    message = f"{function.name} returns a single {made.kind}, not a list: TypeError"
                    yield self.report(launch.location(statement), message)

    def _check_handlers(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        for call in launch.find(*HANDLERS):
            for name, node in call.given.items():
                is_called = name in (*CALLBACKS, *_OUTPUTS)
                count = 1 if name in _OUTPUTS else 2
                problem = _callback_problem(launch, node, count) if is_called else ""
                if problem:
                    yield self.report(launch.location(node), problem)


def _problem(call: LaunchCall, arguments: ast.arguments) -> str:
    """Return how the parameters of a function differ from the passed arguments."""
    args, kwargs = call.given.get("args"), call.given.get("kwargs")
    if isinstance(args, ast.Constant) and isinstance(args.value, str):
        return "gets the string as single characters; args=... must be a list"
    items = args.elts if isinstance(args, ast.List | ast.Tuple) else []
    if (args is not None and _is_unknown(args, items)) or call.is_open:
        return ""
    words: set[str] = set()
    if kwargs is not None:
        if not isinstance(kwargs, ast.Dict):
            return ""
        keys = [key.value if isinstance(key, ast.Constant) else None for key in kwargs.keys]
        if None in keys:
            return ""
        words = {str(key) for key in keys}
    if "ignore_context" in call.given:
        return ""
    return misfit_of_context(arguments, 1 + len(items), words)


def _is_unknown(args: ast.expr, items: list[ast.expr]) -> bool:
    """Return whether the number of arguments is unknown."""
    listed = isinstance(args, ast.List | ast.Tuple)
    return not listed or any(isinstance(item, ast.Starred) for item in items)


def _is_call_of_own(launch: LaunchFile, node: ast.expr) -> bool:
    match node:
        case ast.Call(func=ast.Name(id=name), args=[]):
            return name in launch.module.functions
    return False


def _callback_problem(launch: LaunchFile, node: ast.expr, count: int) -> str:
    """Return the problem with a function that launch calls with a number of arguments."""
    given = "the event" if count == 1 else "event and context"
    if isinstance(node, ast.Lambda):
        return "" if _accepts(node.args, count) else f"launch calls this with {given}: TypeError"
    called = isinstance(node, ast.Call) and not (node.args or node.keywords)
    function = function_of(launch, node.func if called and isinstance(node, ast.Call) else node)
    if function is None or function.decorator_list:
        return ""
    if called and not _accepts(function.args, 0):
        return f"{function.name}() is called here; pass the function itself"
    if not called and not _accepts(function.args, count):
        return f"launch calls {function.name} with {given}: TypeError"
    return ""


def _accepts(arguments: ast.arguments, count: int) -> bool:
    """Return whether a function can be called with this many positional arguments."""
    most = len(arguments.posonlyargs) + len(arguments.args)
    least = most - len(arguments.defaults)
    needed = sum(default is None for default in arguments.kw_defaults)
    return not needed and least <= count and (count <= most or arguments.vararg is not None)
