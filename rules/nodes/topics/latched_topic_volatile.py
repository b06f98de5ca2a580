"""ND121: messages that are published once are transient local."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, Package, RclpyRule, Report, Severity, fact
from scaffold.api.programs import publish_calls, topics_of
from scaffold.api.rclpy import (
    Endpoint,
    NodeClass,
    Publisher,
    RclpyFile,
    Subscription,
    latched_topics,
    rclpy_file,
)

_PUBLISHED_ONCE = frozenset({"robot_description", "tf_static"})
"""Topics that are published once, unlike a map, which some nodes publish periodically."""
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
_NODE_ONCE = (
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
_SEEKING = ("get_subscription_count", "count_subscribers", "get_subscriptions_info_by_topic")
"""Methods that check for subscribers."""
_WAITING = ("spin", "sleep", "wait", *_SEEKING, "input(", "Thread(", "asyncio")
"""Code in programs that keep running, or wait for subscribers."""
_LOOPS = (ast.For, ast.While, ast.AsyncFor)
_MAX_CALLS = 5
"""The maximum number of calls between the entry point and ``publish``."""


class LatchedTopicVolatile(RclpyRule):
    """A message that is published once is volatile, or a transient local topic is used as volatile.

    **Why.** The map, the robot description and static transforms are published once, when their
    node starts; the same is true of messages from a constructor, or from a program that exits
    before subscribers are discovered. A volatile subscription that starts later gets nothing,
    without a warning, and subscriptions that request transient local do not connect to a volatile
    publisher.

    **Fix.** Use ``QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)`` on both sides.

    **Source.** REP 2003; ROS 2 documentation, "Quality of Service settings"; ``nav2_map_server``,
    ``robot_state_publisher``, ``tf2_ros``.
    """

    code = "ND121"
    name = "latched-topic-volatile"
    severity = Severity.WARNING
    other_severities = {Severity.ERROR: "the topic is published only once"}
    effect = Effect.WRONG_BEHAVIOR
    examples = (
        Example(
            "transient local",
            {"viewer.py": _NODE.format(f"subscription(OccupancyGrid, 'map', print, {_LATCHED})")},
        ),
        Example(
            "a map",
            {"viewer.py": _NODE.format("subscription(OccupancyGrid, '/map', print, 10)")},
            "10:64: 'map' is latched: a volatile subscription misses everything published before "
            "it; use QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)",
        ),
        Example(
            "the robot description",
            {"viewer.py": _NODE.format("subscription(String, 'robot_description', print, 10)")},
            Report(
                "10:70",
                "'robot_description' is latched: a volatile subscription misses everything "
                "published before it; use QoSProfile(depth=1, "
                "durability=DurabilityPolicy.TRANSIENT_LOCAL)",
                severity=Severity.ERROR,
            ),
        ),
        Example(
            "published as volatile",
            {"server.py": _NODE.format("publisher(OccupancyGrid, 'map', 1)")},
            "10:53: 'map' is transient local everywhere: subscriptions that request it do not "
            "connect to this volatile publisher; use QoSProfile(depth=1, "
            "durability=DurabilityPolicy.TRANSIENT_LOCAL)",
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
                "'zones' is only published in a constructor: this volatile subscription gets "
                "nothing if it starts later; use "
                "QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)",
                severity=Severity.ERROR,
            ),
        ),
        Example(
            "another type", {"server.py": _NODE.format("subscription(String, 'map', print, 1)")}
        ),
        Example("published once, and transient local", {"server.py": _NODE_ONCE.format(_LATCHED)}),
        Example(
            "after waiting for a subscriber",
            {
                "server.py": _NODE_ONCE.format("1").replace(
                    "        self.map_pub.publish",
                    "        while self.map_pub.get_subscription_count() < 1:\n"
                    "            time.sleep(0.1)\n"
                    "        self.map_pub.publish",
                )
            },
        ),
        Example(
            "published once, and volatile",
            {"server.py": _NODE_ONCE.format("1")},
            "11:9: the only message on 'map' is published in the constructor: later subscribers "
            "miss it; use TRANSIENT_LOCAL",
        ),
        Example(
            "published for every key",
            {
                "keys.py": "import sys\n\nimport rclpy\nfrom rclpy.node import Node\n"
                "from std_msgs.msg import String\n\n\n"
                "class Keys(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('keys')\n"
                "        self.key_pub = self.create_publisher(String, 'key', 10)\n\n"
                "    def send(self, key):\n"
                "        self.key_pub.publish(String(data=key))\n\n"
                "    def run(self):\n"
                "        while rclpy.ok():\n"
                "            self.send(sys.stdin.read(1))\n\n\n"
                "def main():\n    rclpy.init()\n    Keys().run()\n"
            },
        ),
        Example(
            "published by a program that exits, or that waits",
            {
                "tell.py": _PROGRAM.format("pass"),
                "later.py": _PROGRAM.format("time.sleep(2.0)"),
            },
            "tell.py:12:9: the only message on 'joined' is published immediately, and the program "
            "exits: no subscriber is discovered by then; wait for get_subscription_count()",
        ),
    )

    def check_in(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        yield from self._check_topic(package, file)
        yield from self._check_once(file)

    def _check_topic(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        if file.module.in_tests:
            return
        latched = latched_topics()
        for endpoint in (*file.publishers, *file.subscriptions):
            topic = endpoint.name.lstrip("/") if isinstance(endpoint.name, str) else ""
            if isinstance(endpoint, Subscription) and _is_late(package, endpoint, topic):
                message = (
                    f"{topic!r} is only published in a constructor: this volatile subscription "
                    f"gets nothing if it starts later; {_USE}"
                )
                yield self.report(endpoint.qos or endpoint, message, severity=Severity.ERROR)
                continue
            if latched.get(topic) != endpoint.interface or topic not in latched:
                continue
            if endpoint.qos is None or endpoint.qos.durability != "VOLATILE":
                continue
            yield from self._judge(package, endpoint, topic)

    def _judge(self, package: Package, endpoint: Endpoint, topic: str) -> Iterator[Diagnostic]:
        endpoints = topics_of(package).get(topic)
        if isinstance(endpoint, Publisher):
            message = (
                f"{topic!r} is transient local everywhere: subscriptions that request it do not "
                f"connect to this volatile publisher; {_USE}"
            )
            yield self.report(endpoint.qos or endpoint, message)
        elif endpoints is None or not endpoints.publishers:
            message = (
                f"{topic!r} is latched: a volatile subscription misses everything published "
                f"before it; {_USE}"
            )
            is_sure = topic in _PUBLISHED_ONCE
            severity = Severity.ERROR if is_sure else None
            yield self.report(endpoint.qos or endpoint, message, severity=severity)

    def _check_once(self, file: RclpyFile) -> Iterator[Diagnostic]:
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
                    f"the only message{topic} is published immediately, and the program exits: no "
                    f"subscriber is discovered by then; wait for get_subscription_count()"
                )
                yield self.report(file.module.location(call), message)


def _is_late(package: Package, endpoint: Subscription, topic: str) -> bool:
    """Return whether the package publishes everything for a volatile subscription only once."""
    endpoints = topics_of(package).get(topic)
    if endpoint.qos is None or endpoint.qos.durability != "VOLATILE" or endpoints is None:
        return False
    return bool(endpoints.publishers) and all(
        publisher.qos is not None
        and publisher.qos.durability == "TRANSIENT_LOCAL"
        and topic in _published_at_start(package, publisher.location.path)
        for publisher in endpoints.publishers
    )


def _waits(file: RclpyFile, call: ast.Call) -> bool:
    """Return whether a program may run until its message is sent."""
    return file.module.in_tests or file.module.mentions(*_WAITING) or _is_repeated(file, call, 0)


def _is_repeated(file: RclpyFile, node: ast.AST, depth: int) -> bool:
    """Return whether code is in a loop, or in a function that is called repeatedly."""
    module = file.module
    function = file.function_of(node)
    if any(isinstance(parent, _LOOPS) for parent in module.parents(node)) or depth == _MAX_CALLS:
        return True
    name = getattr(function, "name", "")
    calls = [*module.index.names(name), *module.index.attributes(name)] if name else []
    return len(calls) > 1 or any(_is_repeated(file, call, depth + 1) for call in calls)


@fact
def _published_at_start(package: Package, path: str) -> tuple[str, ...]:
    """Return the topics that are only published in constructors."""
    file = rclpy_file(package, path)
    result: list[str] = []
    for publisher in file.publishers:
        if isinstance(publisher.owner, NodeClass) and isinstance(publisher.name, str):
            calls = publish_calls(file, publisher)
            constructor = publisher.owner.constructor
            if calls and all(file.function_of(call) is constructor for call in calls):
                result.append(publisher.name.lstrip("/"))
    return tuple(result)
