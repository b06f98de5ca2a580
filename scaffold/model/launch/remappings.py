"""Remappings of launch files, and the names that the nodes have to be remapped."""

from __future__ import annotations

import ast
from collections.abc import Collection, Iterator
from typing import TYPE_CHECKING

from scaffold.model.launch.markup_file import is_known, markup_files
from scaffold.model.launch.nodes import code_of, started_nodes
from scaffold.model.parameters.declared import escapes, home_of
from scaffold.model.programs.entry_points import files_of
from scaffold.model.rclpy.nodes import NodeClass
from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from scaffold.model.launch.nodes import StartedNode
    from scaffold.model.package import Package
    from scaffold.model.rclpy.entities import Endpoint
    from scaffold.model.rclpy.nodes import NodeDefinition
    from scaffold.source import Location

_ALWAYS = frozenset({"clock", "parameter_events", "rosout", "tf", "tf_static"})
"""Topics that any node may have, by itself or through tf2."""
_OTHER_ENDPOINTS = ("message_filters", "wait_for_message", "image_transport", "create_generic")
"""Words of code that has topics in ways that are not read here."""


class Remapped(NamedTuple):
    """A node of the workspace that a launch file gives remappings."""

    owner: NodeDefinition
    program: str
    name: object
    """The name that it runs under."""
    remappings: list[tuple[str, Location]]
    """The names that are remapped, as far as they are known."""
    parameters: Collection[str] | None
    """The parameters that the launch file gives; ``None`` if not all are known."""


def remapped_nodes(package: Package) -> Iterator[Remapped]:
    """Yield the nodes that launch files of a package give remappings."""
    for started in started_nodes(package):
        names = list(_remapped_by(started))
        owner = started.owner if names else None
        if owner is not None:
            program, given = str(started.executable), _parameters_given(started)
            yield Remapped(owner, program, started.name, names, given)
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
                    [(attribute.value, attribute.location) for attribute in attributes],
                    node.parameter_names,
                )


def _remapped_by(started: StartedNode) -> Iterator[tuple[str, Location]]:
    """Yield the names that a launch file in Python remaps, with their places."""
    given = started.call.given.get("remappings")
    elements = started.launch.evaluator.elements(given).items if given is not None else ()
    for element in elements:
        match element.node:
            case ast.Tuple(elts=[source, _]) | ast.List(elts=[source, _]):
                text = started.launch.evaluator.text(source)
                if isinstance(text, str):
                    yield text, started.launch.location(source)


def names_of(node: Remapped, package: Package) -> set[str] | None:
    """Return the topics, services and actions of a node as written; ``None`` if not all are known.

    A parameter that the launch file gives may name any of them.
    """
    owner = node.owner
    if not isinstance(owner, NodeClass):
        return None  # a program that makes a node in passing may make another
    home = home_of(owner, package)
    names: set[str] = set()
    current: NodeDefinition | None = owner
    while current is not None:
        if escapes(current) or current.is_lifecycle:
            return None
        current = current.base if isinstance(current, NodeClass) else None
    for file in files_of(home, owner.facts.module.path):
        if file.module.mentions(*_OTHER_ENDPOINTS):
            return None
        for endpoint in file.endpoints:
            if not isinstance(endpoint.name, str) or _may_be_set(endpoint, node.parameters):
                return None
            names.add(endpoint.name)
    return names


def has_name(names: set[str], source: str, node: object) -> bool:
    """Tell whether a remapping's name may be one of those of a node."""
    wanted = source.rpartition(":")[2].partition("/_action/")[0].removeprefix("~").strip("/")
    last = wanted.rpartition("/")[2]
    if wanted in _ALWAYS or source.startswith(("__", "rostopic")) or "parameter" in last:
        return True
    plain = {name.removeprefix("~").strip("/") for name in names}
    plain |= {f"{node}/{name}" for name in plain}
    return any(
        name == wanted or name.endswith(f"/{wanted}") or wanted.endswith(f"/{name}")
        for name in plain
    )


def _may_be_set(endpoint: Endpoint, given: Collection[str] | None) -> bool:
    parameter = endpoint.from_parameter
    return parameter is not None and (given is None or parameter in given)


def _parameters_given(started: StartedNode) -> set[str] | None:
    """Return the parameters that a launch file gives by name; ``None`` if files give some."""
    for node in started.parameters:
        values = [node]
        if isinstance(node, ast.Name):
            found = started.launch.module.index.lookup(node.id, node)
            values = [x.value for x in (found[1] if found else ()) if x.value is not None]
        if not values or not all(isinstance(value, ast.Dict) for value in values):
            return None
    return {name for name, _, _ in started.parameter_dicts}
