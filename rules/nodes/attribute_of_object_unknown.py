"""ND047: what is used of publishers, timers, clocks, futures ... exists, and methods are called."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from difflib import get_close_matches

from scaffold.api import Diagnostic, Example, Package, Rule
from scaffold.model.handlers import is_harmless
from scaffold.model.nodes import NodeFacts
from scaffold.model.rclpy_names import NODE, class_of, has, is_method, known_names

_NODE = (
    "from rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.pub = self.create_publisher(String, 'chatter', 10)\n\n"
    "    def on_timer(self):\n"
    "        self.{}.publish(String())\n"
    "        self.pub.{}(String())\n"
    "        return self.get_clock(){}.now()\n"
)
_ELSEWHERE = {
    "to_sec": "nanoseconds / 1e9",
    "seconds": "nanoseconds / 1e9",
    "stop": "cancel",
    "unregister": "destroy",
    "add_callback": "add_done_callback",
}
_VALUES = frozenset(
    {"accepted", "goal_id", "is_active", "is_cancel_requested", "nanoseconds", "request", "status"}
)
_FUNCTION_HAS = ("func", "self")


class AttributeOfObjectUnknown(Rule):
    """A publisher, client, goal handle, future, clock or time is used in a way it has not.

    **Why.** ``AttributeError: 'Publisher' object has no attribute 'send'``; a method that is not
    called is no object: ``'function' object has no attribute 'now'``, and as a condition it is
    always true.

    **Fix.** Spell it as rclpy does, and write the parentheses of a call.

    **Source.** The classes of rclpy 7.1 (ROS 2 Jazzy).
    """

    code = "ND047"
    name = "attribute-of-object-unknown"
    examples = (
        Example("known", {"talker.py": _NODE.format("pub", "publish", "")}),
        Example(
            "unknown",
            {"talker.py": _NODE.format("pub", "send", "")},
            at=("talker.py:12",),
        ),
        Example(
            "not called",
            {
                "talker.py": _NODE.format("pub", "publish", "").replace("clock()", "clock")
                + "        self.pub.get_subscription_count\n"
            },
            at=("talker.py:13", "talker.py:14"),
        ),
        Example(
            "a value called",
            {"talker.py": _NODE.format("pub", "publish", "").replace("w()", "w().nanoseconds()")},
            at=("talker.py:13",),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for facts in package.rclpy_files() if package.name != "rclpy" else ():
            for node in facts.module.walk(ast.Attribute):
                if isinstance(node.ctx, ast.Load):
                    yield from self._check(facts, node)

    def _check(self, facts: NodeFacts, node: ast.Attribute) -> Iterator[Diagnostic]:
        method = _uncalled(facts, node)
        if method:
            message = f"{method} is a method: call it, {method}()"
            yield self.report(facts.module.location(node), message)
            return
        owner = class_of(facts, node.value)
        if owner is not None and node.attr in _VALUES and _is_called(facts, node):
            if has(owner, node.attr) and not is_method(owner, node.attr):
                message = f"{node.attr} is a value, no method: TypeError; leave () out"
                yield self.report(facts.module.location(node), message)
            return
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


def _is_called(facts: NodeFacts, node: ast.Attribute) -> bool:
    parent = facts.module.parent(node)
    return isinstance(parent, ast.Call) and parent.func is node


def _uncalled(facts: NodeFacts, node: ast.Attribute) -> str:
    """Return the method that a node names where only its call makes sense, else nothing."""
    parent = facts.module.parent(node)
    if isinstance(parent, ast.Attribute):
        if parent.attr.startswith("__") or parent.attr in _FUNCTION_HAS:
            return ""
    elif not _is_condition(parent, node) and not isinstance(parent, ast.Expr):
        return ""
    owner = facts.owner_of(node.value)
    if owner is not None:
        is_own = hasattr(owner, "method") and owner.method(node.attr) is not None
        is_own = is_own or bool(facts.evaluator.stores(node.attr))
        return node.attr if is_method(NODE, node.attr) and not is_own else ""
    kind = class_of(facts, node.value)
    return node.attr if kind is not None and is_method(kind, node.attr) else ""


def _is_condition(parent: ast.AST | None, node: ast.expr) -> bool:
    match parent:
        case ast.If(test=test) | ast.While(test=test):
            return test is node
        case ast.UnaryOp(op=ast.Not()) | ast.BoolOp():
            return True
        case _:
            return False
