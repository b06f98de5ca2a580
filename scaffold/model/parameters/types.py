"""The type of a parameter that several nodes may declare."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from scaffold.model.parameters.declared import ALWAYS, Declared, DeclaredParameter, place_of

if TYPE_CHECKING:
    from scaffold.model.package import Package


def agreed_type(
    package: Package, declared: Sequence[Declared], name: str
) -> tuple[str | None, str]:
    """Return the type that all nodes agree on, and the name with where it is declared.

    Args:
        package: The package that is checked.
        declared: The declarations of the nodes that are given the parameter.
        name: The name of the parameter.
    """
    if name in ALWAYS:
        return "bool", f"{name!r} (declared by rclpy)"
    nodes = [item for item in declared if name in item.types]
    types = {node.types[name] for node in nodes}
    if len(types) != 1:
        return None, name
    place = nodes[0].places[name]
    return types.pop(), f"{name!r} ({place_of(place.package, place.location, package)})"


def narrow_default(
    package: Package, declared: Sequence[Declared], name: str, given: str
) -> DeclaredParameter | None:
    """Return the parameter whose default, not the file, has an unintended type.

    Such as ``1`` for a period, or a number in quotes. Those of other packages are judged there.
    """
    if name in ALWAYS:
        return None
    for item in declared:
        parameter = item.places.get(name)
        if parameter is None or parameter.package != package.name:
            continue
        default = parameter.default
        if given == "double" and (type(default) is int or _is_number(default)):
            return parameter
        if given == "integer" and _is_number(default):
            return parameter
    return None


def a_type(kind: str) -> str:
    """Return the name of a type with its article."""
    return f"{'an' if kind.startswith('i') else 'a'} {kind}"


def _is_number(value: object) -> bool:
    return isinstance(value, str) and value.lstrip("+-").replace(".", "", 1).isdecimal()
