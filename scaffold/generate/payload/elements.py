"""Elements of array fields: their names and values."""

from __future__ import annotations

import builtins
import re
from collections.abc import Iterable
from keyword import iskeyword

from scaffold.generate.payload.imports import MODULES
from scaffold.model.interfaces.syntax import Field

ELEMENTS = 3
"""The number of elements generated for an array of any length."""


def several(expression: str, size: int) -> str:
    """Return the code of a list that repeats a value."""
    return f"[{expression}] * {size}" if size > 1 else f"[{expression}]"


def singular(name: str) -> str:
    """Return the name of an element of an array."""
    for ending in ("_list", "_array"):
        name = name.removesuffix(ending)
    if name.endswith(("vertices", "indices")):
        return f"{name[:-4]}ex"
    if name.endswith("ies"):
        return name[:-3] + "y"
    if name.endswith(("sses", "xes", "ches", "shes")):
        return name[:-2]
    return name[:-1] if name.endswith("s") and not name.endswith(("ss", "us", "is")) else name


ROOTS = ("msg", "request", "response", "goal", "feedback", "result")
"""The variables filled by generated code."""
_MODULES = ("os", "pytest", "rclpy", "re", "signal", "subprocess", "sys", "time", *MODULES)
"""Modules imported by nodes and their tests."""
_TAKEN = frozenset({"self", "count", "step", *ROOTS, *_MODULES}) | {
    name for name in dir(builtins) if name[0].islower()
}
"""Names that a local variable must not have."""
_MAX_LENGTH = 20
"""Maximum length of a local name."""


def variable(field: Field) -> str:
    """Return a local name for an element of an array of messages."""
    name = shortened(singular(field.name))
    if name == field.name or not is_free(name):
        snake = re.sub(r"(?<=[a-z0-9])(?=[A-Z][a-z])", "_", field.type.name).lower()
        name = snake if is_free(snake) else "element"
    return name


def shortened(name: str) -> str:
    """Return a name, or its last word if it is too long for a local name."""
    return name if len(name) <= _MAX_LENGTH else name.rpartition("_")[2]


def is_free(name: str) -> bool:
    """Return whether a local variable may have a name."""
    return name.isidentifier() and not iskeyword(name) and name not in _TAKEN


def numbered(name: str, size: int, bound: int | None) -> Iterable[str]:
    """Return texts for the elements of an array."""
    for number in range(1, size + 1):
        text = f"{name}_{number}"
        yield text if bound is None or len(text) <= bound else str(number)[-bound:]


# -- constants
