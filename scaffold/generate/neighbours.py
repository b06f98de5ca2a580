"""What the user should know of a new node and the others of its package."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.generate.names import resolve
from scaffold.model.node_entities import (
    ActionClient,
    ActionServer,
    Client,
    Endpoint,
    Publisher,
    Service,
    Subscription,
)
from scaffold.model.package import Package
from scaffold.record import NamedTuple

_KINDS = (
    ("topic", (Publisher, Subscription)),
    ("service", (Service, Client)),
    ("action", (ActionServer, ActionClient)),
)


class _Use(NamedTuple):
    """A node that uses a topic, a service or an action."""

    kind: str
    name: str
    """In full."""
    type: str
    node: str
    path: str
    line: int
    is_fixed: bool
    """No parameter changes the name."""


def remarks(package: Package, path: str) -> Iterator[str]:
    """Yield what may keep a node from working with others of its package, a line each.

    Args:
        package: The package with the node.
        path: The file of the node.
    """
    yield from _namesakes(package, path)
    yield from _misconnected(package, path)


def _namesakes(package: Package, path: str) -> Iterator[str]:
    files = list(package.rclpy_files())
    names = {node.node_name for one in files if one.module.path == path for node in one.nodes}
    for one in files:
        for node in one.nodes if one.module.path != path else ():
            if isinstance(node.node_name, str) and node.node_name in names:
                at = node.node_name_location
                yield (
                    f"{at.path}:{at.line} makes a node with the name {node.node_name!r}, too: "
                    "nodes that run together need names of their own"
                )


def _misconnected(package: Package, path: str) -> Iterator[str]:
    uses = list(_uses(package))
    said: set[tuple[str, str]] = set()
    for own in uses:
        if own.path != path:
            continue
        for other in uses:
            same = other[:2] == own[:2] and other.path != path and other[:2] not in said
            if same and other.type != own.type and not _is_plain(own, other):
                said.add(other[:2])
                yield (
                    f"the {own.kind} {own.name} is {own.type} in {own.node}, but {other.type} in "
                    f"{other.node}, {other.path}:{other.line}: they do not connect; give both the "
                    "same type, or another name to one"
                )


def _is_plain(own: _Use, other: _Use) -> bool:
    """Tell whether the rule topic-type-differs says it."""
    return own.is_fixed and other.is_fixed and own.kind in {"topic", "service"}


def _uses(package: Package) -> Iterator[_Use]:
    """Yield what the nodes of a package use, as far as names and types are known."""
    for facts in package.rclpy_files():
        for endpoint in facts.endpoints:
            use = _use(endpoint)
            if use is not None:
                yield use


def _use(endpoint: Endpoint) -> _Use | None:
    kind = next((kind for kind, classes in _KINDS if isinstance(endpoint, classes)), None)
    owner = endpoint.owner
    node = owner.node_name if owner is not None and owner.namespace is None else None
    if kind is None or not isinstance(node, str) or not isinstance(endpoint.name, str):
        return None
    if endpoint.interface is None:
        return None
    at, name = endpoint.location, resolve(endpoint.name, node)
    is_fixed = endpoint.from_parameter is None
    return _Use(kind, name, endpoint.interface, node, at.path, at.line, is_fixed)
