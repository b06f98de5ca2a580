"""Constants of an interface that are the values of a field."""

from __future__ import annotations

from collections.abc import Sequence

from scaffold import lazy_re
from scaffold.generate.payload import words
from scaffold.model.interfaces.syntax import Constant, Field, Section
from scaffold.model.interfaces.types import INTEGER_RANGES

_DULL = lazy_re.compile(
    "UNKNOWN|NONE|NOT_SET|UNSET|UNSPECIFIED|UNDEFINED|INVALID|NOTHING|ERROR|FAIL|DEFAULT|DISABLED"
    "|OFF$|IDLE"
)
_OUTCOMES = frozenset({"error", "result", "return"})
"""Words in the names of fields that hold a result code."""
_GOOD = lazy_re.compile("(^|_)(SUCCESS|SUCCEEDED|OK|NONE|NO_ERROR)($|_)")
_ENUMS = frozenset(
    {"action", "code", "command", "error", "event", "kind", "level", "mode", "operation", "option"}
    | {"reason", "result", "severity", "stage", "state", "status", "type"}
)
"""The last words of the names of enum fields."""


def telling(options: Sequence[Constant], field: Field) -> Constant:
    """Return the most telling constant for a field; for result codes, one that means success."""
    if _OUTCOMES & set(words.split(field.name)):
        options = [option for option in options if is_good(option)] or options
    return next((option for option in options if not _DULL.search(option.name)), options[0])


def is_good(constant: Constant) -> bool:
    """Return whether a constant means success."""
    return _GOOD.search(constant.name) is not None


def constants_of(section: Section, field: Field) -> list[Constant]:
    """Return the constants that are the values of a field.

    Found by name, as ``STATUS_OK`` for ``status``; else by place and type, if no other
    field can be meant.
    """
    if field.type.name not in INTEGER_RANGES:
        return []
    named = _by_name(section, field)
    if named:
        return named
    rivals = [
        other
        for other in section.fields
        if other.type == field.type and not _by_name(section, other)
    ]
    taken = {item for other in section.fields for item in _by_name(section, other)}
    free = [
        constant
        for constant in section.constants
        if constant.type == field.type and constant not in taken
    ]
    if len(rivals) > 1:
        free = [item for item in free if _is_next_to(item, field, section)]
    is_only = sum(item.type.name in INTEGER_RANGES for item in section.fields) == 1
    if words.split(field.name)[-1] in _ENUMS or (is_only and len(free) > 1):
        return free
    own = set(words.split(field.name))
    alike = [item for item in free if own & set(item.name.lower().split("_"))]
    return alike if len(alike) > 1 else []


def _by_name(section: Section, field: Field) -> list[Constant]:
    stem = field.name.upper()
    if field.type.is_array or field.type.name not in INTEGER_RANGES:
        return []
    constants = [constant for constant in section.constants if constant.name.startswith(f"{stem}_")]
    constants = constants or [
        constant for constant in section.constants if constant.name.endswith(f"_{stem}")
    ]
    if len(constants) == 1 and words.split(field.name)[-1] not in _ENUMS:
        return []
    longer = [other.name.upper() for other in section.fields if len(other.name) > len(stem)]
    return [
        item
        for item in constants
        if not any(item.name.startswith(f"{name}_") for name in longer if name.startswith(stem))
        and item.type.name in INTEGER_RANGES
    ]


def _is_next_to(constant: Constant, field: Field, section: Section) -> bool:
    """Return whether no other field is between a constant and the field below it."""
    at, line = constant.location.line, field.location.line
    return at < line and not any(at < other.location.line < line for other in section.fields)
