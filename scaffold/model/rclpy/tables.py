"""Loops over literal tables: what their variables stand for in each row."""

from __future__ import annotations

import ast
from collections.abc import Iterable, Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING

from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from scaffold.model.rclpy.evaluation.evaluator import NodeEvaluator

_MOST_ROWS = 30


class Row(NamedTuple):
    """A row of the table that a loop runs over."""

    loop: ast.For | ast.comprehension | None = None
    """The loop; ``None`` outside of loops."""
    values: Mapping[ast.expr, ast.expr] = MappingProxyType({})
    """What variables of the loop stand for in this row."""


ONCE = Row()
"""The row of code outside of loops."""


def rows_of(evaluator: NodeEvaluator, names: Iterable[ast.expr]) -> Sequence[Row]:
    """Return what the variables of one loop among some expressions stand for, row by row.

    One empty row if none of them is one, or if the rows are not all known or differ in length.
    """
    columns: dict[ast.expr, Sequence[ast.expr]] = {}
    loops: set[ast.AST] = set()
    for name in names:
        lookup = (
            evaluator.module.index.lookup(name.id, name) if isinstance(name, ast.Name) else None
        )
        bindings = lookup[1] if lookup is not None else ()
        if len(bindings) == 1 and bindings[0].kind in {"loop", "other"}:
            loop, columns[name] = _column(evaluator, bindings[0].node)
            loops.add(loop)
    number = len(next(iter(columns.values()), ()))
    is_even = all(len(column) == number for column in columns.values())
    only = loops.pop() if len(loops) == 1 else None
    if not isinstance(only, ast.For | ast.comprehension) or not is_even or number > _MOST_ROWS:
        return [ONCE]
    if not _is_complete(evaluator, only.iter):
        return [ONCE]
    rows = zip(*columns.values(), strict=True)
    return [Row(only, dict(zip(columns, row, strict=True))) for row in rows] or [ONCE]


def _is_complete(evaluator: NodeEvaluator, iterated: ast.expr) -> bool:
    """Return whether all rows of a table are known, and certainly in it."""
    match iterated:
        case ast.Call(func=ast.Attribute(value=table, attr="items" | "values"), args=[]):
            values = evaluator.single_value(table)
            return isinstance(values, ast.Dict) and all(values.keys)
        case ast.Call(func=ast.Name(id="enumerate"), args=[table, *_]):
            return _is_complete(evaluator, table)
    if not isinstance(evaluator.single_value(iterated), ast.List | ast.Tuple):
        return False  # such as a parameter, whose default may be replaced
    elements = evaluator.elements(iterated)
    return elements.complete and not any(item.conditional for item in elements.items)


def column(evaluator: NodeEvaluator, target: ast.AST) -> Sequence[ast.expr]:
    """Return the values of a loop variable in each row of a table."""
    return _column(evaluator, target)[1]


def _column(evaluator: NodeEvaluator, target: ast.AST) -> tuple[ast.AST, Sequence[ast.expr]]:
    """Return the loop of a variable, and its values; those may be unknown."""
    places: list[int] = []
    parent = evaluator.module.parent(target)
    while isinstance(parent, ast.Tuple) and target in parent.elts:
        places.insert(0, parent.elts.index(target))
        target, parent = parent, evaluator.module.parent(parent)
    if not isinstance(parent, ast.For | ast.comprehension) or parent.target is not target:
        return target, ()
    iterated = parent.iter
    match iterated, places:
        case ast.Call(func=ast.Name(id="enumerate"), args=[table, *_]), [1, *places]:
            iterated = table
        case ast.Call(func=ast.Attribute(value=table, attr="items")), [0]:
            return parent, _keys(evaluator, table)
        case ast.Call(func=ast.Attribute(attr="items")), [0, *_]:
            return parent, ()
        case ast.Call(func=ast.Attribute(attr="items")), [1, *places]:
            pass
    rows = _rows(evaluator, iterated)
    for place in places:
        rows = entries(rows, place)
    return parent, rows


def _keys(evaluator: NodeEvaluator, table: ast.expr) -> Sequence[ast.expr]:
    """Return the keys of a dictionary; empty if some are unknown."""
    values = evaluator.single_value(table)
    keys = values.keys if isinstance(values, ast.Dict) else []
    return [key for key in keys if key is not None] if all(keys) else ()


def _rows(evaluator: NodeEvaluator, iterated: ast.expr) -> Sequence[ast.expr]:
    """Return the rows of a table, of a dictionary only its values."""
    match iterated:
        case ast.Call(func=ast.Attribute(value=table, attr="items" | "values"), args=[]):
            values = evaluator.single_value(table)
            return values.values if isinstance(values, ast.Dict) else ()
    return [item.node for item in evaluator.elements(iterated).items]


def entries(rows: Sequence[ast.expr], key: object) -> Sequence[ast.expr]:
    """Return the entry with an index or a key of each row that is a literal and has it."""
    result: list[ast.expr] = []
    for row in rows:
        match row:
            case ast.Tuple(elts=values) | ast.List(elts=values) if isinstance(key, int):
                result += values[key : key + 1] if key >= 0 else ()
            case ast.Dict(keys=keys, values=values):
                result += [
                    value
                    for name, value in zip(keys, values, strict=True)
                    if isinstance(name, ast.Constant) and name.value == key
                ]
    return result
