"""Evaluates the conditions of actions in Python launch files."""

from __future__ import annotations

import ast
from collections.abc import Mapping
from typing import TYPE_CHECKING

from scaffold.model.launch.evaluation.conditions import (
    UNKNOWN,
    Text,
    applied,
    as_text,
    joined,
    truth,
)
from scaffold.model.python.conditions.distribution_conditions import holds, value_on_target

if TYPE_CHECKING:
    from scaffold.model.launch.calls import LaunchCall
    from scaffold.model.launch.python_file import LaunchFile

_OPERATORS: Mapping[str, str] = {
    "EqualsSubstitution": "equals",
    "NotEqualsSubstitution": "not-equals",
    "AndSubstitution": "and",
    "OrSubstitution": "or",
    "NotSubstitution": "not",
    "EnvironmentVariable": "env",
    "PythonExpression": "eval",
}
"""Substitutions with string arguments, by their names in XML."""
_OF_LISTS: Mapping[str, str] = {"AllSubstitution": "all", "AnySubstitution": "any"}
_FIRST: Mapping[str, int] = {"EnvironmentVariable": 1, "PythonExpression": 1}
"""The number of arguments used."""
_SETTERS = {"DeclareLaunchArgument": "default_value", "SetLaunchConfiguration": "value"}
_MAX_DEPTH = 20


class Conditions:
    """The values of the conditions of a launch file on the target."""

    def __init__(self, launch: LaunchFile) -> None:
        self._launch = launch

    def holds(self, node: ast.expr) -> bool | None:
        """Return whether a condition is true; ``None`` if not up to the distribution."""
        call = self._launch.call_of(node)
        if call is None:
            return None
        operands = [*call.given.values()] or call.call.args
        match call.kind, operands:
            case "IfCondition", [predicate]:
                return truth(self.text(predicate))
            case "UnlessCondition", [predicate]:
                return truth(applied("not", [self.text(predicate)]))
            case "LaunchConfigurationEquals" | "LaunchConfigurationNotEquals", [name, expected]:
                kind = "not-equals" if "Not" in call.kind else "equals"
                configured = self._configured(self._launch.evaluator.joined_text(name), 0)
                return truth(applied(kind, [configured, self.text(expected)]))
        return None

    def text(self, node: ast.expr, depth: int = 0) -> Text:
        """Return the text of a substitution, a list of them or a string."""
        if depth > _MAX_DEPTH:
            return UNKNOWN
        if isinstance(node, ast.List | ast.Tuple):
            return joined(self.text(item, depth + 1) for item in node.elts)
        value = self._launch.module.index.only_value(node)
        if value is not None:
            return self.text(value, depth + 1)
        call = self._launch.call_of(node)
        return self._plain(node) if call is None else self._substituted(call, depth)

    def _plain(self, node: ast.expr) -> Text:
        """Return the value of an expression when Python executes the file."""
        module = self._launch.module
        match node:
            case ast.Call(func=ast.Name(id="str"), args=[inner], keywords=[]):
                return self._plain(inner)
        value, is_specific = value_on_target(module, node)
        if isinstance(value, str):
            return Text(value, is_specific)
        decided = holds(module, node)
        return UNKNOWN if decided is None else as_text(decided, is_specific=True)

    def _substituted(self, call: LaunchCall, depth: int) -> Text:
        operands = [*call.given.values()] or call.call.args
        if call.kind == "LaunchConfiguration" and operands:
            return self._configured(self._launch.evaluator.joined_text(operands[0]), depth)
        if call.kind == "TextSubstitution" and operands:
            return self.text(operands[0], depth + 1)
        if call.kind in _OF_LISTS:
            return applied(_OF_LISTS[call.kind], self._texts(call.call.args, depth))
        if call.kind in _OPERATORS:
            texts = self._texts(operands[: _FIRST.get(call.kind)], depth)
            return applied(_OPERATORS[call.kind], texts)
        return UNKNOWN

    def _texts(self, nodes: list[ast.expr], depth: int) -> list[Text]:
        return [self.text(node, depth + 1) for node in nodes]

    def _configured(self, name: object, depth: int) -> Text:
        """Return a launch configuration that depends on the distribution; others may be set."""
        values = [
            call.given.get(_SETTERS[call.kind])
            for call in self._launch.find(*_SETTERS)
            if self._launch.text(call, "name") == name
        ]
        if len(values) != 1 or values[0] is None:
            return UNKNOWN
        text = self.text(values[0], depth + 1)
        return text if text.is_specific else UNKNOWN
