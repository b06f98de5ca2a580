"""Reads the parameters of nodes, once per node."""

from __future__ import annotations

import time
from importlib import import_module
from typing import Any

from .messages import SHOWN_CHARACTERS, SHOWN_ELEMENTS

Ros = Any
"""Objects of rclpy, which are untyped."""

MOST_NODES = 50
MOST_PARAMETERS = 500
QUIET = 0.5
"""Seconds between the discovery of a service and the call: an answer that comes before the node
knows where to send it is waited for, and holds up the node that is measured."""

_FIELDS = (
    "", "bool_value", "integer_value", "double_value", "string_value", "byte_array_value",
    "bool_array_value", "integer_array_value", "double_array_value", "string_array_value",
)  # fmt: skip
"""The field of a value, by the number of its type."""


class Parameters:
    """Requests the parameters of nodes.

    Args:
        node: The observing node.
    """

    def __init__(self, node: Ros) -> None:
        self._node = node
        self._services = import_module("rcl_interfaces.srv")
        self._nodes: dict[str, _Inquiry] = {}

    def look(self, nodes: list[str]) -> None:
        """Continue the requests to known nodes, and start those to new ones."""
        for name in nodes:
            if name not in self._nodes and len(self._nodes) < MOST_NODES:
                self._nodes[name] = _Inquiry(self._node, self._services, name)
        for inquiry in self._nodes.values():
            inquiry.go_on()

    def as_data(self) -> dict[str, dict[str, object] | None]:
        """Return the values by node and name; ``None`` for a node that has not answered."""
        return {name: inquiry.values for name, inquiry in self._nodes.items()}


class _Inquiry:
    def __init__(self, node: Ros, services: Ros, name: str) -> None:
        self._node = node
        self._services = services
        self.values: dict[str, object] | None = None
        self._names: list[str] = []
        self._answer: Ros = None
        self._ready_since: float | None = None
        self._is_over = False
        self._list = node.create_client(services.ListParameters, f"{name}/list_parameters")
        self._get = node.create_client(services.GetParameters, f"{name}/get_parameters")

    def go_on(self) -> None:
        """Take the next possible step without blocking."""
        if self._is_over or not self._is_quiet():
            return
        if self._answer is None:
            self._answer = self._list.call_async(self._services.ListParameters.Request())
        elif self._answer.done():
            self._receive(self._answer.result())

    def _is_quiet(self) -> bool:
        if self._ready_since is None:
            if self._list.service_is_ready() and self._get.service_is_ready():
                self._ready_since = time.monotonic()
            return False
        return time.monotonic() >= self._ready_since + QUIET

    def _receive(self, answer: Ros) -> None:
        if hasattr(answer, "result"):
            self._names = sorted(answer.result.names)[:MOST_PARAMETERS]
            request = self._services.GetParameters.Request(names=self._names)
            self._answer = self._get.call_async(request)
            return
        # Fewer values in a response: some were undeclared in the meantime.
        pairs = zip(self._names, answer.values)  # noqa: B905  any Python
        self.values = {name: value_of(value) for name, value in pairs}
        self._is_over = True
        self._node.destroy_client(self._list)
        self._node.destroy_client(self._get)


def value_of(value: Ros) -> object:
    """Return the value of a parameter as JSON data; long ones end in an ellipsis."""
    number = value.type
    plain = getattr(value, _FIELDS[number]) if 0 < number < len(_FIELDS) else None
    if isinstance(plain, str) and len(plain) > SHOWN_CHARACTERS:
        return plain[:SHOWN_CHARACTERS] + "..."
    if plain is None or isinstance(plain, (bool, int, str)):
        return plain
    if isinstance(plain, float):
        return _finite(plain)
    shown = [_element(item) for item in plain[:SHOWN_ELEMENTS]]
    return [*shown, "..."] if len(plain) > SHOWN_ELEMENTS else shown


def _element(item: Ros) -> object:
    if isinstance(item, bytes):
        return item[0]
    if isinstance(item, str):
        return item[:SHOWN_CHARACTERS]
    return _finite(item) if isinstance(item, float) else item


def _finite(number: float) -> object:
    return number if abs(number) < float("inf") else str(number)
