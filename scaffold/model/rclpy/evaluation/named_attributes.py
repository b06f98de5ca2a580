"""Attributes that code reads and sets by name: ``getattr(self, f'on_{name}')``."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from scaffold.model.rclpy.file import RclpyFile

_SETTING = 3
"""The number of arguments of setattr()."""


def set_by_name(file: RclpyFile) -> frozenset[str] | None:
    """Return the attributes that a file sets with setattr(); ``None`` if any name is unknown."""
    result: set[str] = set()
    for name in file.module.index.names("setattr"):
        call = file.module.call_with(name)
        if call is None or len(call.args) != _SETTING:
            return None
        names = names_in(file, call.args[1])
        if names is None:
            return None
        result |= names
    return frozenset(result)


def read_by_name(file: RclpyFile, class_: ast.ClassDef) -> Iterator[tuple[ast.Call, str]]:
    """Yield the attributes of ``self`` that a class reads with getattr(), without a default."""
    for name in file.module.index.names("getattr"):
        match file.module.call_with(name):
            case ast.Call(args=[owner, given], keywords=[]) as call:
                if file.evaluator.self_class(owner) is class_:
                    for text in sorted(names_in(file, given) or ()):
                        yield call, text


def names_in(file: RclpyFile, node: ast.expr) -> frozenset[str] | None:
    """Return all values of a text, which may contain the variable of a loop over known texts.

    ``None`` if any of them is unknown.
    """
    text = file.evaluator.text(node)
    if isinstance(text, str):
        return frozenset({text})
    variables = {part.id: part for part in ast.walk(node) if isinstance(part, ast.Name)}
    if len(variables) != 1:
        return None
    ((variable, use),) = variables.items()
    values = _looped_texts(file, use)
    texts = [_text(node, {variable: value}) for value in values or ()]
    found = frozenset(text for text in texts if text is not None)
    return found if values and None not in texts else None


def _text(node: ast.expr, values: Mapping[str, str]) -> str | None:
    """Return a text made of constants and known variables."""
    match node:
        case ast.Constant(value=str(text)):
            return text
        case ast.Name(id=name):
            return values.get(name)
        case ast.FormattedValue(value=value, conversion=-1, format_spec=None):
            return _text(value, values)
        case ast.JoinedStr(values=nodes):
            parts = [_text(part, values) for part in nodes]
        case ast.BinOp(left=left, op=ast.Add(), right=right):
            parts = [_text(left, values), _text(right, values)]
        case _:
            return None
    known = [part for part in parts if part is not None]
    return "".join(known) if len(known) == len(parts) else None


def _looped_texts(file: RclpyFile, use: ast.Name) -> list[str] | None:
    """Return the values of the variable of a loop; ``None`` if any is unknown."""
    bound = file.module.index.only_node(use)
    target = file.module.parent(bound) if bound is not None else None
    at = -1
    if bound is not None and isinstance(target, ast.Tuple):
        at = [*map(id, target.elts)].index(id(bound))
        target = file.module.parent(target)
    if not isinstance(target, ast.For | ast.comprehension):
        return None
    texts = [file.evaluator.text(item) for item in _items(file, target.iter, at)]
    known = [text for text in texts if isinstance(text, str)]
    return known if known and len(known) == len(texts) else None


def _items(file: RclpyFile, iterated: ast.expr, at: int) -> Iterator[ast.expr | None]:
    """Yield what a loop assigns to its variable, the one at a position of a tuple."""
    match iterated:
        case ast.Call(func=ast.Attribute(attr="items", value=holder), args=[]) if at == 0:
            table = file.evaluator.single_value(holder)
            yield from table.keys if isinstance(table, ast.Dict) else [None]
            return
    value = file.evaluator.single_value(iterated)
    elements = file.evaluator.elements(value if isinstance(value, ast.Tuple) else iterated)
    if not elements.complete:
        yield None
    for item in elements.items:
        made = file.evaluator.single_value(item.node)
        if at < 0:
            yield made
        elif isinstance(made, ast.Tuple | ast.List) and at < len(made.elts):
            yield made.elts[at]
        else:
            yield None
