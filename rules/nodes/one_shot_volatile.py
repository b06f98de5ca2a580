"""ND039: topics that are published once are transient local."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Report, Severity
from scaffold.api.programs import publish_calls
from scaffold.api.rclpy import NodeClass, RclpyFile

_NODE = (
    "from rclpy.node import Node\n"
    "from rclpy.qos import DurabilityPolicy\nfrom rclpy.qos import QoSProfile\n"
    "from std_msgs.msg import String\n\n\n"
    "class Server(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('server')\n"
    "        self.map_pub = self.create_publisher(String, 'map', {})\n"
    "        self.map_pub.publish(String(data='map'))\n"
)
_LATCHED = "QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)"


class OneShotVolatile(RclpyRule):
    """A message is published once, in the constructor, with volatile durability.

    **Why.** Subscribers are discovered only after the constructor: they never get the message.

    **Fix.** Publish with ``QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)``,
    and subscribe with the same profile.

    **Source.** ROS 2 documentation, "Quality of Service settings".
    """

    code = "ND039"
    name = "one-shot-volatile"
    severity = Severity.WARNING
    examples = (
        Example("transient local", {"server.py": _NODE.format(_LATCHED)}),
        Example(
            "volatile",
            {"server.py": _NODE.format("1")},
            Report(
                "11:9",
                "the only message on 'map' is published in the constructor: later "
                "subscribers miss it; use TRANSIENT_LOCAL",
            ),
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for publisher in file.publishers:
            owner = publisher.owner
            if not isinstance(owner, NodeClass) or owner.constructor is None:
                continue
            if publisher.qos is None or publisher.qos.durability != "VOLATILE":
                continue
            calls = publish_calls(file, publisher)
            if not calls or len(calls) != 1:
                continue
            call = calls[0]
            if file.function_of(call) is not owner.constructor or file.is_conditional(call):
                continue
            topic = f" on {publisher.topic!r}" if isinstance(publisher.topic, str) else ""
            message = (
                f"the only message{topic} is published in the constructor: later subscribers "
                "miss it; use TRANSIENT_LOCAL"
            )
            yield self.report(file.module.location(call), message)
