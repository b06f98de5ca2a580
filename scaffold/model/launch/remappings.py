"""Remappings of launch files, and the names that the nodes have to be remapped."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from typing import TYPE_CHECKING

from scaffold.model.parameters.declared import escapes, home_of
from scaffold.model.programs.entry_points import files_of
from scaffold.model.rclpy.nodes import NodeClass
from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from scaffold.model.launch.nodes import StartedNode
    from scaffold.model.package import Package
    from scaffold.model.rclpy.entities import Endpoint
    from scaffold.model.rclpy.nodes import NodeDefinition

_ALWAYS = frozenset({"clock", "parameter_events", "rosout", "tf", "tf_static"})
"""Topics that any node may have, by itself or through tf2."""
_OTHER_ENDPOINTS = ("message_filters", "wait_for_message", "image_transport", "create_generic")
"""Words of code that has topics in ways that are not read here."""


class Remapping(NamedTuple):
    """A remapping of one name."""

    source: str
    node: ast.expr
    """The expression that is the name."""


def remappings_of(started: StartedNode) -> Iterator[Remapping]:
    """Yield the remappings of a node whose first name is known."""
    given = started.call.given.get("remappings")
    elements = started.launch.evaluator.elements(given).items if given is not None else ()
    for element in elements:
        match element.node:
            case ast.Tuple(elts=[source, _]) | ast.List(elts=[source, _]):
                text = started.launch.evaluator.text(source)
                if isinstance(text, str):
                    yield Remapping(text, source)


def names_of(started: StartedNode, package: Package) -> set[str] | None:
    """Return the topics, services and actions of a node as written; ``None`` if not all are known.

    A parameter that the launch file gives may name any of them.
    """
    owner = started.owner
    if owner is None:
        return None
    home = home_of(owner, package)
    names: set[str] = set()
    current: NodeDefinition | None = owner
    while current is not None:
        if escapes(current) or current.is_lifecycle:
            return None
        current = current.base if isinstance(current, NodeClass) else None
    given = _parameters_given(started)
    for file in files_of(home, owner.facts.module.path):
        if file.module.mentions(*_OTHER_ENDPOINTS):
            return None
        for endpoint in file.endpoints:
            if not isinstance(endpoint.name, str) or _may_be_set(endpoint, given):
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


def _may_be_set(endpoint: Endpoint, given: set[str] | None) -> bool:
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
