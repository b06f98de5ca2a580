"""Remappings in launch files, and the names that the nodes use."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from typing import TYPE_CHECKING

from scaffold.model.facts import fact
from scaffold.model.launch.markup_file import is_known, markup_files
from scaffold.model.launch.nodes import code_of, started_nodes
from scaffold.model.parameters.declared import escapes
from scaffold.model.programs.entry_points import files_of
from scaffold.model.rclpy.file import rclpy_file
from scaffold.model.rclpy.nodes import NodeClass
from scaffold.record import NamedTuple
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package
    from scaffold.model.programs.known_nodes import KnownNode
    from scaffold.model.rclpy.nodes import NodeDefinition
    from scaffold.source import Location

_ALWAYS = frozenset({"clock", "parameter_events", "rosout", "tf", "tf_static"})
"""Topics of any node, also through tf2."""
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


def remapped_nodes(package: Package) -> Iterator[Remapped]:
    """Yield the nodes with remappings in launch files of a package."""
    for started in started_nodes(package):
        owner = started.owner(package) if started.remappings else None
        if owner is not None:
            given = {item.name for item in started.parameters}
            yield Remapped(
                owner,
                str(started.executable),
                started.name(package),
                started.namespace,
                started.remappings,
                None if started.has_more_parameters else given,
            )
    for file in markup_files(package):
        for node in file.nodes:
            attributes = [attribute for attribute in node.remappings if is_known(attribute)]
            if not attributes or node.package is None or node.executable is None:
                continue
            owner = code_of(package, node.package.value, node.executable.value)
            if owner is not None:
                name = node.name.value if node.name is not None else owner.node_name
                yield Remapped(
                    owner,
                    node.executable.value,
                    name,
                    None,
                    [(attribute.value, None, attribute.location) for attribute in attributes],
                    node.parameter_names,
                )


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
        if escapes(current) or current.is_lifecycle:
            return None
        current = current.base if isinstance(current, NodeClass) else None
    names: list[tuple[str, str | None]] = []
    for file in files_of(package, path):
        if file.module.mentions(*_OTHER_ENDPOINTS):
            return None
        for endpoint in file.endpoints:
            if not isinstance(endpoint.name, str):
                return None
            parameters: list[str | None] = [*sorted(endpoint.from_parameters)]
            names += [(endpoint.name, parameter) for parameter in parameters or [None]]
    return tuple(names)


def has_name(names: set[str], source: str, node: object) -> bool:
    """Return whether a remapping may apply to a name of a node."""
    wanted = source.rpartition(":")[2].partition("/_action/")[0].removeprefix("~").strip("/")
    last = wanted.rpartition("/")[2]
    if (
        wanted in _ALWAYS
        or source.startswith(("__", "rosservice", "rostopic"))
        or "parameter" in last
    ):
        return True
    plain = {name.removeprefix("~").strip("/") for name in names}
    plain |= {f"{node}/{name}" for name in plain}
    return any(
        name == wanted or name.endswith(f"/{wanted}") or wanted.endswith(f"/{name}")
        for name in plain
    )


def is_reversed(names: set[str], source: str, target: str | None, node: object) -> bool:
    """Return whether a remapping is reversed: the node has the target, not the source."""
    if target is None or any(name.startswith("/") for name in names):
        return False
    plain = {name.removeprefix("~").strip("/") for name in names}
    wanted = {source, source.removeprefix("~/"), source.removeprefix(f"{node}/")}
    if wanted & plain or source.startswith("/") or source.strip("/") in _ALWAYS:
        return False
    return target in names


def misses_privacy(names: set[str], source: str) -> str:
    """Return the private name that a node has, if a remapping names it without its ``~/``."""
    is_plain = "/" not in source and "~" not in source and ":" not in source
    others = {name.rpartition("/")[2] for name in names if name != f"~/{source}"}
    return f"~/{source}" if is_plain and f"~/{source}" in names and source not in others else ""


def misses_namespace(names: set[str], source: str, namespace: object) -> str:
    """Return the name that a node has in its namespace, if a remapping names it without that."""
    name = source.removeprefix("/")
    if not isinstance(namespace, str) or not namespace.strip("/") or name == source:
        return ""
    if name in _ALWAYS or name not in names or source in names:
        return ""
    return f"/{namespace.strip('/')}/{name}"
