"""The function of the package that a call refers to, where that is certain."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING

from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from scaffold.model.package import Package
    from scaffold.model.rclpy.file import RclpyFile


class Called(NamedTuple):
    """A function that a call is of."""

    name: str
    """For people."""
    takes: ast.arguments
    bound: int
    """How many of the first arguments it is given anyway: 1 for ``self``."""


def called_function(package: Package, file: RclpyFile, call: ast.Call) -> Called | None:
    """Return the method, function or constructor of the package that a call is of.

    Returns:
        ``None`` when it is not sure which one, or what it is given: ``*`` or ``**``.
    """
    if not isinstance(call.func, ast.Name | ast.Attribute):
        return None
    if any(isinstance(arg, ast.Starred) for arg in call.args):
        return None
    if any(word.arg is None for word in call.keywords):
        return None
    if file.callback(call.func).function is not None:
        return _of_this_file(file, call.func)
    return _imported(package, file, call.func) or _constructor(file, call.func)


def _of_this_file(file: RclpyFile, func: ast.expr) -> Called | None:
    callback = file.callback(func)
    function = callback.function
    if function is None or isinstance(function, ast.Lambda) or function.decorator_list:
        return None
    if callback.is_called or callback.is_partial or not _is_only_one(file, func, function):
        return None
    name = callback.name or file.module.text(func)
    return Called(name, function.args, int(callback.is_bound))


def _is_only_one(
    file: RclpyFile, func: ast.expr, function: ast.FunctionDef | ast.AsyncFunctionDef
) -> bool:
    """Tell whether no class that inherits, and no assignment, puts another function in place."""
    others = [node for node in file.module.function_nodes if node.name == function.name]
    if len(others) != 1 or file.evaluator.stores(function.name):
        return False
    if not isinstance(func, ast.Attribute):
        return True
    class_ = file.evaluator.self_class(func.value)
    return class_ is not None and function in class_.body


def _imported(package: Package, file: RclpyFile, func: ast.expr) -> Called | None:
    """Return the function of another module of the package."""
    dotted = file.module.qualified_name(func) or ""
    module, _, name = dotted.rpartition(".")
    path = f"{module.replace('.', '/')}.py"
    if not module or not package.has(path):
        return None
    other = package.module(path)
    bindings = other.index.bindings(other.tree).get(name, ())
    function = bindings[0].node if len(bindings) == 1 else None
    if not isinstance(function, ast.FunctionDef | ast.AsyncFunctionDef):
        return None
    return None if function.decorator_list else Called(file.module.text(func), function.args, 0)


def _constructor(file: RclpyFile, func: ast.expr) -> Called | None:
    """Return the constructor of a class of nodes of this file."""
    class_ = file.evaluator.named_class(func)
    node = file.node_class(class_) if class_ is not None else None
    constructor = node.methods.get("__init__") if node is not None else None
    if class_ is None or constructor is None or constructor.decorator_list:
        return None
    if class_.decorator_list or class_.keywords:
        return None
    return Called(file.module.text(func), constructor.args, 1)
