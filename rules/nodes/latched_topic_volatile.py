"""ND121: topics that are published once reach who comes late."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, RclpyRule, Report, Severity
from scaffold.api.programs import topics_of
from scaffold.api.rclpy import Endpoint, Publisher, RclpyFile, latched_topics

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
_LATCHED = "QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)"


class LatchedTopicVolatile(RclpyRule):
    """A well-known topic that is transient local is used with volatile durability.

    **Why.** The map, the description of the robot and static transforms are published once, when
    their node starts. A volatile subscription that comes later gets nothing, without any
    warning; to a volatile publisher, those who request transient local do not connect.

    **Fix.** ``QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)``.

    **Source.** REP 2003; ``nav2_map_server``, ``robot_state_publisher``, ``tf2_ros``.
    """

    code = "ND121"
    name = "latched-topic-volatile"
    severity = Severity.WARNING
    other_severities = {Severity.ERROR: "a topic that is published only once"}
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
            "another type", {"server.py": _NODE.format("subscription(String, 'map', print, 1)")}
        ),
    )

    def check_in(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        if file.module.in_tests:
            return
        latched = latched_topics()
        for endpoint in (*file.publishers, *file.subscriptions):
            topic = endpoint.name.lstrip("/") if isinstance(endpoint.name, str) else ""
            if latched.get(topic) != endpoint.interface or topic not in latched:
                continue
            if endpoint.qos is None or endpoint.qos.durability != "VOLATILE":
                continue
            yield from self._judge(package, endpoint, topic)

    def _judge(self, package: Package, endpoint: Endpoint, topic: str) -> Iterator[Diagnostic]:
        there = topics_of(package).get(topic)
        use = "use QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)"
        if isinstance(endpoint, Publisher):
            message = (
                f"{topic!r} is transient local everywhere: who requests that does not connect to "
                f"this volatile publisher; {use}"
            )
            yield self.report(endpoint.qos or endpoint, message)
        elif there is None or not there.publishers:
            message = (
                f"{topic!r} is latched: a volatile subscription gets nothing of what was published "
                f"before it; {use}"
            )
            is_sure = topic in _PUBLISHED_ONCE
            severity = Severity.ERROR if is_sure else None
            yield self.report(endpoint.qos or endpoint, message, severity=severity)
