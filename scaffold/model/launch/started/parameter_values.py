"""The types of parameters that launch files set directly."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING

from scaffold.model.parameters.files import number_in, text_type
from scaffold.model.python.evaluation.values import is_known
from scaffold.model.rclpy.entities import parameter_type
from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from scaffold.model.launch.python_file import LaunchFile


class GivenValue(NamedTuple):
    """A value that a launch file sets."""

    type: str
    text: str
    """The text, for messages."""
    number: float | None = None
    """The value, if it is a number."""


def value_given(launch: LaunchFile, node: ast.expr) -> GivenValue | None:
    """Return the value of a parameter and its type; ``None`` if uncertain.

    The text of a launch configuration is parsed as YAML, so ``10`` is an integer.
    """
    call = launch.call_of(node)
    kind: str | None
    if call is not None:
        if call.kind != "LaunchConfiguration":
            return None
        default = launch.default_of(node)
        if not isinstance(default, str) or _is_more_than_a_word(default):
            return None
        kind = text_type(default)
        text = f"the default {default!r} of the launch argument"
        return GivenValue(kind, text, number_in(default, kind))
    value = launch.evaluator.evaluate(node)
    if isinstance(value, list | tuple):
        return _list_given(value)
    kind = parameter_type(value) if is_known(value) else None
    number = value if isinstance(value, int | float) and kind != "bool" else None
    return GivenValue(kind, repr(value), number) if kind else None


def _list_given(value: list[object] | tuple[object, ...]) -> GivenValue | None:
    if not value or not all(type(item) in {int, float, bool, str} for item in value):
        return None
    if {type(item) for item in value} == {int, float}:
        return GivenValue("double_array", repr(value))  # launch converts all of them to doubles
    kind = parameter_type(value)
    return GivenValue(kind, repr(value)) if kind and kind != "string_array" else None


def _is_more_than_a_word(text: str) -> bool:
    """Return whether YAML may read a text as other than a word or a number."""
    return text == "" or any(character in text for character in "'\"[]{}:#&*!|>%@`, \n")
