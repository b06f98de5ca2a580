"""Remappings in launch files, and the names that the nodes use."""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING

from scaffold.model.facts import fact
from scaffold.model.parameters.declared import escapes
from scaffold.model.programs.entry_points import imported_files
from scaffold.model.rclpy.file import rclpy_file
from scaffold.model.rclpy.nodes import NodeClass
from scaffold.record import NamedTuple
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package
    from scaffold.model.programs.known_nodes import KnownNode
    from scaffold.model.rclpy.nodes import NodeDefinition
    from scaffold.source import Location

_OTHER_ENDPOINTS = ("message_filters", "wait_for_message", "image_transport", "create_generic")
"""Words in code with topics that are not analyzed here."""


class Remapped(NamedTuple):
    """A node of the workspace with remappings in a launch file."""

    owner: KnownNode
    program: str
    name: object
    """Its name at run time."""
    namespace: object
    """The namespace that the launch file gives it."""
    remappings: Collection[tuple[str, str | None, Location]]
    """The known remapped names, with their targets."""
    parameters: Collection[str] | None
    """The parameters given by the launch file; ``None`` if not all are known."""


def names_of(node: Remapped, package: Package) -> set[str] | None:
    """Return the topics, services and actions of a node as written; ``None`` if not all are known.

    A parameter given by the launch file may set any of them.
    """
    owner = node.owner
    if not owner.is_class:
        return None  # a program that creates nodes inline may create others
    try:
        names = _names_at(owner.home(package), owner.path, owner.number)
    except ViewError:
        return None
    for _, parameter in names or ():
        if parameter is not None and (node.parameters is None or parameter in node.parameters):
            return None
    return None if names is None else {name for name, _ in names}


@fact
def _names_at(
    package: Package, path: str, number: int
) -> tuple[tuple[str, str | None], ...] | None:
    """Return the names, each with the parameter whose default it is; ``None`` if one is unknown."""
    current: NodeDefinition | None = rclpy_file(package, path).nodes[number]
    while current is not None:
        if escapes(current, package) or current.is_lifecycle:
            return None
        current = current.base if isinstance(current, NodeClass) else None
    names: list[tuple[str, str | None]] = []
    for file in imported_files(package, path):
        if file.module.mentions(*_OTHER_ENDPOINTS):
            return None
        for endpoint in file.endpoints:
            if not isinstance(endpoint.name, str):
                return None
            parameters: list[str | None] = [*sorted(endpoint.from_parameters)]
            names += [(endpoint.name, parameter) for parameter in parameters or [None]]
    return tuple(names)
