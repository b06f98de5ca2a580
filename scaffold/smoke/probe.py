"""Observes one ROS domain and says on stdout, line by line in JSON, what it sees.

This file is run by the Python of the ROS environment, which need not know ``scaffold``: it uses
the standard library and rclpy. Events on stdout::

    {"event": "ready"}
    {"event": "graph", "nodes": [...], "topics": [...], "services": [...]}    on every change
    {"event": "message", "topic": "/t", "count": 1}               the first ones of every topic
    {"event": "report", "now": 0.0, "topics": {"/t": {"count", "first", "last", ...}}}

Commands on stdin: ``report`` asks for the last of these events; the end of stdin ends the probe.
"""

from __future__ import annotations

import json
import math
import os
import select
import signal
import struct
import sys
import time
from importlib import import_module
from typing import Any

Ros = Any
"""Whatever rclpy returns: it has no types."""

NAME = "_ros2_scaffold_probe"
"""The name of the observing node; a leading underscore hides it from ``ros2 node list``."""

SHOWN_MESSAGES = 5
SHOWN_ELEMENTS = 16
SHOWN_CHARACTERS = 500
GRAPH_PERIOD = 0.05
"""Seconds between two looks at the graph."""
QUEUE_DEPTH = 1000
"""Messages that may wait: two seconds of a topic at 500 Hz."""

_UNWATCHED = ("/rosout", "/parameter_events")


class Topic:
    """What was received on a topic; times of sending are those of ``time.time``, in seconds."""

    def __init__(self) -> None:
        self.count = 0
        self.first = 0.0
        self.last = 0.0
        self.messages: list[object] = []
        self.error: str | None = None
        self.subscription: Ros = None
        self.asked = False
        self.profile = (False, False)
        """Whether all publishers are reliable, and whether all keep messages for later."""

    def as_data(self) -> dict[str, object]:
        """Return what goes into the report."""
        return {
            "count": self.count,
            "first": self.first,
            "last": self.last,
            "messages": self.messages,
            "error": self.error,
        }


class Probe:
    """The observing node and what it knows."""

    def __init__(self) -> None:
        # Named here, not imported above: the file is read and type-checked where no ROS is.
        self._rclpy = import_module("rclpy")
        self._qos = import_module("rclpy.qos")
        self._deserialize = import_module("rclpy.serialization").deserialize_message
        signals = import_module("rclpy.signals").SignalHandlerOptions
        self._rclpy.init(args=[], signal_handler_options=signals.NO)
        self._node = self._rclpy.create_node(
            NAME,
            enable_rosout=False,
            start_parameter_services=False,
        )
        self._executor = import_module("rclpy.executors").SingleThreadedExecutor()
        self._executor.add_node(self._node)
        self._topics: dict[str, Topic] = {}
        self._graph: dict[str, object] = {}

    def run(self) -> None:
        """Observe until stdin ends."""
        signal.signal(signal.SIGTERM, signal.SIG_IGN)  # from now on there is something to clean up
        say({"event": "ready"})
        commands = Commands()
        next_look = 0.0
        while not commands.ended:
            self._executor.spin_once(timeout_sec=GRAPH_PERIOD / 2)
            now = time.monotonic()
            if now >= next_look:
                next_look = now + GRAPH_PERIOD
                self._look()
            for command in commands.read():
                if command == "report":
                    self._report()
        self._executor.shutdown(timeout_sec=1.0)
        self._node.destroy_node()
        self._rclpy.try_shutdown()

    def _report(self) -> None:
        topics = {name: topic.as_data() for name, topic in self._topics.items()}
        say({"event": "report", "now": time.time(), "topics": topics})

    # -- the graph

    def _look(self) -> None:
        """Read the graph, subscribe to what is new, tell what has changed."""
        nodes = sorted(
            f"{namespace.rstrip('/')}/{name}"
            for name, namespace in self._node.get_node_names_and_namespaces()
            if name != NAME
        )
        services = sorted(service for node in nodes for service in self._services_of(node))
        topics = [
            self._look_at(name, types)
            for name, types in sorted(self._node.get_topic_names_and_types())
            if name not in _UNWATCHED
        ]
        graph: dict[str, object] = {"nodes": nodes, "topics": topics, "services": services}
        if graph != self._graph:
            self._graph = graph
            say({"event": "graph", **graph})

    def _services_of(self, node: str) -> list[list[str]]:
        """Return name and type of the services that a node answers."""
        namespace, _, name = node.rpartition("/")
        try:
            found = self._node.get_service_names_and_types_by_node(name, namespace or "/")
        except Exception:  # noqa: BLE001  the node has gone since it was listed
            return []
        return [[service, types[0]] for service, types in found]

    def _look_at(self, name: str, types: list[str]) -> dict[str, object]:
        publishers = self._node.get_publishers_info_by_topic(name)
        subscribers = [
            info
            for info in self._node.get_subscriptions_info_by_topic(name)
            if info.node_name != NAME
        ]
        offered = sorted({info.topic_type for info in publishers}) or sorted(types)
        if publishers:
            self._watch(name, offered[0], publishers)
        return {
            "name": name,
            "type": offered[0],
            "types": offered,
            "publishers": len(publishers),
            "subscribers": len(subscribers),
        }

    # -- messages

    def _watch(self, name: str, type_name: str, publishers: list[Ros]) -> None:
        """Subscribe with what every publisher of the topic offers."""
        profile = self._weakest(publishers)
        topic = self._topics.setdefault(name, Topic())
        if topic.asked and topic.profile == profile:
            return
        topic.asked = True
        topic.profile = profile
        if topic.subscription is not None:
            self._node.destroy_subscription(topic.subscription)
        try:
            topic.subscription = self._subscribe(name, topic, find_type(type_name))
        except Exception as error:  # noqa: BLE001  generated code may raise anything
            topic.error = f"{type(error).__name__}: {error}"

    def _subscribe(self, name: str, topic: Topic, message_type: Ros) -> Ros:
        def receive(data: bytes, info: dict[str, int]) -> None:
            topic.last = _sending(info)
            topic.count += 1
            if topic.count == 1:
                topic.first = topic.last
            if topic.count <= SHOWN_MESSAGES:
                self._keep(topic, data, message_type)
                say({"event": "message", "topic": name, "count": topic.count})

        return self._node.create_subscription(
            message_type, name, receive, self._as_qos(topic.profile), raw=True
        )

    def _keep(self, topic: Topic, data: bytes, message_type: Ros) -> None:
        try:
            topic.messages.append(as_data(self._deserialize(data, message_type)))
        except Exception as error:  # noqa: BLE001  what cannot be decoded is a finding
            topic.error = f"{type(error).__name__}: {error}"

    def _weakest(self, publishers: list[Ros]) -> tuple[bool, bool]:
        """Return whether all publishers are reliable, and whether all keep messages for later."""
        profiles = [info.qos_profile for info in publishers]
        reliable = self._qos.ReliabilityPolicy.RELIABLE
        transient = self._qos.DurabilityPolicy.TRANSIENT_LOCAL
        return (
            all(profile.reliability == reliable for profile in profiles),
            all(profile.durability == transient for profile in profiles),
        )

    def _as_qos(self, profile: tuple[bool, bool]) -> Ros:
        reliability, durability = self._qos.ReliabilityPolicy, self._qos.DurabilityPolicy
        return self._qos.QoSProfile(
            depth=QUEUE_DEPTH,
            reliability=reliability.RELIABLE if profile[0] else reliability.BEST_EFFORT,
            durability=durability.TRANSIENT_LOCAL if profile[1] else durability.VOLATILE,
        )


class Commands:
    """Lines of stdin, read without waiting for them."""

    def __init__(self) -> None:
        self.ended = False
        self._rest = b""

    def read(self) -> list[str]:
        """Return the commands that have come."""
        if not select.select([0], [], [], 0)[0]:
            return []
        data = os.read(0, 4096)
        if not data:
            self.ended = True
            return []
        *lines, self._rest = (self._rest + data).split(b"\n")
        return [line.decode() for line in lines]


def say(event: dict[str, object]) -> None:
    """Write an event; without a reader there is nothing left to do."""
    try:
        sys.stdout.write(json.dumps(event) + "\n")
        sys.stdout.flush()
    except BrokenPipeError:
        os._exit(1)


def _sending(info: dict[str, int]) -> float:
    """Return when a message was sent, as the middleware knows it.

    This process may be late, and what is kept for late subscribers comes all at once.
    """
    stamp = info.get("source_timestamp") or info.get("received_timestamp")
    return stamp / 1e9 if stamp else time.time()


def find_type(name: str) -> Ros:
    """Return the class of a type such as ``std_msgs/msg/String``."""
    package, kind, message = name.split("/")
    return getattr(import_module(f"{package}.{kind}"), message)


def as_data(message: Ros) -> dict[str, object]:
    """Return a message as JSON knows it; long sequences and texts end in an ellipsis."""
    fields = message.get_fields_and_field_types()
    return {field: _field(getattr(message, field), kind) for field, kind in fields.items()}


def _field(value: Ros, kind: str) -> object:
    if hasattr(value, "get_fields_and_field_types"):
        return as_data(value)
    if isinstance(value, float):
        return _number(value, single=kind == "float")
    if isinstance(value, str) and len(value) > SHOWN_CHARACTERS:
        return value[:SHOWN_CHARACTERS] + "..."
    if isinstance(value, bytes) and len(value) == 1:  # a field of the type ``byte``
        return value[0]
    if isinstance(value, (bool, int, str)):
        return value
    return _sequence(value, kind)


def _sequence(values: Ros, kind: str) -> list[object]:
    """Return the first elements of a list, an array or bytes."""
    element = "float" if kind.startswith(("float[", "sequence<float")) else ""
    first = values[:SHOWN_ELEMENTS]
    plain = first.tolist() if hasattr(first, "tolist") else first
    shown = [_field(value, element) for value in plain]
    return [*shown, "..."] if len(values) > SHOWN_ELEMENTS else shown


def _number(value: float, *, single: bool) -> object:
    """Return a number that JSON can hold, a float32 without digits that it does not have."""
    if not math.isfinite(value):
        return str(value)
    if not single:
        return value
    stored = struct.pack("f", value)
    for digits in range(6, 9):
        shorter = float(f"{value:.{digits}g}")
        if struct.pack("f", shorter) == stored:
            return shorter
    return value


def main() -> None:
    """Run the probe."""
    # The terminal's ^C reaches the whole foreground group; the one who asked decides the end.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    # The middleware complains on the first descriptor, which is for events alone.
    sys.stdout = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)
    Probe().run()


if __name__ == "__main__":
    main()
