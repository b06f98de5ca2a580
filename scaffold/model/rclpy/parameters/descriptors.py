"""Parameter descriptors: ranges, read-only flags and types."""

from __future__ import annotations

import ast
import math
from typing import TYPE_CHECKING

from scaffold.model.python.conditions.handlers import last_name
from scaffold.model.python.evaluation.values import is_none_literal
from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from scaffold.model.python.evaluation.attributes import AttributeEvaluator as Evaluator
    from scaffold.model.python.scopes import Binding

DESCRIPTOR = "rcl_interfaces.msg.ParameterDescriptor"
_RANGES = {
    "floating_point_range": ("double", "rcl_interfaces.msg.FloatingPointRange"),
    "integer_range": ("integer", "rcl_interfaces.msg.IntegerRange"),
}
_TOLERANCE = 1e-6
"""``Node.PARAM_REL_TOL`` of rclpy."""
_KEEPING = ("append", "declare_parameter", "declare_parameters", "print", "set_descriptor")


class Range(NamedTuple):
    """The allowed range of a number."""

    type: str
    """``double`` or ``integer``; other types are not compared with it."""
    low: float
    high: float
    step: float

    @property
    def text(self) -> str:
        """The range in words: ``0.0 to 1.0 in steps of 0.1``."""
        steps = f" in steps of {self.step}" if self.step else ""
        return f"{self.low} to {self.high}{steps}"

    def allows(self, value: float) -> bool:
        """Return whether rclpy accepts a number; the ends are always valid."""
        low, high = min(self.low, self.high), max(self.low, self.high)
        if self.type == "integer":
            on_step = not self.step or (value - low) % self.step == 0
            return value in {low, high} or (low < value < high and on_step)
        if _is_close(value, low) or _is_close(value, high):
            return True
        if not low < value < high:
            return False
        steps = round((value - low) / self.step) if self.step else 0
        return not self.step or _is_close(low + steps * self.step, value)


class Descriptor(NamedTuple):
    """A descriptor that is created in the same function."""

    is_dynamic: bool
    is_read_only: bool
    ranges: list[Range]
    is_typed: bool


_PLAIN = Descriptor(is_dynamic=False, is_read_only=False, ranges=[], is_typed=False)


def descriptor_of(evaluator: Evaluator, node: ast.expr | None) -> Descriptor | None:
    """Return the descriptor of an expression; ``None`` if not fully known."""
    if node is None or is_none_literal(node):
        return _PLAIN
    fields = message_made(evaluator, node, DESCRIPTOR)
    if fields is None:
        return None
    is_dynamic, is_read_only = (
        _flag(evaluator, fields.get(name)) for name in ("dynamic_typing", "read_only")
    )
    if is_dynamic is None or is_read_only is None:
        return None
    ranges: list[Range] = []
    for name in _RANGES:
        if name in fields:
            bounds = _range(evaluator, name, fields[name])
            if bounds is None:
                return None
            ranges.append(bounds)
    return Descriptor(is_dynamic, is_read_only, ranges, is_typed="type" in fields)


def message_made(evaluator: Evaluator, node: ast.expr, kind: str) -> dict[str, ast.expr] | None:
    """Return the values of the fields of a message where an expression uses it.

    By keywords of the constructor, and by later assignments in the same block; ``append``
    on a field gives a list.

    Returns:
        The fields; ``None`` if it is no such message, or if more may be set.
    """
    if not isinstance(node, ast.Name):
        return _keywords(evaluator, _only_value(evaluator, node), kind)
    first = _assigned_before(evaluator, node)
    if first is None or first.value is None:
        return _keywords(evaluator, _only_value(evaluator, node), kind)
    fields = _keywords(evaluator, first.value, kind)
    if fields is None:
        return None
    for use in evaluator.module.index.names(node.id):
        if isinstance(use.ctx, ast.Load) and _is_between(use, first.node, node):
            same = evaluator.module.index.lookup(use.id, use)
            if same is None or all(item is not first for item in same[1]):
                continue
            if not _record_use(evaluator, use, first, fields):
                return None
    return fields


def _is_close(first: float, second: float) -> bool:
    return math.isclose(first, second, rel_tol=_TOLERANCE)


def _keywords(evaluator: Evaluator, node: ast.expr, kind: str) -> dict[str, ast.expr] | None:
    if not isinstance(node, ast.Call) or kind not in evaluator.module.qualified_names(node.func):
        return None
    if node.args or any(word.arg is None for word in node.keywords):
        return None
    return {word.arg: word.value for word in node.keywords if word.arg is not None}


def _only_value(evaluator: Evaluator, node: ast.expr) -> ast.expr:
    """Return the only value of a name or attribute, if its parts are not changed."""
    if isinstance(node, ast.Name):
        uses: list[ast.AST] = [*evaluator.module.index.names(node.id)]
    elif isinstance(node, ast.Attribute):
        uses = [*evaluator.module.index.attributes(node.attr)]
    else:
        return node
    if any(isinstance(evaluator.module.parent(use), ast.Attribute) for use in uses):
        return node
    return evaluator.single_value(node)


def _assigned_before(evaluator: Evaluator, node: ast.Name) -> Binding | None:
    """Return the last assignment of a name, if all are in the same block as its use."""
    block = _block(evaluator, node)
    last: Binding | None = None
    for binding in evaluator.module.index.bindings_of(node):
        if binding.kind != "assignment" or _block(evaluator, binding.node) != block:
            return None
        if _line(binding.node) < node.lineno:
            last = binding
    return last


def _block(evaluator: Evaluator, node: ast.AST) -> tuple[ast.AST | None, str]:
    """Return the block that contains the statement of a node."""
    module = evaluator.module
    while not isinstance(node, ast.stmt):
        parent = module.parent(node)
        if parent is None:
            return None, ""
        node = parent
    return module.parent(node), module.index.place(node)[0]


def _line(node: ast.AST) -> int:
    return getattr(node, "lineno", 0)


def _is_between(use: ast.Name, first: ast.AST, last: ast.Name) -> bool:
    return use is not last and _line(first) < use.lineno <= last.lineno


def _record_use(
    evaluator: Evaluator, use: ast.Name, first: Binding, fields: dict[str, ast.expr]
) -> bool:
    """Record the fields set by a use of the message; return false if unknown."""
    module = evaluator.module
    parent = module.parent(use)
    above = module.parent(parent) if parent is not None else None
    is_straight = _block(evaluator, use) == _block(evaluator, first.node)
    match parent, above:
        case ast.Attribute(attr=name, ctx=ast.Store()), ast.Assign(targets=[_], value=value):
            fields[name] = value
            return is_straight
        case ast.Attribute(attr=name), ast.Attribute(attr="append"):
            call = module.parent(above)
            if not isinstance(call, ast.Call) or len(call.args) != 1 or name in fields:
                return False
            fields[name] = ast.copy_location(ast.List(elts=[call.args[0]], ctx=ast.Load()), call)
            return is_straight
        case ast.Attribute(ctx=ast.Load()), _:
            return not isinstance(above, ast.Attribute | ast.Subscript | ast.Call)
    if isinstance(parent, ast.Tuple | ast.List):
        return True
    call = above if isinstance(parent, ast.keyword) else parent
    return isinstance(call, ast.Call) and _leaves_unchanged(call)


def _leaves_unchanged(call: ast.Call) -> bool:
    """Return whether a call does not change the fields of its arguments."""
    name = last_name(call.func)
    return name in _KEEPING or name[:1].isupper()


def _flag(evaluator: Evaluator, node: ast.expr | None) -> bool | None:
    if node is None:
        return False
    value = evaluator.evaluate(node)
    return value if isinstance(value, bool) else None


def _range(evaluator: Evaluator, field: str, node: ast.expr) -> Range | None:
    type_, kind = _RANGES[field]
    items, is_complete = evaluator.elements(node)
    if len(items) != 1 or not is_complete:
        return None
    fields = message_made(evaluator, items[0].node, kind)
    if fields is None:
        return None
    numbers: list[float] = []
    for name in ("from_value", "to_value", "step"):
        value = evaluator.number(fields[name]) if name in fields else 0
        if not isinstance(value, int | float):
            return None
        numbers.append(float(value) if type_ == "double" else value)
    return Range(type_, *numbers)
