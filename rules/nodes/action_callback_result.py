"""ND065: callbacks of an action server return what the server expects."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, MessageRule, Package, Report
from scaffold.api.distributions import target
from scaffold.api.messages import MessageTypes
from scaffold.api.python import FunctionNode, is_generator, may_end, returned
from scaffold.api.rclpy import ActionServer

_ANSWERS = {"goal_callback": "GoalResponse", "cancel_callback": "CancelResponse"}
_NODE = (
    "from example_interfaces.action import Fibonacci\n"
    "from rclpy.action import ActionServer, CancelResponse, GoalResponse\n"
    "from rclpy.node import Node\n\n\n"
    "class Server(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('server')\n"
    "        self.server = ActionServer(\n"
    "            self, Fibonacci, 'count', self.work, goal_callback=self.judge)\n\n"
    "    def judge(self, goal):\n"
    "        {}\n\n"
    "    def work(self, goal_handle):\n"
    "        goal_handle.succeed()\n"
    "        {}\n"
)
_JUDGED = "return GoalResponse.ACCEPT"


class ActionCallbackResult(MessageRule):
    """A callback of an action server returns nothing, or a value the server cannot use.

    **Why.** A goal callback that does not return a ``GoalResponse`` rejects every goal, a cancel
    callback without a ``CancelResponse`` rejects every request; an execute callback that does not
    return the result ends the node with ``AssertionError`` or ``AttributeError``, and the client
    waits forever.

    **Fix.** ``return GoalResponse.ACCEPT``, ``return CancelResponse.ACCEPT``, and the result of
    the action on every path of the execute callback.

    **Source.** ``rclpy/action/server.py``, ``_execute_goal_request``, ``_execute_goal``.
    """

    code = "ND065"
    name = "action-callback-result"
    examples = (
        Example("returned", {"server.py": _NODE.format(_JUDGED, "return Fibonacci.Result()")}),
        Example(
            "a bool, nothing",
            {"server.py": _NODE.format("return True", "")},
            Report(
                "13:9",
                "returns True, not a GoalResponse for the action server of line 9: "
                "it counts as a rejection",
            ),
            Report(
                "15:9",
                "work() does not return the result for the action server of line 9: "
                "AttributeError when the result is sent",
            ),
        ),
        Example(
            "the wrong response, the feedback",
            {
                "server.py": _NODE.format(
                    "return CancelResponse.ACCEPT", "return Fibonacci.Feedback()"
                )
            },
            Report(
                "13:9",
                "returns a CancelResponse, not a GoalResponse for the action server "
                "of line 9: it counts as a rejection",
            ),
            Report(
                "17:9",
                "returns example_interfaces/action/Fibonacci.Feedback, not the "
                "result for the action server of line 9: AttributeError when the "
                "result is sent",
            ),
        ),
        Example(
            "on one path only",
            {
                "server.py": _NODE.format(
                    _JUDGED, "if self.get_logger():\n            return Fibonacci.Result()"
                )
            },
            Report(
                "15:9",
                "work() does not return the result on every path for the action "
                "server of line 9: AttributeError when the result is sent",
            ),
        ),
        Example(
            "on every path but the shutdown",
            {
                "server.py": _NODE.format(
                    _JUDGED, "while rclpy.ok():\n            return Fibonacci.Result()"
                )
            },
        ),
        Example(
            "the class of the result",
            {"server.py": _NODE.format(_JUDGED, "return Fibonacci.Result")},
            Report(
                "17:9",
                "returns the class Fibonacci.Result, not the result for the action "
                "server of line 9: AttributeError when the result is sent",
            ),
        ),
    )

    def check_in(self, package: Package, types: MessageTypes) -> Iterator[Diagnostic]:
        if package.name == "rclpy":
            return
        seen: set[tuple[str, FunctionNode]] = set()
        for server in types.facts.action_servers:
            for name in ("execute_callback", *_ANSWERS):
                function = _function(types, server, name)
                if function is not None and (name, function) not in seen:
                    seen.add((name, function))
                    yield from self._check(types, server, function, _ANSWERS.get(name, ""))

    def _check(
        self, types: MessageTypes, server: ActionServer, function: FunctionNode, answer: str
    ) -> Iterator[Diagnostic]:
        wanted = f"a {answer}" if answer else "the result"
        happens = "it counts as a rejection" if answer else _when_sent()
        made = f"for the action server of line {server.location.line}"
        cause = f"what {types.module.path}:{function.lineno} returns"
        if may_end(function):
            never = " on every path" if returned(function) else ""
            message = f"{function.name}() does not return {wanted}{never} {made}: {happens}"
            yield self.report(types.module.name_location(function), message, cause=cause)
        for statement in returned(function):
            wrong = _wrong(types, server, statement.value, answer)
            if wrong:
                message = f"returns {wrong}, not {wanted} {made}: {happens}"
                yield self.report(types.module.location(statement), message, cause=cause)


def _when_sent() -> str:
    """Return what happens to a wrong result, which setters look at on some distributions."""
    is_sent = target().fact("messages.has_check_fields")
    return "AttributeError when the result is sent" if is_sent else "AssertionError"


def _function(types: MessageTypes, server: ActionServer, name: str) -> FunctionNode | None:
    """Return the definition of a callback that nothing wraps."""
    given = server.argument(name)
    callback = types.facts.callback(given.node) if given else None
    function = callback.function if callback else None
    if callback is None or function is None or isinstance(function, ast.Lambda):
        return None
    is_plain = not callback.is_called and not callback.is_partial and not function.decorator_list
    return function if is_plain and not is_generator(function) else None


def _wrong(types: MessageTypes, server: ActionServer, value: ast.expr | None, answer: str) -> str:
    """Describe a returned value that is certainly wrong; empty for others."""
    if value is None:
        return "nothing"
    if isinstance(value, ast.Constant):
        return repr(value.value)
    name = types.module.qualified_name(value) or ""
    if answer:
        other = next((x for x in _ANSWERS.values() if f".{x}." in name), answer)
        return "" if other == answer else f"a {other}"
    if isinstance(value, ast.Attribute) and types.class_of(value) is not None:
        return f"the class {types.module.text(value)}"
    message = types.type_of(value)
    if message is None or types.definitions.find(server.interface or "") is None:
        return ""
    return "" if message.name == f"{server.interface}.Result" else message.name
