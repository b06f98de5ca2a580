"""Static evaluation of attributes, parameters and arguments in node code."""

from __future__ import annotations

import ast
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING

from scaffold.model.python.evaluation.attributes import AttributeEvaluator
from scaffold.model.python.evaluation.call_sites import CallSites
from scaffold.model.python.evaluation.given_arguments import argument_of, given_argument
from scaffold.model.python.evaluation.values import UNKNOWN, is_known, same

if TYPE_CHECKING:
    from scaffold.model.python.module import PythonModule

PARAMETER_CALLS = frozenset({"get_parameter", "declare_parameter", "get_parameter_or"})
NOTE = "parameter:"
"""The prefix of a parameter name in the notes of a value that is its default."""

_ACCESSORS: Mapping[str, type] = {
    "double_value": float,
    "integer_value": int,
    "string_value": str,
    "bool_value": bool,
    "double_array_value": list,
    "integer_array_value": list,
    "string_array_value": list,
    "bool_array_value": list,
}


class NodeEvaluator(AttributeEvaluator):
    """An evaluator for attributes, parameter defaults and arguments of private functions."""

    def __init__(
        self,
        module: PythonModule,
        default_of: Callable[[ast.expr, str], object],
        related: Callable[[ast.ClassDef], Sequence[ast.ClassDef]],
        constant: Callable[[str], object],
    ) -> None:
        super().__init__(module, related)
        self._constant = constant
        self._default_of = default_of
        self._call_sites = CallSites(self)

    def imported(self, name: str) -> object:
        """Return the value of a constant of another module of the package."""
        last = name.rpartition(".")[2]
        return UNKNOWN if self.stores(last) else self._constant(name)

    def argument(self, node: ast.arg) -> object:
        """Return the argument on which all calls of a constructor or private function agree."""
        function = self.module.parent(self.module.parent(node) or node)
        if not isinstance(function, ast.FunctionDef | ast.AsyncFunctionDef):
            return UNKNOWN
        calls = self._call_sites.of(function)
        if not calls:
            return UNKNOWN
        is_method = isinstance(self.module.parent(function), ast.ClassDef)
        given = [given_argument(function, call, node, is_method=is_method) for call in calls]
        return self._common([self.evaluate(value) for value in given])

    def _common(self, values: Sequence[object]) -> object:
        """Return the common value of all values."""
        if any(value is UNKNOWN or not same(value, values[0]) for value in values):
            return UNKNOWN
        return values[0] if values else UNKNOWN

    def attribute(self, node: ast.Attribute) -> object:
        """Return the value of an attribute of ``self`` or of a parameter."""
        if node.attr == "value":
            return self._parameter(node.value)
        if node.attr in _ACCESSORS:
            return self._parameter_field(node, _ACCESSORS[node.attr])
        values = self.attribute_values(node)
        if values is None:
            return self._default_in_class(node)
        if not values:
            return UNKNOWN
        value = self.evaluate(values[0])
        for other in values[1:]:
            if value is UNKNOWN or not same(self.evaluate(other), value):
                return UNKNOWN
        # Changes of lists in attributes are not tracked.
        return UNKNOWN if isinstance(value, list | dict) else value

    def _default_in_class(self, node: ast.Attribute) -> object:
        """Return the initial value of an attribute of an object created without arguments.

        Such as that of a dataclass, ``Topics().image``, if the file never sets it.
        """
        made = self.single_value(node.value)
        match made:
            case ast.BoolOp(op=ast.Or(), values=[given, default]) if self.evaluate(given) is None:
                made = default
        if not isinstance(made, ast.Call) or made.args or made.keywords:
            return UNKNOWN
        name = self.module.qualified_name(made.func)
        return self.imported(f"{name}.{node.attr}") if name else UNKNOWN

    def _parameter(self, node: ast.expr) -> object:
        """Return the default of the parameter read by an expression."""
        call = self.single_value(node)
        if not isinstance(call, ast.Call):
            return UNKNOWN
        func = self.single_value(call.func) if isinstance(call.func, ast.Name) else call.func
        if not isinstance(func, ast.Attribute) or func.attr not in PARAMETER_CALLS:
            return UNKNOWN
        named = argument_of(call, "name", 0)
        name = self.text(named) if named is not None else UNKNOWN
        if name is UNKNOWN:
            return UNKNOWN
        value = self._default_of(func.value, name)
        if value is None or not is_known(value):
            return UNKNOWN
        self.note(NOTE + name)
        return value

    def _parameter_field(self, node: ast.Attribute, kind: type) -> object:
        call = self.single_value(node.value)
        match call:
            case ast.Call(func=ast.Attribute(attr="get_parameter_value", value=parameter)):
                value = self._parameter(parameter)
                return value if type(value) is kind else UNKNOWN
            case _:
                return UNKNOWN
