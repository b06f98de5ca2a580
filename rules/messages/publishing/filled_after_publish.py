"""MS035: messages are filled before they are published."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, MessageRule
from scaffold.api.messages import MessageTypes

_NODE = (
    "from rclpy.node import Node\nfrom sensor_msgs.msg import JointState\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.publisher = self.create_publisher(JointState, 'joints', 10)\n"
    "        self.create_timer(1.0, self.tick)\n\n"
    "    def tick(self):\n"
    "        joints = JointState(name=['arm'])\n"
    "{}"
)
_FILL = "        joints.position = [0.5]\n"
_SEND = "        self.publisher.publish(joints)\n"
_LOOPS = (ast.For, ast.While)
_Place = ast.Name | ast.Attribute | ast.Subscript


class FilledAfterPublish(MessageRule):
    """A field of a message is set after the message was published, and it is not published again.

    **Why.** ``publish()`` sends the message as it is at that time: subscribers get the default
    value of the field.

    **Fix.** Set all fields before ``publish()``.

    **Source.** ``rclpy/publisher.py``, ``publish``.
    """

    code = "MS035"
    name = "filled-after-publish"
    examples = (
        Example("field set before publishing", {"talker.py": _NODE.format(_FILL + _SEND)}),
        Example(
            "message published again after the field is set",
            {"talker.py": _NODE.format(_SEND + _FILL + _SEND)},
        ),
        Example(
            "message published again in a loop, message stored for later",
            {
                "talker.py": _NODE.format(
                    "        for _ in range(2):\n    " + _SEND + "    " + _FILL
                ),
                "other.py": _NODE.format(_SEND + _FILL + "        self.last = joints\n"),
            },
        ),
        Example(
            "field set after publishing",
            {"talker.py": _NODE.format(_SEND + _FILL)},
            "14:9: joints.position is set after joints was published in line 13: subscribers do "
            "not get it; publish last",
        ),
    )

    def check_file(self, types: MessageTypes) -> Iterator[Diagnostic]:
        for sent, _ in types.module.method_calls("publish"):
            match sent:
                case ast.Call(args=[ast.Name() as name]):
                    late = _first_set_after(types, sent, name)
                    if late is not None:
                        line = types.module.location(sent).line
                        field = types.module.text(late)
                        message = f"set after {name.id} was published in line {line}"
                        yield self.report(
                            types.module.location(late),
                            f"{field} is {message}: subscribers do not get it; publish last",
                        )


def _first_set_after(types: MessageTypes, sent: ast.Call, name: ast.Name) -> ast.expr | None:
    """Return the first field that is set after the last use of a message: to publish it."""
    module = types.module
    statement, made = module.parent(sent), module.index.only_value(name)
    is_message = isinstance(made, ast.Call) and types.class_of(made.func) is not None
    if not isinstance(statement, ast.Expr) or made is None or not is_message:
        return None
    if module.enclosing(made, *_LOOPS) is not module.enclosing(sent, *_LOOPS):
        return None
    if module.enclosing_function(made) is not module.enclosing_function(sent):
        return None
    later = [use for use in module.index.uses_of(name) if use.lineno > statement.lineno]
    fields = [_whole(types, use) for use in later]
    if not fields or not all(isinstance(field.ctx, ast.Store) for field in fields):
        return None
    return fields[0] if _follows(types, statement, fields[0]) else None


def _whole(types: MessageTypes, use: ast.Name) -> _Place:
    """Return the field of a field that begins with a name: ``msg.pose.position.x``."""
    place: _Place = use
    above = types.module.parent(place)
    while isinstance(above, ast.Attribute | ast.Subscript) and above.value is place:
        place, above = above, types.module.parent(above)
    return place


def _follows(types: MessageTypes, statement: ast.stmt, later: ast.expr) -> bool:
    """Return whether an expression is in a statement after another one of the same block."""
    index, above = types.module.index, types.module.parent(statement)
    block, number = index.place(statement)
    for other in types.module.parents(later):
        if types.module.parent(other) is above:
            its_block, its_number = index.place(other)
            return its_block == block and its_number > number
    return False
