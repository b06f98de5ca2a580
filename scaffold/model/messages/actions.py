"""Feedback and results as an action client receives them, wrapped in messages."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from typing import TYPE_CHECKING

from scaffold.model.rclpy.api import future_given
from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from scaffold.model.rclpy.entities import ActionClient
    from scaffold.model.rclpy.file import RclpyFile


class Wrapped(NamedTuple):
    """A message that wraps a part of an action."""

    client: ActionClient
    part: str
    """``Feedback`` or ``Result``."""
    field: str
    """The field that it is in."""
    other: str
    """The only other field."""


class ActionMessages:
    """Finds the messages that action clients receive in a file."""

    def __init__(self, file: RclpyFile) -> None:
        self._file = file
        self._clients = {client.call: client for client in file.action_clients}
        self._feedback = dict(self._feedback_arguments())

    def wrapped(self, node: ast.expr) -> Wrapped | None:
        """Return the wrapped message of an expression, if a client receives it."""
        if not self._clients:
            return None
        value = self._file.evaluator.single_value(node)
        argument = self._file.parameter_of(value)
        client = self._feedback.get(argument) if argument is not None else None
        if client is not None:
            return Wrapped(client, "Feedback", "feedback", "goal_id")
        made = self._made_of(value, "get_result_async")
        sent = self._made_of(made, "send_goal_async") if made is not None else None
        client = self._client(sent)
        return Wrapped(client, "Result", "result", "status") if client else None

    def _made_of(self, node: ast.expr, method: str) -> ast.expr | None:
        """Return the object whose method returned the future of a result."""
        match self._file.evaluator.single_value(node):
            case ast.Call(func=ast.Attribute(attr="result", value=future), args=[]):
                given = future_given(self._file, future)
                made = self._file.evaluator.single_value(future if given is None else given)
            case ast.Await(value=awaited):
                made = self._file.evaluator.single_value(awaited)
            case _:
                return None
        match made:
            case ast.Call(func=ast.Attribute(attr=name, value=holder)) if name == method:
                return holder
        return None

    def _client(self, node: ast.expr | None) -> ActionClient | None:
        call = self._file.evaluator.single_value(node) if node is not None else None
        return self._clients.get(call) if isinstance(call, ast.Call) else None

    def _feedback_arguments(self) -> Iterator[tuple[ast.arg, ActionClient | None]]:
        """Yield the parameters that receive feedback, with the client."""
        result: dict[ast.arg, ActionClient | None] = {}
        for call, method in self._file.module.method_calls("send_goal_async"):
            client = self._client(method.value)
            if client is None:
                continue
            named = [word.value for word in call.keywords if word.arg == "feedback_callback"]
            for given in [*call.args[1:2], *named]:
                callback = self._file.callback(given)
                function = callback.function
                if function is None or callback.is_called or callback.is_partial:
                    continue
                if not isinstance(function, ast.Lambda) and function.decorator_list:
                    continue
                arguments = [*function.args.posonlyargs, *function.args.args]
                for argument in arguments[int(callback.is_bound) :][:1]:
                    same = result.get(argument, client)
                    result[argument] = (
                        client if same and same.interface == client.interface else None
                    )
        yield from result.items()
