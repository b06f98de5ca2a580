"""ND091: publishers and subscriptions have a depth or a valid QoS profile."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule
from scaffold.api.python import kind_of
from scaffold.api.rclpy import Endpoint, Publisher, RclpyFile, Subscription

_POLICIES = {
    "reliability": "ReliabilityPolicy",
    "durability": "DurabilityPolicy",
    "history": "HistoryPolicy",
    "liveliness": "LivelinessPolicy",
}
_NODE = (
    "from rclpy.node import Node\nfrom rclpy.qos import DurabilityPolicy, QoSProfile\n"
    "from std_msgs.msg import String\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.create_publisher(String, 'chatter', {})\n"
)
_NODE_MISSING = (
    "from rclpy.node import Node\nfrom std_msgs.msg import String\n{}\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.create_publisher(String, 'chatter'{})\n"
)
_QOS = "from rclpy.qos import QoSProfile\n"


class QosUnusable(RclpyRule):
    """A QoS argument is missing, or not a depth or a profile, or a profile has an invalid value.

    **Why.** ``TypeError`` without the argument or for a str, ``InvalidQoSProfileException`` without
    a depth, ``AssertionError`` for an invalid value in a profile. A policy of another kind is
    converted by its number: the profile differs from the intended one.

    **Fix.** Pass a depth such as ``10``, a profile such as ``qos_profile_sensor_data``, or
    ``QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)``.

    **Source.** ``rclpy/node.py``; ``rclpy/qos.py``, ``QoSProfile``.
    """

    code = "ND091"
    name = "qos-unusable"
    examples = (
        Example(
            "a profile",
            {
                "talker.py": _NODE.format(
                    "QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)"
                )
            },
        ),
        Example(
            "a str",
            {"talker.py": _NODE.format("'10'")},
            "9:50: expected a depth or a QoSProfile, not a str: TypeError",
        ),
        Example(
            "a negative depth",
            {"talker.py": _NODE.format("QoSProfile(depth=-1)")},
            "9:67: the depth is -1, but must not be negative: ValueError",
        ),
        Example(
            "only a policy",
            {"talker.py": _NODE.format("DurabilityPolicy.TRANSIENT_LOCAL")},
            "9:50: DurabilityPolicy.TRANSIENT_LOCAL is a policy, but is used as the depth; write "
            "QoSProfile(depth=10, ...)",
        ),
        Example(
            "a policy of another kind",
            {
                "talker.py": _NODE.format(
                    "QoSProfile(depth=1, reliability=DurabilityPolicy.TRANSIENT_LOCAL)"
                )
            },
            "9:82: reliability must be a ReliabilityPolicy, not a DurabilityPolicy: another "
            "policy takes effect",
        ),
        Example(
            "a negative number, a class, a function",
            {
                "negative.py": _NODE.format("-1"),
                "class.py": _NODE.format("QoSProfile"),
                "function.py": _NODE.format("profile")
                + "\n\ndef profile():\n    return QoSProfile(depth=10)\n",
            },
            "class.py:9:50: QoSProfile is a class, not a profile: TypeError; write "
            "QoSProfile(depth=10)",
            "function.py:9:50: expected a depth or a QoSProfile, not a function: TypeError",
            "negative.py:9:50: the depth is -1, but must not be negative: ValueError",
        ),
        Example(
            "str values in a profile",
            {"talker.py": _NODE.format("QoSProfile(depth='10', reliability='reliable')")},
            "9:67: the depth must be an int, not a str: AssertionError",
            "9:85: reliability must be a ReliabilityPolicy, not a str: AssertionError",
        ),
        Example("a depth", {"talker.py": _NODE_MISSING.format("", ", 10")}),
        Example(
            "a keyword of ROS 1, which TY004 reports",
            {"talker.py": _NODE_MISSING.format("", ", queue_size=10")},
        ),
        Example(
            "no argument",
            {"talker.py": _NODE_MISSING.format("", "")},
            "8:9: create_publisher() is missing a depth or a QoS profile: TypeError",
        ),
        Example(
            "a profile without a depth",
            {"talker.py": _NODE_MISSING.format(_QOS, ", QoSProfile()")},
            "9:50: QoS profile without a depth: InvalidQoSProfileException",
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        yield from self._check_values(file)
        yield from self._check_missing(file)

    def _check_values(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for entity in file.entities:
            given = entity.argument("qos_profile") if isinstance(entity, Endpoint) else None
            problem = _problem(file, given.node, given.value) if given else ""
            if given and problem:
                yield self.report(given, problem)
        for call in file.module.calls_of("rclpy.qos.QoSProfile"):
            for word in call.keywords:
                problem = _problem_of_word(file, word)
                if problem:
                    yield self.report(file.module.location(word.value), problem)
            if _lacks_depth(file, call):
                message = "QoS profile without a depth: InvalidQoSProfileException"
                yield self.report(file.module.location(call), message)

    def _check_missing(self, file: RclpyFile) -> Iterator[Diagnostic]:
        entities: list[Publisher | Subscription] = [*file.publishers, *file.subscriptions]
        for entity in entities:
            problem = self._problem(entity)
            if problem:
                yield self.report(entity, problem, cause=f"missing QoS in {file.module.path}")

    def _problem(self, entity: Publisher | Subscription) -> str | None:
        if entity.has_unknown_arguments or _has_old_keyword(entity.call):
            return None
        if entity.owner is None and entity.name_argument is None:
            return None  # a method of this name of another library
        if entity.argument("qos_profile") is None and entity.qos is None:
            method = "create_publisher" if isinstance(entity, Publisher) else "create_subscription"
            return f"{method}() is missing a depth or a QoS profile: TypeError"
        return None


def _lacks_depth(file: RclpyFile, call: ast.Call) -> bool:
    """Return whether a profile has neither a depth nor a history without one."""
    words = {word.arg: word.value for word in call.keywords}
    if {"depth", None} & words.keys() or call.args:
        return False
    history = words.get("history")
    return history is None or file.module.text(history).endswith("KEEP_LAST")


def _problem(file: RclpyFile, node: ast.expr, value: object) -> str:
    """Return the message for a wrong QoS argument."""
    if isinstance(value, str | float) or value is None:
        return f"expected a depth or a QoSProfile, not {kind_of(value)}: TypeError"
    if type(value) is int and value < 0:
        return f"the depth is {value}, but must not be negative: ValueError"
    name = file.module.qualified_name(node) or ""
    if name == "rclpy.qos.QoSProfile":
        return "QoSProfile is a class, not a profile: TypeError; write QoSProfile(depth=10)"
    if name.startswith("rclpy.qos.") and "Policy." in name:
        return f"{name[10:]} is a policy, but is used as the depth; write QoSProfile(depth=10, ...)"
    if isinstance(node, ast.Attribute | ast.Name) and file.callback(node).function is not None:
        return "expected a depth or a QoSProfile, not a function: TypeError"
    return ""


def _problem_of_word(file: RclpyFile, word: ast.keyword) -> str:
    """Return the message for a wrong argument of QoSProfile."""
    value = file.evaluator.evaluate(word.value)
    if word.arg == "depth" and isinstance(value, str | float):
        return f"the depth must be an int, not {kind_of(value)}: AssertionError"
    if word.arg == "depth" and type(value) is int and value < 0:
        return f"the depth is {value}, but must not be negative: ValueError"
    wanted = _POLICIES.get(word.arg or "")
    if wanted and isinstance(value, str):
        return f"{word.arg} must be a {wanted}, not a str: AssertionError"
    name = file.module.qualified_name(word.value) or ""
    given = name.split(".")[2] if name.startswith("rclpy.qos.") else ""
    if wanted and given.endswith("Policy") and not given.endswith(wanted):
        return f"{word.arg} must be a {wanted}, not a {given}: another policy takes effect"
    return ""


def _has_old_keyword(call: ast.Call) -> bool:
    """Return whether the depth has its ROS 1 name, which TY004 reports."""
    return any(word.arg == "queue_size" for word in call.keywords)
