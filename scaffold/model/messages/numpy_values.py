"""NumPy values that message fields reject although they look like numbers."""

from __future__ import annotations

import ast
from collections.abc import Mapping
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from scaffold.model.messages.inference import MessageTypes

_SINGLE = ("float", "numpy.float32")
_MADE: Mapping[str, tuple[str, str]] = {
    "numpy.float16": ("float", "numpy.float16"),
    "numpy.float32": _SINGLE,
    "numpy.bool_": ("bool", "numpy.bool_"),
    "numpy.all": ("bool", "numpy.bool_"),
    "numpy.any": ("bool", "numpy.bool_"),
}
"""The class that numpy functions return, and the similar Python type.

Humble refuses its objects with an AssertionError; later the C code of a message takes them for
what they look like, and other values arrive. A ``numpy.float64`` is a float.
"""
_REDUCING = frozenset(
    {"amax", "amin", "max", "mean", "median", "min", "nanmax", "nanmean", "nanmin", "std", "sum"}
)
"""Functions and array methods that return one number of the element type."""
_ARRAYS = frozenset({"numpy.array", "numpy.asarray"})
_MAX_DEPTH = 6
"""The maximum number of names, slices and copies to follow."""


def numpy_class(types: MessageTypes, node: ast.expr) -> tuple[str, str] | None:
    """Return the Python type that a value resembles, and its numpy class."""
    value = types.file.evaluator.single_value(node)
    if not isinstance(value, ast.Call) or value.keywords:
        return None
    name = types.module.qualified_name(value.func) or ""
    if len(value.args) == 1:
        root, _, function = name.rpartition(".")
        if root == "numpy" and function in _REDUCING:
            return _SINGLE if _is_single_precision(types, value.args[0]) else None
        return _MADE.get(name)
    match value:
        case ast.Call(func=ast.Attribute(attr=method, value=array), args=[]) if (
            method in _REDUCING and _is_single_precision(types, array)
        ):
            return _SINGLE
    return None


def _is_single_precision(types: MessageTypes, node: ast.expr) -> bool:
    """Return whether numpy converts a field to an array of 32-bit floats."""
    for _ in range(_MAX_DEPTH):
        node = types.file.evaluator.single_value(node)
        field = types.field_type_of(node)
        if field is not None:
            return field.name == "float32" and field.is_array
        match node:
            case ast.Subscript(value=value):
                node = value
            case ast.Call(func=func, args=[value], keywords=[]) if (
                types.module.qualified_name(func) in _ARRAYS
            ):
                node = value
            case _:
                return False
    return False
