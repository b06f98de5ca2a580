"""Notes for the user about a new node and the other nodes of its package."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.generate.connections import Clash, Use, clashes, mismatches
from scaffold.generate.questions.names import resolve
from scaffold.model.package import Package
from scaffold.model.rclpy.entities import (
    ActionClient,
    ActionServer,
    Client,
    Endpoint,
    Publisher,
    Service,
    Subscription,
)
from scaffold.model.rclpy.files import rclpy_files

_KINDS = (
    ("topic", (Publisher, Subscription)),
    ("service", (Service, Client)),
    ("action", (ActionServer, ActionClient)),
)


def remarks(package: Package, path: str) -> Iterator[str]:
    """Yield problems of a node with others of its package, one line each.

    Args:
        package: The package with the node.
        path: The file of the node.
    """
    yield from _duplicate_node_names(package, path)
    yield from _misconnected(package, path)


def _duplicate_node_names(package: Package, path: str) -> Iterator[str]:
    files = list(rclpy_files(package))
    names = {node.node_name for file in files if file.module.path == path for node in file.nodes}
    for item in files:
        for node in item.nodes if item.module.path != path else ():
            if isinstance(node.node_name, str) and node.node_name in names:
                at = node.node_name_location
                yield (
                    f"{at.path}:{at.line} also creates a node named {node.node_name!r}: nodes "
                    "that run together need different names"
                )


def conflicts(package: Package, path: str) -> Iterator[str]:
    """Yield why a node does not connect with others, if the checker reports it as an error.

    Args:
        package: The package with the node.
        path: The file of the node.
    """
    for clash in _clashes(package, path):
        if _has_rule(clash):
            yield str(clash)
    for mismatch in mismatches(uses(package)):
        if path in {_path(mismatch.publisher), _path(mismatch.subscription)}:
            yield str(mismatch)


def _misconnected(package: Package, path: str) -> Iterator[str]:
    for clash in _clashes(package, path):
        if not _has_rule(clash):
            yield str(clash)


def _clashes(package: Package, path: str) -> Iterator[Clash]:
    """Yield the clashes of a new node with others, each name once."""
    used = sorted(uses(package), key=lambda use: _path(use) != path)  # the new node comes first
    result: set[tuple[str, str]] = set()
    for clash in clashes(used):
        name = clash.first.kind, clash.first.name
        if _path(clash.first) == path != _path(clash.other) and name not in result:
            result.add(name)
            yield clash


def _path(use: Use) -> str | None:
    return use.location and use.location.path


def _has_rule(clash: Clash) -> bool:
    """Return whether the rule topic-type-differs reports a clash."""
    is_fixed = clash.first.is_fixed and clash.other.is_fixed
    return is_fixed and clash.first.kind in {"topic", "service"}


def uses(package: Package) -> Iterator[Use]:
    """Yield the topics, services and actions of a package with known names and types."""
    for file in rclpy_files(package):
        for endpoint in file.endpoints:
            use = _use_of(endpoint)
            if use is not None:
                yield use


def _use_of(endpoint: Endpoint) -> Use | None:
    kind = next((kind for kind, classes in _KINDS if isinstance(endpoint, classes)), None)
    owner = endpoint.owner
    node = owner.node_name if owner is not None and owner.namespace is None else None
    if kind is None or not isinstance(node, str) or not isinstance(endpoint.name, str):
        return None
    if endpoint.interface is None:
        return None
    name, is_fixed = resolve(endpoint.name, node), endpoint.from_parameter is None
    use = Use(kind, name, endpoint.interface, node, endpoint.location, is_fixed)
    if kind != "topic" or endpoint.qos is None:
        return use
    qos = endpoint.qos
    return use._replace(
        direction="published" if isinstance(endpoint, Publisher) else "subscribed",
        reliability=qos.reliability.lower() if isinstance(qos.reliability, str) else "",
        durability=qos.durability.lower() if isinstance(qos.durability, str) else "",
    )
