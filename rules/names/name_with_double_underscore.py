"""NM003: no two underscores in a row."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Report, Severity
from scaffold.api.rclpy import RclpyFile, topic_problem

_NODE = (
    "from rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.create_publisher(String, '{}', 10)\n"
)


class NameWithDoubleUnderscore(RclpyRule):
    """The name of a topic, service or action has two underscores in a row.

    **Why.** The design forbids it, and no tool says so: middlewares may use ``__`` themselves.

    **Fix.** Write one underscore.

    **Source.** design.ros2.org, "Topic and service name mapping".
    """

    code = "NM003"
    name = "name-with-double-underscore"
    severity = Severity.WARNING
    examples = (
        Example("one", {"talker.py": _NODE.format("front_scan")}),
        Example(
            "two",
            {"talker.py": _NODE.format("front__scan")},
            Report("8:39", "the name 'front__scan' has two underscores in a row"),
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for entity in file.endpoints:
            argument = entity.name_argument
            name = entity.name
            if argument is None or not isinstance(name, str) or topic_problem(name):
                continue
            if "__" in name:
                yield self.report(argument, f"the name {name!r} has two underscores in a row")
