"""ND051: publishers and subscriptions have compatible QoS."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, Package, Report, Rule, Severity
from scaffold.api.install import is_never_run
from scaffold.api.parameters import keeps_default_name
from scaffold.api.programs import NamedEndpoint, is_named_in_compiled_code, topics_of
from scaffold.api.rclpy import conflict_of

_NODE = (
    "from rclpy.node import Node\n"
    "from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data\n"
    "from std_msgs.msg import String\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.create_{}\n"
)
_LOOP = "        for topic, type_ in {{'chatter': String, 'echo': String}}.items():\n"
_DEFAULT = _NODE.replace(
    "        self.create_",
    "        topic = self.declare_parameter('topic', 'chatter').value\n        self.create_",
)
_LATCHED = "QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)"


class QosIncompatible(Rule):
    """A subscription requests a stricter QoS than any publisher of its topic offers.

    **Why.** They do not connect: nothing arrives, and the only sign is the warning ``New publisher
    discovered on topic ..., offering incompatible QoS``.

    **Fix.** Use the same profile for both.

    **Source.** ROS 2 documentation, "About quality of service settings", compatibilities.
    """

    code = "ND051"
    name = "qos-incompatible"
    other_severities = {Severity.WARNING: "the other side is in a script that is not installed"}
    effect = Effect.WRONG_BEHAVIOR
    examples = (
        Example(
            "compatible",
            {
                "a.py": _NODE.format(f"publisher(String, 'chatter', {_LATCHED})"),
                "b.py": _NODE.format(
                    "subscription(String, 'chatter', print, qos_profile_sensor_data)"
                ),
            },
        ),
        Example(
            "best effort offered, reliable requested",
            {
                "a.py": _NODE.format("publisher(String, 'chatter', qos_profile_sensor_data)"),
                "b.py": _NODE.format("subscription(String, 'chatter', print, 10)"),
            },
            "a.py:9:50: publisher 'chatter' is BEST_EFFORT, but the subscription in b.py:9 "
            "requests RELIABLE: nothing arrives",
            "b.py:9:60: subscription 'chatter' requests RELIABLE, but the publisher in a.py:9 is "
            "BEST_EFFORT: nothing arrives",
        ),
        Example(
            "topics of a table, in every case and under a condition",
            {
                "a.py": _NODE.format("publisher(String, 'chatter', qos_profile_sensor_data)"),
                "b.py": _NODE.replace(
                    "        self.create", _LOOP + "            self.create"
                ).format("subscription(type_, topic, print, 10)"),
                "c.py": _NODE.format("publisher(String, 'spoken', qos_profile_sensor_data)"),
                "d.py": _NODE.replace(
                    "        self.create",
                    _LOOP.replace("chatter", "spoken")
                    + "            if topic in self.wanted:\n                self.create",
                ).format("subscription(type_, topic, print, 10)"),
            },
            "a.py:9:50: publisher 'chatter' is BEST_EFFORT, but the subscription in b.py:10 "
            "requests RELIABLE: nothing arrives",
            "b.py:10:59: subscription 'chatter' requests RELIABLE, but the publisher in a.py:9 is "
            "BEST_EFFORT: nothing arrives",
        ),
        Example(
            "a topic from a parameter that is set to its default",
            {
                "a.py": _DEFAULT.format("publisher(String, topic, qos_profile_sensor_data)"),
                "b.py": _NODE.format("subscription(String, 'chatter', print, 10)"),
                "config/a.yaml": "talker:\n  ros__parameters:\n    topic: chatter\n",
            },
            "a.py:10:46: publisher 'chatter' is BEST_EFFORT, but the subscription in b.py:9 "
            "requests RELIABLE: nothing arrives",
            "b.py:9:60: subscription 'chatter' requests RELIABLE, but the publisher in a.py:10 is "
            "BEST_EFFORT: nothing arrives",
        ),
        Example(
            "a topic from a parameter that is set to another topic",
            {
                "a.py": _DEFAULT.format("publisher(String, topic, qos_profile_sensor_data)"),
                "b.py": _NODE.format("subscription(String, 'chatter', print, 10)"),
                "config/a.yaml": "talker:\n  ros__parameters:\n    topic: other\n",
            },
        ),
        Example(
            "a C++ program also publishes the topic",
            {
                "a.py": _NODE.format("publisher(String, 'chatter', qos_profile_sensor_data)"),
                "b.py": _NODE.format("subscription(String, 'chatter', print, 10)"),
                "src/talk.cpp": 'auto talker = node->create_publisher<String>("/chatter", 10);\n',
            },
        ),
        Example(
            "the publisher of a script that is not installed",
            {
                "setup.py": "from setuptools import setup\n\nsetup(packages=['talker'])\n",
                "talker/__init__.py": "",
                "talker/b.py": _NODE.format("subscription(String, 'chatter', print, 10)"),
                "scripts/a.py": _NODE.format(
                    "publisher(String, 'chatter', qos_profile_sensor_data)"
                ),
            },
            Report(
                "scripts/a.py:9:50",
                "publisher 'chatter' is BEST_EFFORT, but the subscription in "
                "talker/b.py:9 requests RELIABLE: nothing arrives",
                severity=Severity.WARNING,
            ),
            Report(
                "talker/b.py:9:60",
                "subscription 'chatter' requests RELIABLE, but the publisher in "
                "scripts/a.py:9 is BEST_EFFORT: nothing arrives",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "volatile offered, transient local requested",
            {
                "a.py": _NODE.format("publisher(String, 'chatter', 10)"),
                "b.py": _NODE.format(f"subscription(String, 'chatter', print, {_LATCHED})"),
            },
            "a.py:9:50: publisher 'chatter' is VOLATILE, but the subscription in b.py:9 requests "
            "TRANSIENT_LOCAL: nothing arrives",
            "b.py:9:60: subscription 'chatter' requests TRANSIENT_LOCAL, but the publisher in "
            "a.py:9 is VOLATILE: nothing arrives",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for name, topic in topics_of(package).items():
            if not topic.publishers or not topic.is_plain_by_default:
                continue
            endpoints = (*topic.publishers, *topic.subscriptions)
            if not all(keeps_default_name(package, endpoint) for endpoint in endpoints):
                continue
            for subscription in topic.subscriptions:
                pairs = [(x, conflict_of(x, subscription)) for x in topic.publishers]
                publisher, conflict = pairs[0]
                if conflict is None or not all(other for _, other in pairs):
                    continue
                if is_named_in_compiled_code(package, name):
                    continue
                is_apart = any(
                    is_never_run(package, x.location.path) for x in (subscription, publisher)
                )
                severity = Severity.WARNING if is_apart else Severity.ERROR
                both = ((subscription, publisher), (publisher, subscription))
                for receiver, sender in both:
                    other, has = conflict if receiver is subscription else conflict[::-1]
                    message = (
                        f"{_kind(receiver)} {name!r} {has}, but the {_kind(sender)} in "
                        f"{sender.location.path}:{sender.location.line} {other}: nothing arrives"
                    )
                    at = receiver.qos.location if receiver.qos is not None else receiver.location
                    yield self.report(at, message, severity=severity, cause=f"QoS of {name}")


def _kind(endpoint: NamedEndpoint) -> str:
    return endpoint.kind.lower()
