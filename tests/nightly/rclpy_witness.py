"""Prints what a plain rclpy node observes in its domain: JSON on stdout, once stdin ends.

It is run by the Python of the ROS environment, and shares nothing with the tool that it judges.
"""

from __future__ import annotations

import json
import select
import sys
import time
from contextlib import suppress
from importlib import import_module
from operator import sub
from statistics import pstdev
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Mapping

Ros = Any
"""Whatever rclpy returns: it has no types."""

NAME = "witness"
PATIENCE = 1.5
"""Seconds from the first sight of a node to the questions to it."""
FOREVER = 10**9
UNWATCHED = ("/rosout", "/parameter_events")
ACTION = "/_action/"
"""In the names of what actions are made of: its messages have no classes of their own."""


class Witness:
    """A node and its observations."""

    def __init__(self) -> None:
        self.rclpy = import_module("rclpy")
        self.rclpy.init(args=[])
        self.node = self.rclpy.create_node(
            NAME, enable_rosout=False, start_parameter_services=False
        )
        self.asked: dict[str, float] = {}
        self.nodes: set[str] = set()
        self.types: dict[str, set[str]] = {}
        self.endpoints: dict[str, list[dict[str, object]]] = {}
        self.services: dict[str, str] = {}
        self.actions: dict[str, str] = {}
        self.parameters: dict[str, dict[str, object]] = {}
        self.times: dict[str, list[float]] = {}
        self.kept: list[object] = []

    def look(self) -> None:
        """Record the current nodes and topics."""
        graph = import_module("rclpy.action.graph")
        for name, namespace in self.node.get_node_names_and_namespaces():
            if name == NAME:
                continue
            full = f"{namespace.rstrip('/')}/{name}"
            self.nodes.add(full)
            with suppress(Exception):  # it has just gone
                services = self.node.get_service_names_and_types_by_node(name, namespace)
                self.services.update({service: types[0] for service, types in services})
                actions = graph.get_action_server_names_and_types_by_node(
                    self.node, name, namespace
                )
                self.actions.update({action: types[0] for action, types in actions})
                self.ask(full)
        for topic, types in self.node.get_topic_names_and_types():
            if topic not in UNWATCHED and ACTION not in topic:
                self.look_at(topic, types)

    def look_at(self, topic: str, types: list[str]) -> None:
        """Record the endpoints of a topic, and subscribe to it."""
        publishers = self.node.get_publishers_info_by_topic(topic)
        both = [*publishers, *self.node.get_subscriptions_info_by_topic(topic)]
        self.types.setdefault(topic, set()).update(types)
        seen = [endpoint(info) for info in both if info.node_name != NAME]
        if len(seen) >= len(self.endpoints.get(topic, ())):
            self.endpoints[topic] = seen
        if publishers and topic not in self.times:
            self.listen(topic, types[0], publishers)

    def listen(self, topic: str, type_name: str, publishers: list[Ros]) -> None:
        """Subscribe with a QoS profile compatible with all publishers."""
        qos = import_module("rclpy.qos")
        times = self.times[topic] = []
        profile = qos.QoSProfile(
            depth=1000,
            reliability=max(info.qos_profile.reliability for info in publishers),
            durability=qos.DurabilityPolicy.VOLATILE,
        )
        package, kind, name = type_name.split("/")
        message = getattr(import_module(f"{package}.{kind}"), name)
        self.node.create_subscription(
            message, topic, lambda _, info: times.append(sent(info)), profile
        )

    def ask(self, node: str) -> None:
        """Request the parameters of a node, and activate a managed node."""
        since = self.asked.setdefault(node, time.monotonic())
        if not 0 < since < time.monotonic() - PATIENCE:
            return
        self.asked[node] = 0
        if self.services.get(f"{node}/change_state") == "lifecycle_msgs/srv/ChangeState":
            self.activate(node)
        if f"{node}/list_parameters" not in self.services:
            return
        client = import_module("rclpy.parameter_client").AsyncParameterClient(self.node, node)
        value = import_module("rclpy.parameter").parameter_value_to_python

        def take_names(answer: Ros) -> None:
            names = sorted(answer.result().result.names)

            def take_values(values: Ros) -> None:
                plain = (value(item) for item in values.result().values)
                self.parameters[node] = dict(zip(names, plain))  # noqa: B905  any Python

            self.kept.append(client.get_parameters(names, callback=take_values))

        self.kept.append(client.list_parameters(callback=take_names))

    def activate(self, node: str) -> None:
        """Configure a node, and then activate it."""
        change = import_module("lifecycle_msgs.srv").ChangeState
        client = self.node.create_client(change, f"{node}/change_state")

        def ask_for(number: int) -> Ros:
            request = change.Request()
            request.transition.id = number
            return client.call_async(request)

        ask_for(1).add_done_callback(lambda _: self.kept.append(ask_for(3)))

    def run(self) -> None:
        """Observe until stdin ends."""
        say("ready")
        next_look = 0.0
        while not select.select([0], [], [], 0)[0]:
            if time.monotonic() > next_look:
                self.look()
                next_look = time.monotonic() + 0.1
            self.rclpy.spin_once(self.node, timeout_sec=0.05)

    def as_data(self) -> dict[str, object]:
        """Return all observations."""
        topics = {
            topic: {
                "types": sorted(types),
                "endpoints": self.endpoints[topic],
                "count": len(self.times.get(topic, ())),
                "rate_hz": rate(self.times.get(topic, [])),
                "interval": deviation(self.times.get(topic, [])),
            }
            for topic, types in self.types.items()
        }
        return {
            "nodes": sorted(self.nodes),
            "topics": topics,
            "services": self.services,
            "actions": self.actions,
            "parameters": self.parameters,
        }


def say(data: object) -> None:
    """Write a line."""
    sys.stdout.write(json.dumps(data) + "\n")
    sys.stdout.flush()


def sent(info: Mapping[str, int]) -> float:
    """Return the source timestamp of a message, which does not depend on this process."""
    return (info["source_timestamp"] or time.time_ns()) / 1e9


def deviation(times: list[float]) -> float:
    """Return the standard deviation of the intervals between messages."""
    return pstdev(map(sub, times[1:], times)) if len(times) > 1 else 0.0


def rate(times: list[float]) -> float | None:
    """Return the messages per second for a list of times."""
    return (len(times) - 1) / (times[-1] - times[0]) if len(times) > 1 else None


def endpoint(info: Ros) -> dict[str, object]:
    """Return an endpoint in the format of the report of ``smoke``."""
    profile = info.qos_profile
    qos: dict[str, object] = {"depth": profile.depth}
    for policy in ("reliability", "durability", "history", "liveliness"):
        qos[policy] = getattr(profile, policy).name.lower()
    for policy in ("deadline", "lifespan", "liveliness_lease_duration"):
        seconds = getattr(profile, policy).nanoseconds / 1e9
        qos[policy] = seconds if 0 < seconds < FOREVER else None
    return {
        "kind": info.endpoint_type.name.lower(),
        "node": f"{info.node_namespace.rstrip('/')}/{info.node_name}",
        "type": info.topic_type,
        "qos": qos,
    }


if __name__ == "__main__":
    witness = Witness()
    witness.run()
    say(witness.as_data())
