"""MS025: a private topic is not used by another node under its plain name."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity
from scaffold.api.programs import (
    NamedEndpoint,
    is_private,
    is_remapped,
    named_endpoints,
    one_sided,
)

_NODE = (
    "from rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.create_{}\n"
)


class PrivateTopicDiffers(Rule):
    """One side of a topic has a private name, ``~/chatter``, and the other does not.

    **Why.** ``~`` expands to the name of the node: nothing arrives, and there is no error. Only
    names of the same type that have no other end in the package are reported.

    **Fix.** Write the name without ``~/``, or with the name of the node: ``talker/chatter``.

    **Source.** ROS 2 design, "Topic and Service name mapping to DDS", private names.
    """

    code = "MS025"
    name = "private-topic-differs"
    severity = Severity.WARNING
    examples = (
        Example(
            "the same name",
            {
                "a.py": _NODE.format("publisher(String, 'chatter', 10)"),
                "b.py": _NODE.format("subscription(String, 'chatter', print, 10)"),
            },
        ),
        Example(
            "private to the node that publishes it",
            {
                "a.py": _NODE.format("publisher(String, '~/chatter', 10)"),
                "b.py": _NODE.format("subscription(String, 'chatter', print, 10)"),
            },
            Report(
                "b.py:8:42",
                "no publisher for 'chatter': a.py:8 publishes '~/chatter', and ~ "
                "expands to the node name",
            ),
        ),
        Example(
            "remapped by a launch file",
            {
                "a.py": _NODE.format("publisher(String, '~/chatter', 10)"),
                "b.py": _NODE.format("subscription(String, 'chatter', print, 10)"),
                "launch/talk.launch.py": "from launch_ros.actions import Node\n\n"
                "LISTENER = Node(package='talk', executable='b',\n"
                "                remappings=[('chatter', 'a/chatter')])\n",
            },
        ),
        Example(
            "private to the node that subscribes",
            {
                "a.py": _NODE.format("publisher(String, 'chatter', 10)"),
                "b.py": _NODE.format("subscription(String, '~/chatter', print, 10)"),
            },
            Report(
                "b.py:8:42",
                "no publisher for '~/chatter': a.py:8 publishes 'chatter', and ~ "
                "expands to the node name",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        sent, awaited = one_sided(package)
        for private in named_endpoints(package):
            is_sent = private.kind == "Publisher"
            if not is_sent and private.kind != "Subscription":
                continue
            if not is_private(private) or is_remapped(package, private):
                continue
            for topic in awaited if is_sent else sent:
                other = topic.subscriptions[0] if is_sent else topic.publishers[0]
                is_same = topic.is_plain and _is_same_but_private(other, private)
                if is_same and not is_remapped(package, other):
                    here, there = (other, private) if is_sent else (private, other)
                    place = f"{there.location.path}:{there.location.line}"
                    message = (
                        f"no publisher for {here.name!r}: {place} publishes {there.name!r}, "
                        "and ~ expands to the node name"
                    )
                    yield self.report(here.name_location, message)
                    break


def _is_same_but_private(here: NamedEndpoint, there: NamedEndpoint) -> bool:
    """Return whether two names of the same type differ only by a ``~/`` before the second."""
    if here.interface is None or here.interface != there.interface:
        return False
    return here.name.strip("/") == there.name.removeprefix("~/")
