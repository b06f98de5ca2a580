"""Angles about the vertical axis that are taken for parts of quaternions, and the other way."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from scaffold.api.messages import MessageTypes

Flaw = tuple[ast.expr, str]
"""The place and the problem."""
_WORDS = frozenset({"yaw", "theta", "heading", "psi"})
"""Parts of the names of such angles."""
OF_EULER = ("tf_transformations.quaternion_from_euler", "transforms3d.euler.euler2quat")
"""Functions of roll, pitch and yaw."""
DEGREES = frozenset({30, 45, 60, 90, 120, 135, 180, 270, 360})
"""Angles in degrees that are no sensible angles or velocities in radians."""


def flaws(types: MessageTypes) -> Iterator[Flaw]:
    """Yield angles that are written into or read from a quaternion without conversion."""
    for item in types.assigned:
        if (item.owner.name, item.field.name) == ("geometry_msgs/msg/Quaternion", "z"):
            problem = _written_problem(types, item.holder, item.value)
            if problem:
                yield item.value, problem
        elif item.owner.name == "geometry_msgs/msg/Vector3" and _is_in_degrees(
            types, item.holder, item.value
        ):
            text = types.module.text(item.value)
            yield (
                item.value,
                (
                    f"angular velocities are in radians per second: {text} is "
                    f"implausibly fast; use math.radians()"
                ),
            )
    for call in types.module.calls_of(*OF_EULER):
        match call.args:
            case [angle, _, ast.Constant(value=0)] if _is_angle(angle) and not call.keywords:
                text = types.module.text(angle)
                called = types.module.text(call.func)
                yield angle, f"the first argument of {called}() is roll; write (0, 0, {text})"
    for assigned in types.module.walk(ast.Assign):
        match assigned:
            case ast.Assign(targets=[ast.Name() | ast.Attribute() as name], value=value) if (
                _is_angle(name)
            ):
                problem = _read_problem(types, value)
                if problem:
                    yield value, problem


def _is_in_degrees(types: MessageTypes, holder: ast.expr, given: ast.expr) -> bool:
    """Return whether a whole angle in degrees is written into an angular velocity."""
    value = types.file.evaluator.evaluate(given)
    is_velocity = isinstance(holder, ast.Attribute) and holder.attr == "angular"
    return is_velocity and isinstance(value, int | float) and abs(value) in DEGREES


def _written_problem(types: MessageTypes, holder: ast.expr, z: ast.expr) -> str:
    """Return the problem with the value of z of a quaternion; empty if there is none."""
    if _is_angle(z):
        text = types.module.text(z)
        return (
            f"z of a quaternion is not an angle; write z=sin({text} / 2.0) and w=cos({text} / 2.0)"
        )
    angle = _whole_angle(types, holder, z)
    if angle:
        return (
            f"a quaternion uses half of the angle; write sin({angle} / 2.0) and cos({angle} / 2.0)"
        )
    return ""


def _is_angle(node: ast.expr) -> bool:
    """Return whether an expression is a yaw by its name."""
    match node:
        case ast.Call(args=[value], func=ast.Name(id="float") | ast.Attribute(attr="radians")):
            return _is_angle(value)
        case ast.Attribute(
            attr="value",
            value=ast.Call(
                func=ast.Attribute(attr="get_parameter" | "declare_parameter"),
                args=[ast.Constant(value=str(name)), *_],
            ),
        ):
            return _is_angle(ast.Name(id=name))
        case ast.Name(id=name) | ast.Attribute(attr=name):
            return not _WORDS.isdisjoint(re.split(r"[_\d]+", name.lower()))
    return False


def _whole_angle(types: MessageTypes, holder: ast.expr, z: ast.expr) -> str:
    """Return the yaw whose sine and cosine are z and w without halving; empty if none."""
    angle = _argument_of(types, z, "sin")
    if angle is None or not _is_angle(angle):
        return ""
    if isinstance(types.file.evaluator.single_value(angle), ast.BinOp):
        return ""
    bindings = types.module.index.bindings_of(angle) if isinstance(angle, ast.Name) else ()
    if any(isinstance(binding.value, ast.BinOp) for binding in bindings):
        return ""  # halved before
    text = types.module.text(angle)
    function = types.module.enclosing_function(holder)
    for item in types.assigned:
        if item.field.name == "w" and types.module.text(item.holder) == types.module.text(holder):
            other = _argument_of(types, item.value, "cos")
            if other is not None and types.module.text(other) == text:
                return text if types.module.enclosing_function(item.holder) is function else ""
    return ""


def _argument_of(types: MessageTypes, node: ast.expr, function: str) -> ast.expr | None:
    """Return the argument of a function of math or numpy."""
    match node:
        case ast.Call(args=[argument]):
            name = types.module.qualified_name(node.func) or ""
            return argument if name in {f"math.{function}", f"numpy.{function}"} else None
    return None


def _read_problem(types: MessageTypes, value: ast.expr) -> str:
    """Return the problem with a yaw that is read from a quaternion; empty if there is none."""
    match value:
        case ast.Attribute(attr="z", value=holder) if _is_quaternion(types, holder):
            if _holds_angles(types, holder):
                return ""
            text = types.module.text(holder)
            return (
                "z of a quaternion is not an angle; write "
                f"2.0 * math.atan2({text}.z, {text}.w), or euler_from_quaternion()"
            )
        case ast.Call(
            args=[ast.Attribute(attr="z", value=first), ast.Attribute(attr="w", value=second)]
        ) if types.module.text(first) == types.module.text(second):
            name = types.module.qualified_name(value.func)
            is_half = name in {"math.atan2", "numpy.arctan2"} and _is_quaternion(types, first)
            return "this is half of the angle; multiply by 2.0" if is_half else ""
    return ""


def _holds_angles(types: MessageTypes, holder: ast.expr) -> bool:
    """Return whether w is also read as an angle: the quaternion just stores four of them."""
    module = types.module
    reads = [
        module.parent(read)
        for read in module.index.attributes("w")
        if module.text(read.value) == module.text(holder)
    ]
    return any(
        isinstance(read, ast.Assign)
        and isinstance(read.value, ast.Attribute)
        and any(map(_is_angle, read.targets))
        for read in reads
    )


def _is_quaternion(types: MessageTypes, node: ast.expr) -> bool:
    """Return whether an expression is a quaternion, by its type or field name."""
    owner = types.type_of(node)
    if owner is not None:
        return owner.name == "geometry_msgs/msg/Quaternion"
    value = types.file.evaluator.single_value(node)
    return isinstance(value, ast.Attribute) and value.attr in {"orientation", "rotation"}
