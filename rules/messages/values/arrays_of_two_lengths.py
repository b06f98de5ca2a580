"""MS028: the arrays of a joint state have the same length."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping

from scaffold.api import Diagnostic, Example, MessageRule, Report, Severity
from scaffold.api.messages import MessageTypes

_NODE = (
    "from sensor_msgs.msg import JointState\n\n\n"
    "def state():\n"
    "    msg = JointState()\n"
    "    msg.name = ['left', 'right']\n"
    "    msg.position = {}\n"
    "    return msg, JointState(name=['a'], velocity={})\n"
)
_PARALLEL: Mapping[str, tuple[str, tuple[str, ...]]] = {
    "sensor_msgs/msg/JointState": ("name", ("position", "velocity", "effort")),
    "sensor_msgs/msg/MultiDOFJointState": ("joint_names", ("transforms", "twist", "wrench")),
    "control_msgs/msg/JointJog": ("joint_names", ("displacements", "velocities")),
}

_UNREAD = frozenset({("sensor_msgs/msg/JointState", name) for name in ("velocity", "effort")})
_LATER = "robot_state_publisher does not check this, others reject it"


class ArraysOfTwoLengths(MessageRule):
    """A message has a different number of joint names and values.

    **Why.** robot_state_publisher ignores the message: ``Robot state publisher ignored an invalid
    JointState message``. Other subscribers may read past the end of the shorter array.

    **Fix.** Set one value for each name, in the same order, or leave the array empty.

    **Source.** ``sensor_msgs/msg/JointState``; robot_state_publisher, ``callbackJointState``.
    """

    code = "MS028"
    name = "arrays-of-two-lengths"
    other_severities = {Severity.WARNING: "the array is the velocity or effort of a joint state"}
    examples = (
        Example("arrays of the same length, or empty", {"a.py": _NODE.format("[0.0, 1.0]", "[]")}),
        Example(
            "list multiplied by a number",
            {"a.py": _NODE.format("[0.0] * 3", "[*read(3)]")},
            "7:20: position has 3 values for 2 names: the message is ignored; give one for each",
        ),
        Example(
            "names from attributes: constant, and extended by another method",
            {
                "a.py": "from rclpy.node import Node\nfrom sensor_msgs.msg import JointState\n\n"
                "ARM = ['shoulder', 'elbow']\n\n\n"
                "class Joints(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('joints')\n"
                "        self.names = [*ARM, 'gripper']\n"
                "        self.found = ['base']\n\n"
                "    def find(self, name, angle):\n"
                "        self.found.append(name)\n"
                "        angles = [angle]\n"
                "        angles.append(0.0)\n"
                "        first = JointState(name=self.found, position=angles)\n"
                "        return first, JointState(name=self.names, position=angles)\n"
            },
            "18:60: position has 2 values for 3 names: the message is ignored; give one for each",
        ),
        Example(
            "too few positions, too many velocities",
            {"a.py": _NODE.format("[0.0]", "[1.0, 2.0]")},
            "7:20: position has 1 values for 2 names: the message is ignored; give one for each",
            Report(
                "8:49",
                "velocity has 2 values for 1 names: robot_state_publisher does not "
                "check this, others reject it; give one for each",
                severity=Severity.WARNING,
            ),
        ),
    )

    def check_file(self, types: MessageTypes) -> Iterator[Diagnostic]:
        module = types.module
        if module.in_tests:
            return  # test messages may be wrong on purpose
        given: dict[tuple[ast.AST | None, str, str], dict[str, list[ast.expr]]] = {}
        for item in types.assigned:
            if item.owner.name in _PARALLEL:
                holder = module.text(item.holder)
                key = (module.enclosing_function(item.holder), holder, item.owner.name)
                given.setdefault(key, {}).setdefault(item.field.name, []).append(item.value)
        for (_, _, owner), fields in given.items():
            names, others = _PARALLEL[owner]
            count = _length(types, fields.get(names, []))
            for name in others:
                length = _length(types, fields.get(name, []))
                if count and length and count != length:
                    message = (
                        f"{name} has {length} values for {count} names: {{}}; give one for each"
                    )
                    is_read = (owner, name) not in _UNREAD
                    yield self.report(
                        module.location(fields[name][0]),
                        message.format("the message is ignored" if is_read else _LATER),
                        severity=None if is_read else Severity.WARNING,
                    )


def _length(types: MessageTypes, values: list[ast.expr]) -> int | None:
    """Return the length of a literal list that is assigned once."""
    if len(values) != 1:
        return None
    given = values[0]
    if isinstance(given, ast.Attribute):
        uses = types.module.index.attributes(given.attr)
        if any(isinstance(types.module.parent(use), ast.Attribute | ast.AugAssign) for use in uses):
            return None  # such as names.append()
        given = types.file.evaluator.single_value(given)
    elements = types.file.evaluator.elements(given)
    is_known = elements.complete and not any(item.conditional for item in elements.items)
    return len(elements.items) if is_known else None
