"""The behavior of executables that the sources of a package declare."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import TypeVar

from scaffold.model.package import Package
from scaffold.model.programs.entry_points import EntryPoint, entry_points_of, execution_of
from scaffold.model.programs.publish_reach import PublishReach, Reach
from scaffold.model.programs.publishing import publish_rates
from scaffold.model.python.evaluation.values import Unknown
from scaffold.model.python.scopes import FunctionNode
from scaffold.model.rclpy.entities import Endpoint
from scaffold.model.rclpy.file import NodeClass, NodeDefinition, RclpyFile
from scaffold.smoke.expectation import Expectation, Offer, Publication
from scaffold.source import ViewError

_MAX_BASES = 8
_LEADING_UP = ("on_configure", "on_activate")
_Entity = TypeVar("_Entity", bound=Endpoint)


def expectations(package: Package) -> dict[str, Expectation]:
    """Return the expectations of Python executables, by name."""
    result: dict[str, Expectation] = {}
    for start in entry_points_of(package):
        expectation = _expectation(package, start)
        if expectation is not None:
            result[start.program] = expectation
    return result


# -- executables


def _expectation(package: Package, start: EntryPoint) -> Expectation | None:
    try:
        run = execution_of(package, start.path, start.function)
    except ViewError:
        return None
    owners = [] if _has_own_arguments(run.file) else [owner for _, owner in run.nodes()]
    return Expectation(
        publications=_merged(_publications(run.file, owners, run.functions)),
        offers=tuple(dict.fromkeys(_offers(owners, run.functions))),
        is_node=_is_node(package, run.file),
        runs_nothing=start.function is None and not run.calls and bool(run.file.nodes),
        source=start.path,
    )


def _has_own_arguments(file: RclpyFile) -> bool:
    """Return whether a program passes ROS arguments to itself, which may change names and rates."""
    texts = (node.value for node in file.module.walk(ast.Constant) if isinstance(node.value, str))
    return any(text.split()[:1] == ["--ros-args"] for text in texts)


def _is_node(package: Package, file: RclpyFile) -> bool | None:
    """Return whether a file uses rclpy; ``None`` if it may do so through another module."""
    if file.uses_rclpy:
        return True
    roots = set(file.module.imports_by_root)
    own = {path.split("/")[0].removesuffix(".py") for path in package.python_files}
    return None if roots & (own | {"", package.name}) else False


# -- nodes


def _publications(
    file: RclpyFile, owners: Iterable[NodeDefinition], starts: Sequence[FunctionNode]
) -> Iterator[Publication]:
    for owner in owners:
        alone = owner.file is file and not (isinstance(owner, NodeClass) and owner.base)
        reaches = PublishReach(owner.file, starts, alone=alone)
        for publisher in _made(owner, starts, lambda item: item.publishers):
            topic = _resolved(publisher.topic, owner)
            if topic is not None and owner.is_lifecycle:
                yield Publication(topic, publisher.message_type, is_managed=True)
            elif topic is not None:
                rates = publish_rates(owner.file, publisher) if alone else None
                rate = sum(rates) if rates else None
                reach = reaches.of(publisher)
                timers = publish_rates(owner.file, publisher, may_leave=True) if alone else None
                yield Publication(
                    topic,
                    publisher.message_type,
                    rate,
                    certain=rate is not None or reach is Reach.ALWAYS,
                    never=reach is Reach.NEVER,
                    sources=len(rates) if rates else 1,
                    timer_hz=sum(timers) if timers else None,
                )


def _offers(owners: Iterable[NodeDefinition], starts: Sequence[FunctionNode]) -> Iterator[Offer]:
    """Yield the services and actions that exist once the nodes are constructed."""
    for owner in owners:
        for service in _made(owner, starts, lambda item: item.services):
            name = _resolved(service.name, owner)
            if name is not None:
                yield Offer("service", name, service.interface)
        for server in _made(owner, starts, lambda item: item.action_servers):
            name = _resolved(server.name, owner)
            if name is not None:
                yield Offer("action", name, server.interface)


def _made(
    owner: NodeDefinition,
    starts: Sequence[FunctionNode],
    own: Callable[[NodeDefinition], Sequence[_Entity]],
) -> Iterator[_Entity]:
    """Yield the entities of a kind that exist once the node is constructed."""
    if not isinstance(owner, NodeClass):
        for entity in own(owner):
            if not entity.is_conditional and entity.function in {*starts, None}:
                yield entity
        return
    node_class: NodeClass | None = owner
    for _ in range(_MAX_BASES):
        if node_class is None:
            return
        made_in = {
            function
            for start in _constructors(node_class)
            for function in node_class.file.reached(start)
        }
        for entity in own(node_class):
            if not entity.is_conditional and entity.function in made_in:
                yield entity
        if not node_class.calls_super_init:
            return
        node_class = node_class.base


def _constructors(owner: NodeClass) -> Iterator[FunctionNode]:
    """Yield the methods that create the entities of a node: constructor and lifecycle callbacks."""
    if owner.constructor is not None:
        yield owner.constructor
    for item in owner.node.body if owner.is_lifecycle else ():
        if isinstance(item, FunctionNode) and item.name in _LEADING_UP:
            yield item


def _resolved(topic: str | Unknown, owner: NodeDefinition) -> str | None:
    """Return the full name of a topic; ``None`` if that is unknown."""
    if not isinstance(topic, str) or not topic or "{" in topic:
        return None
    root = owner
    while isinstance(root, NodeClass) and root.base is not None:
        root = root.base
    call = root.constructor_call
    if call is not None and any(word.arg in {None, "cli_args"} for word in call.keywords):
        return None
    if topic.startswith("/"):
        return topic
    namespace = "" if root.namespace is None else root.namespace
    if not isinstance(namespace, str):
        return None
    parts = [namespace.strip("/")]
    if topic.startswith("~"):
        if not isinstance(owner.node_name, str):
            return None
        parts.append(owner.node_name)
        topic = topic[1:]
    return "/" + "/".join(part for part in (*parts, topic.strip("/")) if part)


def _merged(publications: Iterable[Publication]) -> tuple[Publication, ...]:
    """Merge publications on the same topic: their rates add up."""
    result: dict[str, Publication] = {}
    for publication in publications:
        other = result.get(publication.topic)
        result[publication.topic] = publication if other is None else _combined(publication, other)
    return tuple(result.values())


def _combined(publication: Publication, other: Publication) -> Publication:
    rates = (publication.rate_hz, other.rate_hz)
    stated = [rate for rate in rates if rate is not None]
    rate = sum(stated) if len(stated) == len(rates) else None
    return Publication(
        publication.topic,
        other.type or publication.type,
        rate,
        certain=publication.certain or other.certain,
        never=publication.never and other.never,
        sources=publication.sources + other.sources,
        timer_hz=publication.timer_hz or other.timer_hz,
    )
