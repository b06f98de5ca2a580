"""The clocks of rclpy times, and times truncated to whole seconds."""

from __future__ import annotations

import ast
from collections.abc import Mapping
from typing import TYPE_CHECKING

from scaffold.api.python import argument_of, returned
from scaffold.api.rclpy import class_of

if TYPE_CHECKING:
    from scaffold.api.rclpy import RclpyFile

_DEFAULTS: Mapping[str, tuple[int, str]] = {
    "rclpy.time.Time.from_msg": (1, "ROS_TIME"),
    "rclpy.time.Time": (9, "SYSTEM_TIME"),
    "rclpy.clock.Clock": (9, "SYSTEM_TIME"),
    "rclpy.clock.ROSClock": (9, "ROS_TIME"),
}
"""The position of the clock type argument, if any, and the default type."""
NUMBER = "number"
"""The pseudo clock type of a number in place of a time."""
_SECONDS = frozenset({"time.time", "time.monotonic", "time.perf_counter", "time.time_ns"})
_MAX_DEPTH = 5


def clocks_of(file: RclpyFile, node: ast.expr, depth: int = 0) -> Mapping[ast.expr, str | None]:
    """Return the possible clock types of a time, by its origins.

    ``None`` for an unknown clock type, ``NUMBER`` for a number.
    """
    result: dict[ast.expr, str | None] = {}
    for origin in file.evaluator.origins(node):
        result[origin] = _clock_of(file, origin, depth) if depth <= _MAX_DEPTH else None
    return result


def _clock_of(file: RclpyFile, node: ast.expr, depth: int) -> str | None:
    match node:
        case ast.Constant(value=value):
            return NUMBER if type(value) in {int, float} else None
        case ast.BinOp(left=ast.Attribute(attr="nanoseconds"), op=ast.Div() | ast.Mult()):
            return NUMBER
        case ast.BinOp(left=left, op=ast.Add() | ast.Sub(), right=right):
            is_span = class_of(file, right) == "rclpy.duration.Duration"
            return _common_clock(clocks_of(file, left, depth + 1)) if is_span else None
        case ast.Call():
            return _clock_of_call(file, node, depth)
    return None


def _clock_of_call(file: RclpyFile, node: ast.Call, depth: int) -> str | None:
    if file.module.qualified_name(node.func) in _SECONDS:
        return NUMBER
    made = _made(file, node)
    if made is not None:
        return made
    match node:
        case ast.Call(func=ast.Attribute(attr="now", value=clock), args=[], keywords=[]):
            clocks = {
                origin: _type_of_clock(file, origin) for origin in file.evaluator.origins(clock)
            }
            return _common_clock(clocks)
    function = file.callback(node.func).function
    if isinstance(function, ast.FunctionDef) and not function.decorator_list:
        values = [statement.value for statement in returned(function)]
        kinds = [_common_clock(clocks_of(file, x, depth + 1)) if x else None for x in values]
        return kinds[0] if kinds and len({*kinds}) == 1 else None
    return None


def _common_clock(clocks: Mapping[ast.expr, str | None]) -> str | None:
    kinds = {*clocks.values()}
    return kinds.pop() if len(kinds) == 1 else None


def _type_of_clock(file: RclpyFile, node: ast.expr) -> str | None:
    match node:
        case ast.Call(func=ast.Attribute(attr="get_clock"), args=[], keywords=[]):
            return "ROS_TIME"
        case ast.Call():
            return _made(file, node)
    return None


def _made(file: RclpyFile, call: ast.Call) -> str | None:
    """Return the clock type of a constructed time or clock."""
    name = file.module.qualified_name(call.func) or ""
    if name not in _DEFAULTS or any(word.arg is None for word in call.keywords):
        return None
    place, default = _DEFAULTS[name]
    given = argument_of(call, "clock_type", place)
    if given is None:
        return default
    type_ = file.module.qualified_name(file.evaluator.single_value(given)) or ""
    return type_.rpartition(".")[2] if "ClockType." in type_ else None
