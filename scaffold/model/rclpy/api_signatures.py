"""Which arguments the functions of rclpy take, and whether a call gives others.

The tables are those of Jazzy; ``arguments.txt`` of another distribution has what is different.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from functools import cache
from typing import TYPE_CHECKING

from scaffold import distributions
from scaffold.model.rclpy.api import class_of
from scaffold.model.rclpy.nodes import NodeClass, NodeObject
from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from scaffold.distributions import Distribution
    from scaffold.model.rclpy.file import RclpyFile

_NODE_KEYWORDS = (
    "context cli_args namespace use_global_arguments enable_rosout start_parameter_services "
    "parameter_overrides allow_undeclared_parameters enable_logger_service "
    "automatically_declare_parameters_from_overrides"
)
_EVENTS = "callback_group event_callbacks qos_overriding_options"
_GOALS = "goal_service_qos_profile result_service_qos_profile cancel_service_qos_profile"


class Signature(NamedTuple):
    """The parameters of a function of rclpy, without ``self``."""

    positional: tuple[str, ...]
    """By position or by name."""
    keywords: frozenset[str]
    """By name only."""


def _signature(positional: str, keywords: str = "") -> Signature:
    return Signature(tuple(positional.split()), frozenset(keywords.split()))


FUNCTIONS: Mapping[str, Signature] = {
    "rclpy.init": _signature("", "args context domain_id signal_handler_options"),
    "rclpy.shutdown": _signature("", "context uninstall_handlers"),
    "rclpy.try_shutdown": _signature("", "context"),
    "rclpy.ok": _signature("", "context"),
    "rclpy.spin": _signature("node executor"),
    "rclpy.spin_once": _signature("node", "executor timeout_sec"),
    "rclpy.spin_until_future_complete": _signature("node future executor timeout_sec"),
    "rclpy.create_node": _signature("node_name", _NODE_KEYWORDS),
    "rclpy.node.Node": _signature("node_name", _NODE_KEYWORDS),
    "rclpy.action.ActionServer": _signature(
        "node action_type action_name execute_callback",
        f"callback_group goal_callback handle_accepted_callback cancel_callback {_GOALS} "
        "feedback_pub_qos_profile status_pub_qos_profile result_timeout",
    ),
    "rclpy.action.ActionClient": _signature(
        "node action_type action_name",
        f"callback_group {_GOALS} feedback_sub_qos_profile status_sub_qos_profile",
    ),
    "rclpy.executors.SingleThreadedExecutor": _signature("", "context"),
    "rclpy.executors.MultiThreadedExecutor": _signature("num_threads", "context"),
    "rclpy.qos.QoSProfile": _signature(
        "",
        "history depth reliability durability lifespan deadline liveliness "
        "liveliness_lease_duration avoid_ros_namespace_conventions",
    ),
}
"""By full name."""

METHODS: Mapping[str, Signature] = {
    "create_publisher": _signature("msg_type topic qos_profile", f"{_EVENTS} publisher_class"),
    "create_subscription": _signature("msg_type topic callback qos_profile", f"{_EVENTS} raw"),
    "create_service": _signature("srv_type srv_name callback", "qos_profile callback_group"),
    "create_client": _signature("srv_type srv_name", "qos_profile callback_group"),
    "create_timer": _signature("timer_period_sec callback callback_group clock autostart"),
    "create_rate": _signature("frequency clock"),
    "declare_parameter": _signature("name value descriptor ignore_override"),
    "declare_parameters": _signature("namespace parameters ignore_override"),
    "get_parameter": _signature("name"),
    "get_parameter_or": _signature("name alternative_value"),
    "get_parameters": _signature("names"),
    "has_parameter": _signature("name"),
    "get_logger": _signature(""),
    "get_clock": _signature(""),
    "get_name": _signature(""),
    "get_namespace": _signature(""),
    "get_fully_qualified_name": _signature(""),
    "get_node_names": _signature(""),
    "get_service_names_and_types": _signature(""),
    "get_topic_names_and_types": _signature("no_demangle"),
    "count_publishers": _signature("topic_name"),
    "count_subscribers": _signature("topic_name"),
    "add_on_set_parameters_callback": _signature("callback"),
    "set_parameters": _signature("parameter_list"),
    "destroy_node": _signature(""),
    "destroy_publisher": _signature("publisher"),
    "destroy_subscription": _signature("subscription"),
    "destroy_timer": _signature("timer"),
    "destroy_service": _signature("service"),
    "destroy_client": _signature("client"),
}
"""Of ``rclpy.node.Node``, by name."""

_CLIENT = "rclpy.client.Client"
_ACTION_CLIENT = "rclpy.action.client.ActionClient"
_EXECUTOR = _signature("timeout_sec")
OBJECTS: Mapping[str, Mapping[str, Signature]] = {
    "wait_for_service": {_CLIENT: _signature("timeout_sec")},
    "service_is_ready": {_CLIENT: _signature("")},
    "call": {_CLIENT: _signature("request timeout_sec")},
    "call_async": {_CLIENT: _signature("request")},
    "wait_for_server": {_ACTION_CLIENT: _signature("timeout_sec")},
    "server_is_ready": {_ACTION_CLIENT: _signature("")},
    "send_goal_async": {_ACTION_CLIENT: _signature("goal feedback_callback goal_uuid")},
    "publish": {"rclpy.publisher.Publisher": _signature("msg")},
    "get_subscription_count": {"rclpy.publisher.Publisher": _signature("")},
    "now": {"rclpy.clock.Clock": _signature("")},
    "to_msg": {"rclpy.time.Time": _signature(""), "rclpy.duration.Duration": _signature("")},
    "seconds_nanoseconds": {"rclpy.time.Time": _signature("")},
    "sleep": {"rclpy.timer.Rate": _signature("")},
    "add_done_callback": {"rclpy.task.Future": _signature("callback")},
    "result": {"rclpy.task.Future": _signature("")},
    "done": {"rclpy.task.Future": _signature("")},
    "add_node": {
        "rclpy.executors.SingleThreadedExecutor": _signature("node"),
        "rclpy.executors.MultiThreadedExecutor": _signature("node"),
    },
    "spin": {
        "rclpy.executors.SingleThreadedExecutor": _signature(""),
        "rclpy.executors.MultiThreadedExecutor": _signature(""),
    },
    "spin_once": {
        "rclpy.executors.SingleThreadedExecutor": _EXECUTOR,
        "rclpy.executors.MultiThreadedExecutor": _EXECUTOR,
    },
}
"""Of other objects of rclpy, by the name of the method and by class."""


_PLACES: Mapping[str, str] = {
    "rclpy.action.ActionClient": "rclpy.action.client.ActionClient",
    "rclpy.action.ActionServer": "rclpy.action.server.ActionServer",
    "rclpy.shutdown": "rclpy.utilities.shutdown",
}
"""Where functions are defined that are called by a shorter name."""


@cache
def _changed(distribution: Distribution) -> Mapping[str, Signature | None]:
    """Return the functions that take other arguments on a distribution, by full name.

    Nothing is known of one that takes any keyword.
    """
    if distribution.place == distributions.JAZZY.place:
        return {}
    result: dict[str, Signature | None] = {}
    with open(distribution.path("arguments.txt"), encoding="utf-8") as file:
        for line in file:
            name, _, rest = line.partition(": ")
            positional, _, keywords = rest.partition("|")
            result[name] = None if "..." in keywords else _signature(positional, keywords)
    return result


def _on_target(name: str, signature: Signature) -> Signature | None:
    """Return what a function takes on the target; ``None`` if that is not known."""
    changed = _changed(distributions.target())
    return changed.get(name, changed.get(_PLACES.get(name, name), signature))


class Excess(NamedTuple):
    """An argument that the called function does not take."""

    call: ast.Call
    function: str
    """How the function is called: ``rclpy.init``, ``create_service``."""
    signature: Signature
    keyword: str
    """The unknown keyword; empty for one position too many."""
    node: ast.expr
    """The first such argument."""


def excess_arguments(file: RclpyFile) -> Iterator[Excess]:
    """Yield the calls of rclpy's functions that end in a TypeError, in the order of the text."""
    for call in file.module.walk(ast.Call):
        named = _called(file, call) if call.args or call.keywords else None
        if named is not None:
            yield from _excess(call, *named)
    for node in file.classes:
        base = node.constructor_call if node.base is None and not node.is_lifecycle else None
        if base is not None:
            constructor = _on_target("rclpy.node.Node", FUNCTIONS["rclpy.node.Node"])
            if constructor is not None:
                yield from _excess(base, "Node.__init__", constructor)


def _called(file: RclpyFile, call: ast.Call) -> tuple[str, Signature] | None:
    """Return how a function of rclpy is called in messages, and what it takes."""
    for name in file.module.qualified_names(call.func):
        if name in FUNCTIONS:
            return _named(name, name, FUNCTIONS[name])
    func = call.func
    if not isinstance(func, ast.Attribute):
        return None
    if func.attr in OBJECTS:
        class_ = class_of(file, func.value) or ""
        return _named(func.attr, f"{class_}.{func.attr}", OBJECTS[func.attr].get(class_))
    if func.attr not in METHODS or not _is_plain(file, func):
        return None
    return _named(func.attr, f"rclpy.node.Node.{func.attr}", METHODS[func.attr])


def _named(shown: str, full: str, given: Signature | None) -> tuple[str, Signature] | None:
    signature = None if given is None else _on_target(full, given)
    return None if signature is None else (shown, signature)


def _is_plain(file: RclpyFile, func: ast.Attribute) -> bool:
    """Tell whether a method is rclpy's own, not one of a class in between."""
    owner = file.owner_of(func.value)
    if isinstance(owner, NodeObject):
        return not owner.is_lifecycle
    while isinstance(owner, NodeClass):
        if owner.base_index or func.attr in owner.methods:
            return False
        if owner.base is None:
            return True
        owner = owner.base
    return False


def _excess(call: ast.Call, function: str, signature: Signature) -> Iterator[Excess]:
    """Yield the first argument that does not fit."""
    for position, arg in enumerate(call.args):
        if isinstance(arg, ast.Starred):
            break
        if position >= len(signature.positional):
            yield Excess(call, function, signature, "", arg)
            return
    for word in call.keywords:
        if word.arg and word.arg not in {*signature.positional, *signature.keywords}:
            yield Excess(call, function, signature, word.arg, word.value)
            return
