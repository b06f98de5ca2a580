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
    """Return the type on which all nodes agree, and the name with the place of its declaration.

    Args:
        package: The checked package.
        declared: The declarations in the nodes that receive the parameter.
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
    """Return the parameter with an unintended type of its default, rather than in the file.

    Such as ``1`` for a period, or a number in quotes. Other packages are checked separately.
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
