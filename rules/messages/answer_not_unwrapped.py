"""MS022: feedback and results are taken out of the messages that hold them."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, MessageRule, Report
from scaffold.api.messages import MessageTypes
from scaffold.api.python import is_harmless

_NODE = (
    "from example_interfaces.action import Fibonacci\nfrom rclpy.action import ActionClient\n"
    "from rclpy.node import Node\n\n\n"
    "class Sender(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('sender')\n"
    "        self.client = ActionClient(self, Fibonacci, 'count')\n\n"
    "    def send(self):\n"
    "        future = self.client.send_goal_async(Fibonacci.Goal(), self.show)\n"
    "        future.add_done_callback(self.ask)\n\n"
    "    def show(self, message):\n"
    "        self.last = message{}.sequence\n\n"
    "    def ask(self, future):\n"
    "        handle = future.result()\n"
    "        handle.get_result_async().add_done_callback(self.end)\n\n"
    "    def end(self, future):\n"
    "        answer = future.result()\n"
    "        self.last = answer{}.sequence, answer.status\n"
)


class AnswerNotUnwrapped(MessageRule):
    """A field of the feedback or the result of an action is read from the message around it.

    **Why.** ``AttributeError: 'Fibonacci_FeedbackMessage' object has no attribute 'sequence'``;
    ``'Fibonacci_GetResult_Response' object has no attribute 'sequence'``.

    **Fix.** ``message.feedback.sequence`` and ``future.result().result.sequence``.

    **Source.** ROS 2 documentation, "Writing an action server and client (Python)".
    """

    code = "MS022"
    name = "answer-not-unwrapped"
    examples = (
        Example("taken out", {"sender.py": _NODE.format(".feedback", ".result")}),
        Example(
            "read at once",
            {"sender.py": _NODE.format("", "")},
            reports=(
                Report(
                    "sender.py:16:21",
                    "this holds the feedback and the goal_id, but no 'sequence': read "
                    ".feedback.sequence",
                ),
                Report(
                    "sender.py:24:21",
                    "this holds the result and the status, but no 'sequence': read "
                    ".result.sequence",
                ),
            ),
        ),
    )

    def check_file(self, types: MessageTypes) -> Iterator[Diagnostic]:
        if not types.facts.action_clients:
            return
        for node in types.module.walk(ast.Attribute):
            message = _message(types, node)
            if message and not is_harmless(types.module, node, "AttributeError"):
                yield self.report(types.module.location(node), message)


def _message(types: MessageTypes, node: ast.Attribute) -> str:
    found = types.action_messages.wrapped(node.value)
    if found is None or node.attr in {found.field, found.other} or node.attr.startswith("_"):
        return ""
    if node.attr in {"get_fields_and_field_types", "SLOT_TYPES"}:
        return ""
    return (
        f"this holds the {found.field} and the {found.other}, but no {node.attr!r}: "
        f"read .{found.field}.{node.attr}"
    )
