"""Constants of a message in a field that other constants are for."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api.messages import MessageClass, MessageTypes

Flaw = tuple[ast.expr, str]
"""The place and the problem."""


def flaws(types: MessageTypes) -> Iterator[Flaw]:
    """Yield constants named after another field of the message than the one that they are for."""
    for item in types.assigned:
        yield from _flaws(types, item.owner, item.field.name, item.value)
    for node in types.module.walk(ast.Compare):
        for side, other in ((node.left, node.comparators[0]), (node.comparators[0], node.left)):
            owner = types.type_of(side.value) if isinstance(side, ast.Attribute) else None
            if owner is not None and isinstance(side, ast.Attribute):
                yield from _flaws(types, owner, side.attr, other)


def _flaws(types: MessageTypes, owner: MessageClass, field: str, value: ast.expr) -> Iterator[Flaw]:
    match value:
        case ast.Attribute(attr=constant, value=holder) if constant.isupper():
            class_ = types.class_of(holder)
            if class_ is not None and class_.name == owner.name:
                meant = _field_of(class_, constant)
                if meant and meant != field and _has_own(class_, field):
                    text = types.module.text(value)
                    yield value, f"{text} is a value of {meant}, not of {field}"


def _field_of(class_: MessageClass, constant: str) -> str:
    """Return the field that a constant is named after: the one with the longest name."""
    names = [field.name for field in class_.section.fields]
    fitting = [name for name in names if constant.startswith(f"{name.upper()}_")]
    return max(fitting, key=len, default="")


def _has_own(class_: MessageClass, name: str) -> bool:
    """Return whether constants are named after a field."""
    return any(_field_of(class_, constant.name) == name for constant in class_.section.constants)
