"""NumPy arrays in code, and dtypes given as strings."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.model.rclpy.file import RclpyFile

ARRAY = "numpy.ndarray"
DTYPE = "numpy.dtype"
_TYPED = frozenset(
    f"numpy.{name}"
    for name in (
        *("array", "asarray", "asanyarray", "empty", "frombuffer", "fromfile", "fromiter"),
        *("fromstring", "ones", "zeros"),
    )
)
"""Functions that return arrays, and whose second argument is a type."""
_MAKERS = _TYPED | {
    f"numpy.{name}"
    for name in (
        *("arange", "ascontiguousarray", "column_stack", "concatenate", "copy", "dstack"),
        *("empty_like", "eye", "full", "full_like", "hstack", "identity", "linspace", "loadtxt"),
        *("logspace", "ones_like", "ravel", "repeat", "stack", "tile", "vstack", "zeros_like"),
    )
}
"""Functions that return arrays."""
_METHODS = frozenset(
    ("astype", "clip", "copy", "flatten", "ravel", "repeat", "reshape", "squeeze", "transpose")
)
"""Methods of arrays that return arrays."""
_MAX_DEPTH = 8


def is_array(file: RclpyFile, node: ast.expr, depth: int = 0) -> bool:
    """Return whether an expression is certainly an array of NumPy.

    Args:
        file: The file.
        node: The expression.
        depth: The number of expressions followed so far.
    """
    value = file.evaluator.single_value(node)
    if isinstance(value, ast.Call):
        if not file.module.qualified_names(value.func).isdisjoint(_MAKERS):
            return True
        match value.func:
            case ast.Attribute(attr=name, value=base) if name in _METHODS and depth < _MAX_DEPTH:
                return is_array(file, base, depth + 1)
        return False
    argument = file.parameter_of(value if isinstance(value, ast.expr) else node)
    if argument is None or argument.annotation is None:
        return False
    return file.module.qualified_name(argument.annotation) == ARRAY


def type_names(file: RclpyFile) -> Iterator[ast.Constant]:
    """Yield the strings given as a type to NumPy calls."""
    for call in file.module.walk(ast.Call):
        for node in _types(file, call):
            if isinstance(node, ast.Constant) and isinstance(node.value, str):
                yield node


def _types(file: RclpyFile, call: ast.Call) -> Iterator[ast.expr]:
    """Yield the type arguments of a call."""
    names = file.module.qualified_names(call.func)
    is_of_numpy = any(name.startswith("numpy.") for name in names)
    at = 0 if DTYPE in names else 1 if not names.isdisjoint(_TYPED) else None
    match call.func:
        case ast.Attribute(attr="astype", value=value) if not names and is_array(file, value):
            at, is_of_numpy = 0, True
    if at is not None and not any(isinstance(item, ast.Starred) for item in call.args):
        yield from call.args[at : at + 1]
    if is_of_numpy:
        yield from (word.value for word in call.keywords if word.arg == "dtype")
