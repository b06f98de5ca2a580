"""ND071: publishers are used."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, RclpyRule, Report, Severity
from scaffold.api.python import Unknown
from scaffold.api.rclpy import RclpyFile

_NODE = (
    "import rclpy\nfrom rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.chatter_pub = self.create_publisher(String, 'chatter', 10)\n"
    "        self.create_timer(1.0, self.tick)\n\n"
    "    def tick(self):\n"
    "        {}\n\n\n"
    "def main():\n    rclpy.init()\n    rclpy.spin(Talker())\n"
)


class PublisherNeverUsed(RclpyRule):
    """A publisher is assigned to an attribute that nothing in the package reads.

    **Why.** ``ros2 topic list`` shows the topic, but nothing is ever published on it.

    **Fix.** Publish, or remove the publisher.

    **Source.** ``rclpy/publisher.py``, ``publish``.
    """

    code = "ND071"
    name = "publisher-never-used"
    severity = Severity.WARNING
    examples = (
        Example("used", {"talker.py": _NODE.format("self.chatter_pub.publish(String(data='a'))")}),
        Example(
            "used by another module",
            {
                "talker.py": _NODE.format("pass"),
                "other.py": "def talk(node, message):\n    node.chatter_pub.publish(message)\n",
            },
        ),
        Example(
            "never used",
            {"talker.py": _NODE.format("pass")},
            Report("9:28", "publisher 'chatter_pub' is never used: no messages on 'chatter'"),
        ),
    )

    def check_in(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        if not file.init_calls or file.module.in_tests:
            return  # a class that other packages may inherit from, or use
        for publisher in file.publishers:
            name = _kept_in(file, publisher.call)
            if not name or isinstance(publisher.name, Unknown) or publisher.is_conditional:
                continue
            if package.occurrences(name) == 1:
                message = f"publisher {name!r} is never used: no messages on {publisher.name!r}"
                yield self.report(publisher, message)


def _kept_in(file: RclpyFile, call: ast.Call) -> str:
    """Return the attribute that the result of a call is assigned to."""
    match file.module.parent(call):
        case ast.Assign(targets=[ast.Attribute(value=ast.Name(), attr=name)]):
            return name
        case ast.AnnAssign(target=ast.Attribute(value=ast.Name(), attr=name)):
            return name
    return ""
