r"""Evaluates xacro expressions in attributes, as far as possible without arguments.

Parts that are only known at run time are kept in the text between two ``\0``: texts with the same
unknown part compare equal.
"""

from __future__ import annotations

import ast
import math
import operator
import re
from collections.abc import Callable, Iterator, Mapping

from scaffold import lazy_re

Value = str | int | float | bool
"""The supported values of properties; all others are unknown."""

UNKNOWN_MARK = "\0"
SHARE_MARK = "\2"
"""The marks around the package name of ``$(find package)``."""
_MAX_TEXT = 5_000
_TOKEN = lazy_re.compile(r"\${2,99}[{(]|\$\{[^}]{0,900}\}|\$\([^)]{0,900}\)|[^$]+|\$")
_MATH: Mapping[str, object] = {
    name: value for name, value in vars(math).items() if not name.startswith("_")
}
_PYTHON: Mapping[str, object] = {
    "len": len, "str": str, "float": float, "int": int, "min": min, "max": max, "round": round,
}  # fmt: skip
BUILT_IN = frozenset(
    {*_MATH, *_PYTHON, "list", "dict", "map", "True", "False", "None", "sorted", "range"}
    | {"load_yaml", "abs_filename", "dotify", "python", "math", "xacro"}
)
"""The names that every expression of xacro may use."""
COMMANDS = ("find", "env", "optenv", "dirname", "arg", "eval", "anon", "cwd")
"""The commands of ``$(...)``."""
_OPERATORS: Mapping[type, Callable[..., object]] = {
    ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul,
    ast.Div: operator.truediv, ast.FloorDiv: operator.floordiv, ast.Mod: operator.mod,
    ast.USub: operator.neg, ast.UAdd: operator.pos, ast.Not: operator.not_,
    ast.Eq: operator.eq, ast.NotEq: operator.ne, ast.Lt: operator.lt, ast.LtE: operator.le,
    ast.Gt: operator.gt, ast.GtE: operator.ge,
}  # fmt: skip


class NotKnownError(Exception):
    """The value of an expression is only known at run time."""


def tokens(text: str) -> Iterator[str]:
    """Yield the parts of a text: ``${...}``, ``$(...)``, and plain text."""
    for match in _TOKEN.finditer(text):
        yield match[0]


def is_known(value: object) -> bool:
    """Return whether a value has no unknown parts."""
    return not (isinstance(value, str) and UNKNOWN_MARK in value)


def unknown(text: str) -> str:
    """Return a placeholder for a text that is only known at run time."""
    return f"{UNKNOWN_MARK}{text.replace(UNKNOWN_MARK, '')}{UNKNOWN_MARK}"


def shown(text: str) -> str:
    """Return a text for messages, with placeholders as references to what is unknown."""
    return re.sub(f"{UNKNOWN_MARK}([^{UNKNOWN_MARK}]*){UNKNOWN_MARK}", _reference, text)


def _reference(mark: re.Match[str]) -> str:
    name = mark[1].partition(" ")[0]
    return f"$({mark[1]})" if name == "arg" else f"${{{name}}}"


def may_be(name: str, other: str) -> bool:
    """Return whether two names may be the same, as far as they are known."""
    if name == other:
        return True
    if is_known(name) or is_known(other):
        text, pattern = (name, other) if is_known(name) else (other, name)
        parts = pattern.split(UNKNOWN_MARK)
        return re.fullmatch(".*".join(map(re.escape, parts[::2])), text) is not None
    first, second = _start(name), _start(other)
    is_common = bool(first) and first == second
    rest = (name.removeprefix(first), other.removeprefix(first))
    return not is_common or not all(map(is_known, rest)) or rest[0] == rest[1]


def _start(name: str) -> str:
    """Return the placeholder that a name starts with, which has one value; empty if none."""
    match = re.match(f"{UNKNOWN_MARK}[^{UNKNOWN_MARK}]*{UNKNOWN_MARK}", name)
    return match[0] if match is not None else ""


def literal(text: str) -> Value:
    """Return the number, bool or string that xacro reads from the value of a property."""
    if len(text) > 1 and text[0] == text[-1] == "'":
        return text[1:-1]
    if "_" in text:
        return text
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            continue
    return {"true": True, "True": True, "false": False, "False": False}.get(text, text)


def truth(value: Value) -> bool | None:
    """Return the value of a condition; ``None`` if unknown.

    Raises:
        ValueError: xacro rejects the condition.
    """
    if not is_known(value):
        return None
    if isinstance(value, str):
        named = {"true": True, "True": True, "false": False, "False": False}.get(value)
        return bool(int(value)) if named is None else named
    return bool(value)


def names_in(expression: str) -> list[str]:
    """Return the free names of an expression; raises SyntaxError."""
    tree = ast.parse(expression.strip(), mode="eval")
    bound = {
        node.id
        for node in ast.walk(tree)
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)
    }
    bound.update(node.arg for node in ast.walk(tree) if isinstance(node, ast.arg))
    used = [node.id for node in ast.walk(tree) if isinstance(node, ast.Name)]
    return [name for name in dict.fromkeys(used) if name not in bound]


def evaluate(expression: str, look_up: Callable[[str], Value]) -> Value:
    """Return the value of an expression.

    Args:
        expression: The text inside of ``${...}``.
        look_up: Returns the value of a property.

    Raises:
        NotKnownError: it is unknown.
    """
    try:
        tree = ast.parse(expression.strip(), mode="eval")
        value = _value(tree.body, look_up)
    except NotKnownError:
        raise
    except (ArithmeticError, LookupError, SyntaxError, TypeError, ValueError) as error:
        raise NotKnownError from error
    if not isinstance(value, (str, int, float)) or len(str(value)) > _MAX_TEXT:
        raise NotKnownError
    return value


def _value(node: ast.expr, look_up: Callable[[str], Value]) -> object:
    match node:
        case ast.Constant(value=value) if isinstance(value, (str, int, float)):
            return value
        case ast.Name(id=name):
            named = _MATH[name] if name in _MATH else look_up(name)
            if is_known(named):
                return named
        case ast.IfExp(test=test, body=body, orelse=orelse):
            return _value(body if _value(test, look_up) else orelse, look_up)
        case ast.Call(func=function, args=args, keywords=[]):
            return _function(function)(*(_value(item, look_up) for item in args))
        case _:
            return _computed(node, look_up)
    raise NotKnownError


def _computed(node: ast.expr, look_up: Callable[[str], Value]) -> object:
    """Return the value of an operation."""
    match node:
        case ast.BinOp(left=left, op=op, right=right):
            values = [_value(left, look_up), _value(right, look_up)]
            if isinstance(op, ast.Mult) and not _are_numbers(*values):
                raise NotKnownError
        case ast.Compare(left=left, ops=[op], comparators=[right]):
            values = [_value(left, look_up), _value(right, look_up)]
        case ast.UnaryOp(op=op, operand=operand):
            values = [_value(operand, look_up)]
        case ast.BoolOp(op=op, values=items):
            wanted = isinstance(op, ast.Or)
            values = [_value(item, look_up) for item in items]
            return next((value for value in values if bool(value) is wanted), values[-1])
        case _:
            raise NotKnownError
    if type(op) not in _OPERATORS:
        raise NotKnownError
    return _OPERATORS[type(op)](*values)


def _are_numbers(*values: object) -> bool:
    return all(isinstance(value, (int, float)) for value in values)


def _function(node: ast.expr) -> Callable[..., object]:
    match node:
        case ast.Name(id=name) | ast.Attribute(value=ast.Name(id="math" | "python"), attr=name):
            function = _MATH.get(name) or _PYTHON.get(name)
            if callable(function) and name not in {"factorial", "comb", "perm"}:
                return function
    raise NotKnownError
