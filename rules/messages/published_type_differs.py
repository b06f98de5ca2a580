"""MS004: messages have the type of their publisher or client."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, MessageRule, Report
from scaffold.api.messages import MessageTypes
from scaffold.api.rclpy import Client, Endpoint, Publisher

_SENDS = {"publish": Publisher, "call_async": Client, "call": Client}
_NODE = (
    "from rclpy.node import Node\nfrom std_msgs.msg import Bool, String\n"
    "from std_srvs.srv import Trigger\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.pub = self.create_publisher(String, 'chatter', 10)\n"
    "        self.client = self.create_client(Trigger, 'report')\n\n"
    "    def talk(self):\n"
    "        self.pub.publish({})\n"
    "        self.client.call_async({})\n"
)


class PublishedTypeDiffers(MessageRule):
    """A publisher or client is used with a message of another type than its own.

    **Why.** ``TypeError: Expected <class 'std_msgs.msg._string.String'>, got <class ...>`` as
    soon as the line is reached.

    **Fix.** Use a publisher of that type, or change the type of the publisher.

    **Source.** ``rclpy/publisher.py``, ``Publisher.publish``; ``rclpy/client.py``.
    """

    code = "MS004"
    name = "published-type-differs"
    examples = (
        Example(
            "the right types, serialized messages, unknown values",
            {
                "talker.py": _NODE.format("String(data='hello')", "Trigger.Request()")
                + "        self.pub.publish(b'raw')\n        self.pub.publish(self.other)\n"
            },
        ),
        Example(
            "another message, the response of a service",
            {"talker.py": _NODE.format("Bool(data=True)", "Trigger.Response()")},
            Report(
                "13:26",
                "std_msgs/msg/Bool sent through the publisher of line 9, which "
                "takes std_msgs/msg/String: TypeError",
            ),
            Report(
                "14:32",
                "std_srvs/srv/Trigger.Response sent through the client of line 10, "
                "which takes std_srvs/srv/Trigger.Request: TypeError",
            ),
        ),
        Example(
            "a str without its message, the class",
            {"talker.py": _NODE.format("'hello'", "Trigger.Request")},
            Report(
                "13:26",
                "a str sent through the publisher of line 9, which takes "
                "std_msgs/msg/String: TypeError",
            ),
            Report(
                "14:32",
                "the class std_srvs/srv/Trigger.Request sent through the client of "
                "line 10, which takes std_srvs/srv/Trigger.Request: TypeError",
            ),
        ),
        Example(
            "the class of the service",
            {"talker.py": _NODE.format("String()", "Trigger")},
            Report(
                "14:32",
                "the class std_srvs/srv/Trigger sent through the client of line 10, "
                "which takes std_srvs/srv/Trigger.Request: TypeError",
            ),
        ),
        Example(
            "a number, a field of a response",
            {"talker.py": _NODE.format("1.5", "Trigger.Response().message")},
            Report(
                "13:26",
                "a number sent through the publisher of line 9, which takes "
                "std_msgs/msg/String: TypeError",
            ),
            Report(
                "14:32",
                "field 'message' sent through the client of line 10, which takes "
                "std_srvs/srv/Trigger.Request: TypeError",
            ),
        ),
    )

    def check_file(self, types: MessageTypes) -> Iterator[Diagnostic]:
        calls = {endpoint.call: endpoint for endpoint in types.facts.endpoints}
        for call in types.module.walk(ast.Call):
            endpoint = _sender(types, call, calls)
            if endpoint is None or endpoint.interface is None or types.is_tolerated(call):
                continue
            wanted = endpoint.interface
            if isinstance(endpoint, Client):
                wanted += ".Request"
            given = _given(types, call.args[0])
            if given and given != wanted and types.definitions.find(endpoint.interface):
                kind = "client" if isinstance(endpoint, Client) else "publisher"
                message = (
                    f"{given} sent through the {kind} of line {endpoint.location.line}, "
                    f"which takes {wanted}: TypeError"
                )
                yield self.report(types.module.location(call.args[0]), message)


def _sender(
    types: MessageTypes, call: ast.Call, calls: dict[ast.Call, Endpoint]
) -> Endpoint | None:
    func = call.func
    if not isinstance(func, ast.Attribute) or func.attr not in _SENDS or len(call.args) != 1:
        return None
    made = types.facts.evaluator.single_value(func.value)
    endpoint = calls.get(made) if isinstance(made, ast.Call) else None
    return endpoint if isinstance(endpoint, _SENDS[func.attr]) else None


def _given(types: MessageTypes, node: ast.expr) -> str | None:
    """Describe the value that is sent, if it is certain."""
    owner = types.type_of(node)
    if owner is not None:
        return owner.name
    value = types.facts.evaluator.evaluate(node)
    if isinstance(node, ast.JoinedStr) or isinstance(value, str):
        return "a str"
    if isinstance(value, int | float):
        return "a number"
    if isinstance(node, ast.Attribute) and (owner := types.type_of(node.value)) is not None:
        field = owner.section.field(node.attr)
        return f"field {node.attr!r}" if field and field.type.is_primitive else None
    if isinstance(node, ast.Name | ast.Attribute):
        class_ = types.class_of(node)
        name = class_.name if class_ else types.facts.interface(node)
        return f"the class {name}" if name else None
    return None
