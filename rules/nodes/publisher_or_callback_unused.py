"""ND071: publishers are used, and callbacks registered."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, RclpyRule, Report, Severity
from scaffold.api.python import Unknown
from scaffold.api.rclpy import NodeClass, RclpyFile

_NAMES = r"^on_[a-z]|^callback_|_callback$|_cb$"
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


class PublisherOrCallbackUnused(RclpyRule):
    """A node has a publisher or a callback that nothing in the package mentions again.

    **Why.** ``ros2 topic list`` shows the topic, but nothing is ever published on it. A callback
    that is not passed to anything never runs: often two subscriptions got the same one, or it has
    not the name that the base class subscribes with.

    **Fix.** Publish, pass the callback to ``create_subscription``, or remove what is not used.

    **Source.** ``rclpy/publisher.py``, ``publish``; ``rclpy/node.py``, ``create_subscription``.
    """

    code = "ND071"
    name = "publisher-or-callback-unused"
    severity = Severity.WARNING
    examples = (
        Example(
            "one callback for two topics",
            {
                "wheels.py": _NODE.format(
                    "self.chatter_pub.publish(String())\n\n"
                    "    def left_callback(self, msg):\n        pass\n\n"
                    "    def right_callback(self, msg):\n        pass\n"
                ).replace(
                    "        self.create_timer",
                    "        self.create_subscription(String, 'left', self.left_callback, 10)\n"
                    "        self.create_subscription(String, 'right', self.left_callback, 10)\n"
                    "        self.create_timer",
                )
            },
            Report("20:9", "callback 'right_callback' is never registered: it never runs"),
        ),
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
        for class_ in file.classes:
            for name in _callbacks(file, class_):
                if package.occurrences(name) == 1:
                    message = f"callback {name!r} is never registered: it never runs"
                    yield self.report(file.module.name_location(class_.methods[name]), message)


def _callbacks(file: RclpyFile, class_: NodeClass) -> Iterator[str]:
    """Yield the methods with the name of a callback that only this package can register."""
    if class_.is_lifecycle or file.module.mentions("getattr(self"):
        return
    if len(class_.node.bases) != 1:
        return  # a mixin may register what has a certain name
    for name, method in class_.methods.items():
        takes_message = len(method.args.args) > 1
        is_named = re.search(_NAMES, name) is not None and (
            takes_message or name.endswith(("_callback", "_cb"))
        )
        if is_named and not method.decorator_list:
            yield name


def _kept_in(file: RclpyFile, call: ast.Call) -> str:
    """Return the attribute that the result of a call is assigned to."""
    match file.module.parent(call):
        case ast.Assign(targets=[ast.Attribute(value=ast.Name(), attr=name)]):
            return name
        case ast.AnnAssign(target=ast.Attribute(value=ast.Name(), attr=name)):
            return name
    return ""
