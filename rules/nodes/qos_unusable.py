"""ND091: a quality of service is a depth, or a profile of the policies that it takes."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Report
from scaffold.api.python import kind_of
from scaffold.api.rclpy import Endpoint, RclpyFile

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


class QosUnusable(RclpyRule):
    """A quality of service is given as something else than a depth or a profile.

    **Why.** ``TypeError: Expected QoSProfile or int, but received <class 'str'>``, or
    ``AssertionError`` for a value of a profile. A policy that stands for another one is taken by
    its number: the profile is not the one that is meant.

    **Fix.** Give a depth such as ``10``, a profile such as ``qos_profile_sensor_data``, or
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
            "a text",
            {"talker.py": _NODE.format("'10'")},
            reports=(
                Report(
                    "talker.py:9:50",
                    "a quality of service is a depth or a QoSProfile, not a str: TypeError",
                ),
            ),
        ),
        Example(
            "a depth below nothing",
            {"talker.py": _NODE.format("QoSProfile(depth=-1)")},
            reports=(
                Report("talker.py:9:67", "a depth is at least 0, and this is -1: ValueError"),
            ),
        ),
        Example(
            "a policy alone",
            {"talker.py": _NODE.format("DurabilityPolicy.TRANSIENT_LOCAL")},
            reports=(
                Report(
                    "talker.py:9:50",
                    "a policy alone is no profile: write QoSProfile(depth=10, "
                    "...=DurabilityPolicy.TRANSIENT_LOCAL)",
                ),
            ),
        ),
        Example(
            "a policy of another kind",
            {
                "talker.py": _NODE.format(
                    "QoSProfile(depth=1, reliability=DurabilityPolicy.TRANSIENT_LOCAL)"
                )
            },
            reports=(
                Report(
                    "talker.py:9:82",
                    "reliability is a ReliabilityPolicy, and this is a "
                    "DurabilityPolicy: another policy than is meant",
                ),
            ),
        ),
    )

    def check_file(self, facts: RclpyFile) -> Iterator[Diagnostic]:
        for entity in facts.entities:
            given = entity.argument("qos_profile") if isinstance(entity, Endpoint) else None
            problem = _problem(facts, given.node, given.value) if given else ""
            if given and problem:
                yield self.report(given, problem)
        for call in facts.module.walk(ast.Call):
            if facts.module.qualified_name(call.func) == "rclpy.qos.QoSProfile":
                for word in call.keywords:
                    problem = _problem_of_word(facts, word)
                    if problem:
                        yield self.report(facts.module.location(word.value), problem)


def _problem(facts: RclpyFile, node: ast.expr, value: object) -> str:
    """Return what is wrong about a quality of service."""
    if isinstance(value, str | float) or value is None:
        return f"a quality of service is a depth or a QoSProfile, not {kind_of(value)}: TypeError"
    if type(value) is int and value < 0:
        return "a depth is at least 0: ValueError"
    name = facts.module.qualified_name(node) or ""
    if name == "rclpy.qos.QoSProfile":
        return "this is the class: write QoSProfile(depth=10)"
    if name.startswith("rclpy.qos.") and "Policy." in name:
        return f"a policy alone is no profile: write QoSProfile(depth=10, ...={name[10:]})"
    if isinstance(node, ast.Attribute | ast.Name) and facts.callback(node).function is not None:
        return "this is a function, but a depth or a QoSProfile belongs here: TypeError"
    return ""


def _problem_of_word(facts: RclpyFile, word: ast.keyword) -> str:
    """Return what is wrong about a value that QoSProfile is given."""
    value = facts.evaluator.evaluate(word.value)
    if word.arg == "depth" and isinstance(value, str | float):
        return f"a depth is an int, and this is {kind_of(value)}: AssertionError"
    if word.arg == "depth" and type(value) is int and value < 0:
        return f"a depth is at least 0, and this is {value}: ValueError"
    wanted = _POLICIES.get(word.arg or "")
    if wanted and isinstance(value, str):
        return f"{word.arg} is a {wanted}, and this is a str: AssertionError"
    name = facts.module.qualified_name(word.value) or ""
    given = name.split(".")[2] if name.startswith("rclpy.qos.") else ""
    if wanted and given.endswith("Policy") and not given.endswith(wanted):
        return f"{word.arg} is a {wanted}, and this is a {given}: another policy than is meant"
    return ""
