"""The values of expressions whose parts are evaluated: operators, literals, methods of text."""

from __future__ import annotations

import ast
from collections.abc import Callable, Mapping

from scaffold.model.python.evaluation.values import (
    COMPARISONS,
    UNKNOWN,
    Glob,
    PathValue,
    binary,
    format_text,
    is_hashable,
    is_known,
    join_paths,
    path_method,
    same,
    text_method,
)

Evaluate = Callable[[ast.expr], object]
"""Returns the value of an expression; ``UNKNOWN`` if it is not certain."""


def _f_string(evaluate: Evaluate, node: ast.JoinedStr) -> object:
    parts: list[str] = []
    for part in node.values:
        if isinstance(part, ast.FormattedValue):
            text = _formatted(evaluate, part)
            if text is None:
                return UNKNOWN
            parts.append(text)
        elif isinstance(part, ast.Constant):
            parts.append(str(part.value))
    return "".join(parts)


def _formatted(evaluate: Evaluate, node: ast.FormattedValue) -> str | None:
    value = evaluate(node.value)
    if not isinstance(value, str | int | float):
        return value.text if isinstance(value, PathValue) and not node.format_spec else None
    convert: dict[int, Callable[[object], str]] = {115: str, 114: repr, 97: ascii}
    if node.conversion in convert:
        value = convert[node.conversion](value)
    spec = evaluate(node.format_spec) if node.format_spec else ""
    return None if spec is UNKNOWN else format_text(f"{{:{spec}}}", (value,), {})


def _binary(evaluate: Evaluate, node: ast.BinOp) -> object:
    left, right = evaluate(node.left), evaluate(node.right)
    if left is UNKNOWN or right is UNKNOWN:
        return UNKNOWN
    return binary(type(node.op), left, right)


def _unary(evaluate: Evaluate, node: ast.UnaryOp) -> object:
    value = evaluate(node.operand)
    if isinstance(node.op, ast.Not):
        return (not value) if is_known(value) else UNKNOWN
    if not isinstance(value, int | float) or isinstance(node.op, ast.Invert):
        return UNKNOWN
    return -value if isinstance(node.op, ast.USub) else +value


def _boolean(evaluate: Evaluate, node: ast.BoolOp) -> object:
    wanted = isinstance(node.op, ast.Or)
    value: object = UNKNOWN
    for part in node.values:
        value = evaluate(part)
        if not is_known(value):
            return UNKNOWN
        if bool(value) is wanted:
            return value
    return value


def comparison(evaluate: Evaluate, node: ast.Compare) -> object:
    """Return the result of comparing two values."""
    left, right = evaluate(node.left), evaluate(node.comparators[0])
    compare = COMPARISONS.get(type(node.ops[0]))
    if len(node.ops) > 1 or compare is None or not is_known(left) or not is_known(right):
        return UNKNOWN
    try:
        return compare(left, right)
    except TypeError:  # of `in`
        return UNKNOWN


def _conditional(evaluate: Evaluate, node: ast.IfExp) -> object:
    test = evaluate(node.test)
    if is_known(test):
        return evaluate(node.body if test else node.orelse)
    first, second = evaluate(node.body), evaluate(node.orelse)
    return first if same(first, second) else UNKNOWN


def _sequence(evaluate: Evaluate, node: ast.List | ast.Tuple | ast.Set) -> object:
    values: list[object] = []
    for part in node.elts:
        if not isinstance(part, ast.Starred):
            values.append(evaluate(part))
            continue
        inner = evaluate(part.value)
        if not isinstance(inner, list | tuple):
            return UNKNOWN
        values.extend(inner)
    return tuple(values) if isinstance(node, ast.Tuple) else values


def _dictionary(evaluate: Evaluate, node: ast.Dict) -> object:
    result: dict[object, object] = {}
    for key, value in zip(node.keys, node.values, strict=True):
        if key is None:
            inner = evaluate(value)
            if not isinstance(inner, dict):
                return UNKNOWN
            result.update(inner)
            continue
        constant = evaluate(key)
        if not isinstance(constant, str | int | float):
            return UNKNOWN
        result[constant] = evaluate(value)
    return result


def subscript(evaluate: Evaluate, node: ast.Subscript) -> object:
    """Return an item of a list, a text or a dictionary."""
    holder, key = evaluate(node.value), evaluate(node.slice)
    if isinstance(holder, dict) and isinstance(key, str | int | float):
        return holder.get(key, UNKNOWN)
    if isinstance(holder, str | tuple | list) and type(key) is int:
        if any(isinstance(item, Glob) for item in holder):
            return UNKNOWN
        return holder[key] if -len(holder) <= key < len(holder) else UNKNOWN
    return UNKNOWN


def _walrus(evaluate: Evaluate, node: ast.NamedExpr) -> object:
    return evaluate(node.value)


def joined_path(evaluate: Evaluate, node: ast.Call) -> object:
    """Return the value of ``os.path.join(...)``."""
    parts: list[object] = []
    for arg in node.args:
        if isinstance(arg, ast.Starred):
            inner = evaluate(arg.value)
            parts.extend(inner if isinstance(inner, list | tuple) else [UNKNOWN])
        else:
            parts.append(evaluate(arg))
    texts = [part.text if isinstance(part, PathValue) else part for part in parts]
    strings = [text for text in texts if isinstance(text, str)]
    return join_paths(strings) if strings and len(strings) == len(texts) else UNKNOWN


def method_result(evaluate: Evaluate, node: ast.Call, func: ast.Attribute) -> object:
    """Return the value of a call of a method of a text, a path or a dictionary."""
    holder = evaluate(func.value)
    args = [evaluate(arg) for arg in node.args]
    keywords = {word.arg or "**": evaluate(word.value) for word in node.keywords}
    if not all(map(is_known, (*args, *keywords.values()))) and func.attr != "join":
        return UNKNOWN
    match holder:
        case str():
            return text_method(holder, func.attr, args, keywords)
        case PathValue() | Glob():
            return path_method(holder, func.attr, args, keywords)
        case dict() if func.attr == "get" and args and is_hashable(args[0]):
            return holder.get(*args[:2])
        case dict() if func.attr in _PARTS and not args:
            return _PARTS[func.attr](holder)
        case _:
            return UNKNOWN


_PARTS: Mapping[str, Callable[[dict[object, object]], list[object]]] = {
    "keys": list,
    "values": lambda holder: [*holder.values()],
    "items": lambda holder: [*holder.items()],
}
OPERATIONS: Mapping[type[ast.expr], Callable[..., object]] = {
    ast.JoinedStr: _f_string,
    ast.BinOp: _binary,
    ast.UnaryOp: _unary,
    ast.BoolOp: _boolean,
    ast.IfExp: _conditional,
    ast.List: _sequence,
    ast.Tuple: _sequence,
    ast.Set: _sequence,
    ast.Dict: _dictionary,
    ast.NamedExpr: _walrus,
}
"""Functions that return the value of a kind of expression, given how to evaluate its parts."""
