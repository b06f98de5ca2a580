"""ND071: publishers publish."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity, ViewError
from scaffold.api.python import Unknown
from scaffold.api.rclpy import RclpyFile, rclpy_files

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


class PublisherNeverUsed(Rule):
    """A publisher is kept in an attribute that nothing in the package reads.

    **Why.** The topic is there, `ros2 topic list` shows it, and nothing is ever published on it.

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
            "never",
            {"talker.py": _NODE.format("pass")},
            reports=(
                Report(
                    "talker.py:9:28", "nothing publishes with chatter_pub: 'chatter' stays silent"
                ),
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for facts in rclpy_files(package):
            if not facts.init_calls or facts.module.in_tests:
                continue  # a class that others inherit from, or use
            for publisher in facts.publishers:
                name = _kept_in(facts, publisher.call)
                if not name or isinstance(publisher.name, Unknown) or publisher.is_conditional:
                    continue
                if _mentions(package, name) == 1:
                    message = f"nothing publishes with {name}: {publisher.name!r} stays silent"
                    yield self.report(publisher, message)


def _kept_in(facts: RclpyFile, call: ast.Call) -> str:
    """Return the attribute that what a call makes is assigned to."""
    match facts.module.parent(call):
        case ast.Assign(targets=[ast.Attribute(value=ast.Name(), attr=name)]):
            return name
        case ast.AnnAssign(target=ast.Attribute(value=ast.Name(), attr=name)):
            return name
    return ""


def _mentions(package: Package, name: str) -> int:
    """Count how often the Python files of a package have a word in them, in any way."""
    found = 0
    for path in package.python_files:
        try:
            found += package.source(path).text.count(name)
        except ViewError:
            continue
    return found
