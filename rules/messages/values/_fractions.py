"""Fractions of a second that become nanoseconds with another factor."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api.messages import MessageTypes

Flaw = tuple[ast.expr, str]
"""The place and the problem."""
_PARTS = frozenset((f"builtin_interfaces/msg/{name}", "nanosec") for name in ("Time", "Duration"))
_IN_A_SECOND = 1e9
_WHOLE = frozenset({"int", "floor", "trunc"})


def flaws(types: MessageTypes) -> Iterator[Flaw]:
    """Yield ``stamp.nanosec = int((now % 1) * 1e6)``, and products with another power of ten."""
    for item in types.assigned:
        if (item.owner.name, item.field.name) not in _PARTS:
            continue
        match _unwrapped(types, item.value):
            case ast.BinOp(left=left, op=ast.Mult(), right=right):
                for fraction, factor in ((left, right), (right, left)):
                    number = types.file.evaluator.number(factor)
                    is_number = isinstance(number, int | float) and number != _IN_A_SECOND
                    if is_number and _is_fraction(types, fraction):
                        text = types.module.text(factor)
                        yield factor, f"a second has 1e9 nanoseconds, but this multiplies by {text}"


def _unwrapped(types: MessageTypes, node: ast.expr) -> ast.expr:
    """Return the argument of ``int()`` or ``round()``, or the expression itself."""
    value = types.file.evaluator.single_value(node)
    match value:
        case ast.Call(func=ast.Name(id="int" | "round"), args=[inner, *_]):
            return types.file.evaluator.single_value(inner)
    return value


def _is_fraction(types: MessageTypes, node: ast.expr) -> bool:
    """Return whether an expression is ``x % 1``, or ``x - int(x)``."""
    evaluator = types.file.evaluator
    match evaluator.single_value(node):
        case ast.BinOp(op=ast.Mod(), right=right):
            return evaluator.number(right) == 1
        case ast.BinOp(left=time, op=ast.Sub(), right=right):
            match evaluator.single_value(right):
                case ast.Call(func=ast.Name(id=name) | ast.Attribute(attr=name), args=[inner]) if (
                    name in _WHOLE
                ):
                    return types.module.text(inner) == types.module.text(time)
    return False
