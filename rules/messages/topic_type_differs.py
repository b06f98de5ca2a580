"""MS020: a topic or service of a package has one type."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.messages import MessageTypes
from scaffold.api.programs import services_of, topics_of
from scaffold.api.rclpy import Endpoint

_NODE = (
    "from rclpy.node import Node\nfrom std_msgs.msg import Bool, String\n"
    "from std_srvs.srv import Empty, Trigger\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.create_{}\n"
)


class TopicTypeDiffers(Rule):
    """The two sides of a topic or service in one package use different types.

    **Why.** They do not connect: nothing arrives, and a client waits forever, without an error.

    **Fix.** Use the same type on both sides, or two names.

    **Source.** ROS 2 documentation, "Topics": a topic has one type.
    """

    code = "MS020"
    name = "topic-type-differs"
    examples = (
        Example(
            "the same type",
            {
                "a.py": _NODE.format("publisher(String, 'chatter', 10)"),
                "b.py": _NODE.format("subscription(String, 'chatter', print, 10)"),
            },
        ),
        Example(
            "two types for a topic",
            {
                "a.py": _NODE.format("publisher(String, 'chatter', 10)"),
                "b.py": _NODE.format("subscription(Bool, 'chatter', print, 10)"),
            },
            Report(
                "a.py:9:31",
                "'chatter' has type std_msgs/msg/String here, but std_msgs/msg/Bool "
                "in b.py:9: they never connect",
            ),
            Report(
                "b.py:9:34",
                "'chatter' has type std_msgs/msg/Bool here, but std_msgs/msg/String "
                "in a.py:9: they never connect",
            ),
        ),
        Example(
            "two types for a service",
            {
                "a.py": _NODE.format("service(Trigger, 'reset', print)"),
                "b.py": _NODE.format("client(Empty, 'reset')"),
            },
            Report(
                "a.py:9:29",
                "'reset' has type std_srvs/srv/Trigger here, but std_srvs/srv/Empty "
                "in b.py:9: they never connect",
            ),
            Report(
                "b.py:9:28",
                "'reset' has type std_srvs/srv/Empty here, but std_srvs/srv/Trigger "
                "in a.py:9: they never connect",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        definitions = next(MessageTypes.of_package(package), None)
        if definitions is None:
            return
        for name, topic in topics_of(package).items():
            if topic.is_plain and _are_known(definitions, topic.publishers, topic.subscriptions):
                yield from self._check(name, topic.publishers, topic.subscriptions)
        for name, service in services_of(package).items():
            if service.is_plain and _are_known(definitions, service.services, service.clients):
                yield from self._check(name, service.services, service.clients)

    def _check(
        self, name: str, sides: Sequence[Endpoint], others: Sequence[Endpoint]
    ) -> Iterator[Diagnostic]:
        types = [{endpoint.interface for endpoint in side} for side in (sides, others)]
        if any(len(side) != 1 or None in side for side in types) or types[0] == types[1]:
            return
        for here, there in ((sides[0], others[0]), (others[0], sides[0])):
            message = (
                f"{name!r} has type {here.interface} here, but {there.interface} in "
                f"{there.location.path}:{there.location.line}: they never connect"
            )
            yield self.report(here.type_argument or here, message)


def _are_known(types: MessageTypes, *sides: Sequence[Endpoint]) -> bool:
    """Return whether all types are defined; another rule reports those that are not."""
    names = {endpoint.interface for side in sides for endpoint in side}
    return all(name is not None and types.definitions.find(name) for name in names)
