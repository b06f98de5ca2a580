"""The arguments that calls pass for the parameters of functions."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from scaffold.model.python.scopes import FunctionNode
    from scaffold.model.python.syntax_tree import SyntaxTree


def given_once(module: SyntaxTree, parameter: ast.AST) -> ast.expr | None:
    """Return the argument for a parameter of a function if the file only calls it once."""
    function = module.parent(module.parent(parameter) or parameter)
    if not isinstance(parameter, ast.arg) or not isinstance(function, ast.FunctionDef):
        return None
    if function.decorator_list or not isinstance(module.parent(function), ast.Module):
        return None
    uses = [name for name in module.index.names(function.name) if isinstance(name.ctx, ast.Load)]
    call = module.parent(uses[0]) if len(uses) == 1 else None
    if not isinstance(call, ast.Call) or call.func is not uses[0]:
        return None
    return given_argument(function, call, parameter, is_method=False)


def given_argument(
    function: FunctionNode, call: ast.Call, parameter: ast.arg, *, is_method: bool
) -> ast.expr | None:
    """Return the argument for a parameter in a call, or its default.

    ``None`` if that is unknown: ``*args``, ``**kwargs``, a variadic parameter.
    """
    signature = function.args
    positional = [*signature.posonlyargs, *signature.args]
    if parameter not in positional and parameter not in signature.kwonlyargs:
        return None
    if any(word.arg is None for word in call.keywords):
        return None
    for word in call.keywords:
        if word.arg == parameter.arg:
            return word.value
    if parameter in positional:
        position = positional.index(parameter) - is_method
        if any(isinstance(arg, ast.Starred) for arg in call.args[: position + 1]):
            return None
        if 0 <= position < len(call.args):
            return call.args[position]
    defaults: dict[ast.arg, ast.expr | None] = dict(
        zip(reversed(positional), reversed(signature.defaults), strict=False)
    )
    defaults.update(zip(signature.kwonlyargs, signature.kw_defaults, strict=True))
    return defaults.get(parameter)
