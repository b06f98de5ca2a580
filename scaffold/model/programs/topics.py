"""Who publishes and subscribes to which topic in a package, as far as that is plain."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from scaffold.model.python.values import Unknown
from scaffold.model.rclpy.entities import Client, Endpoint, Publisher, Service, Subscription
from scaffold.model.rclpy.file import rclpy_files
from scaffold.record import NamedTuple
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package


class Topic(NamedTuple):
    """The endpoints of one topic."""

    publishers: list[Publisher]
    subscriptions: list[Subscription]
    is_plain: bool
    """Every endpoint of the topic is created for sure, once, by a node without a namespace."""
    is_plain_by_default: bool
    """So it is, unless somebody sets the parameters that hold its name."""


class ServiceName(NamedTuple):
    """The endpoints of one service."""

    services: list[Service]
    clients: list[Client]
    is_plain: bool
    """So are all endpoints of the service."""


def topics_of(package: Package) -> Mapping[str, Topic]:
    """Return the topics by their names as written, a leading slash aside."""
    return package.remember("topics", lambda: _topics(package))


def one_sided(package: Package) -> tuple[list[Topic], list[Topic]]:
    """Return the topics that are published only, and those that are subscribed to only."""
    topics = topics_of(package).values()
    return (
        [topic for topic in topics if topic.publishers and not topic.subscriptions],
        [topic for topic in topics if topic.subscriptions and not topic.publishers],
    )


def services_of(package: Package) -> Mapping[str, ServiceName]:
    """Return the services by their names as written, a leading slash aside."""
    return package.remember("services", lambda: _services(package))


def is_private(endpoint: Endpoint) -> bool:
    """Tell whether a name is below that of its node: ``~/chatter``."""
    return isinstance(endpoint.name, str) and endpoint.name.startswith("~/")


def is_remapped(package: Package, endpoint: Endpoint) -> bool:
    """Tell whether a launch file of the package names what an endpoint is called: it remaps it."""
    for path in package.files:
        if ".launch." in path or path.endswith("_launch.py"):
            try:
                text = package.source(path).text
            except ViewError:
                continue
            if str(endpoint.name) in text:
                return True
    return False


def _topics(package: Package) -> Mapping[str, Topic]:
    result: dict[str, Topic] = {}
    for name, endpoints in _by_name(package, (Publisher, Subscription)).items():
        result[name] = Topic(
            [endpoint for endpoint in endpoints if isinstance(endpoint, Publisher)],
            [endpoint for endpoint in endpoints if isinstance(endpoint, Subscription)],
            all(_is_plain(x) and x.from_parameter is None for x in endpoints),
            all(map(_is_plain, endpoints)),
        )
    return result


def _services(package: Package) -> Mapping[str, ServiceName]:
    result: dict[str, ServiceName] = {}
    for name, endpoints in _by_name(package, (Service, Client)).items():
        result[name] = ServiceName(
            [endpoint for endpoint in endpoints if isinstance(endpoint, Service)],
            [endpoint for endpoint in endpoints if isinstance(endpoint, Client)],
            all(_is_plain(x) and x.from_parameter is None for x in endpoints),
        )
    return result


def _by_name(package: Package, kinds: tuple[type[Endpoint], ...]) -> Mapping[str, list[Endpoint]]:
    result: dict[str, list[Endpoint]] = {}
    for file in rclpy_files(package):
        for endpoint in file.endpoints:
            name = endpoint.name
            if not isinstance(endpoint, kinds) or isinstance(name, Unknown):
                continue
            if not name.startswith("~"):
                result.setdefault(name.removeprefix("/"), []).append(endpoint)
    return result


def _is_plain(endpoint: Endpoint) -> bool:
    owner = endpoint.owner
    return (
        owner is not None
        and owner.namespace is None
        and not endpoint.is_conditional
        and not endpoint.has_unknown_arguments
    )
