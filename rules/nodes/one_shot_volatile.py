"""ND039: topics that are published once are transient local."""

from __future__ import annotations

import ast
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
_PROGRAM = (
    "import rclpy\nfrom rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
    "class Teller(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('teller')\n"
    "        self.publisher = self.create_publisher(String, 'joined', 10)\n\n"
    "    def tell(self):\n"
    "        self.publisher.publish(String(data='here'))\n\n\n"
    "def main():\n"
    "    rclpy.init()\n    teller = Teller()\n    {}\n    teller.tell()\n    rclpy.shutdown()\n"
)
_LATCHED = "QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)"


class OneShotVolatile(RclpyRule):
    """A message is published once, in the constructor or by a program that ends, and volatile.

    **Why.** Subscribers are discovered only after the constructor: they never get the message.
    A program that publishes and ends is gone before any is discovered.

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
            "after waiting for a subscriber",
            {
                "server.py": _NODE.format("1").replace(
                    "        self.map_pub.publish",
                    "        while self.map_pub.get_subscription_count() < 1:\n"
                    "            time.sleep(0.1)\n"
                    "        self.map_pub.publish",
                )
            },
        ),
        Example(
            "volatile",
            {"server.py": _NODE.format("1")},
            Report(
                "11:9",
                "the only message on 'map' is published in the constructor: later "
                "subscribers miss it; use TRANSIENT_LOCAL",
            ),
        ),
        Example(
            "published by a program that ends, or that waits",
            {
                "tell.py": _PROGRAM.format("pass"),
                "later.py": _PROGRAM.format("time.sleep(2.0)"),
            },
            Report(
                "tell.py:12:9",
                "the only message on 'joined' is published as soon as the publisher "
                "is there, and the program ends: no subscriber is found by then; "
                "wait for get_subscription_count()",
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
            if file.is_conditional(call):
                continue
            topic = f" on {publisher.topic!r}" if isinstance(publisher.topic, str) else ""
            if file.function_of(call) is owner.constructor:
                if file.module.mentions(*_SEEKING):
                    continue  # it is for those that it waits for
                message = (
                    f"the only message{topic} is published in the constructor: later subscribers "
                    "miss it; use TRANSIENT_LOCAL"
                )
                yield self.report(file.module.location(call), message)
            elif file.init_calls and not _waits(file, call):
                message = (
                    f"the only message{topic} is published as soon as the publisher is there, and "
                    "the program ends: no subscriber is found by then; wait for "
                    "get_subscription_count()"
                )
                yield self.report(file.module.location(call), message)


_SEEKING = ("get_subscription_count", "count_subscribers", "get_subscriptions_info_by_topic")
"""What asks whether anybody subscribes."""
_WAITING = ("spin", "sleep", "wait", *_SEEKING, "input(", "Thread(", "asyncio")
"""What programs contain that last longer, or look for subscribers."""


def _waits(file: RclpyFile, call: ast.Call) -> bool:
    """Tell whether a program may last until its message is sent."""
    loops = (ast.For, ast.While, ast.AsyncFor)
    in_loop = any(isinstance(x, loops) for x in file.module.parents(call))
    return in_loop or file.module.in_tests or file.module.mentions(*_WAITING)
