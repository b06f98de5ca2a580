"""Arguments that functions of the package assign to fields of messages, unchanged."""

from __future__ import annotations

import ast
from collections.abc import Collection, Iterator, Mapping
from typing import TYPE_CHECKING

from scaffold.model.python.conditions.guards import conditions_on
from scaffold.model.python.evaluation.given_arguments import given_argument, parameter_of
from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from scaffold.model.messages.inference import Assigned, MessageTypes
    from scaffold.model.python.scopes import FunctionNode

Fields = Mapping[ast.arg, "Assigned"]
"""The field that each parameter is assigned to."""


def fields_of_parameters(types: MessageTypes) -> Mapping[FunctionNode, Fields]:
    """Return the fields that the functions of a file assign their parameters to.

    Without parameters with other values, and fields that depend on any of the parameters.
    """
    result: dict[FunctionNode, dict[ast.arg, Assigned]] = {}
    for item in types.assigned:
        if not isinstance(item.value, ast.Name):
            continue
        parameter, function = parameter_of(types.module, item.value)
        if parameter is None or function is None or function.decorator_list:
            continue
        if len(types.module.index.bindings_of(item.value)) == 1 and not _depends(types, item.value):
            result.setdefault(function, {}).setdefault(parameter, item)
    return result


def _depends(types: MessageTypes, value: ast.Name) -> bool:
    """Return whether a condition about a parameter decides whether a value is assigned."""
    return any(
        isinstance(part, ast.Name)
        and part.id != "self"
        and parameter_of(types.module, part)[0] is not None
        for condition in conditions_on(types.module, value)
        for part in ast.walk(condition)
    )


class OwnCall(NamedTuple):
    """A call of a function of the package."""

    call: ast.Call
    types: MessageTypes
    """The view of the file that defines the function."""
    function: ast.FunctionDef

    def given(self, parameter: ast.arg) -> ast.expr | None:
        """Return the argument for a parameter, or its default; ``None`` if unknown."""
        is_method = isinstance(self.types.module.parent(self.function), ast.ClassDef)
        return given_argument(self.function, self.call, parameter, is_method=is_method)

    def is_in(self, types: MessageTypes, value: ast.expr) -> bool:
        """Return whether an argument is in a file, which a default of another file is not."""
        keywords = [word.value for word in self.call.keywords]
        return self.types is types or value in (*self.call.args, *keywords)


def own_calls(types: MessageTypes) -> Iterator[OwnCall]:
    """Yield the calls of functions of the package."""
    names = {function.name for function in types.module.function_nodes}
    for call in types.module.walk(ast.Call):
        if not _may_be_own(types, call.func, names):
            continue
        defined = types.file.definition_of(call.func)
        other = types.of_file(defined[0]) if defined is not None else None
        function = defined[1] if defined is not None else None
        if other is not None and isinstance(function, ast.FunctionDef):
            yield OwnCall(call, other, function)


def passed(types: MessageTypes) -> Iterator[Assigned]:
    """Yield the arguments in a file for parameters that functions assign to fields.

    Also the defaults that calls in the file use, each once.
    """
    seen: set[ast.expr] = set()
    for own in types.own_calls:
        for parameter, item in own.types.fields_of_parameters.get(own.function, {}).items():
            value = own.given(parameter)
            if value is not None and value not in seen and own.is_in(types, value):
                seen.add(value)
                yield item._replace(value=value, holder=own.call)


def _may_be_own(types: MessageTypes, func: ast.expr, defined: Collection[str]) -> bool:
    """Return whether a function may be one of the package, without looking for it."""
    match func:
        case ast.Attribute(attr=name) if name in defined:
            return True
        case ast.Attribute(value=ast.Name(id="self" | "cls")) | ast.Name():
            return True
        case ast.Attribute(value=ast.Name() | ast.Attribute(value=ast.Name()) as owner):
            names = (
                types.module.qualified_name(item.func if isinstance(item, ast.Call) else func) or ""
                for item in (types.file.evaluator.single_value(owner),)
            )
            return any(types.file.is_own_module(name.rpartition(".")[0]) for name in names)
    return False
