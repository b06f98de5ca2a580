"""MS020: a topic or service of a package has one type."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity
from scaffold.api.messages import message_paths
from scaffold.api.parameters import is_named_in_launch_files, keeps_default_name
from scaffold.api.programs import (
    NamedEndpoint,
    is_named_in_compiled_code,
    services_of,
    topics_of,
)

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

    **Why.** The two sides do not connect: no message arrives, or the client waits forever, without
    an error.

    **Fix.** Use the same type on both sides, or different names.

    **Source.** ROS 2 documentation, "Topics": a topic has one type.
    """

    code = "MS020"
    name = "topic-type-differs"
    other_severities = {
        Severity.WARNING: "a launch file gives the topic to other nodes, which may be the partners"
    }
    examples = (
        Example(
            "same topic type",
            {
                "a.py": _NODE.format("publisher(String, 'chatter', 10)"),
                "b.py": _NODE.format("subscription(String, 'chatter', print, 10)"),
            },
        ),
        Example(
            "different types for a topic",
            {
                "a.py": _NODE.format("publisher(String, 'chatter', 10)"),
                "b.py": _NODE.format("subscription(Bool, 'chatter', print, 10)"),
            },
            "a.py:9:31: 'chatter' has type std_msgs/msg/String here, but std_msgs/msg/Bool in "
            "b.py:9: they never connect",
            "b.py:9:34: 'chatter' has type std_msgs/msg/Bool here, but std_msgs/msg/String in "
            "a.py:9: they never connect",
        ),
        Example(
            "Python nodes whose counterparts may be C++ nodes",
            {
                "a.py": _NODE.format("publisher(String, 'chatter', 10)"),
                "b.py": _NODE.format("subscription(Bool, 'chatter', print, 10)"),
                "c.py": _NODE.format("service(Trigger, 'reset', print)"),
                "d.py": _NODE.format("client(Empty, 'reset')"),
                "src/hear.cpp": 'create_subscription<String>("/robot/chatter", 10, hear);\n'
                'create_service<Empty>("reset", reset);\n',
            },
        ),
        Example(
            "different types for a topic that a launch file gives to another node",
            {
                "a.py": _NODE.format("publisher(String, 'chatter', 10)"),
                "b.py": _NODE.format("subscription(Bool, 'chatter', print, 10)"),
                "launch/talk.launch.py": "from launch import LaunchDescription\n"
                "from launch_ros.actions import Node\n\n\n"
                "def generate_launch_description():\n"
                "    topic = {'input': '/chatter'}\n"
                "    stamper = Node(package='topics', executable='stamp', parameters=[topic])\n"
                "    return LaunchDescription([stamper])\n",
            },
            Report(
                "a.py:9:31",
                "'chatter' has type std_msgs/msg/String here, but std_msgs/msg/Bool in b.py:9: "
                "they never connect",
                severity=Severity.WARNING,
            ),
            Report(
                "b.py:9:34",
                "'chatter' has type std_msgs/msg/Bool here, but std_msgs/msg/String in a.py:9: "
                "they never connect",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "different types for a topic in four files",
            {
                "a.py": _NODE.format("publisher(String, 'chatter', 10)"),
                "b.py": _NODE.format("publisher(Bool, 'chatter', 10)"),
                "c.py": _NODE.format("subscription(String, 'chatter', print, 10)"),
                "d.py": _NODE.format("subscription(String, 'chatter', print, 10)"),
            },
            "b.py:9:31: 'chatter' has type std_msgs/msg/Bool here, but std_msgs/msg/String in "
            "c.py:9, d.py:9: they never connect",
            "c.py:9:34: 'chatter' has type std_msgs/msg/String here, but std_msgs/msg/Bool in "
            "b.py:9: they never connect",
            "d.py:9:34: 'chatter' has type std_msgs/msg/String here, but std_msgs/msg/Bool in "
            "b.py:9: they never connect",
        ),
        Example(
            "two pairs of nodes, each with a type of its own",
            {
                "a.py": _NODE.format("publisher(String, 'chatter', 10)"),
                "b.py": _NODE.format("subscription(String, 'chatter', print, 10)"),
                "c.py": _NODE.format("publisher(Bool, 'chatter', 10)"),
                "d.py": _NODE.format("subscription(Bool, 'chatter', print, 10)"),
            },
        ),
        Example(
            "different types for a service",
            {
                "a.py": _NODE.format("service(Trigger, 'reset', print)"),
                "b.py": _NODE.format("client(Empty, 'reset')"),
            },
            "a.py:9:29: 'reset' has type std_srvs/srv/Trigger here, but std_srvs/srv/Empty in "
            "b.py:9: they never connect",
            "b.py:9:28: 'reset' has type std_srvs/srv/Empty here, but std_srvs/srv/Trigger in "
            "a.py:9: they never connect",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        if not message_paths(package):
            return
        for name, topic in topics_of(package).items():
            sides = topic.publishers, topic.subscriptions
            if not topic.is_plain_by_default or not _are_known(package, *sides):
                continue
            diagnostics = [*self._check(name, *sides)]
            # This is slower to determine than whether the types differ.
            if (
                diagnostics
                and all(keeps_default_name(package, x) for side in sides for x in side)
                and not is_named_in_compiled_code(package, name)
            ):
                is_given = is_named_in_launch_files(package, name)
                for diagnostic in diagnostics:
                    severity = Severity.WARNING if is_given else diagnostic.severity
                    yield diagnostic._replace(severity=severity)
        for name, service in services_of(package).items():
            if service.is_plain and _are_known(package, service.services, service.clients):
                diagnostics = [*self._check(name, service.services, service.clients)]
                if diagnostics and not is_named_in_compiled_code(package, name):
                    yield from diagnostics

    def _check(
        self, name: str, side: Sequence[NamedEndpoint], other_side: Sequence[NamedEndpoint]
    ) -> Iterator[Diagnostic]:
        if {x.interface for x in side} == {x.interface for x in other_side}:
            return  # such as two variants of a tutorial, of which each works
        for named, others in ((side, other_side), (other_side, side)):
            for endpoint in named:
                differing = [x for x in others if x.interface != endpoint.interface]
                if differing:
                    message = f"{name!r} has type {endpoint.interface} here, but"
                    message = f"{message} {_types_with_places(differing)}: they never connect"
                    yield self.report(endpoint.type_location, message, cause=f"types of {name}")


def _types_with_places(endpoints: Sequence[NamedEndpoint]) -> str:
    """Return types with the places that use them: ``std_msgs/msg/Bool in a.py:1, b.py:2``."""
    places: dict[str, list[str]] = {}
    for endpoint in endpoints:
        place = f"{endpoint.location.path}:{endpoint.location.line}"
        places.setdefault(str(endpoint.interface), []).append(place)
    return " and ".join(f"{type_} in {', '.join(items)}" for type_, items in places.items())


def _are_known(package: Package, *sides: Sequence[NamedEndpoint]) -> bool:
    """Return whether all types are defined; another rule reports those that are not."""
    names = {endpoint.interface for side in sides for endpoint in side}
    return all(name is not None and package.workspace.interfaces.find(name) for name in names)
