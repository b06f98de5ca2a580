"""Callbacks that are registered indirectly: in loops, lambdas and partials.

``for topic, kind, callback in [('odom', Odometry, self.on_odom), ...]`` with
``self.create_subscription(kind, topic, callback, 10)`` registers ``on_odom`` like a direct call.
"""

from __future__ import annotations

import ast
from collections.abc import Collection, Iterator, Mapping, Sequence

from scaffold.model.python.conditions.handlers import last_name
from scaffold.record import NamedTuple

_MAX_ROWS = 60
_FUNCTIONS = (ast.FunctionDef, ast.AsyncFunctionDef)
_COMPREHENSIONS = (ast.ListComp, ast.SetComp, ast.GeneratorExp, ast.DictComp)
_Loop = ast.For | ast.comprehension


class Registration(NamedTuple):
    """A call that may register a callback, with the values of the surrounding loops."""

    line: int
    column: int
    """The column of its function, in bytes."""
    function: str
    arguments: Mapping[str, ast.expr]
    """By keyword or position."""


class Target(NamedTuple):
    """A function or method used as a callback."""

    name: str
    order: Sequence[int]
    """The index of the passed argument for each parameter; -1 for another value."""


class _Place(NamedTuple):
    """The class, function and loops around a node."""

    node: ast.AST
    class_: ast.AST | None
    function: ast.AST | None
    loops: Sequence[_Loop]


def registrations(text: str, functions: Collection[str]) -> Iterator[Registration]:
    """Yield the calls of some functions, once for each row of the tables in the loops."""
    try:
        tree = ast.parse(text)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return
    values: dict[tuple[ast.AST | None, str], list[ast.expr]] = {}
    calls: list[tuple[ast.Call, str, _Place]] = []
    for place in _places(tree):
        node = place.node
        if isinstance(node, ast.Assign):
            for target in node.targets:
                values.setdefault(_key(place, target), []).append(node.value)
        elif isinstance(node, ast.Call):
            function = last_name(node.func)
            if function in functions:
                calls.append((node, function, place))
    for call, function, place in calls:
        arguments = {str(at): value for at, value in enumerate(call.args)}
        arguments.update({item.arg: item.value for item in call.keywords if item.arg})
        end = call.func.end_lineno or 0, call.func.end_col_offset or 0
        for row in _rows(place, values):
            given = {key: _replaced(value, row, place, values) for key, value in arguments.items()}
            yield Registration(*end, function, given)


def targets(value: ast.expr, count: int) -> Iterator[Target]:
    """Yield the callbacks that are called with some arguments.

    Args:
        value: The registered expression.
        count: How many arguments are passed.
    """
    match value:
        case ast.Attribute(value=ast.Name(id="self"), attr=name) | ast.Name(id=name):
            yield Target(name, range(count))
        case ast.IfExp(body=body, orelse=orelse):
            yield from targets(body, count)
            yield from targets(orelse, count)
        case ast.Lambda(args=parameters, body=ast.Call(func=called, args=given)):
            names = [item.arg for item in (*parameters.posonlyargs, *parameters.args)][:count]
            order = [_number(item, names) for item in given]
            for target in targets(called, len(order)):
                yield Target(target.name, [order[at] if at >= 0 else -1 for at in target.order])
        case ast.Call(func=ast.Name(id="partial") | ast.Attribute(attr="partial")):
            bound = len(value.args) - 1
            for target in targets(value.args[0], count) if bound >= 0 else ():
                yield Target(target.name, [*[-1] * bound, *target.order])
        case ast.Call(
            func=ast.Name(id="getattr"), args=[ast.Name(id="self"), ast.Constant(value=str(name))]
        ):
            yield Target(name, range(count))


def _number(value: ast.expr, names: Sequence[str]) -> int:
    return names.index(value.id) if isinstance(value, ast.Name) and value.id in names else -1


def _places(tree: ast.Module) -> Iterator[_Place]:
    pending = [_Place(tree, None, None, ())]
    while pending:
        place = pending.pop()
        yield place
        node, class_, function, loops = place
        if isinstance(node, ast.ClassDef):
            class_, function, loops = node, None, ()
        elif isinstance(node, _FUNCTIONS):
            function, loops = node, ()
        elif isinstance(node, ast.For):
            loops = (*loops, node)
        elif isinstance(node, _COMPREHENSIONS):
            loops = (*loops, *node.generators)
        pending += (_Place(child, class_, function, loops) for child in ast.iter_child_nodes(node))


def _key(place: _Place, target: ast.expr) -> tuple[ast.AST | None, str]:
    """Return the key of a variable or an attribute of ``self``."""
    if isinstance(target, ast.Name):
        return place.function, target.id
    is_own = isinstance(target, ast.Attribute) and isinstance(target.value, ast.Name)
    return (place.class_, ast.unparse(target)) if is_own else (None, "")


def _rows(
    place: _Place, values: Mapping[tuple[ast.AST | None, str], list[ast.expr]]
) -> Iterator[Mapping[str, ast.expr]]:
    """Yield the values of the loop variables around a place, for each row."""
    rows: list[dict[str, ast.expr]] = [{}]
    for loop in place.loops:
        target, iterated = loop.target, loop.iter
        match target, iterated:
            case ast.Tuple(elts=[_, item]), ast.Call(
                func=ast.Name(id="enumerate"), args=[table, *_]
            ):
                target, iterated = item, table
        bound = [_loop_values(target, row) for row in _table(iterated, place, values)]
        rows = [{**row, **more} for row in rows for more in bound] or rows
        if len(rows) > _MAX_ROWS:
            return
    yield from rows


def _table(
    iterated: ast.expr,
    place: _Place,
    values: Mapping[tuple[ast.AST | None, str], list[ast.expr]],
) -> list[ast.expr]:
    """Return the rows that a loop runs over, if they are literals."""
    method = ""
    match iterated:
        case ast.Call(func=ast.Attribute(value=value, attr="items" | "values" as method), args=[]):
            iterated = value
    if isinstance(iterated, ast.Name | ast.Attribute):
        stored = values.get(_key(place, iterated), [])
        if not stored and isinstance(iterated, ast.Name):
            stored = values.get((None, iterated.id), [])
        if len(stored) != 1:
            return []
        iterated = stored[0]
    match iterated:
        case ast.Dict(keys=keys, values=entries) if method and None not in keys:
            pairs = zip(keys, entries, strict=True)
            return [
                ast.Tuple([key, entry], ast.Load()) if method == "items" else entry
                for key, entry in pairs
                if key is not None
            ]
        case ast.List(elts=entries) | ast.Tuple(elts=entries) if not method:
            return entries
    return []


def _loop_values(target: ast.expr, value: ast.expr) -> dict[str, ast.expr]:
    """Return the value of each loop variable in one row."""
    if isinstance(target, ast.Name):
        return {target.id: value}
    result: dict[str, ast.expr] = {}
    match target, value:
        case (
            ast.Tuple(elts=names) | ast.List(elts=names),
            ast.Tuple(elts=entries) | ast.List(elts=entries),
        ) if len(names) == len(entries):
            for name, entry in zip(names, entries, strict=True):
                result.update(_loop_values(name, entry))
    return result


def _entry(row: ast.expr, key: object) -> ast.expr | None:
    """Return the entry of a row of a table: ``row[0]`` or ``row['type']``."""
    match row:
        case ast.Tuple(elts=entries) | ast.List(elts=entries) if isinstance(key, int):
            return entries[key] if key < len(entries) else None
        case ast.Dict(keys=keys, values=entries):
            for name, entry in zip(keys, entries, strict=True):
                if isinstance(name, ast.Constant) and name.value == key:
                    return entry
    return None


def _replaced(
    value: ast.expr,
    row: Mapping[str, ast.expr],
    place: _Place,
    values: Mapping[tuple[ast.AST | None, str], list[ast.expr]],
) -> ast.expr:
    """Return an argument, or the value of the variable that it is."""
    match value:
        case ast.Name(id=name) if name in row:
            return row[name]
        case ast.Name():
            stored = values.get(_key(place, value), [])
            return stored[0] if place.function is not None and len(stored) == 1 else value
        case ast.Call(func=func, args=given):
            replaced = [_replaced(item, row, place, values) for item in given]
            return ast.Call(func, replaced, value.keywords)
        case ast.Subscript(value=ast.Name(id=name), slice=ast.Constant(value=key)) if name in row:
            return _entry(row[name], key) or value
        case ast.Lambda(args=parameters, body=ast.Call(func=ast.Name() as called) as body):
            called_ = _replaced(called, row, place, values)
            return ast.Lambda(parameters, ast.Call(called_, body.args, body.keywords))
    return value
