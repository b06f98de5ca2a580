"""ND119: an overridden destroy_node() destroys the node."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Severity
from scaffold.api.rclpy import RclpyFile

_NODE = (
    "from rclpy.node import Node\n\n\n"
    "class Driver(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('driver')\n\n"
    "    def destroy_node(self):\n"
    "        self.port.close()\n"
    "        {}\n"
)


class DestroyNodeIncomplete(RclpyRule):
    """A class of nodes overrides ``destroy_node`` without calling the one of rclpy.

    **Why.** The node stays in the graph after ``destroy_node()``, with its publishers, timers and
    subscriptions: its callbacks run with what is closed.

    **Fix.** End with ``super().destroy_node()``.

    **Source.** ``rclpy/node.py``, ``destroy_node``.
    """

    code = "ND119"
    name = "destroy-node-incomplete"
    severity = Severity.WARNING
    examples = (
        Example("complete", {"driver.py": _NODE.format("super().destroy_node()")}),
        Example(
            "incomplete",
            {"driver.py": _NODE.format("self.port = None")},
            "8:9: super().destroy_node() is not called: publishers, timers and subscriptions "
            "stay; call it at the end",
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for node in file.classes:
            method = node.methods.get("destroy_node")
            if method is None or method.decorator_list or any(map(_raises, method.body)):
                continue
            calls = [
                func
                for reached in file.reached(method)
                for func in file.module.below(reached, ast.Attribute)
                if func.attr in {"destroy_node", "__getattribute__"}
            ]
            if not calls and not file.module.mentions("super(Node", "super().__getattr"):
                message = (
                    "super().destroy_node() is not called: publishers, timers and subscriptions "
                    "stay; call it at the end"
                )
                yield self.report(file.module.name_location(method), message)


def _raises(statement: ast.stmt) -> bool:
    return isinstance(statement, ast.Raise)
