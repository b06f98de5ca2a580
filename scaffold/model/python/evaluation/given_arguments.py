"""The arguments that calls pass for the parameters of functions."""

from __future__ import annotations

import ast
from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from scaffold.model.python.scopes import FunctionNode
    from scaffold.model.python.syntax_tree import SyntaxTree


def argument_of(call: ast.Call, name: str, place: int | None = None) -> ast.expr | None:
    """Return the argument of a call by its name or place; ``None`` if it is not given, or unknown.

    Args:
        call: The call.
        name: The name of the parameter.
        place: Its place among positional arguments; ``None`` if it is keyword-only.
    """
    for word in call.keywords:
        if word.arg == name:
            return word.value
    if place is None or not 0 <= place < len(call.args):
        return None
    before = call.args[: place + 1]
    return None if any(isinstance(item, ast.Starred) for item in before) else call.args[place]


def given_once(module: SyntaxTree, parameter: ast.AST) -> ast.expr | None:
    """Return the argument for a parameter of a function if the file only calls it once."""
    function = module.parent(module.parent(parameter) or parameter)
    if not isinstance(parameter, ast.arg) or not isinstance(function, ast.FunctionDef):
        return None
    if function.decorator_list or not isinstance(module.parent(function), ast.Module):
        return None
    uses = [name for name in module.index.names(function.name) if isinstance(name.ctx, ast.Load)]
    call = module.call_with(uses[0]) if len(uses) == 1 else None
    if call is None:
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


def arguments_for(module: SyntaxTree, name: ast.Name) -> Sequence[ast.expr]:
    """Return the arguments that calls in the file pass for a parameter; empty for other names."""
    parameter, function = parameter_of(module, name)
    if parameter is None or function is None:
        return ()
    class_ = module.parent(function)
    is_bound = isinstance(class_, ast.ClassDef)
    is_bound = is_bound and not any(map(_is_static, function.decorator_list))
    names: Sequence[ast.expr] = module.index.names(function.name)
    if isinstance(class_, ast.ClassDef):
        is_constructor = function.name == "__init__"
        index = module.index
        names = index.names(class_.name) if is_constructor else index.attributes(function.name)
    calls = [call for call in map(module.parent, names) if isinstance(call, ast.Call)]
    given = (
        given_argument(function, call, parameter, is_method=is_bound)
        for call in calls
        if call.func in names
    )
    return [value for value in given if value is not None]


def parameter_of(
    module: SyntaxTree, name: ast.Name
) -> tuple[ast.arg | None, ast.FunctionDef | ast.AsyncFunctionDef | None]:
    """Return the parameter that a name refers to, and its function."""
    lookup = module.index.lookup(name.id, name)
    parameter = lookup[1][0].node if lookup is not None and lookup[1] else None
    function = lookup[0] if lookup is not None else None
    if not isinstance(parameter, ast.arg) or not isinstance(
        function, ast.FunctionDef | ast.AsyncFunctionDef
    ):
        return None, None
    return parameter, function


def _is_static(decorator: ast.expr) -> bool:
    return isinstance(decorator, ast.Name) and decorator.id == "staticmethod"
