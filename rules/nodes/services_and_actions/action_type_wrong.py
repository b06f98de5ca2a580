"""ND067: action servers and clients are made with an action type."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule
from scaffold.api.rclpy import RclpyFile

_NODE = (
    "from example_interfaces.action import Fibonacci\nfrom rclpy.action import ActionClient\n"
    "from rclpy.node import Node\n\n\n"
    "class Sender(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('sender')\n"
    "        self.client = ActionClient({}, 'count')\n\n"
    "    def send(self):\n"
    "        self.client.send_goal_async({})\n"
)
_GOAL = "Fibonacci.Goal(order=3)"


class ActionTypeWrong(RclpyRule):
    """An action server or client is created with something that is not an action type.

    **Why.** ``AttributeError: type object 'Fibonacci' has no attribute 'handle'``, or rclpy finds
    no type support.

    **Fix.** ``ActionClient(self, Fibonacci, 'fibonacci')``.

    **Source.** ``rclpy/action/server.py``, ``rclpy/action/client.py``.
    """

    code = "ND067"
    name = "action-type-wrong"
    examples = (
        Example("an action type", {"sender.py": _NODE.format("self, Fibonacci", _GOAL)}),
        Example(
            "a part of the action",
            {"sender.py": _NODE.format("self, Fibonacci.Goal", _GOAL)},
            "9:42: this is only a part of an action; pass Fibonacci",
        ),
        Example(
            "a message type",
            {
                "sender.py": "from std_msgs.msg import String\n"
                + _NODE.format("self, String", _GOAL)
            },
            "10:42: 'String' is not an action type",
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for entity in [*file.action_servers, *file.action_clients]:
            argument = entity.argument("action_type")
            problem = _problem(file, argument.node) if argument else ""
            if argument and problem:
                yield self.report(argument, problem)


def _problem(file: RclpyFile, node: ast.expr) -> str:
    """Return the message for a wrong type of an action server or client."""
    full = file.module.qualified_name(node) or ""
    if re.fullmatch(r"(?!rclpy\.)\w+\.action\.[A-Z][A-Za-z0-9]*\.(Goal|Result|Feedback)", full):
        return f"this is only a part of an action; pass {full.split('.')[2]}"
    if re.fullmatch(r"\w+\.(msg|srv)\.[A-Z][A-Za-z0-9]*", full) and file.interface(node):
        return f"{full.rpartition('.')[2]!r} is not an action type"
    return ""
