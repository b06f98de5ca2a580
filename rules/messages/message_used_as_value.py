"""MS023: messages are not used as lists or dicts, nor plain values as messages."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, MessageRule, Report
from scaffold.api.interfaces import FLOATS, INTEGER_RANGES, TEXTS, FieldType
from scaffold.api.messages import MessageTypes
from scaffold.api.python import is_for_ros1, is_handled

_NODE = (
    "from rclpy.node import Node\nfrom std_msgs.msg import Float32MultiArray, String\n\n\n"
    "class Listener(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('listener')\n"
    "        self.create_subscription(String, 'chatter', self.on_chatter, 10)\n"
    "        self.create_subscription(Float32MultiArray, 'row', self.on_row, 10)\n\n"
    "    def on_chatter(self, msg):\n"
    "        self.get_logger().info({})\n\n"
    "    def on_row(self, msg):\n"
    "        return {}\n"
)


class MessageUsedAsValue(MessageRule):
    """A message is used as a list, dict or function, or a plain value as a message.

    **Why.** ``TypeError: 'String' object is not subscriptable``, ``AttributeError: 'str' object
    has no attribute 'data'``: in a callback, the first message ends the node.

    **Fix.** Read the field: ``msg.data``, ``msg.data[0]``, ``len(msg.data)``.

    **Source.** ``rosidl_generator_py``: messages are objects with one property for each field;
    fields of plain types are ``bool``, ``int``, ``float`` and ``str``.
    """

    code = "MS023"
    name = "message-used-as-value"
    examples = (
        Example(
            "fields",
            {"listener.py": _NODE.format("msg.data.upper()", "len(msg.data), msg.data[0]")},
        ),
        Example(
            "as a dict, as a list",
            {"listener.py": _NODE.format("msg['data']", "len(msg), msg[0], msg.layout[0]")},
            Report(
                "12:32", "std_msgs/msg/String cannot be indexed: TypeError; use one of its fields"
            ),
            Report(
                "15:16",
                "std_msgs/msg/Float32MultiArray has no length: TypeError; use one of its fields",
            ),
            Report(
                "15:26",
                "std_msgs/msg/Float32MultiArray cannot be indexed: TypeError; use "
                "one of its fields",
            ),
            Report(
                "15:34",
                "std_msgs/msg/MultiArrayLayout cannot be indexed: TypeError; use one of its fields",
            ),
        ),
        Example(
            "a field of a str, a field called, a message iterated over",
            {
                "listener.py": _NODE.format(
                    "msg.data.data", "msg.layout.data_offset(), [x for x in msg]"
                )
            },
            Report("12:32", "msg.data is a str, which has no 'data': AttributeError"),
            Report(
                "15:16", "msg.layout.data_offset is a field, not a method: TypeError; remove the ()"
            ),
            Report(
                "15:54",
                "std_msgs/msg/Float32MultiArray is not iterable: TypeError; use one of its fields",
            ),
        ),
        Example(
            "a message in a for loop",
            {
                "listener.py": _NODE.format("''", "0").replace(
                    "        return", "        for x in msg:\n            print(x)\n        return"
                )
            },
            Report(
                "15:18",
                "std_msgs/msg/Float32MultiArray is not iterable: TypeError; use one of its fields",
            ),
        ),
    )

    def check_file(self, types: MessageTypes) -> Iterator[Diagnostic]:
        for node, problem in _problems(types):
            if is_for_ros1(types.module, node) or types.is_tolerated(node):
                continue
            if not is_handled(types.module, node, "TypeError"):
                yield self.report(types.module.location(node), problem)


def _problems(types: MessageTypes) -> Iterator[tuple[ast.expr, str]]:
    module = types.module
    for node, value, problem in _uses_as_list(types):
        owner = types.type_of(value)
        if owner is not None:
            yield node, f"{owner.name} {problem}: TypeError; use one of its fields"
    for call in module.walk(ast.Call):
        if isinstance(call.func, ast.Attribute) and (
            types.type_of(call.func) or _kind(types.field_type_of(call.func))
        ):
            yield (
                call,
                f"{module.text(call.func)} is a field, not a method: TypeError; remove the ()",
            )
    for node in module.walk(ast.Attribute):
        kind = _kind(types.field_type_of(node.value))
        if kind and not hasattr(_KINDS[kind], node.attr):
            message = f"{module.text(node.value)} is a {kind}, which has no {node.attr!r}"
            yield node, f"{message}: AttributeError"


def _uses_as_list(types: MessageTypes) -> Iterator[tuple[ast.expr, ast.expr, str]]:
    """Yield uses that only collections support: the expression, the collection, the problem."""
    for index in types.module.walk(ast.Subscript):
        yield index, index.value, "cannot be indexed"
    for call in types.module.walk(ast.Call):
        match call:
            case ast.Call(func=ast.Name(id="len"), args=[counted]):
                yield call, counted, "has no length"
    for loop in types.module.walk(ast.For):
        yield loop.iter, loop.iter, "is not iterable"
    for part in types.module.walk(ast.comprehension):
        yield part.iter, part.iter, "is not iterable"


_KINDS: dict[str, type] = {"bool": bool, "float": float, "int": int, "str": str}


def _kind(type_: FieldType | None) -> str:
    """Return the Python type of a field of a plain type; empty for other fields."""
    if type_ is None or type_.is_array or not type_.is_primitive or type_.name == "byte":
        return ""
    if type_.name in FLOATS:
        return "float"
    if type_.name in TEXTS:
        return "str"
    return "int" if type_.name in INTEGER_RANGES else "bool"
