"""ND055: functions of rclpy get arguments of the right types, in the right order."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, RclpyRule, Report
from scaffold.api.python import UNKNOWN, argument_of, kind_of
from scaffold.api.rclpy import (
    Argument,
    Client,
    Endpoint,
    Entity,
    Parameter,
    RclpyFile,
    Service,
    Timer,
)

_TYPES = ("msg_type", "srv_type", "action_type")
_NAMES = ("topic", "srv_name", "action_name")
_CALLBACKS = ("callback", "execute_callback")
_TOPICS = frozenset({"rosbag2_py.TopicMetadata", "rosbag2_py._storage.TopicMetadata"})
_FULL_NAME = r"[a-z][a-z0-9_]*/(?:msg|srv|action)/[A-Za-z0-9_]+"
_NODE = (
    "from rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.create_publisher({}, 'chatter', 10)\n"
    "        self.create_timer(0.1, {})\n"
    "        self.declare_parameter('gains', {})\n\n"
    "    def tick(self):\n        pass\n"
)
_HELPER = {
    "talker/__init__.py": "",
    "talker/base.py": "class Helper:\n    def create_client(self, kind, name):\n        pass\n",
    "talker/pull.py": "import rclpy\nfrom std_srvs.srv import Trigger\n\n"
    "from .base import Helper\n\n\n"
    "class Pull(Helper):\n    def client(self) -> rclpy.node.Client:\n"
    "        return self.create_client(Trigger, ('mission', 'pull'))\n",
}
_ASKER = (
    "from rclpy.callback_groups import MutuallyExclusiveCallbackGroup\n"
    "from rclpy.node import Node\nfrom std_msgs.msg import String\n"
    "from std_srvs.srv import Trigger\n\n\n"
    "class Asker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('asker')\n"
    "        self.create_client({}, {}, callback_group={})\n"
)
_CLIENT = "        self.create_client({}, {}, callback_group={})\n"
_NODE_ORDER = (
    "from rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.create_publisher({}, 10)\n"
    "        self.create_timer({})\n\n"
    "    def tick(self):\n"
    "        pass\n"
)
_SENDER = (
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


class ArgumentUnusable(RclpyRule):
    """An rclpy function gets an argument of the wrong type, or its first two arguments are swapped.

    **Why.** ``TypeError: 'str' object is not callable`` and the like, at start or at the first
    call. ``create_timer`` takes the period first, ``create_publisher`` and the like the type.

    **Fix.** Pass what the parameter expects: a class for a type, a str for a name, a function for a
    callback; swap swapped arguments.

    **Source.** ``rclpy/node.py``, ``rclpy/parameter.py``.
    """

    code = "ND055"
    name = "argument-unusable"
    examples = (
        Example(
            "valid arguments", {"talker.py": _NODE.format("String", "self.tick", "[1.0, 2.0]")}
        ),
        Example("a method of the same name", _HELPER),
        Example(
            "an object, a str, mixed types",
            {"talker.py": _NODE.format("String()", "'tick'", "[1, 2.0]")},
            "8:31: this is an instance, not the message type; remove the parentheses",
            "9:32: the callback must be a function, but this is a str: TypeError",
            "10:41: a list parameter cannot mix float, int: TypeError",
        ),
        Example(
            "a QoS profile",
            {
                "talker.py": "from rclpy.qos import QoSProfile\n"
                + _NODE.format("QoSProfile(depth=1)", "self.tick", "[1.0]")
            },
            "9:31: this is a QoSProfile instead of the message type: AttributeError",
        ),
        Example(
            "a dictionary",
            {"talker.py": _NODE.format("String", "self.tick", "{'p': 1.0}")},
            "10:41: a parameter cannot hold a dict: TypeError; declare a parameter for each key",
        ),
        Example(
            "a name, a callback group, a service type",
            {
                "asker.py": _ASKER.format("Trigger.Request", "'report'", "'alone'")
                + _CLIENT.format("String", "7", "MutuallyExclusiveCallbackGroup")
            },
            "10:28: this is only one part of a service: RuntimeError; pass Trigger",
            "10:70: the callback group must be a CallbackGroup, but this is a str: AttributeError",
            "11:28: 'String' is not a service type: RuntimeError",
            "11:36: the name must be a str, but this is an int: TypeError",
            "11:54: this is a class, not a callback group; instantiate it",
        ),
        Example(
            "topic types in a bag",
            {
                "record.py": "import rclpy\nimport rosbag2_py\n\n\n"
                "def topics(kind):\n"
                "    for name in ('std_msgs/msg/String', 'String', 'std_msgs.msg.String'):\n"
                "        yield rosbag2_py.TopicMetadata(\n"
                "            id=0, name='a', type=name, serialization_format='cdr')\n"
                "    yield rosbag2_py.TopicMetadata(\n"
                "        id=0, name='a', type='String', serialization_format='cdr')\n"
                "    yield rosbag2_py.TopicMetadata(\n"
                "        id=0, name='a', type='std_msgs/msg/String', serialization_format='cdr')\n"
            },
            "10:30: 'String' is not a full type name, such as 'std_msgs/msg/String': the bag "
            "cannot be read",
        ),
        Example(
            "period and type in the right order",
            {"talker.py": _NODE_ORDER.format("String, 'chatter'", "0.5, self.tick")},
        ),
        Example(
            "swapped",
            {"talker.py": _NODE_ORDER.format("'chatter', String", "self.tick, 0.5")},
            Report(
                "8:31",
                "swapped arguments: the type comes first, then the name 'chatter'",
                fix="Swap the arguments",
            ),
            Report(
                "9:27",
                "swapped arguments: create_timer() takes the period first, then the callback",
                fix="Swap the arguments",
            ),
            fixed={"talker.py": _NODE_ORDER.format("String, 'chatter'", "0.5, self.tick")},
        ),
        Example("an action type", {"sender.py": _SENDER.format("self, Fibonacci", _GOAL)}),
        Example(
            "a part of an action",
            {"sender.py": _SENDER.format("self, Fibonacci.Goal", _GOAL)},
            "9:42: this is only one part of an action; pass Fibonacci",
        ),
        Example(
            "a message type",
            {
                "sender.py": "from std_msgs.msg import String\n"
                + _SENDER.format("self, String", _GOAL)
            },
            "10:42: 'String' is not an action type",
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        yield from self._check_types(file)
        yield from self._check_order(file)
        for call in file.module.walk(ast.Call):
            if file.module.qualified_name(call.func) in _TOPICS:
                given = argument_of(call, "type")
                name = file.evaluator.evaluate(given) if given is not None else ""
                if given is None or not isinstance(name, str) or not name:
                    continue
                if not re.fullmatch(_FULL_NAME, name):
                    message = f"{name!r} is not a full type name, such as "
                    message += "'std_msgs/msg/String': the bag cannot be read"
                    yield self.report(file.module.location(given), message)

    def _check_types(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for entity in file.entities:
            for argument in entity.arguments.values():
                problem = _problem(file, entity, argument)
                if problem:
                    yield self.report(argument, problem)

    def _check_order(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for entity in file.entities:
            wanted = self._swapped_arguments(file, entity)
            if wanted:
                first, second = entity.call.args[:2]
                path = file.module.path
                edits = (
                    Edit(path, *file.module.span(first), file.module.text(second)),
                    Edit(path, *file.module.span(second), file.module.text(first)),
                )
                at = file.module.location(first)
                yield self.report(at, wanted, Fix("Swap the arguments", edits))

    def _swapped_arguments(self, file: RclpyFile, entity: Entity) -> str | None:
        """Return the message if the first two arguments are certainly swapped."""
        if len(entity.call.args) < 2:  # noqa: PLR2004  the two that may be swapped
            return None
        first, second = entity.call.args[:2]
        evaluate = file.evaluator.evaluate
        if isinstance(entity, Timer):
            is_callable = isinstance(first, ast.Lambda | ast.Attribute) and not isinstance(
                evaluate(first), int | float
            )
            if is_callable and isinstance(evaluate(second), int | float):
                return "swapped arguments: create_timer() takes the period first, then the callback"
        elif (
            isinstance(entity, Endpoint)
            and isinstance(evaluate(first), str)
            and file.interface(second) is not None
        ):
            return f"swapped arguments: the type comes first, then the name {evaluate(first)!r}"
        return None


def _problem(file: RclpyFile, entity: Entity, argument: Argument) -> str:
    name, node, value = argument.name, argument.node, argument.value
    problem = ""
    if isinstance(entity, Parameter):
        return _default_problem(value) if name == "value" else ""
    if isinstance(entity, Endpoint) and name in _TYPES and isinstance(node, ast.Call):
        problem = _object_problem(file, node)
    elif name == "action_type":
        problem = _action_problem(file, node)
    elif isinstance(entity, Service | Client) and name == "srv_type":
        problem = _service_problem(file, node)
    elif name in _NAMES and value is not UNKNOWN and not isinstance(value, str):
        problem = f"the name must be a str, but this is {kind_of(value)}: TypeError"
    elif name in _CALLBACKS and isinstance(value, str):
        problem = f"the callback must be a function, but this is {kind_of(value)}: TypeError"
    elif name == "callback_group" and isinstance(value, str):
        problem = "the callback group must be a CallbackGroup, but this is a str: AttributeError"
    elif name == "callback_group":
        full = file.module.qualified_name(node) or ""
        is_class = full.startswith("rclpy.callback_groups.")
        problem = "this is a class, not a callback group; instantiate it" if is_class else ""
    return problem


def _object_problem(file: RclpyFile, call: ast.Call) -> str:
    """Return the message for an object in place of the type of messages."""
    if file.interface(call.func) is not None:
        return "this is an instance, not the message type; remove the parentheses"
    made = re.fullmatch(r"rclpy\.(?:\w+\.)*([A-Z]\w*)", file.module.qualified_name(call.func) or "")
    if made is None:
        return ""
    return f"this is a {made[1]} instead of the message type: AttributeError"


def _service_problem(file: RclpyFile, node: ast.expr) -> str:
    """Return the message for a type that is not a service."""
    full = file.module.qualified_name(node) or ""
    if re.fullmatch(r"\w+\.srv\.\w+\.(Request|Response)", full):
        return f"this is only one part of a service: RuntimeError; pass {full.split('.')[2]}"
    if re.fullmatch(r"\w+\.(msg|action)\.[A-Z][A-Za-z0-9]*", full):
        return f"{full.rpartition('.')[2]!r} is not a service type: RuntimeError"
    return ""


def _default_problem(value: object) -> str:
    if isinstance(value, dict):
        return "a parameter cannot hold a dict: TypeError; declare a parameter for each key"
    if isinstance(value, list | tuple) and UNKNOWN not in value:
        kinds = {type(item) for item in value}
        if len(kinds) > 1 or kinds & {list, dict, tuple}:
            names = ", ".join(sorted(kind.__name__ for kind in kinds))
            return f"a list parameter cannot mix {names}: TypeError"
    return ""


def _action_problem(file: RclpyFile, node: ast.expr) -> str:
    """Return the message for a wrong type of an action server or client."""
    full = file.module.qualified_name(node) or ""
    if re.fullmatch(r"(?!rclpy\.)\w+\.action\.[A-Z][A-Za-z0-9]*\.(Goal|Result|Feedback)", full):
        return f"this is only one part of an action; pass {full.split('.')[2]}"
    if re.fullmatch(r"\w+\.(msg|srv)\.[A-Z][A-Za-z0-9]*", full) and file.interface(node):
        return f"{full.rpartition('.')[2]!r} is not an action type"
    return ""
