"""rclpy times and durations that are used in the wrong unit."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from scaffold.api.rclpy import RclpyFile

_LARGEST = 10_000
"""The number of nanoseconds below which a compared number has another unit."""
# linear: fixed words
_SPEED = re.compile(r"\.(?:linear|angular|angular_velocity|linear_acceleration)\.[xyz]$")
_UNITS = {1.0: "nanoseconds", 1e-3: "microseconds", 1e-6: "milliseconds"}
"""The unit of ``nanoseconds`` after a factor."""
_TIMES = frozenset({"rclpy.time.Time", "rclpy.duration.Duration"})


def unit_problems(file: RclpyFile) -> Iterator[tuple[ast.expr, str]]:
    """Yield expressions with a certainly wrong unit, and the problem."""
    for compared in file.module.walk(ast.Compare):
        if len(compared.ops) == 1 and isinstance(
            compared.ops[0], ast.Lt | ast.LtE | ast.Gt | ast.GtE
        ):
            for operand, other in (
                (compared.left, compared.comparators[0]),
                (compared.comparators[0], compared.left),
            ):
                yield from _compared(file, operand, other)
    for node in file.module.walk(ast.BinOp):
        if isinstance(node.op, ast.Sub):
            yield from _mixed(node)
        elif isinstance(node.op, ast.Mult) and _is_outermost(file, node):
            yield from _multiplied(file, node)
        elif isinstance(node.op, ast.Add):
            yield from _added(file, node)
    for call in file.module.walk(ast.Call):
        yield from _made_of_seconds(file, call)
        yield from _written_in_seconds(file, call)
        yield from _joined(call)


def _compared(file: RclpyFile, time: ast.expr, limit: ast.expr) -> Iterator[tuple[ast.expr, str]]:
    """Find ``duration.nanoseconds > 0.5``."""
    number = file.evaluator.evaluate(limit)
    if not isinstance(number, int | float) or isinstance(number, bool):
        return
    if 0 < number <= _LARGEST and _scale(file, time) == 1.0:
        yield (
            time,
            f"nanoseconds are compared with {number:g}: divide by 1e9 to compare seconds",
        )


def _scale(file: RclpyFile, node: ast.expr) -> float | None:
    """Return the factor of ``nanoseconds`` of rclpy in an expression."""
    value = file.evaluator.single_value(node)
    match value:
        case ast.Attribute(attr="nanoseconds"):
            return 1.0
        case ast.BinOp(left=left, op=ast.Sub(), right=right):
            first = _scale(file, left)
            return first if first == _scale(file, right) else None
        case ast.BinOp(left=left, op=ast.Mult() | ast.Div() as op, right=right):
            factor = file.evaluator.number(right)
            inner = _scale(file, left)
            if inner is None or not isinstance(factor, int | float) or not factor:
                return None
            return inner * factor if isinstance(op, ast.Mult) else inner / factor
    return None


def _mixed(node: ast.BinOp) -> Iterator[tuple[ast.expr, str]]:
    """Find ``now.nanoseconds - stamp.nanosec``."""
    names = {side.attr for side in (node.left, node.right) if isinstance(side, ast.Attribute)}
    if names == {"nanoseconds", "nanosec"}:
        message = "'nanosec' is only the part of a time below a second, 'nanoseconds' is all of it"
        yield node, message + "; use Time.from_msg(stamp).nanoseconds"


def _added(file: RclpyFile, node: ast.BinOp) -> Iterator[tuple[ast.expr, str]]:
    """Find ``stamp.sec + stamp.nanosec / 1e6``, and the sum without a factor."""
    for operand, other in ((node.left, node.right), (node.right, node.left)):
        first, second = _part(file, operand, "sec"), _part(file, other, "nanosec")
        if first is None or second is None or first[0] != second[0]:
            continue
        right = first[1] * 1e-9
        if abs(second[1] / right - 1.0) < _NEAR:
            continue
        if first[1] == second[1] == 1.0:
            yield node, "nanoseconds are added to seconds: divide 'nanosec' by 1e9"
        else:
            yield node, f"'nanosec' is added in another unit than 'sec': multiply it by {right:g}"


def _part(file: RclpyFile, node: ast.expr, part: str) -> tuple[str, float] | None:
    """Return the time of a part such as ``nanosec``, and the factor of the part."""
    value = node if isinstance(node, ast.Attribute) else file.evaluator.single_value(node)
    match value:
        case ast.Attribute(attr=name, value=time) if name == part:
            return file.module.text(time), 1.0
        case ast.Call(func=ast.Name(id="float" | "int" | "round"), args=[inner]):
            return _part(file, inner, part)
        case ast.BinOp(left=left, op=ast.Mult() | ast.Div() | ast.FloorDiv() as op, right=right):
            if isinstance(op, ast.Mult) and _part(file, left, part) is None:
                left, right = right, left
            found, factor = _part(file, left, part), file.evaluator.number(right)
            if found is None or not isinstance(factor, int | float) or not factor:
                return None
            return found[0], found[1] * factor if isinstance(op, ast.Mult) else found[1] / factor
    return None


def _joined(call: ast.Call) -> Iterator[tuple[ast.expr, str]]:
    """Find ``float(f"{stamp.sec}.{stamp.nanosec}")``."""
    match call:
        case ast.Call(
            func=ast.Name(id="float"),
            args=[
                ast.JoinedStr(
                    values=[
                        ast.FormattedValue(value=ast.Attribute(attr="sec")),
                        ast.Constant(value="."),
                        ast.FormattedValue(
                            value=ast.Attribute(attr="nanosec"), format_spec=None
                        ) as part,
                    ]
                )
            ],
        ):
            yield part.value, "'nanosec' has no zeros in front: 5 becomes .5; divide it by 1e9"


def _is_outermost(file: RclpyFile, node: ast.BinOp) -> bool:
    parent = file.module.parent(node)
    return not (isinstance(parent, ast.BinOp) and isinstance(parent.op, ast.Mult | ast.Div))


def _factors(node: ast.expr) -> Iterator[ast.expr]:
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Mult):
        yield from _factors(node.left)
        yield from _factors(node.right)
    else:
        yield node


def _multiplied(file: RclpyFile, node: ast.BinOp) -> Iterator[tuple[ast.expr, str]]:
    """Find a speed multiplied by a step in milliseconds."""
    factors = list(_factors(node))
    if not any(_SPEED.search(file.module.text(item)) for item in factors):
        return
    if any(isinstance(file.evaluator.number(item), int | float) for item in factors):
        return
    for item in factors:
        scale = _scale(file, item)
        for factor, unit in _UNITS.items():
            if scale is not None and abs(scale / factor - 1.0) < _NEAR:
                message = f"{file.module.text(item)} is in {unit}, a speed is per second: "
                yield item, message + "multiply nanoseconds by 1e-9"


_NEAR = 1e-6


def _made_of_seconds(file: RclpyFile, call: ast.Call) -> Iterator[tuple[ast.expr, str]]:
    """Find ``Time(seconds=stamp.sec)``, which drops ``nanosec``."""
    if file.module.qualified_name(call.func) not in _TIMES:
        return
    match call:
        case ast.Call(
            args=[], keywords=[ast.keyword(arg="seconds", value=ast.Attribute(attr="sec"))]
        ):
            pass
        case ast.Call(
            args=[],
            keywords=[
                ast.keyword(arg="seconds", value=ast.Attribute(attr="sec")),
                ast.keyword(arg="clock_type"),
            ],
        ):
            pass
        case _:
            return
    name = file.module.text(call.func).rpartition(".")[2]
    message = f"the fraction in 'nanosec' is ignored: use {name}.from_msg()"
    yield call, message


def _written_in_seconds(file: RclpyFile, call: ast.Call) -> Iterator[tuple[ast.expr, str]]:
    """Find ``writer.write(topic, data, int(time.time()))``: bags use nanoseconds."""
    match call:
        case ast.Call(func=ast.Attribute(attr="write", value=writer), args=[_, _, stamp]):
            made = file.evaluator.single_value(writer)
        case _:
            return
    names = file.module.qualified_names(made.func) if isinstance(made, ast.Call) else ()
    if "rosbag2_py.SequentialWriter" not in names:
        return
    value = stamp
    while isinstance(value, ast.Call) and isinstance(value.func, ast.Name) and value.args:
        value = value.args[0]  # int(...), round(...)
    scale = _scale(file, value)
    is_of_python = (
        isinstance(value, ast.Call) and file.module.qualified_name(value.func) == "time.time"
    )
    is_part = isinstance(value, ast.Attribute) and value.attr in {"sec", "nanosec"}
    if is_of_python or is_part or (scale is not None and scale < _NEAR):
        message = "the time of a message in a bag is all its nanoseconds; write "
        yield stamp, message + "self.get_clock().now().nanoseconds"
