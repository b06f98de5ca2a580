"""Evaluates launch conditions on the target, if they depend on ROS_DISTRO.

Unknown parts, such as launch arguments, are placeholders in the text; a condition that contains
them may still be decided by its other parts.
"""

from __future__ import annotations

import ast
import warnings
from collections.abc import Iterable, Sequence

from scaffold.distributions import VARIABLE, target
from scaffold.model.python.conditions.distribution_conditions import asks, holds, value_on_target
from scaffold.model.python.module import PythonModule
from scaffold.record import NamedTuple
from scaffold.source import Source, ViewError

HOLE = "__unknown__"
"""The placeholder of unknown parts: a valid Python name, as the text may be an expression."""
_TRUE = frozenset({"true", "1"})
_FALSE = frozenset({"false", "0"})
_MAX_LENGTH = 1000


class Text(NamedTuple):
    """The value of a substitution."""

    value: str
    """The text, with `HOLE` for each unknown part."""
    is_specific: bool = False
    """Whether the distribution decides it."""


UNKNOWN = Text(HOLE)


def truth(text: Text) -> bool | None:
    """Return whether a condition is true on the target; ``None`` if that is open."""
    return _boolean(text) if text.is_specific else None


def _boolean(text: Text) -> bool | None:
    value = text.value.strip().lower()
    return True if value in _TRUE else False if value in _FALSE else None


def as_text(decision: bool | None, *, is_specific: bool) -> Text:  # noqa: FBT001  three values
    """Return a decision as text for launch."""
    return Text(HOLE if decision is None else str(decision).lower(), is_specific)


def joined(parts: Iterable[Text]) -> Text:
    """Join texts like launch joins lists of substitutions."""
    listed = [*parts]
    return Text("".join(text.value for text in listed), any(text.is_specific for text in listed))


def of_environment(name: str) -> Text:
    """Return the value of an environment variable."""
    return Text(target().name, is_specific=True) if name == VARIABLE else UNKNOWN


def applied(kind: str, operands: Sequence[Text]) -> Text:
    """Return the value of a substitution.

    Args:
        kind: Its name in XML, such as ``equals``.
        operands: Its arguments.
    """
    is_specific = any(operand.is_specific for operand in operands)
    values = [_boolean(operand) for operand in operands]
    match kind, operands:
        case "env", [name, *_]:
            return of_environment(name.value)
        case "eval", [expression]:
            return _evaluated(expression)
        case "equals" | "not-equals", [left, right]:
            is_open = HOLE in left.value + right.value
            is_same = (left.value == right.value) == (kind == "equals")
            return as_text(None if is_open else is_same, is_specific=is_specific)
        case "not", [_]:
            return as_text(None if values[0] is None else not values[0], is_specific=is_specific)
        case ("and" | "all") | ("or" | "any"), [_, *_]:
            deciding = kind in {"or", "any"}
            decided = None if None in values else not deciding
            return as_text(deciding if deciding in values else decided, is_specific=is_specific)
    return UNKNOWN


def _evaluated(expression: Text) -> Text:
    """Evaluate a Python expression statically."""
    if len(expression.value) > _MAX_LENGTH:
        return UNKNOWN
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            tree = _Holes().visit(ast.parse(expression.value.strip(), mode="eval"))
            module = PythonModule.parse(Source("condition", f"import os\n{ast.unparse(tree)}\n"))
    except (SyntaxError, ValueError, RecursionError, MemoryError, ViewError):
        return UNKNOWN
    statement = module.tree.body[-1]
    if not isinstance(statement, ast.Expr):
        return UNKNOWN
    is_specific = expression.is_specific or asks(module, statement.value)
    value, _ = value_on_target(module, statement.value)
    if isinstance(value, str):
        return Text(value, is_specific)
    return as_text(holds(module, statement.value, is_specific=True), is_specific=is_specific)


class _Holes(ast.NodeTransformer):
    """Replaces unknown parts of texts with names whose values are unknown."""

    def visit_Constant(self, node: ast.Constant) -> ast.expr:
        is_open = isinstance(node.value, str) and HOLE in node.value
        return ast.Name(HOLE, ast.Load()) if is_open else node
