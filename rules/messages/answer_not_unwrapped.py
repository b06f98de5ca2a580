"""MS022: action feedback and results are unwrapped before their fields are read."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, MessageRule
from scaffold.api.messages import MessageTypes
from scaffold.api.python import is_handled

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
    """A field of action feedback or of a result is read from the message that wraps it.

    **Why.** ``AttributeError: 'Fibonacci_FeedbackMessage' object has no attribute 'sequence'``;
    ``'Fibonacci_GetResult_Response' object has no attribute 'sequence'``.

    **Fix.** ``message.feedback.sequence`` and ``future.result().result.sequence``.

    **Source.** ROS 2 documentation, "Writing an action server and client (Python)".
    """

    code = "MS022"
    name = "answer-not-unwrapped"
    examples = (
        Example("unwrapped", {"sender.py": _NODE.format(".feedback", ".result")}),
        Example(
            "not unwrapped",
            {"sender.py": _NODE.format("", "")},
            "16:21: this wrapper has only 'feedback' and 'goal_id', not 'sequence': "
            "AttributeError; use .feedback.sequence",
            "24:21: this wrapper has only 'result' and 'status', not 'sequence': AttributeError; "
            "use .result.sequence",
        ),
    )

    def check_file(self, types: MessageTypes) -> Iterator[Diagnostic]:
        if not types.file.action_clients:
            return
        for node in types.module.walk(ast.Attribute):
            message = _message(types, node)
            if message and not is_handled(types.module, node, "AttributeError"):
                yield self.report(types.module.location(node), message)


def _message(types: MessageTypes, node: ast.Attribute) -> str:
    wrapped = types.action_messages.wrapped(node.value)
    if wrapped is None or node.attr in {wrapped.field, wrapped.other} or node.attr.startswith("_"):
        return ""
    if node.attr in {"get_fields_and_field_types", "SLOT_TYPES"}:
        return ""
    return (
        f"this wrapper has only {wrapped.field!r} and {wrapped.other!r}, not {node.attr!r}: "
        f"AttributeError; use .{wrapped.field}.{node.attr}"
    )
