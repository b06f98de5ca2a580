"""ND047: what is used of publishers, timers, clocks, futures ... exists."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from difflib import get_close_matches

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.python import is_harmless
from scaffold.api.rclpy import RclpyFile, class_of, has, known_names, rclpy_files

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


class AttributeOfObjectUnknown(Rule):
    """A publisher, client, goal handle, future, clock or time has no such attribute.

    **Why.** ``AttributeError: 'Publisher' object has no attribute 'send'``.

    **Fix.** Spell it as rclpy does.

    **Source.** The classes of rclpy 7.1 (ROS 2 Jazzy).
    """

    code = "ND047"
    name = "attribute-of-object-unknown"
    examples = (
        Example("known", {"talker.py": _NODE.format("publish")}),
        Example(
            "unknown",
            {"talker.py": _NODE.format("send")},
            reports=(
                Report("talker.py:11:9", "a Publisher of rclpy has no 'send': AttributeError"),
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for facts in rclpy_files(package) if package.name != "rclpy" else ():
            for node in facts.module.walk(ast.Attribute):
                if isinstance(node.ctx, ast.Load):
                    yield from self._check(facts, node)

    def _check(self, facts: RclpyFile, node: ast.Attribute) -> Iterator[Diagnostic]:
        owner = class_of(facts, node.value)
        if owner is None or has(owner, node.attr) or facts.evaluator.stores(node.attr):
            return
        if is_harmless(facts.module, node, "AttributeError"):
            return
        known = [one.removesuffix("()") for one in known_names()[owner] if one[0] != "_"]
        near = _ELSEWHERE.get(node.attr) or next(iter(get_close_matches(node.attr, known, 1)), "")
        hint = f"; {near!r} is meant" if near else ""
        kind = owner.rpartition(".")[2]
        article = "an" if kind[0] in "AEIOU" else "a"
        message = f"{article} {kind} of rclpy has no {node.attr!r}{hint}: AttributeError"
        yield self.report(facts.module.location(node), message)
