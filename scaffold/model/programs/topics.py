"""The publishers and subscriptions of each topic in a package, where known."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from contextlib import suppress
from typing import TYPE_CHECKING

from scaffold.model.facts import fact
from scaffold.model.rclpy.entities import (
    ActionClient,
    ActionServer,
    Client,
    Endpoint,
    Publisher,
    Service,
    Subscription,
)
from scaffold.model.rclpy.file import rclpy_file
from scaffold.model.rclpy.files import rclpy_paths
from scaffold.model.rclpy.topics.qos import Qos
from scaffold.model.remembered import remembered
from scaffold.record import NamedTuple
from scaffold.source import Location, ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package

_COMPILED = (".cpp", ".hpp", ".cc", ".cxx", ".c", ".h", ".rs")
_KINDS = (Publisher, Subscription, Service, Client, ActionServer, ActionClient)


class NamedEndpoint(NamedTuple):
    """An endpoint with a known name, for use by other files."""

    kind: str
    """``Publisher``, ``Subscription``, ``Service``, ``Client``, ``ActionServer``, ..."""
    name: str
    interface: str | None
    location: Location
    type_location: Location
    """The location of the type, or of the endpoint without one."""
    name_location: Location
    qos: Qos | None
    profile: Mapping[str, str] | None
    """The arguments of its QoSProfile; ``None`` if unknown."""
    is_plain: bool
    """Whether it is certainly created, once, by a node without a namespace."""
    from_parameter: str | None
    """The parameter with the name as its default."""


class Topic(NamedTuple):
    """The endpoints of one topic."""

    publishers: list[NamedEndpoint]
    subscriptions: list[NamedEndpoint]
    is_plain: bool
    """Whether every endpoint is certainly created, once, by a node without a namespace."""
    is_plain_by_default: bool
    """The same, unless parameters with its name are set."""


class ServiceName(NamedTuple):
    """The endpoints of one service."""

    services: list[NamedEndpoint]
    clients: list[NamedEndpoint]
    is_plain: bool
    """Whether all endpoints of the service are plain."""


def named_endpoints(package: Package) -> Iterator[NamedEndpoint]:
    """Yield the endpoints of a package with known names."""
    for path in rclpy_paths(package):
        with suppress(ViewError):
            yield from _named_endpoints(package, path)


@fact
def _named_endpoints(package: Package, path: str) -> tuple[NamedEndpoint, ...]:
    return tuple(
        NamedEndpoint(
            type(item).__name__,
            item.name,
            item.interface,
            item.location,
            (item.type_argument or item).location,
            (item.name_argument or item).location,
            item.qos,
            _profile_words(item),
            _is_plain(item),
            item.from_parameter,
        )
        for item in rclpy_file(package, path).endpoints
        if isinstance(item.name, str) and type(item) in _KINDS
    )


@remembered
def topics_of(package: Package) -> Mapping[str, Topic]:
    """Return the topics by name as written, without a leading slash."""
    return {
        name: Topic(publishers, subscriptions, *is_plain)
        for name, publishers, subscriptions, is_plain in _by_name(
            package, "Publisher", "Subscription"
        )
    }


def one_sided(package: Package) -> tuple[list[Topic], list[Topic]]:
    """Return the topics only published, and those only subscribed to."""
    topics = topics_of(package).values()
    return (
        [topic for topic in topics if topic.publishers and not topic.subscriptions],
        [topic for topic in topics if topic.subscriptions and not topic.publishers],
    )


@remembered
def services_of(package: Package) -> Mapping[str, ServiceName]:
    """Return the services by name as written, without a leading slash."""
    return {
        name: ServiceName(services, clients, is_plain[0])
        for name, services, clients, is_plain in _by_name(package, "Service", "Client")
    }


def is_private(endpoint: NamedEndpoint) -> bool:
    """Return whether a name is below that of its node: ``~/chatter``."""
    return endpoint.name.startswith("~/")


def is_remapped(package: Package, endpoint: NamedEndpoint) -> bool:
    """Return whether a launch file of the package mentions the name of an endpoint, to remap it."""
    for path in package.files:
        if ".launch." in path or path.endswith("_launch.py"):
            try:
                text = package.source(path).text
            except ViewError:
                continue
            if endpoint.name in text:
                return True
    return False


def is_named_in_compiled_code(package: Package, topic: str) -> bool:
    """Return whether C++ or Rust code of the workspace mentions a name, in any namespace."""
    texts = [f'{before}{topic}"'.encode() for before in ('"', "/")]
    return any(text in data for data in _compiled_code(package) for text in texts)


def _compiled_code(package: Package) -> Iterator[bytes]:
    for other in package.workspace:
        for path in other.files:
            if path.endswith(_COMPILED):
                with suppress(ViewError):
                    yield other.data(path)


def _by_name(
    package: Package, kind: str, other: str
) -> Iterator[tuple[str, list[NamedEndpoint], list[NamedEndpoint], tuple[bool, bool]]]:
    """Yield names with the endpoints of two kinds, and whether all are plain.

    The latter twice: certainly, and unless parameters with names are set.
    """
    result: dict[str, list[NamedEndpoint]] = {}
    for endpoint in named_endpoints(package):
        if endpoint.kind in {kind, other} and not endpoint.name.startswith("~"):
            result.setdefault(endpoint.name.removeprefix("/"), []).append(endpoint)
    for name, endpoints in result.items():
        sides = [[item for item in endpoints if item.kind == side] for side in (kind, other)]
        is_plain = all(item.is_plain for item in endpoints)
        is_certain = is_plain and all(item.from_parameter is None for item in endpoints)
        yield name, sides[0], sides[1], (is_certain, is_plain)


def _is_plain(endpoint: Endpoint) -> bool:
    owner = endpoint.owner
    return (
        owner is not None
        and owner.namespace is None
        and not endpoint.is_conditional
        and not endpoint.has_unknown_arguments
        and len(endpoint.from_parameters) <= 1
    )


def _profile_words(endpoint: Endpoint) -> dict[str, str] | None:
    """Return the arguments of the QoSProfile of an endpoint; empty for a depth or a preset."""
    argument = endpoint.argument("qos_profile")
    if argument is None or endpoint.qos is None or endpoint.qos.reliability is None:
        return None
    if isinstance(argument.value, int) or endpoint.qos.profile is not None:
        return {}
    file = endpoint.owner.file if endpoint.owner else None
    value = file.evaluator.single_value(argument.node) if file else None
    if not isinstance(value, ast.Call) or any(word.arg is None for word in value.keywords):
        return None
    names = ("deadline", "liveliness")
    if file is None or any(file.evaluator.stores(name) for name in names):
        return None
    return {word.arg or "": ast.unparse(word.value) for word in value.keywords}
