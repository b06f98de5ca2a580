"""ND121: topics that are published once reach who comes late."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, RclpyRule, Report, Severity
from scaffold.api.programs import published_at_start, topics_of
from scaffold.api.rclpy import Endpoint, Publisher, RclpyFile, Subscription, latched_topics

_PUBLISHED_ONCE = frozenset({"robot_description", "tf_static"})
"""Topics that nobody publishes again and again, as some do a map."""
_NODE = (
    "from nav_msgs.msg import OccupancyGrid\nfrom rclpy.node import Node\n"
    "from rclpy.qos import DurabilityPolicy, QoSProfile\n"
    "from std_msgs.msg import String\n\n\n"
    "class Viewer(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('viewer')\n"
    "        self.create_{}\n"
)
_USE = "use QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)"
_LATCHED = "QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)"


class LatchedTopicVolatile(RclpyRule):
    """A topic that is transient local is used with volatile durability.

    **Why.** The map, the description of the robot and static transforms are published once, when
    their node starts; so is what a constructor publishes. A volatile subscription that comes
    later gets nothing, without any warning; to a volatile publisher, those who request transient
    local do not connect.

    **Fix.** ``QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)``.

    **Source.** REP 2003; ``nav2_map_server``, ``robot_state_publisher``, ``tf2_ros``.
    """

    code = "ND121"
    name = "latched-topic-volatile"
    severity = Severity.WARNING
    other_severities = {Severity.ERROR: "the topic is published only once"}
    examples = (
        Example(
            "transient local",
            {"viewer.py": _NODE.format(f"subscription(OccupancyGrid, 'map', print, {_LATCHED})")},
        ),
        Example(
            "a map",
            {"viewer.py": _NODE.format("subscription(OccupancyGrid, '/map', print, 10)")},
            Report(
                "10:64",
                "'map' is latched: a volatile subscription gets nothing of what was "
                "published before it; use QoSProfile(depth=1, "
                "durability=DurabilityPolicy.TRANSIENT_LOCAL)",
            ),
        ),
        Example(
            "the description of a robot",
            {"viewer.py": _NODE.format("subscription(String, 'robot_description', print, 10)")},
            Report(
                "10:70",
                "'robot_description' is latched: a volatile subscription gets "
                "nothing of what was published before it; use QoSProfile(depth=1, "
                "durability=DurabilityPolicy.TRANSIENT_LOCAL)",
                severity=Severity.ERROR,
            ),
        ),
        Example(
            "published",
            {"server.py": _NODE.format("publisher(OccupancyGrid, 'map', 1)")},
            Report(
                "10:53",
                "'map' is transient local everywhere: who requests that does not "
                "connect to this volatile publisher; use QoSProfile(depth=1, "
                "durability=DurabilityPolicy.TRANSIENT_LOCAL)",
            ),
        ),
        Example(
            "published by a constructor",
            {
                "server.py": _NODE.format(f"publisher(String, 'zones', {_LATCHED})").replace(
                    "self.create", "self.pub = self.create"
                )
                + "        self.pub.publish(String())\n",
                "viewer.py": _NODE.format("subscription(String, 'zones', print, 1)"),
            },
            Report(
                "viewer.py:10:58",
                "'zones' is published in a constructor alone: this volatile "
                "subscription gets nothing if it comes later; use "
                "QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)",
                severity=Severity.ERROR,
            ),
        ),
        Example(
            "another type", {"server.py": _NODE.format("subscription(String, 'map', print, 1)")}
        ),
    )

    def check_in(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        if file.module.in_tests:
            return
        latched = latched_topics()
        for endpoint in (*file.publishers, *file.subscriptions):
            topic = endpoint.name.lstrip("/") if isinstance(endpoint.name, str) else ""
            if isinstance(endpoint, Subscription) and _is_late(package, endpoint, topic):
                message = (
                    f"{topic!r} is published in a constructor alone: this volatile subscription "
                    f"gets nothing if it comes later; {_USE}"
                )
                yield self.report(endpoint.qos or endpoint, message, severity=Severity.ERROR)
                continue
            if latched.get(topic) != endpoint.interface or topic not in latched:
                continue
            if endpoint.qos is None or endpoint.qos.durability != "VOLATILE":
                continue
            yield from self._judge(package, endpoint, topic)

    def _judge(self, package: Package, endpoint: Endpoint, topic: str) -> Iterator[Diagnostic]:
        there = topics_of(package).get(topic)
        if isinstance(endpoint, Publisher):
            message = (
                f"{topic!r} is transient local everywhere: who requests that does not connect to "
                f"this volatile publisher; {_USE}"
            )
            yield self.report(endpoint.qos or endpoint, message)
        elif there is None or not there.publishers:
            message = (
                f"{topic!r} is latched: a volatile subscription gets nothing of what was published "
                f"before it; {_USE}"
            )
            is_sure = topic in _PUBLISHED_ONCE
            severity = Severity.ERROR if is_sure else None
            yield self.report(endpoint.qos or endpoint, message, severity=severity)


def _is_late(package: Package, endpoint: Subscription, topic: str) -> bool:
    """Tell whether all that the package publishes for a volatile subscription is published once."""
    there = topics_of(package).get(topic)
    if endpoint.qos is None or endpoint.qos.durability != "VOLATILE" or there is None:
        return False
    return bool(there.publishers) and all(
        publisher.qos is not None
        and publisher.qos.durability == "TRANSIENT_LOCAL"
        and topic in published_at_start(package, publisher.location.path)
        for publisher in there.publishers
    )
