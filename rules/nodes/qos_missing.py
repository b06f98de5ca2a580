"""ND010: publishers and subscriptions have a QoS profile."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Report
from scaffold.api.rclpy import Publisher, RclpyFile, Subscription

_NODE = (
    "from rclpy.node import Node\nfrom std_msgs.msg import String\n{}\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.create_publisher(String, 'chatter'{})\n"
)
_QOS = "from rclpy.qos import QoSProfile\n"


class QosMissing(RclpyRule):
    """A publisher or subscription has no QoS argument, or a profile without a depth.

    **Why.** ROS 2 needs to know how many messages to keep: ``TypeError`` without the argument,
    ``InvalidQoSProfileException`` without the depth.

    **Fix.** Pass a depth, such as 10, or a profile such as ``qos_profile_sensor_data``.

    **Source.** ``rclpy/node.py``; ``rclpy/qos.py``.
    """

    code = "ND010"
    name = "qos-missing"
    examples = (
        Example("a depth", {"talker.py": _NODE.format("", ", 10")}),
        Example(
            "a keyword of ROS 1, which TY004 reports",
            {"talker.py": _NODE.format("", ", queue_size=10")},
        ),
        Example(
            "no argument",
            {"talker.py": _NODE.format("", "")},
            Report("8:9", "create_publisher() is missing a depth or a QoS profile: TypeError"),
        ),
        Example(
            "a profile without a depth",
            {"talker.py": _NODE.format(_QOS, ", QoSProfile()")},
            Report("9:9", "QoS profile without a depth: InvalidQoSProfileException"),
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        entities: list[Publisher | Subscription] = [*file.publishers, *file.subscriptions]
        for entity in entities:
            problem = self._problem(entity)
            if problem:
                yield self.report(entity, problem)

    def _problem(self, entity: Publisher | Subscription) -> str | None:
        if entity.has_unknown_arguments or _has_old_keyword(entity.call):
            return None
        if entity.owner is None and entity.name_argument is None:
            return None  # a method of this name that is not rclpy's
        if entity.argument("qos_profile") is None and entity.qos is None:
            what = "create_publisher" if isinstance(entity, Publisher) else "create_subscription"
            return f"{what}() is missing a depth or a QoS profile: TypeError"
        qos = entity.qos
        if qos is not None and qos.depth is None:
            return "QoS profile without a depth: InvalidQoSProfileException"
        return None


def _has_old_keyword(call: ast.Call) -> bool:
    """Tell whether the depth has the name that it has in ROS 1, which TY004 reports."""
    return any(word.arg == "queue_size" for word in call.keywords)
