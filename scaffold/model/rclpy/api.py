"""The names in rclpy on the target distribution, and the classes of objects."""

from __future__ import annotations

import ast
from collections.abc import Mapping
from functools import cache
from typing import TYPE_CHECKING

from scaffold import distributions
from scaffold.model.rclpy.parameters.objects import is_listed_parameter
from scaffold.model.remembered import remembered

if TYPE_CHECKING:
    from scaffold.distributions import Distribution
    from scaffold.model.python.scopes import FunctionNode
    from scaffold.model.rclpy.file import RclpyFile

NODE = "rclpy.node.Node"
PARAMETER = "rclpy.parameter.Parameter"
PLACES: Mapping[str, str] = {
    "Node": "rclpy.node",
    "LifecycleNode": "rclpy.lifecycle",
    "QoSProfile": "rclpy.qos",
    "qos_profile_sensor_data": "rclpy.qos",
    "ReliabilityPolicy": "rclpy.qos",
    "DurabilityPolicy": "rclpy.qos",
    "ActionServer": "rclpy.action",
    "ActionClient": "rclpy.action",
    "MultiThreadedExecutor": "rclpy.executors",
    "SingleThreadedExecutor": "rclpy.executors",
    "ExternalShutdownException": "rclpy.executors",
    "ReentrantCallbackGroup": "rclpy.callback_groups",
    "MutuallyExclusiveCallbackGroup": "rclpy.callback_groups",
    "Duration": "rclpy.duration",
    "Time": "rclpy.time",
}
"""The modules of names that are often imported from ``rclpy`` itself."""
_MADE: Mapping[str, str] = {
    "create_publisher": "rclpy.publisher.Publisher",
    "create_subscription": "rclpy.subscription.Subscription",
    "create_service": "rclpy.service.Service",
    "create_client": "rclpy.client.Client",
    "create_timer": "rclpy.timer.Timer",
    "create_rate": "rclpy.timer.Rate",
    "get_logger": "rclpy.impl.rcutils_logger.RcutilsLogger",
    "get_clock": "rclpy.clock.Clock",
    "get_parameter": PARAMETER,
    "get_parameter_or": PARAMETER,
    "declare_parameter": PARAMETER,
}
"""The classes returned by methods of a node."""
_GIVEN: Mapping[str, str] = {
    "rclpy.clock.Clock.now": "rclpy.time.Time",
    "rclpy.client.Client.call_async": "rclpy.task.Future",
    "rclpy.action.client.ActionClient.send_goal_async": "rclpy.task.Future",
    "rclpy.action.client.ClientGoalHandle.get_result_async": "rclpy.task.Future",
    "rclpy.action.client.ClientGoalHandle.cancel_goal_async": "rclpy.task.Future",
    "rclpy.logging.get_logger": "rclpy.impl.rcutils_logger.RcutilsLogger",
}
_RESULTS: Mapping[str, str] = {
    "rclpy.action.client.ActionClient.send_goal_async": "rclpy.action.client.ClientGoalHandle",
}
"""The classes of the results of futures returned by methods."""
GOAL_HANDLE = "rclpy.action.server.ServerGoalHandle"
_GOAL_CALLBACKS = ("execute_callback", "handle_accepted_callback", "cancel_callback")
_MAX_DEPTH = 20


def known_names() -> Mapping[str, frozenset[str]]:
    """Return the names in modules and classes by full name; methods end in ``()``."""
    return names_of(distributions.target())


@cache
def names_of(distribution: Distribution) -> Mapping[str, frozenset[str]]:
    """Return the names in modules and classes of a distribution; see `known_names`."""
    with open(distribution.path("names.txt"), encoding="utf-8") as file:
        pairs = [line.partition(": ") for line in file]
    return {owner: frozenset(names.split()) for owner, _, names in pairs}


def has(owner: str, name: str) -> bool:
    """Return whether a module or class of the table has a name."""
    names = known_names()[owner]
    return name in names or f"{name}()" in names or name.startswith("__")


def is_method(owner: str, name: str) -> bool:
    """Return whether a name of a class is a method."""
    return f"{name}()" in known_names().get(owner, ())


@cache
def _places(distribution: Distribution) -> Mapping[str, str]:
    """Return the modules of classes that a package re-exports, by the shorter name."""
    result: dict[str, str] = {}
    names = names_of(distribution)
    for place in names:
        module, _, name = place.rpartition(".")
        package = module.rpartition(".")[0]
        if name[:1].isupper() and name in names.get(package, ()):
            result[f"{package}.{name}"] = place
    return result


def class_of(file: RclpyFile, node: ast.expr, depth: int = 0) -> str | None:
    """Return the rclpy class of an expression, by its name in the table."""
    classes = _classes(file)
    if node not in classes and depth <= _MAX_DEPTH:
        classes[node] = None  # ends the recursion of what is assigned to itself
        classes[node] = _find_class(file, node, depth)
    return classes.get(node)


@remembered
def _classes(_: RclpyFile) -> dict[ast.expr, str | None]:
    """Return the classes that were found so far."""
    return {}


def _find_class(file: RclpyFile, node: ast.expr, depth: int) -> str | None:
    value = file.evaluator.single_value(node)
    if isinstance(value, ast.Name | ast.Attribute):
        values = file.evaluator.values(value)
        classes = {class_of(file, other, depth + 1) for other in values}
        if len(values) > 1 and len(classes) == 1:
            return classes.pop()
    if not isinstance(value, ast.Call):
        return _class_of_argument(file, value, depth)
    name = file.module.qualified_name(value.func) or ""
    name = _places(distributions.target()).get(name, name)
    if name in _GIVEN:
        return _GIVEN[name]
    if name in known_names() and name.rpartition(".")[2][:1].isupper():
        return name
    if not isinstance(value.func, ast.Attribute):
        return None
    return _class_made(file, value, value.func, depth)


def _class_made(file: RclpyFile, call: ast.Call, func: ast.Attribute, depth: int) -> str | None:
    """Return the class returned by a method."""
    owner = file.owner_of(func.value)
    if owner is not None:
        is_own = hasattr(owner, "method") and owner.method(func.attr) is not None
        return None if is_own or owner.is_lifecycle else _MADE.get(func.attr)
    if func.attr == "result" and not call.args:
        return _class_of_result(file, func.value, depth)
    if func.attr in _MADE and _is_annotated_as_node(file, func.value):
        return _MADE[func.attr]
    inner = class_of(file, func.value, depth + 1)
    return _GIVEN.get(f"{inner}.{func.attr}")


def _is_annotated_as_node(file: RclpyFile, node: ast.expr) -> bool:
    """Return whether an expression is a function parameter annotated as a node, or set to one."""
    argument = file.parameter_of(file.evaluator.single_value(node))
    if argument is None or argument.annotation is None:
        return False
    return file.module.qualified_name(argument.annotation) == NODE


def _class_of_result(file: RclpyFile, node: ast.expr, depth: int) -> str | None:
    """Return the class of the result of a future: the handle of a sent goal."""
    future = future_given(file, node)
    made = file.evaluator.single_value(node if future is None else future)
    if isinstance(made, ast.Call) and isinstance(made.func, ast.Attribute):
        inner = class_of(file, made.func.value, depth + 1)
        return _RESULTS.get(f"{inner}.{made.func.attr}")
    return None


def _class_of_argument(file: RclpyFile, node: ast.expr, depth: int) -> str | None:
    """Return the class of a callback argument: a done future, a goal handle."""
    argument = file.parameter_of(node)
    if argument is not None and argument in _goal_arguments(file):
        return GOAL_HANDLE
    if is_listed_parameter(file, node):
        return PARAMETER
    future = future_given(file, node)
    return class_of(file, future, depth + 1) if future is not None else None


@remembered
def _goal_arguments(file: RclpyFile) -> set[ast.arg]:
    """Return the function parameters that receive goal handles from action servers."""
    result: set[ast.arg] = set()
    for server in file.action_servers:
        for name in _GOAL_CALLBACKS:
            given = server.argument(name)
            callback = file.callback(given.node) if given else None
            if callback is None or callback.is_partial or callback.is_called:
                continue
            argument = _first_argument(callback.function, is_bound=callback.is_bound)
            if argument is not None:
                result.add(argument)
    return result


def future_given(file: RclpyFile, node: ast.expr) -> ast.expr | None:
    """Return the future passed to a callback as the argument in a name."""
    argument = file.parameter_of(node)
    return _futures(file).get(argument) if argument is not None else None


@remembered
def _futures(file: RclpyFile) -> Mapping[ast.arg, ast.expr]:
    """Return the futures passed to done callbacks, by parameter."""
    result: dict[ast.arg, ast.expr] = {}
    for call, method in file.module.method_calls("add_done_callback"):
        if len(call.args) == 1:
            callback = file.callback(call.args[0])
            argument = _first_argument(callback.function, is_bound=callback.is_bound)
            if argument is not None and not callback.is_partial:
                result.setdefault(argument, method.value)
    return result


def _first_argument(
    function: FunctionNode | ast.Lambda | None, *, is_bound: bool
) -> ast.arg | None:
    if function is None:
        return None
    arguments = [*function.args.posonlyargs, *function.args.args][1 if is_bound else 0 :]
    return arguments[0] if arguments else None
