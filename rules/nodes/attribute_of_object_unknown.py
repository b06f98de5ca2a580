"""ND047: attributes of publishers, timers, clocks and futures exist."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from difflib import get_close_matches

from scaffold.api import Diagnostic, Example, Package, RclpyRule, Report
from scaffold.api.python import is_handled
from scaffold.api.rclpy import RclpyFile, class_of, has, known_names

_NODE = (
    "from rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.pub = self.create_publisher(String, 'chatter', 10)\n\n"
    "    def on_timer(self):\n"
    "        self.pub.{}(String())\n"
)
_ELSEWHERE = {
    "to_sec": "nanoseconds / 1e9",
    "seconds": "nanoseconds / 1e9",
    "stop": "cancel",
    "unregister": "destroy",
    "add_callback": "add_done_callback",
}


class AttributeOfObjectUnknown(RclpyRule):
    """An attribute of a publisher, client, goal handle, future, clock or time does not exist.

    **Why.** ``AttributeError: 'Publisher' object has no attribute 'send'``.

    **Fix.** Use the name that rclpy defines.

    **Source.** The classes of rclpy 7.1 (ROS 2 Jazzy).
    """

    code = "ND047"
    name = "attribute-of-object-unknown"
    examples = (
        Example("known", {"talker.py": _NODE.format("publish")}),
        Example(
            "unknown",
            {"talker.py": _NODE.format("send")},
            Report("11:9", "rclpy's Publisher has no 'send': AttributeError"),
        ),
        Example(
            "assigned twice",
            {
                "talker.py": _NODE.format("publish") + "\n    def on_reset(self):\n"
                "        self.pub = None\n"
                "        self.pub = self.create_publisher(String, 'other', 10)\n"
                "        self.started = self.get_clock().now()\n\n"
                "    def on_tick(self):\n"
                "        self.started = self.get_clock().now()\n"
                "        self.pub.send(self.started.to_sec())\n"
            },
            Report("20:9", "rclpy's Publisher has no 'send': AttributeError"),
            Report(
                "20:23",
                "rclpy's Time has no 'to_sec': AttributeError; did you mean 'nanoseconds / 1e9'?",
            ),
        ),
        Example(
            "assigned objects of two classes",
            {
                "talker.py": _NODE.format("publish") + "\n    def on_tick(self):\n"
                "        now = self.get_clock().now()\n"
                "        now = print(now)\n"
                "        return now.to_sec()\n"
            },
        ),
    )

    def check_in(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        if package.name == "rclpy":
            return
        for node in file.module.walk(ast.Attribute):
            if isinstance(node.ctx, ast.Load):
                yield from self._check(file, node)

    def _check(self, file: RclpyFile, node: ast.Attribute) -> Iterator[Diagnostic]:
        owner = class_of(file, node.value)
        if owner is None or has(owner, node.attr) or file.evaluator.stores(node.attr):
            return
        if is_handled(file.module, node, "AttributeError"):
            return
        known = [name.removesuffix("()") for name in known_names()[owner] if name[0] != "_"]
        near = _ELSEWHERE.get(node.attr) or next(iter(get_close_matches(node.attr, known, 1)), "")
        hint = f"; did you mean {near!r}?" if near else ""
        message = f"rclpy's {owner.rpartition('.')[2]} has no {node.attr!r}: AttributeError{hint}"
        yield self.report(file.module.location(node), message)
