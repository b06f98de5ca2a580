"""MS002: message fields that are read or set exist."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, MessageRule
from scaffold.api.distributions import removed_interface
from scaffold.api.interfaces import closest_word
from scaffold.api.messages import PARTS, MessageClass, MessageTypes, is_error_expected
from scaffold.api.python import is_expected

from ._named_fields import named_fields

_CLASS_PARTS = frozenset({"Request", "Response", "Event", "Goal", "Result", "Feedback", "Impl"})
_RAISED = frozenset({"AttributeError"})
_NODE = (
    "from rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
    "class Listener(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('listener')\n"
    "        self.create_subscription(String, 'chatter', self.on_chatter, 10)\n\n"
    "    def on_chatter(self, msg):\n"
    "        self.get_logger().info(msg.{})\n"
)
_NODE_WRAPPED = (
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

_BY_NAME = (
    "from rclpy.node import Node\nfrom sensor_msgs.msg import Imu\n\n"
    "FIELDS = [('angular_velocity', 'xyz'), ('{}', 'xy{}')]\n\n\n"
    "class Driver(Node):\n"
    "    def read(self, values):\n"
    "        imu = Imu()\n"
    "        for vector, axes in FIELDS:\n"
    "            part = getattr(imu, vector)\n"
    "            for axis in axes:\n"
    "                setattr(part, axis, values.pop())\n"
    "        return imu\n"
)


class MessageFieldUnknown(MessageRule):
    """Code reads or sets a field that the message, or what wraps it, does not have.

    **Why.** ``AttributeError: 'String' object has no attribute 'text'``; in a callback, the
    first message crashes the node. Action feedback and results are wrapped in another message:
    ``'Fibonacci_FeedbackMessage' object has no attribute 'sequence'``.

    **Fix.** Use a field of the definition: ``ros2-scaffold interfaces String`` shows it; for
    actions, ``message.feedback.sequence`` and ``future.result().result.sequence``. Only objects
    that are certainly messages are checked: those a constructor returns, and the parameters that
    rclpy passes to callbacks.

    **Source.** ``rosidl_generator_py``: the classes have ``__slots__``; ROS 2 documentation,
    "Writing an action server and client (Python)".
    """

    code = "MS002"
    name = "message-field-unknown"
    examples = (
        Example("fields by name", {"driver.py": _BY_NAME.format("linear_acceleration", "z")}),
        Example(
            "an unknown field in a table",
            {"driver.py": _BY_NAME.format("linear_accel", "z")},
            "4:41: sensor_msgs/msg/Imu has no field or constant 'linear_accel'; did you mean "
            "'linear_acceleration'? (definition: sensor_msgs 5.3.6 of ROS 2 Jazzy)",
        ),
        Example(
            "an unknown field of a field in a table",
            {"driver.py": _BY_NAME.format("linear_acceleration", "w")},
            "4:64: geometry_msgs/msg/Vector3 has no field or constant 'w'; it has x, y, z "
            "(definition: geometry_msgs 5.3.6 of ROS 2 Jazzy)",
        ),
        Example("existing field", {"listener.py": _NODE.format("data")}),
        Example(
            "subscription with a message type that other code may set",
            {
                "listener.py": _NODE.replace("n(String", "n(self.kind")
                .replace(
                    "        self.create",
                    "        if not hasattr(self, 'kind'):\n            self.kind = String\n"
                    "        self.create",
                )
                .format("text")
            },
        ),
        Example(
            "unknown field in a callback",
            {"listener.py": _NODE.format("text")},
            "11:36: std_msgs/msg/String has no field or constant 'text'; it has data (definition: "
            "std_msgs 5.3.6 of ROS 2 Jazzy)",
        ),
        Example(
            "methods that the file adds to a class",
            {
                "times.py": "import builtin_interfaces.msg\nfrom std_msgs.msg import Header\n\n\n"
                "def seconds(time):\n    return time.sec + time.nanosec / 1e9\n\n\n"
                "builtin_interfaces.msg.Time.to_sec = seconds\n"
                "Header.seq = property(lambda self: 0)\n"
                "print(Header().stamp.to_sec(), Header().seq, Header.seq)\n"
            },
        ),
        Example(
            "callback that another library calls as well",
            {
                "listener.py": _NODE.format("text")
                + "\n    def listen(self, port):\n        port.found += self.on_chatter\n"
            },
        ),
        Example(
            "unknown nested fields, response fields and constants",
            {
                "talker.py": "from geometry_msgs.msg import Twist\n"
                "from diagnostic_msgs.msg import DiagnosticStatus\n"
                "from std_srvs.srv import SetBool\n\n\n"
                "def make(other):\n"
                "    twist = Twist()\n"
                "    twist.linear.y = 1.0\n"
                "    twist.linear.yaw = 1.0\n"
                "    twist.speed = 1.0\n"
                "    answer = SetBool.Response()\n"
                "    answer.succes = DiagnosticStatus.OKAY\n"
                "    mixed = Twist()\n"
                "    mixed = other\n"
                "    mixed.anything = 1\n"
            },
            "9:18: geometry_msgs/msg/Vector3 has no field or constant 'yaw'; it has x, y, z "
            "(definition: geometry_msgs 5.3.6 of ROS 2 Jazzy)",
            "10:11: geometry_msgs/msg/Twist has no field or constant 'speed'; it has linear, "
            "angular (definition: geometry_msgs 5.3.6 of ROS 2 Jazzy)",
            "12:12: std_srvs/srv/SetBool.Response has no field or constant 'succes'; did you mean "
            "'success'? (definition: std_srvs 5.3.6 of ROS 2 Jazzy)",
            "12:38: diagnostic_msgs/msg/DiagnosticStatus has no field or constant 'OKAY'; did you "
            "mean 'OK'? (definition: diagnostic_msgs 5.3.6 of ROS 2 Jazzy)",
        ),
        Example(
            "field removed in this distribution",
            {
                "talker.py": "from lifecycle_msgs.msg import TransitionEvent\n\n"
                "event = TransitionEvent()\nevent.timestamp = 3\n"
            },
            "4:7: 'timestamp' of lifecycle_msgs/msg/TransitionEvent was removed in Lyrical: use "
            "stamp, a builtin_interfaces/msg/Time; timestamp counted nanoseconds (rcl_interfaces "
            "2.4)",
            distro="lyrical",
        ),
        Example(
            "misspelled Request class of a service",
            {"talker.py": "from std_srvs.srv import SetBool\n\nrequest = SetBool.Requests()\n"},
            "3:19: std_srvs/srv/SetBool has no 'Requests': AttributeError; did you mean 'Request'?",
        ),
        Example(
            "fields read from .feedback and .result",
            {"sender.py": _NODE_WRAPPED.format(".feedback", ".result")},
        ),
        Example(
            "fields read without .feedback and .result",
            {"sender.py": _NODE_WRAPPED.format("", "")},
            "16:21: this wrapper has only 'feedback' and 'goal_id', not 'sequence': "
            "AttributeError; use .feedback.sequence",
            "24:21: this wrapper has only 'result' and 'status', not 'sequence': AttributeError; "
            "use .result.sequence",
        ),
        Example(
            "next to handlers of this error and of another one",
            {
                "talker/node.py": "from std_srvs.srv import SetBool\n\n\n"
                "def flag():\n    try:\n        return int(SetBool.request.data)\n"
                "    except ValueError:\n        return 0\n\n\n"
                "def old_flag():\n    try:\n        return SetBool.request.data\n"
                "    except AttributeError:\n        return 0\n"
            },
            "6:28: std_srvs/srv/SetBool has no 'request': AttributeError; did you mean 'Request'?",
        ),
    )

    def check_file(self, types: MessageTypes) -> Iterator[Diagnostic]:
        yield from self._check_wrapped(types)
        added = _added_to_classes(types)
        for node in types.module.walk(ast.Attribute):
            message = _problem(types, node, added)
            if message and not is_error_expected(types.module, node, _RAISED):
                start, end = types.module.span(node)
                at = types.module.source.location(max(start, end - len(node.attr)), end)
                cause = f"fields of {message.partition(' has no ')[0]}"
                yield self.report(at, message, cause=cause)

        for owner, name in named_fields(types):
            field = str(name.value)
            if field.isidentifier() and not owner.allows(field) and name.value is not None:
                message = _message(owner, field)
                yield self.report(
                    types.module.location(name), message, cause=f"fields of {owner.name}"
                )

    def _check_wrapped(self, types: MessageTypes) -> Iterator[Diagnostic]:
        if not types.file.action_clients:
            return
        for node in types.module.walk(ast.Attribute):
            message = _message_wrapped(types, node)
            if message and not is_expected(types.module, node, "AttributeError"):
                yield self.report(types.module.location(node), message)


def _added_to_classes(types: MessageTypes) -> set[tuple[str, str]]:
    """Return what the file adds to message classes: ``Time.to_sec = to_sec``."""
    places = [node for node in types.module.walk(ast.Attribute) if isinstance(node.ctx, ast.Store)]
    classes = ((types.class_of(node.value), node.attr) for node in places)
    return {(class_.name, name) for class_, name in classes if class_ is not None}


def _problem(types: MessageTypes, node: ast.Attribute, added: set[tuple[str, str]]) -> str | None:
    owner = types.type_of(node.value)
    if owner is not None:
        is_known = owner.allows(node.attr) or (owner.name, node.attr) in added
        return None if is_known else _message(owner, node.attr)
    if not isinstance(node.value, ast.Name | ast.Attribute):
        return None
    class_ = types.class_of(node.value)
    if class_ is not None:
        is_known = class_.allows(node.attr) or node.attr in _CLASS_PARTS
        is_known = is_known or (class_.name, node.attr) in added
        return None if is_known or hasattr(type, node.attr) else _message(class_, node.attr)
    return _unknown_part(types, node)


def _message(owner: MessageClass, name: str) -> str:
    change = removed_interface(f"{owner.name}.{name}")
    if change is not None:
        return f"{name!r} of {owner.name} {change.state}: {change.advice} ({change.source})"
    fields = [field.name for field in owner.section.fields]
    hint = closest_word(name, [*fields, *(constant.name for constant in owner.section.constants)])
    if not hint and fields:
        more = " ..." if len(fields) > 5 else ""  # noqa: PLR2004  as many as fit a line
        hint = f"; it has {', '.join(fields[:5])}{more}"
    return f"{owner.name} has no field or constant {name!r}{hint} (definition: {owner.origin})"


def _unknown_part(types: MessageTypes, node: ast.Attribute) -> str | None:
    """Return the message for ``SetBool.Requests``."""
    dotted = (types.module.qualified_name(node.value) or "").split(".")
    if len(dotted) != 3 or not PARTS.get(dotted[1]):  # noqa: PLR2004  package, kind and name
        return None
    full_name = "/".join(dotted)
    if types.definitions.find(full_name) is None or node.attr in _CLASS_PARTS:
        return None
    if hasattr(type, node.attr) or node.attr.startswith("_"):
        return None
    hint = closest_word(node.attr, [*PARTS[dotted[1]]])
    return f"{full_name} has no {node.attr!r}: AttributeError{hint}"


def _message_wrapped(types: MessageTypes, node: ast.Attribute) -> str:
    wrapped = types.action_messages.wrapped(node.value)
    if wrapped is None or node.attr in {wrapped.field, wrapped.other} or node.attr.startswith("_"):
        return ""
    if node.attr in {"get_fields_and_field_types", "SLOT_TYPES"}:
        return ""
    return (
        f"this wrapper has only {wrapped.field!r} and {wrapped.other!r}, not {node.attr!r}: "
        f"AttributeError; use .{wrapped.field}.{node.attr}"
    )
