"""Static evaluation of QoS profiles, and whether two are compatible."""

from __future__ import annotations

import ast
from collections.abc import Mapping
from typing import TYPE_CHECKING, Protocol

from scaffold.model.python.evaluation.values import UNKNOWN, Unknown
from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from scaffold.model.python.evaluation.attributes import AttributeEvaluator
    from scaffold.source import Location

PROFILES: Mapping[str, tuple[int, str, str, str]] = {
    "default": (10, "KEEP_LAST", "RELIABLE", "VOLATILE"),
    "sensor_data": (5, "KEEP_LAST", "BEST_EFFORT", "VOLATILE"),
    "services_default": (10, "KEEP_LAST", "RELIABLE", "VOLATILE"),
    "parameters": (1000, "KEEP_LAST", "RELIABLE", "VOLATILE"),
    "parameter_events": (1000, "KEEP_LAST", "RELIABLE", "VOLATILE"),
    "action_status_default": (1, "KEEP_LAST", "RELIABLE", "TRANSIENT_LOCAL"),
    "best_available": (10, "KEEP_LAST", "BEST_AVAILABLE", "BEST_AVAILABLE"),
    "system_default": (0, "SYSTEM_DEFAULT", "SYSTEM_DEFAULT", "SYSTEM_DEFAULT"),
}
"""Depth, history, reliability and durability of the predefined profiles of rclpy 7.1."""

Conflict = tuple[str, str]
"""The offered and the requested policy: ``is BEST_EFFORT``, ``requests RELIABLE``."""

_QOS_PARAMETERS = ("history", "depth", "reliability", "durability")


class Qos(NamedTuple):
    """The quality of service of a publisher or subscription; policies in capitals."""

    location: Location
    profile: str | None = None
    """The predefined profile: ``sensor_data`` ..."""
    depth: int | Unknown | None = UNKNOWN
    """The depth; ``None`` if missing, though the history needs it."""
    history: str | Unknown = UNKNOWN
    reliability: str | Unknown = UNKNOWN
    durability: str | Unknown = UNKNOWN


def qos_of(evaluator: AttributeEvaluator, node: ast.expr) -> Qos:
    """Return the quality of service of an expression."""
    at = evaluator.module.location(node)
    qos = _literal_qos(evaluator, evaluator.single_value(node), at)
    return _with_later_changes(evaluator, qos, node)


def _literal_qos(evaluator: AttributeEvaluator, node: ast.expr, at: Location) -> Qos:
    value = evaluator.evaluate(node)
    if type(value) is int:
        return Qos(at, None, value, *PROFILES["default"][1:])
    name = evaluator.module.qualified_name(node) or ""
    profile = ""
    if name.startswith("rclpy.qos.qos_profile_"):
        profile = name.removeprefix("rclpy.qos.qos_profile_")
    elif name.startswith("rclpy.qos.QoSPresetProfiles.") and name.endswith(".value"):
        profile = name.split(".")[3].lower()
    elif isinstance(node, ast.Call):
        called = evaluator.module.qualified_name(node.func)
        if called == "rclpy.qos.QoSPresetProfiles.get_from_short_key" and node.args:
            profile = str(evaluator.evaluate(node.args[0])).lower()
        elif called == "rclpy.qos.QoSProfile":
            return _constructed(evaluator, node, at)
    return Qos(at, profile, *PROFILES[profile]) if profile in PROFILES else Qos(at)


def _constructed(evaluator: AttributeEvaluator, node: ast.Call, at: Location) -> Qos:
    given: dict[str, ast.expr] = dict(zip(_QOS_PARAMETERS, node.args, strict=False))
    for word in node.keywords:
        if word.arg is None:
            return Qos(at)
        given[word.arg] = word.value
    if any(isinstance(arg, ast.Starred) for arg in node.args):
        return Qos(at)
    history = _policy(evaluator, given.get("history"), "KEEP_LAST")
    depth: int | Unknown | None
    if "depth" in given:
        value = evaluator.evaluate(given["depth"])
        depth = value if type(value) is int else UNKNOWN
    else:
        depth = None if history == "KEEP_LAST" else UNKNOWN if history is UNKNOWN else 10
    return Qos(
        at,
        None,
        depth,
        history,
        _policy(evaluator, given.get("reliability"), "RELIABLE"),
        _policy(evaluator, given.get("durability"), "VOLATILE"),
    )


def _policy(evaluator: AttributeEvaluator, node: ast.expr | None, default: str) -> str | Unknown:
    """Return the policy's name: ``TRANSIENT_LOCAL``, in whichever spelling."""
    if node is None:
        return default
    name = evaluator.module.qualified_name(evaluator.single_value(node)) or ""
    if not name.startswith("rclpy.qos."):
        return UNKNOWN
    policy = name.rpartition(".")[2]
    for prefix in ("HISTORY_", "RELIABILITY_", "DURABILITY_"):
        policy = policy.partition(prefix)[2] or policy
    return policy.upper()


def _with_later_changes(evaluator: AttributeEvaluator, qos: Qos, node: ast.expr) -> Qos:
    """Apply assignments such as ``qos.depth = 5`` before the use; ``None`` if uncertain."""
    if not isinstance(node, ast.Name | ast.Attribute):
        return qos
    for name in _QOS_PARAMETERS:
        for store in evaluator.stores(name):
            order = _order(evaluator, store.node, node)
            if order != "after" and _is_same_object(evaluator, store.node.value, node):
                value = store.value if order == "before" else None
                qos = _changed(evaluator, qos, name, value)
    return qos


def _changed(evaluator: AttributeEvaluator, qos: Qos, name: str, value: ast.expr | None) -> Qos:
    """Return a quality of service with one field set; ``None`` for an unknown value."""
    if name == "depth":
        depth = evaluator.evaluate(value)
        return qos._replace(profile=None, depth=depth if type(depth) is int else UNKNOWN)
    policy = UNKNOWN if value is None else _policy(evaluator, value, "")
    if name == "history":
        return qos._replace(profile=None, history=policy)
    if name == "reliability":
        return qos._replace(profile=None, reliability=policy)
    return qos._replace(profile=None, durability=policy)


def _is_same_object(evaluator: AttributeEvaluator, first: ast.expr, second: ast.expr) -> bool:
    if isinstance(first, ast.Name) and isinstance(second, ast.Name):
        lookup = evaluator.module.index.lookup
        scopes = [scope_bindings[0] for n in (first, second) if (scope_bindings := lookup(n.id, n))]
        return first.id == second.id and len({*scopes}) <= 1
    return evaluator.module.text(first) == evaluator.module.text(second)


def _order(evaluator: AttributeEvaluator, change: ast.AST, use: ast.AST) -> str:
    """Return whether a statement is certainly run ``before`` or ``after`` a use, else ``""``."""
    function = evaluator.module.enclosing_function(change)
    if function is not evaluator.module.enclosing_function(use):
        return ""
    around = {function, evaluator.module.tree, *evaluator.module.parents(use)}
    block = evaluator.module.parent(_statement_of(evaluator, change))
    loops = ast.For | ast.While | ast.AsyncFor
    if block not in around or isinstance(block, loops | ast.If | ast.Try):
        return ""
    if getattr(change, "lineno", 0) < getattr(use, "lineno", 0):
        return "before"
    return "" if any(isinstance(parent, loops) for parent in around) else "after"


def _statement_of(evaluator: AttributeEvaluator, node: ast.AST) -> ast.AST:
    for parent in (node, *evaluator.module.parents(node)):
        if isinstance(parent, ast.stmt):
            return parent
    return node


# -- compatibility


class Offered(Protocol):
    """The policies that `conflict_of` compares."""

    @property
    def qos(self) -> Qos | None:
        """The quality of service, if it is known."""

    @property
    def profile(self) -> Mapping[str, str] | None:
        """The arguments of its QoSProfile; ``None`` if unknown."""


def conflict_of(publisher: Offered, subscription: Offered) -> Conflict | None:
    """Return the offered and the requested policy, if they are incompatible."""
    offered, asked = publisher.qos, subscription.qos
    if offered is None or asked is None:
        return None
    if offered.reliability == "BEST_EFFORT" and asked.reliability == "RELIABLE":
        return ("is BEST_EFFORT", "requests RELIABLE")
    if offered.durability == "VOLATILE" and asked.durability == "TRANSIENT_LOCAL":
        return ("is VOLATILE", "requests TRANSIENT_LOCAL")
    return _conflict_of_time(publisher.profile, subscription.profile)


def _conflict_of_time(
    offered: Mapping[str, str] | None, asked: Mapping[str, str] | None
) -> Conflict | None:
    if offered is None or asked is None:
        return None
    if "deadline" in asked and "deadline" not in offered:
        return ("has no deadline", "requests a deadline")
    if "MANUAL" in asked.get("liveliness", "") and "liveliness" not in offered:
        return ("has AUTOMATIC liveliness", "requests MANUAL_BY_TOPIC")
    return None
