"""What a ``PythonExpression`` of a launch file comes to with the defaults of its arguments."""

from __future__ import annotations

import ast
import builtins
import math
import warnings
from typing import TYPE_CHECKING

from scaffold.model.values import UNKNOWN, Unknown

if TYPE_CHECKING:
    from scaffold.model.launch_py import LaunchFile

_NAMES = frozenset({*dir(builtins), *dir(math), "math"})


def failure(launch: LaunchFile, node: ast.expr | None) -> str:
    """Return why an expression fails when nobody gives another value to its arguments.

    Nothing is evaluated: it is looked at whether Python can read it, and knows its names.
    """
    text = _text(launch, node)
    if not isinstance(text, str) or len(text) > 1000:  # noqa: PLR2004  nobody writes that
        return ""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            tree = ast.parse(text.strip(), mode="eval")
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return f"with the defaults this is {text!r}, which is no expression of Python"
    own = {one.id for one in ast.walk(tree) if isinstance(one, ast.Name) and _is_set(one)}
    own |= {one.arg for one in ast.walk(tree) if isinstance(one, ast.arg)}
    for one in ast.walk(tree):
        if isinstance(one, ast.Name) and one.id not in _NAMES | own:
            return f"with the defaults this is {text!r}: the name {one.id!r} is not defined"
    return ""


def _is_set(name: ast.Name) -> bool:
    return not isinstance(name.ctx, ast.Load)


def _text(launch: LaunchFile, node: ast.expr | None) -> str | Unknown:
    """Return the text of an expression, with the defaults of the launch arguments in it."""
    if not isinstance(node, ast.List):
        return _part(launch, node)
    parts = [_part(launch, item) for item in node.elts]
    texts = [part for part in parts if isinstance(part, str)]
    return "".join(texts) if len(texts) == len(parts) else UNKNOWN


def _part(launch: LaunchFile, node: ast.expr | None) -> str | Unknown:
    call = launch.call_of(node)
    if call is not None and call.kind == "LaunchConfiguration":
        return launch.default_of(node)
    return launch.evaluator.joined_text(node)
