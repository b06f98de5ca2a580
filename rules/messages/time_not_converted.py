"""MS005: rclpy times are converted for messages."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, MessageRule, Report
from scaffold.api.messages import MessageTypes, rclpy_time
from scaffold.api.python import PythonModule

_OF_BUFFERS = frozenset({"set_transform", "set_transform_static", "transform"})

_CODE = (
    "from rclpy.node import Node\nfrom sensor_msgs.msg import Temperature\n\n\n"
    "class Talker(Node):\n"
    "    def talk(self, other):\n"
    "        reading = Temperature()\n"
    "        reading.header.stamp = self.get_clock().now(){}\n"
    "        other.header.stamp = self.get_clock().now(){}\n"
)


class TimeNotConverted(MessageRule):
    """An rclpy Time or Duration is assigned to a message field.

    **Why.** ``AttributeError: 'Time' object has no attribute 'sec'`` when the message is
    published; on some builds the node aborts without an error message.

    **Fix.** Append ``.to_msg()``.

    **Source.** ``rclpy/time.py``, ``Time.to_msg``; ROS 2 documentation, "Writing a tf2
    broadcaster (Python)".
    """

    code = "MS005"
    name = "time-not-converted"
    examples = (
        Example("converted", {"talker.py": _CODE.format(".to_msg()", ".to_msg()")}),
        Example(
            "for a buffer of transforms, which reads both",
            {
                "talker.py": "from geometry_msgs.msg import TransformStamped\n"
                "from rclpy.time import Time\nfrom tf2_py import BufferCore\n\n\n"
                "def fill():\n"
                "    transform = TransformStamped()\n"
                "    transform.header.stamp = Time(seconds=1)\n"
                "    BufferCore().set_transform(transform, 'test')\n",
                "ask.py": "from geometry_msgs.msg import Vector3Stamped\n"
                "from rclpy.time import Time\n\n\n"
                "def ask(buffer, vector):\n"
                "    stamped = Vector3Stamped()\n"
                "    stamped.header.frame_id = 'tool0'\n"
                "    stamped.header.stamp = Time()\n"
                "    stamped.vector = vector\n"
                "    return buffer.transform(stamped, 'base')\n",
            },
        ),
        Example(
            "the time of the clock, for a field and for the header of an unknown message",
            {"talker.py": _CODE.format("", "")},
            Report(
                "8:32",
                "stamp is a builtin_interfaces/msg/Time, but this is an rclpy Time: "
                "AttributeError when published; append .to_msg()",
                fix="append .to_msg()",
            ),
            Report(
                "9:30",
                "header.stamp is a builtin_interfaces/msg/Time, but this is an "
                "rclpy Time: AttributeError when published; append .to_msg()",
                fix="append .to_msg()",
            ),
            fixed={"talker.py": _CODE.format(".to_msg()", ".to_msg()")},
        ),
    )

    def check_file(self, types: MessageTypes) -> Iterator[Diagnostic]:
        for value, field in _times(types):
            kind = rclpy_time(types, value)
            if kind is None or _is_for_buffer(types.module, value):
                continue
            _, end = types.module.span(value)
            fix = None
            if isinstance(value, ast.Call | ast.Name | ast.Attribute):
                edit = Edit(types.module.path, end, end, ".to_msg()")
                fix = Fix("append .to_msg()", (edit,))
            given = kind.rpartition("/")[2]
            message = (
                f"{field} is a {kind}, but this is an rclpy {given}: "
                "AttributeError when published; append .to_msg()"
            )
            yield self.report(types.module.location(value), message, fix)


def _times(types: MessageTypes) -> Iterator[tuple[ast.expr, str]]:
    """Yield the values assigned to time fields, and the names of the fields."""
    headers: set[ast.expr] = set()
    for item in types.assigned:
        headers.add(item.value)
        if item.field.type.package == "builtin_interfaces":
            yield item.value, item.field.name
    for store in types.file.evaluator.stores("stamp"):
        holder = store.node.value
        in_header = isinstance(holder, ast.Attribute) and holder.attr == "header"
        if in_header and store.value is not None and store.value not in headers:
            yield store.value, "header.stamp"


def _is_for_buffer(module: PythonModule, value: ast.expr) -> bool:
    """Tell whether the message is only handed to a buffer of tf2, whose code in C reads both."""
    match module.parent(value):
        case ast.Assign(targets=[ast.Attribute(value=ast.Attribute(value=ast.Name(id=name)))]):
            scope = module.index.scope_of(value)
            calls = [
                call
                for call in module.below(scope, ast.Call)
                if any(isinstance(item, ast.Name) and item.id == name for item in call.args)
            ]
            return bool(calls) and all(
                isinstance(call.func, ast.Attribute) and call.func.attr in _OF_BUFFERS
                for call in calls
            )
    return False
