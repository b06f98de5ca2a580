"""Stimuli for executables: service calls, goals and messages."""

from __future__ import annotations

import time
from collections.abc import Callable
from importlib import import_module
from typing import Any

from .building import fill
from .messages import as_data, find_type

Ros = Any
"""Objects of rclpy, which are untyped."""

Say = Callable[[dict[str, object]], None]

_DEPTH = 10
_GOAL_SUCCEEDED = 4


class Stimuli:
    """Calls and publishes for a node, and reports the results.

    Args:
        node: The observing node.
        say: Writes an event.
    """

    def __init__(self, node: Ros, say: Say) -> None:
        self._node = node
        self._say = say
        self._calls: list[_Call] = []
        self._kept: list[Ros] = []

    def publish(self, command: dict[str, Ros]) -> None:
        """Publish a message periodically."""
        qos = import_module("rclpy.qos")
        try:
            kind = find_type(command["type"])
            message = fill(kind(), command["message"])
            profile = qos.QoSProfile(
                depth=_DEPTH,
                reliability=qos.ReliabilityPolicy.RELIABLE,
                durability=qos.DurabilityPolicy.TRANSIENT_LOCAL,  # matches all subscriptions
            )
            publisher = self._node.create_publisher(kind, command["topic"], profile)
        except Exception as error:  # noqa: BLE001  generated code may raise anything
            self._say({"event": "refused", "topic": command["topic"], "error": _text(error)})
            return
        timer = self._node.create_timer(1 / command["rate"], lambda: publisher.publish(message))
        self._kept += [publisher, timer]

    def call(self, command: dict[str, Ros]) -> None:
        """Call a service or an action; its answer is an event."""
        self._calls.append(_Call(self._node, command))

    def go_on(self) -> None:
        """Take the next step of every call without blocking."""
        for call in tuple(self._calls):
            event = call.go_on()
            if event is not None:
                self._calls.remove(call)
                self._say(event)


class _Call:
    def __init__(self, node: Ros, command: dict[str, Ros]) -> None:
        self._node = node
        self._command = command
        self._deadline = time.monotonic() + command["timeout"]
        self._future: Ros = None
        self._client: Ros = None

    def go_on(self) -> dict[str, object] | None:
        try:
            value = self._advance()
        except Exception as error:  # noqa: BLE001  generated code may raise anything
            return self._answer(None, _text(error))
        if value is not None:
            return self._answer(value, "")
        if time.monotonic() < self._deadline:
            return None
        waits = "nothing offers it" if self._future is None else "it does not respond"
        return self._answer(None, f"{waits} within {self._command['timeout']:g} s")

    def _advance(self) -> dict[str, object] | None:
        if self._client is None:
            self._client = self._create()
        if self._future is None:
            if not self._is_ready():
                return None
            self._future = self._send()
        if not self._future.done():
            return None
        result = self._future.result()
        if self._command["kind"] == "service":
            return as_data(result)
        return self._of_action(result)

    def _create(self) -> Ros:
        kind = find_type(self._command["type"])
        if self._command["kind"] == "service":
            return self._node.create_client(kind, self._command["name"])
        action = import_module("rclpy.action").ActionClient
        return action(self._node, kind, self._command["name"])

    def _is_ready(self) -> bool:
        if self._command["kind"] == "service":
            return bool(self._client.service_is_ready())
        return bool(self._client.server_is_ready())

    def _send(self) -> Ros:
        kind = find_type(self._command["type"])
        if self._command["kind"] == "service":
            return self._client.call_async(fill(kind.Request(), self._command["request"]))
        return self._client.send_goal_async(fill(kind.Goal(), self._command["request"]))

    def _of_action(self, result: Ros) -> dict[str, object] | None:
        if hasattr(result, "accepted"):
            if not result.accepted:
                raise RuntimeError("the goal was rejected")
            self._future = result.get_result_async()
            return None
        if result.status != _GOAL_SUCCEEDED:
            raise RuntimeError(f"the goal ended with status {result.status} instead of success")
        return as_data(result.result)

    def _answer(self, value: dict[str, object] | None, error: str) -> dict[str, object]:
        return {"event": "answer", "id": self._command["id"], "value": value, "error": error}


def _text(error: Exception) -> str:
    return str(error) or type(error).__name__
