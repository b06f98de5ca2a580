"""TY009: methods in conditions are called."""

from __future__ import annotations

import ast

from scaffold.api import Diagnostic, Example, TypeRule
from scaffold.api.rclpy import class_of, is_method, rclpy_file
from scaffold.api.types import MARKED, TypeFinding

_CLIENTS = (
    "from rclpy.node import Node\nfrom std_srvs.srv import Trigger\n\n\n"
    "class Chooser(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('chooser')\n"
    "        self.choices = [self.create_client(Trigger, name) for name in ('a', 'b')]\n\n"
    "    def choose(self):\n"
    "        for client in reversed(self.choices):\n"
    "            if client.service_is_ready{0}:\n"
    "                client.call_async(Trigger.Request())\n"
)


class MethodAsCondition(TypeRule):
    """A condition is a method of a ROS object that is not called.

    **Why.** A method object is always truthy: the node never waits for the service, or reads a
    result before it exists.

    **Fix.** Call the method: ``if client.service_is_ready():``.

    **Source.** The methods of the classes of ROS 2 Jazzy.
    """

    code = "TY009"
    name = "method-as-condition"
    kinds = frozenset({"redundant-condition"})
    examples = (
        Example("method call as a condition", {"chooser.py": _CLIENTS.format("()")}),
        Example(
            "methods of clients and futures without parentheses",
            {"chooser.py": _CLIENTS.format("")},
            "12:16: 'service_is_ready' is a method: always true; write service_is_ready()",
        ),
    )

    def judge(self, finding: TypeFinding) -> Diagnostic | None:
        matched = finding.match(rf"Method `{MARKED}\.(?P<name>\w+)` is always truthy.*")
        node = finding.expression()
        if matched is None or not isinstance(node, ast.Attribute):
            return None
        file = rclpy_file(finding.package, finding.path)
        if is_method(class_of(file, node.value) or "", node.attr):
            return None  # ND093 reports it
        name = matched["name"]
        return self.report(finding, f"{name!r} is a method: always true; write {name}()")
