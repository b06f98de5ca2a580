"""ND048: callbacks of services and action servers return a valid response or result."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator
from typing import NamedTuple

from scaffold.api import Diagnostic, Example, MessageRule, Package, Report, Severity
from scaffold.api.distributions import target
from scaffold.api.messages import MessageTypes
from scaffold.api.python import FunctionNode, is_generator, may_end, returned, value_set_before
from scaffold.api.rclpy import ActionServer, Service, is_overridden, worker

from ._returned_values import ANSWERS, wrong_for_action, wrong_response

_REJECTED = "it is treated as a rejection"
"""The effect of a missing answer, which may be intended on some paths."""
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
_NODE_SERVICES = (
    "from rclpy.node import Node\nfrom std_srvs.srv import Trigger\n\n\n"
    "class Server(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('server')\n"
    "        self.create_service(Trigger, 'report', self.report)\n\n"
    "    def report(self, request, response):\n"
    "        response.success = True\n"
    "{}"
)
_OTHER = (
    "        return self.filled(response)\n\n"
    "    def filled(self, response):\n        response.success = True\n{}"
)


class _Expected(NamedTuple):
    """What the caller of a callback can use."""

    what: str
    otherwise: str
    """The effect of any other value."""
    cause: str
    wrong: Callable[[ast.Return], str]
    """Describes the wrong return value of a statement; empty if valid or unknown."""


class CallbackResultWrong(MessageRule):
    """A callback of a service or action server returns nothing, or an object of the wrong type.

    **Why.** rclpy raises ``TypeError`` in ``send_response`` at the first request, or
    ``AssertionError`` or ``AttributeError`` for an action result: the node ends, and the client
    waits forever. A goal callback without a ``GoalResponse`` rejects every goal, a cancel callback
    without a ``CancelResponse`` every request.

    **Fix.** End the callback with ``return response``, the result of the action, ``return
    GoalResponse.ACCEPT`` or ``return CancelResponse.ACCEPT``, on every path.

    **Source.** ``rclpy/service.py``, ``Service.send_response``; ``rclpy/action/server.py``,
    ``_execute_goal_request``, ``_execute_goal``.
    """

    code = "ND048"
    name = "callback-result-wrong"
    other_severities = {Severity.WARNING: "a missing GoalResponse or CancelResponse is a rejection"}
    examples = (
        Example(
            "a result and a GoalResponse returned",
            {"server.py": _NODE.format(_JUDGED, "return Fibonacci.Result()")},
        ),
        Example(
            "a bool instead of a GoalResponse, no result",
            {"server.py": _NODE.format("return True", "")},
            "13:9: returns True, not a GoalResponse for the action server of line 9: it is "
            "treated as a rejection",
            "15:9: work() does not return the result for the action server of line 9: "
            "AttributeError when the result is sent",
        ),
        Example(
            "a comparison instead of a GoalResponse",
            {"server.py": _NODE.format("return goal.order < 10", "return Fibonacci.Result()")},
            "13:9: returns a bool, not a GoalResponse for the action server of line 9: it is "
            "treated as a rejection",
        ),
        Example(
            "a bool computed by a function",
            {"server.py": _NODE.format("return bool(goal.order)", "return Fibonacci.Result()")},
            "13:9: returns a bool, not a GoalResponse for the action server of line 9: it is "
            "treated as a rejection",
        ),
        Example(
            "the wrong response type, the feedback",
            {
                "server.py": _NODE.format(
                    "return CancelResponse.ACCEPT", "return Fibonacci.Feedback()"
                )
            },
            "13:9: returns a CancelResponse, not a GoalResponse for the action server of line 9: "
            "it is treated as a rejection",
            "17:9: returns example_interfaces/action/Fibonacci.Feedback, not the result for the "
            "action server of line 9: AttributeError when the result is sent",
        ),
        Example(
            "a GoalResponse on one path only",
            {
                "server.py": _NODE.format(
                    "if goal.order > 1:\n            return GoalResponse.ACCEPT",
                    "return Fibonacci.Result()",
                )
            },
            Report(
                "12:9",
                "judge() does not return a GoalResponse on every path for the action "
                "server of line 9: it is treated as a rejection",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "on every path except shutdown",
            {
                "server.py": _NODE.format(
                    _JUDGED, "while rclpy.ok():\n            return Fibonacci.Result()"
                )
            },
        ),
        Example(
            "the class of the result",
            {"server.py": _NODE.format(_JUDGED, "return Fibonacci.Result")},
            "17:9: returns the class Fibonacci.Result, not the result for the action server of "
            "line 9: AttributeError when the result is sent",
        ),
        Example(
            "a method that every subclass overrides",
            {
                "server.py": _NODE_SERVICES.format("").replace("Server", "Base")
                + "\n\nclass Server(Base):\n    def report(self, request, response):\n"
                "        super().report(request, response)\n        return response\n"
            },
        ),
        Example(
            "a method that only one subclass overrides",
            {
                "server.py": _NODE_SERVICES.format("").replace("Server", "Base")
                + "\n\nclass Server(Base):\n    def report(self, request, response):\n"
                "        return response\n\n\nbase = Base()\n"
            },
            "10:9: report() does not return the response (service of line 8): TypeError",
        ),
        Example(
            "a response returned", {"server.py": _NODE_SERVICES.format("        return response\n")}
        ),
        Example(
            "a new response that is filled, an empty one",
            {
                "a.py": _NODE_SERVICES.format(
                    "        response = Trigger.Response()\n        response.success = False\n"
                    "        return response\n"
                ),
                "b.py": _NODE_SERVICES.format("        return Trigger.Response(success=True)\n"),
                "server.py": _NODE_SERVICES.format("        return Trigger.Response()\n"),
            },
            "server.py:12:9: returns a new response: the fields set in the given one are lost",
        ),
        Example(
            "the return value of a method, and of one that returns nothing",
            {
                "a.py": _NODE_SERVICES.format(_OTHER.format("        return response\n")),
                "b.py": _NODE_SERVICES.format(_OTHER.format("")),
            },
            "b.py:12:9: returns nothing from filled(), not the response (service of line 8): "
            "TypeError",
        ),
        Example(
            "no response",
            {"server.py": _NODE_SERVICES.format("")},
            "10:9: report() does not return the response (service of line 8): TypeError",
        ),
        Example(
            "a response on one path only, and a bool",
            {
                "server.py": _NODE_SERVICES.format(
                    "        if request is None:\n            return True\n"
                    "        for _ in range(3):\n            return response\n"
                )
            },
            "10:9: report() does not return the response on every path (service of line 8): "
            "TypeError",
            "13:13: returns a bool, not the response (service of line 8): TypeError",
        ),
        Example(
            "a field of the response",
            {"server.py": _NODE_SERVICES.format("        return response.success\n")},
            "12:9: returns the field response.success, not the response (service of line 8): "
            "TypeError",
        ),
        Example(
            "the request",
            {"server.py": _NODE_SERVICES.format("        return Trigger.Request()\n")},
            "12:9: returns std_srvs/srv/Trigger.Request, not the response (service of line 8): "
            "TypeError",
        ),
        Example(
            "the class instead of the response",
            {
                "server.py": _NODE_SERVICES.format(
                    "        response = Trigger.Response\n        return response\n"
                )
            },
            "13:9: returns the class std_srvs/srv/Trigger.Response, not the response (service of "
            "line 8): TypeError",
        ),
        Example(
            "a new response is filled, but the given one returned",
            {
                "server.py": _NODE_SERVICES.format(
                    "        answer = Trigger.Response()\n        answer.success = True\n"
                    "        return response\n"
                ).replace("        response.success = True\n", "")
            },
            "11:18: returns the given response unchanged: the fields set in this one are lost",
        ),
        Example(
            "a dict instead of the response",
            {"server.py": _NODE_SERVICES.format("        return {'success': True}\n")},
            "12:9: returns a dict, not the response (service of line 8): TypeError",
        ),
        Example(
            "a tuple from the function that a lambda calls",
            {
                "server.py": "from rclpy.node import Node\nfrom std_srvs.srv import Trigger\n\n\n"
                "def answer(ok):\n    return ok, 'done'\n\n\n"
                "class Server(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('server')\n"
                "        self.create_service(Trigger, 'open', lambda _, response: answer(True))\n"
            },
            "6:5: returns a tuple, not the response (service of line 12): TypeError",
        ),
    )

    def check_in(self, package: Package, types: MessageTypes) -> Iterator[Diagnostic]:
        if package.name != "rclpy":
            yield from self._check_actions(types)
        yield from self._check_services(package, types)

    def _check_actions(self, types: MessageTypes) -> Iterator[Diagnostic]:
        seen: set[tuple[str, FunctionNode]] = set()
        for server in types.file.action_servers:
            for name in ("execute_callback", *ANSWERS):
                function = _function(types, server, name)
                if function is not None and (name, function) not in seen:
                    seen.add((name, function))
                    expected = _expected_by_action(types, server, function, ANSWERS.get(name, ""))
                    yield from self._check(types, function, expected)

    def _check_services(self, package: Package, types: MessageTypes) -> Iterator[Diagnostic]:
        seen: set[FunctionNode] = set()
        for service in types.file.services:
            given = service.callback
            callback = worker(types.file, given) if given else None
            function = callback.function if callback else None
            if function is None or isinstance(function, ast.Lambda) or function in seen:
                continue
            if callback and (callback.is_called or function.decorator_list):
                continue
            class_ = types.module.enclosing_class(function)
            if class_ is not None and is_overridden(package, function, class_):
                continue
            seen.add(function)
            if not is_generator(function):
                expected = _expected_by_service(types, service, function)
                yield from self._check(types, function, expected)
                if callback is given:
                    yield from self._check_lost(types, service, function, expected)

    def _check(
        self, types: MessageTypes, function: FunctionNode, expected: _Expected
    ) -> Iterator[Diagnostic]:
        """Check each exit of a callback."""
        if may_end(function):
            never = " on every path" if returned(function) else ""
            message = (
                f"{function.name}() does not return {expected.what}{never} {expected.otherwise}"
            )
            is_rejection = bool(never) and expected.otherwise.endswith(_REJECTED)
            yield self.report(
                types.module.name_location(function),
                message,
                severity=Severity.WARNING if is_rejection else None,
                cause=expected.cause,
            )
        for statement in returned(function):
            wrong = expected.wrong(statement)
            if wrong:
                message = f"returns {wrong}, not {expected.what} {expected.otherwise}"
                yield self.report(types.module.location(statement), message, cause=expected.cause)

    def _check_lost(
        self, types: MessageTypes, service: Service, function: FunctionNode, expected: _Expected
    ) -> Iterator[Diagnostic]:
        """Check whether a callback returns the response that it fills in."""
        last = function.body[-1]
        if not isinstance(last, ast.Return) or expected.wrong(last):
            return
        filled = _filled_instead(types, service, function)
        if filled is not None and _is_untouched(types, function, last.value):
            message = "returns the given response unchanged: the fields set in this one are lost"
            yield self.report(types.module.location(filled), message)
        if _is_new(types, function, last.value):
            message = "returns a new response: the fields set in the given one are lost"
            yield self.report(types.module.location(last), message)


def _expected_by_action(
    types: MessageTypes, server: ActionServer, function: FunctionNode, answer: str
) -> _Expected:
    happens = _REJECTED if answer else _when_sent()
    return _Expected(
        f"a {answer}" if answer else "the result",
        f"for the action server of line {server.location.line}: {happens}",
        f"what {types.module.path}:{function.lineno} returns",
        lambda statement: wrong_for_action(types, server, statement.value, answer),
    )


def _expected_by_service(
    types: MessageTypes, service: Service, function: FunctionNode
) -> _Expected:
    return _Expected(
        "the response",
        f"(service of line {service.location.line}): TypeError",
        f"what {types.module.path}:{function.lineno} returns",
        lambda statement: wrong_response(
            types, service, value_set_before(function, statement) or statement.value
        ),
    )


def _when_sent() -> str:
    """Return the effect of a wrong result, which setters check on some distributions."""
    is_sent = target().fact("messages.has_check_fields")
    return "AttributeError when the result is sent" if is_sent else "AssertionError"


def _function(types: MessageTypes, server: ActionServer, name: str) -> FunctionNode | None:
    """Return the definition of a callback without a wrapper."""
    given = server.argument(name)
    callback = worker(types.file, types.file.callback(given.node)) if given else None
    function = callback.function if callback else None
    if callback is None or function is None or isinstance(function, ast.Lambda):
        return None
    is_plain = not callback.is_called and not callback.is_partial and not function.decorator_list
    return function if is_plain and not is_generator(function) else None


def _is_new(types: MessageTypes, function: FunctionNode, value: ast.expr | None) -> bool:
    """Return whether a new response is returned although fields of the given one were set."""
    if not isinstance(value, ast.Call) or value.args or value.keywords:
        return False
    given = function.args.args[-1].arg if function.args.args else ""
    return types.type_of(value) is not None and any(
        isinstance(node.ctx, ast.Store)
        and isinstance(node.value, ast.Name)
        and node.value.id == given
        for node in types.module.below(function, ast.Attribute)
    )


def _filled_instead(
    types: MessageTypes, service: Service, function: FunctionNode
) -> ast.Call | None:
    """Return the creation of a response whose fields are set, but that is not used."""
    module = types.module
    for assigned in module.below(function, ast.Assign):
        match assigned:
            case ast.Assign(targets=[ast.Name(id=name)], value=ast.Call(args=[]) as made):
                owner = types.type_of(made)
                uses = [
                    module.parent(use)
                    for use in module.below(function, ast.Name)
                    if use.id == name and isinstance(use.ctx, ast.Load)
                ]
                if owner is None or owner.name != f"{service.interface}.Response" or not uses:
                    continue
                if all(isinstance(x, ast.Attribute) and isinstance(x.ctx, ast.Store) for x in uses):
                    return made
    return None


def _is_untouched(types: MessageTypes, function: FunctionNode, value: ast.expr | None) -> bool:
    """Return whether a value is the given response without changes."""
    given = function.args.args[-1].arg if function.args.args else ""
    uses = [x for x in types.module.below(function, ast.Name) if x.id == given]
    return bool(given) and uses == [value]
