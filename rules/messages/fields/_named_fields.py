"""Fields of messages that code reads or sets by name, also for each row of a table; for MS002."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping, Sequence

from scaffold.api.messages import MessageClass, MessageTypes

_MAX_ROWS = 60
_MAX_DEPTH = 4
_Row = Mapping[str, ast.expr]
"""The values of loop variables."""
_ARGUMENTS = {"getattr": 2, "setattr": 3}


def named_fields(types: MessageTypes) -> Iterator[tuple[MessageClass, ast.Constant]]:
    """Yield the messages and the names of the fields in calls of ``getattr`` and ``setattr``."""
    if not types.module.mentions("attr(") or types.module.mentions("hasattr("):
        return
    named: dict[tuple[str, ast.Constant], MessageClass] = {}
    for call in filter(_is_by_name, types.module.walk(ast.Call)):
        for row in _rows(types, call):
            name = _value(types, call.args[1], row)
            owner = _owner(types, call.args[0], row, _MAX_DEPTH)
            if owner is not None and isinstance(name, ast.Constant):
                named[owner.name, name] = owner
    yield from ((owner, name) for (_, name), owner in named.items())


def _is_by_name(call: ast.Call) -> bool:
    """Return whether a call reads or sets an attribute by name, without a default."""
    match call:
        case ast.Call(func=ast.Name(id=name), args=args, keywords=[]):
            return len(args) == _ARGUMENTS.get(name)
    return False


def _owner(types: MessageTypes, node: ast.expr, row: _Row, depth: int) -> MessageClass | None:
    """Return the message whose field is read or set."""
    if isinstance(node, ast.Name) and depth:
        made = types.module.index.only_value(node)
        if isinstance(made, ast.Call) and _is_by_name(made):
            return _owner(types, made, row, depth - 1)
    if not isinstance(node, ast.Call) or not _is_by_name(node) or not depth:
        return types.type_of(node)
    outer = _owner(types, node.args[0], row, depth - 1)
    name = _value(types, node.args[1], row)
    if outer is None or not isinstance(name, ast.Constant):
        return None
    return types.class_of_field(outer, str(name.value))


def _value(types: MessageTypes, node: ast.expr, row: _Row) -> ast.expr | None:
    """Return an expression, or the value of the variable that it is."""
    match node:
        case ast.Name(id=name) if name in row:
            return row[name]
        case ast.Name():
            return types.module.index.only_value(node)
        case ast.Subscript(value=ast.Name(id=name), slice=ast.Constant(value=int(at))):
            match row.get(name):
                case ast.Tuple(elts=items) | ast.List(elts=items) if at < len(items):
                    return items[at]
            return None
    return node


def _rows(types: MessageTypes, node: ast.AST) -> Iterator[_Row]:
    """Yield the values of the variables of the loops around a node."""
    loops = [it for it in types.module.parents(node) if isinstance(it, ast.For)]
    rows: list[dict[str, ast.expr]] = [{}]
    for loop in reversed(loops):
        rows = [
            {**row, **_bound(loop.target, item)}
            for row in rows
            for item in _items(_value(types, loop.iter, row)) or [ast.Constant(None)]
        ]
        if len(rows) > _MAX_ROWS:
            return
    yield from rows


def _items(table: ast.expr | None) -> Sequence[ast.expr]:
    """Return the items of a literal; each has its place in the code."""
    match table:
        case ast.List(elts=items) | ast.Tuple(elts=items) | ast.Set(elts=items):
            return items
        case ast.Constant(value=str(text)):
            return [ast.copy_location(ast.Constant(letter), table) for letter in text]
        case ast.Call(func=ast.Attribute(attr="items", value=ast.Dict() as pairs), args=[]):
            keys = [key for key in pairs.keys if key is not None]
            return [ast.Tuple([*pair]) for pair in zip(keys, pairs.values, strict=False)]
        case ast.Call(func=ast.Name(id="enumerate" | "zip" as name), args=[inner, *others]):
            start = [ast.Constant(0)] if name == "enumerate" else []
            more = [ast.Constant(None) for _ in others] if name == "zip" else []
            return [ast.Tuple([*start, item, *more]) for item in _items(inner)]
        case ast.Dict(keys=keys):
            return [key for key in keys if key is not None]
    return []


def _bound(target: ast.expr, item: ast.expr) -> dict[str, ast.expr]:
    """Return the loop variables for an item."""
    match target, item:
        case ast.Name(id=name), _:
            return {name: item}
        case (
            ast.Tuple(elts=targets) | ast.List(elts=targets),
            ast.Tuple(elts=items) | ast.List(elts=items),
        ) if len(targets) == len(items):
            pairs = zip(targets, items, strict=True)
            return {name: it for pair in pairs for name, it in _bound(*pair).items()}
    names = [node.id for node in ast.walk(target) if isinstance(node, ast.Name)]
    return dict.fromkeys(names, ast.Constant(None))
