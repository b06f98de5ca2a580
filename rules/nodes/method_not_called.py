"""ND093: methods of rclpy objects are called, not only referenced."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, RclpyRule, Report
from scaffold.api.rclpy import NODE, RclpyFile, class_of, is_method

_FUNCTIONS = frozenset({"rclpy.init", "rclpy.shutdown", "rclpy.try_shutdown"})
_FUNCTION_HAS = ("func", "self")
"""Attributes of bound methods and wrappers."""
_NODE = (
    "import rclpy\nfrom rclpy.node import Node\nfrom std_srvs.srv import Trigger\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.client = self.create_client(Trigger, 'reset')\n"
    "        self.start = self.get_clock{}.now()\n"
    "        while rclpy.ok{} and not self.client.service_is_ready{}:\n"
    "            self.get_logger().info('waiting')\n"
    "        self.destroy_node{}\n"
    "        rclpy.shutdown{}\n"
)


class MethodNotCalled(RclpyRule):
    """A method of an rclpy object is referenced where only a call makes sense.

    **Why.** ``AttributeError: 'function' object has no attribute 'now'``; as a condition, a
    method is always true; as a statement, it does nothing.

    **Fix.** Add the parentheses.

    **Source.** The classes of rclpy 7.1 (ROS 2 Jazzy).
    """

    code = "ND093"
    name = "method-not-called"
    examples = (
        Example("called", {"talker.py": _NODE.format("()", "()", "()", "()", "()")}),
        Example(
            "not called: for its result, as conditions, as a statement",
            {"talker.py": _NODE.format("", "", "", "", "")},
            Report("10:22", "'get_clock' is a method that is not called; write get_clock()"),
            Report("11:15", "rclpy.ok is a function: always true; write rclpy.ok()"),
            Report(
                "11:32",
                "'service_is_ready' is a method that is not called; write service_is_ready()",
            ),
            Report("13:9", "'destroy_node' is a method that is not called; write destroy_node()"),
            Report("14:9", "rclpy.shutdown is not called; add the parentheses"),
        ),
    )

    def check_in(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        if package.name == "rclpy":
            return
        for node in file.module.walk(ast.Attribute):
            if not isinstance(node.ctx, ast.Load) or not _needs_value(file, node):
                continue
            if file.module.qualified_name(node) == "rclpy.ok":
                message = "rclpy.ok is a function: always true; write rclpy.ok()"
                yield self.report(file.module.location(node), message)
            elif file.module.qualified_name(node) in _FUNCTIONS:
                message = f"{file.module.text(node)} is not called; add the parentheses"
                yield self.report(file.module.location(node), message)
            elif _is_method_of_rclpy(file, node):
                message = f"{node.attr!r} is a method that is not called; write {node.attr}()"
                yield self.report(file.module.location(node), message)


def _needs_value(file: RclpyFile, node: ast.Attribute) -> bool:
    """Return whether a method that is not called makes no sense in this place."""
    match file.module.parent(node):
        case ast.Attribute(attr=attr):
            return not attr.startswith("__") and attr not in _FUNCTION_HAS
        case ast.If(test=test) | ast.While(test=test):
            return test is node
        case ast.UnaryOp(op=ast.Not()) | ast.BoolOp() | ast.Expr():
            return True
        case _:
            return False


def _is_method_of_rclpy(file: RclpyFile, node: ast.Attribute) -> bool:
    owner = file.owner_of(node.value)
    if owner is None:
        return is_method(class_of(file, node.value) or "", node.attr)
    is_own = hasattr(owner, "method") and owner.method(node.attr) is not None
    return is_method(NODE, node.attr) and not is_own and not file.evaluator.stores(node.attr)
