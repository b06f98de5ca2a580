"""The observing node: watches the graph, subscribes to new topics, and reports."""

from __future__ import annotations

import json
import os
import select
import signal
import sys
import time
from importlib import import_module
from typing import Any

from .fields import Field
from .log import TOPIC as ROSOUT
from .log import Log
from .messages import find_type
from .parameters import Parameters
from .qos import endpoint
from .stimuli import Stimuli
from .topics import SHOWN_MESSAGES, Topic

Ros = Any
"""Objects of rclpy, which are untyped."""

NAME = "_ros2_scaffold_probe"
"""The name of the observing node; a leading underscore hides it from ``ros2 node list``."""

GRAPH_PERIOD = 0.05
"""Seconds between two readings of the graph."""
MOST_ENDPOINTS = 100
"""The maximum number of listed endpoints of a topic; all are counted."""

_UNWATCHED = (ROSOUT, "/parameter_events")


class Probe:
    """The observing node and its state."""

    def __init__(self) -> None:
        # Not imported at the top: the file is also read and type-checked without ROS.
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
        self._publishers: dict[str, int] = {}
        self._log = Log(self._node, self._qos, self._deserialize)
        self._parameters = Parameters(self._node)
        self._stimuli = Stimuli(self._node, say)
        self._fields: dict[str, dict[str, Field]] = {}

    def run(self) -> None:
        """Observe until stdin ends."""
        signal.signal(signal.SIGTERM, signal.SIG_IGN)  # from here on, cleanup is needed
        say({"event": "ready"})
        commands = Commands()
        next_look = 0.0
        while not commands.ended:
            self._executor.spin_once(timeout_sec=GRAPH_PERIOD / 2)
            now = time.monotonic()
            if now >= next_look:
                next_look = now + GRAPH_PERIOD
                self._inspect_graph()
            self._stimuli.go_on()
            for command in commands.read():
                self._handle(json.loads(command))
        self._executor.shutdown(timeout_sec=1.0)
        self._node.destroy_node()
        self._rclpy.try_shutdown()

    def _handle(self, command: dict[str, Any]) -> None:
        kind = command["command"]
        if kind == "report":
            self._report()
        elif kind == "fields":
            paths = command["topics"]
            self._fields = {name: {path: Field(path) for path in paths[name]} for name in paths}
        elif kind == "publish":
            self._stimuli.publish(command)
        else:
            self._stimuli.call(command)

    def _report(self) -> None:
        topics = {
            name: topic.as_report(publishers=self._publishers.get(name, 0))
            for name, topic in self._topics.items()
        }
        say(
            {
                "event": "report",
                "now": time.time(),
                "topics": topics,
                "parameters": self._parameters.as_data(),
                "log": self._log.as_data(),
                "fields": {
                    name: {path: field.as_data() for path, field in fields.items()}
                    for name, fields in self._fields.items()
                },
            }
        )

    # -- the graph

    def _inspect_graph(self) -> None:
        """Read the graph, subscribe to new topics, report changes."""
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
        self._parameters.look(nodes)

    def _services_of(self, node: str) -> list[list[str]]:
        """Return name and type of the services of a node."""
        namespace, _, name = node.rpartition("/")
        try:
            services = self._node.get_service_names_and_types_by_node(name, namespace or "/")
        except Exception:  # noqa: BLE001  the node has gone since it was listed
            return []
        return [[service, types[0]] for service, types in services]

    def _look_at(self, name: str, types: list[str]) -> dict[str, object]:
        publishers = [
            info for info in self._node.get_publishers_info_by_topic(name) if info.node_name != NAME
        ]
        subscribers = [
            info
            for info in self._node.get_subscriptions_info_by_topic(name)
            if info.node_name != NAME
        ]
        offered = sorted({info.topic_type for info in publishers}) or sorted(types)
        if publishers:
            self._choose_qos_and_subscribe(name, offered[0], publishers)
            self._publishers[name] = max(self._publishers.get(name, 0), len(publishers))
        endpoints = [
            *(endpoint("publisher", info) for info in publishers[:MOST_ENDPOINTS]),
            *(endpoint("subscription", info) for info in subscribers[:MOST_ENDPOINTS]),
        ]
        return {
            "name": name,
            "type": offered[0],
            "types": offered,
            "publishers": len(publishers),
            "subscribers": len(subscribers),
            "endpoints": sorted(endpoints, key=str),
        }

    # -- messages

    def _choose_qos_and_subscribe(self, name: str, type_name: str, publishers: list[Ros]) -> None:
        """Subscribe with a QoS compatible with every publisher of the topic."""
        profile = self._common_qos(publishers)
        topic = self._topics.setdefault(name, Topic())
        depth = topic.fitting_depth()
        # Latched messages have arrived already when the queue is shortened.
        is_shorter = depth < topic.depth / 2
        if topic.profile == profile and not is_shorter:
            return
        topic.profile = profile
        topic.depth = min(depth, topic.depth)
        if topic.subscription is not None:
            self._node.destroy_subscription(topic.subscription)
        try:
            qos = self._as_qos(profile[0], profile[1] and not is_shorter, topic.depth)
            topic.subscription = self._subscribe(name, topic, find_type(type_name), qos)
        except Exception as error:  # noqa: BLE001  generated code may raise anything
            topic.error = f"{type(error).__name__}: {error}"

    def _subscribe(self, name: str, topic: Topic, message_type: Ros, qos: Ros) -> Ros:
        def receive(data: bytes, info: dict[str, int]) -> None:
            topic.take(data, info, message_type)
            if topic.count <= SHOWN_MESSAGES:
                topic.keep(data, message_type, self._deserialize)
                say({"event": "message", "topic": name, "count": topic.count})
            fields = self._fields.get(name)
            if fields:
                message = self._deserialize(data, message_type)
                for field in fields.values():
                    field.take(message)

        return self._node.create_subscription(message_type, name, receive, qos, raw=True)

    def _common_qos(self, publishers: list[Ros]) -> tuple[bool, bool]:
        """Return whether all publishers are reliable, and whether all are transient local."""
        profiles = [info.qos_profile for info in publishers]
        reliable = self._qos.ReliabilityPolicy.RELIABLE
        transient = self._qos.DurabilityPolicy.TRANSIENT_LOCAL
        return (
            all(profile.reliability == reliable for profile in profiles),
            all(profile.durability == transient for profile in profiles),
        )

    def _as_qos(self, is_reliable: bool, is_kept: bool, depth: int) -> Ros:  # noqa: FBT001  a pair
        reliability, durability = self._qos.ReliabilityPolicy, self._qos.DurabilityPolicy
        return self._qos.QoSProfile(
            depth=depth,
            reliability=reliability.RELIABLE if is_reliable else reliability.BEST_EFFORT,
            durability=durability.TRANSIENT_LOCAL if is_kept else durability.VOLATILE,
        )


class Commands:
    """Lines of stdin, read without blocking."""

    def __init__(self) -> None:
        self.ended = False
        self._rest = b""

    def read(self) -> list[str]:
        """Return the received commands."""
        if not select.select([0], [], [], 0)[0]:
            return []
        data = os.read(0, 4096)
        if not data:
            self.ended = True
            return []
        *lines, self._rest = (self._rest + data).split(b"\n")
        return [line.decode() for line in lines]


def say(event: dict[str, object]) -> None:
    """Write an event; exit if there is no reader."""
    try:
        sys.stdout.write(json.dumps(event) + "\n")
        sys.stdout.flush()
    except BrokenPipeError:
        os._exit(1)


def main() -> None:
    """Run the probe."""
    # ^C reaches the whole foreground group; the parent process decides when to end.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    # The middleware writes messages to stdout, which is only for events.
    sys.stdout = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)
    Probe().run()
