"""ND067: action servers and clients get a node, an action type and goals of that type."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, MessageRule, Report
from scaffold.api.messages import MessageTypes
from scaffold.api.python import kind_of
from scaffold.api.rclpy import ActionClient, RclpyFile

_WHOLE = r"(?!rclpy\.)\w+\.action\.[A-Z][A-Za-z0-9]*"
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


class ActionTypeWrong(MessageRule):
    """An action server or client gets a wrong node, action type or goal.

    **Why.** ``AttributeError: type object 'Fibonacci' has no attribute 'handle'``, or rclpy finds
    no type support; a goal of another type raises ``TypeError``.

    **Fix.** ``ActionClient(self, Fibonacci, 'fibonacci')``, and ``Fibonacci.Goal()`` to send.

    **Source.** ``rclpy/action/server.py``, ``rclpy/action/client.py``.
    """

    code = "ND067"
    name = "action-type-wrong"
    examples = (
        Example("a node, a type, a goal", {"sender.py": _NODE.format("self, Fibonacci", _GOAL)}),
        Example(
            "no node",
            {"sender.py": _NODE.format("Fibonacci", _GOAL)},
            Report("9:36", "'Fibonacci' is not a node; pass the node first, then the type"),
        ),
        Example(
            "a part of the action",
            {"sender.py": _NODE.format("self, Fibonacci.Goal", _GOAL)},
            Report("9:42", "this is only a part of an action; pass Fibonacci"),
        ),
        Example(
            "a number, the class of goals, the result",
            {
                "sender.py": _NODE.format("self, Fibonacci", "3")
                + "        self.client.send_goal(Fibonacci.Goal)\n"
                + "        self.client.send_goal(Fibonacci.Result())\n"
            },
            Report(
                "12:37",
                "an int sent through the client of line 9, which takes "
                "example_interfaces/action/Fibonacci.Goal: TypeError",
            ),
            Report(
                "13:31",
                "the class example_interfaces/action/Fibonacci.Goal sent through "
                "the client of line 9, which takes "
                "example_interfaces/action/Fibonacci.Goal: TypeError",
            ),
            Report(
                "14:31",
                "example_interfaces/action/Fibonacci.Result sent through the client "
                "of line 9, which takes example_interfaces/action/Fibonacci.Goal: "
                "TypeError",
            ),
        ),
        Example(
            "a message type",
            {
                "sender.py": "from std_msgs.msg import String\n"
                + _NODE.format("self, String", _GOAL)
            },
            Report("10:42", "'String' is not an action type"),
            Report(
                "13:37",
                "example_interfaces/action/Fibonacci.Goal sent through the client "
                "of line 10, which takes std_msgs/msg/String.Goal: TypeError",
            ),
        ),
    )

    def check_file(self, types: MessageTypes) -> Iterator[Diagnostic]:
        facts = types.facts
        for entity in [*facts.action_servers, *facts.action_clients]:
            for name in ("node", "action_type"):
                argument = entity.argument(name)
                problem = _problem(facts, argument.node, name) if argument else ""
                if argument and problem:
                    yield self.report(argument, problem)
        yield from self._check_goals(types)

    def _check_goals(self, types: MessageTypes) -> Iterator[Diagnostic]:
        clients = {client.call: client for client in types.facts.action_clients}
        for name in ("send_goal", "send_goal_async") if clients else ():
            for attribute in types.module.index.attributes(name):
                call = types.module.parent(attribute)
                made = types.facts.evaluator.single_value(attribute.value)
                client = clients.get(made) if isinstance(made, ast.Call) else None
                if client is None or not isinstance(call, ast.Call) or call.func is not attribute:
                    continue
                given = _given(types, client, call.args[0]) if call.args else ""
                if given and not types.is_tolerated(call):
                    message = f"{given} sent through the client of line {client.location.line}, "
                    message += f"which takes {client.interface}.Goal: TypeError"
                    yield self.report(types.module.location(call.args[0]), message)


def _problem(file: RclpyFile, node: ast.expr, name: str) -> str:
    """Return the message for a wrong first or second argument of an action server."""
    full = file.module.qualified_name(node) or ""
    if name == "node":
        kind = full.rpartition(".")[2]
        is_type = re.fullmatch(_WHOLE, full) and file.interface(node) is not None
        return f"'{kind}' is not a node; pass the node first, then the type" if is_type else ""
    if re.fullmatch(_WHOLE + r"\.(Goal|Result|Feedback)", full):
        return f"this is only a part of an action; pass {full.split('.')[2]}"
    if re.fullmatch(r"\w+\.(msg|srv)\.[A-Z][A-Za-z0-9]*", full) and file.interface(node):
        return f"{full.rpartition('.')[2]!r} is not an action type"
    return ""


def _given(types: MessageTypes, client: ActionClient, node: ast.expr) -> str:
    """Describe a goal that certainly has another type than the client's; empty for others."""
    if client.interface is None or types.definitions.find(client.interface) is None:
        return ""
    owner = types.type_of(node)
    if owner is not None:
        return owner.name if owner.name != f"{client.interface}.Goal" else ""
    if isinstance(node, ast.Name | ast.Attribute):
        class_ = types.class_of(node)
        whole = types.facts.interface(node)
        return f"the class {class_.name}" if class_ else f"the class {whole}" if whole else ""
    return kind_of(node.value) if isinstance(node, ast.Constant) else ""
