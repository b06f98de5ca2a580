"""What the sources of a package say that its executables do."""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator

from scaffold.errors import ViewError
from scaffold.model.node_entities import Publisher
from scaffold.model.nodes import NodeClass, NodeFacts, NodeOwner
from scaffold.model.package import Package
from scaffold.model.scopes import FunctionNode
from scaffold.model.values import Unknown
from scaffold.smoke.expectation import Expectation, Publication
from scaffold.smoke.publishing import Publishing, Reach

_MAX_BASES = 8


def expectations(package: Package) -> dict[str, Expectation]:
    """Return what is expected of the executables that are Python, by their names."""
    found: dict[str, Expectation] = {}
    for name, path, function in _executables(package):
        expectation = _expectation(package, path, function)
        if expectation is not None:
            found[name] = expectation
    return found


# -- executables


def _executables(package: Package) -> Iterator[tuple[str, str, str | None]]:
    """Yield name, file and entry function; without one, the file is run as a script."""
    try:
        if package.build_type == "ament_python":
            yield from _console_scripts(package)
        elif package.build_type == "ament_cmake":
            yield from _programs(package)
    except ViewError:
        return


def _console_scripts(package: Package) -> Iterator[tuple[str, str, str | None]]:
    for entry in package.setup_py.console_scripts:
        path = _file_of(package, entry.module)
        if path is not None and not entry.malformed:
            yield entry.name, path, entry.function


def _file_of(package: Package, module: str) -> str | None:
    stem = module.replace(".", "/")
    paths = (f"{top}{stem}{end}" for top in ("", "src/") for end in (".py", "/__init__.py"))
    return next((path for path in paths if package.has(path)), None)


def _programs(package: Package) -> Iterator[tuple[str, str, str | None]]:
    for install in package.cmake.installs:
        if install.kind != "PROGRAMS" or package.cmake.guarded_by_testing(install.command):
            continue
        for item in install.items:
            path = item.path
            if path is None or path not in package.python_files:
                continue
            # A node is meant for `ros2 run` wherever it is installed.
            if install.destination == f"lib/{package.name}" or package.node_facts(path).nodes:
                yield install.rename or path.rpartition("/")[2], path, None


# -- what one of them does


def _expectation(package: Package, path: str, function: str | None) -> Expectation | None:
    try:
        facts = package.node_facts(path)
    except ViewError:
        return None
    starts = _starts(facts, function)
    calls = _calls_from(facts, starts, as_script=function is None)
    owners = list(_made(facts, calls))
    return Expectation(
        publications=_merged(_publications(facts, owners, starts)),
        is_node=_is_node(package, facts),
        runs_nothing=function is None and not calls and bool(facts.nodes),
        source=path,
    )


def _starts(facts: NodeFacts, function: str | None) -> list[FunctionNode]:
    """Return the functions that run, from the entry on, in the same file."""
    if function is not None:
        found = facts.module.functions.get(function)
        begin = [found.node] if found else []
    else:
        called = [facts.callback(call.func).function for call in _calls_outside(facts)]
        begin = [one for one in called if one is not None and not isinstance(one, ast.Lambda)]
    reached: dict[FunctionNode, None] = {}
    for one in begin:
        for other in facts.reached(one):
            if not isinstance(other, ast.Lambda):
                reached[other] = None
    return list(reached)


def _calls_outside(facts: NodeFacts) -> list[ast.Call]:
    """Return the calls that importing or running the file makes itself."""
    module = facts.module
    return [
        call
        for call in module.walk(ast.Call)
        if module.enclosing_function(call) is None and module.enclosing_class(call) is None
    ]


def _calls_from(
    facts: NodeFacts, starts: Iterable[FunctionNode], *, as_script: bool
) -> list[ast.Call]:
    calls = _calls_outside(facts) if as_script else []
    return calls + [call for start in starts for call in facts.calls_in(start)]


def _made(facts: NodeFacts, calls: Iterable[ast.Call]) -> Iterator[NodeOwner]:
    """Yield the nodes that are certainly made by these calls."""
    for call in calls:
        owner = None if facts.is_conditional(call) else facts.owner_of(call)
        if owner is not None:
            yield owner


def _is_node(package: Package, facts: NodeFacts) -> bool | None:
    """Tell whether a file uses rclpy; ``None`` if it may, through another of the package."""
    if facts.uses_rclpy:
        return True
    roots = set(facts.module.imports_by_root)
    own = {path.split("/")[0].removesuffix(".py") for path in package.python_files}
    return None if roots & (own | {"", package.name}) else False


# -- what a node publishes


def _publications(
    facts: NodeFacts, owners: Iterable[NodeOwner], starts: list[FunctionNode]
) -> Iterator[Publication]:
    for owner in owners:
        if owner.is_lifecycle:
            continue  # it publishes once it is activated, which nobody does here
        alone = owner.facts is facts and not (isinstance(owner, NodeClass) and owner.base)
        publishing = Publishing(owner.facts, starts, alone=alone)
        for publisher in _publishers(owner, starts):
            topic = _resolved(publisher.topic, owner)
            if topic is not None:
                rate = publishing.rate(publisher) if alone else None
                reach = publishing.reach(publisher)
                yield Publication(
                    topic,
                    publisher.message_type,
                    rate,
                    certain=rate is not None or reach is Reach.ALWAYS,
                    never=reach is Reach.NEVER,
                    sources=publishing.sources(publisher) if rate else 1,
                )


def _publishers(owner: NodeOwner, starts: list[FunctionNode]) -> Iterator[Publisher]:
    """Yield the publishers that exist once the node is made."""
    if not isinstance(owner, NodeClass):
        for publisher in owner.publishers:
            if not publisher.is_conditional and publisher.function in {*starts, None}:
                yield publisher
        return
    one: NodeClass | None = owner
    for _ in range(_MAX_BASES):
        if one is None:
            return
        constructor = one.constructor
        made_in = one.facts.reached(constructor) if constructor else ()
        for publisher in one.publishers:
            if not publisher.is_conditional and publisher.function in made_in:
                yield publisher
        if not one.calls_super_init:
            return
        one = one.base


def _resolved(topic: str | Unknown, owner: NodeOwner) -> str | None:
    """Return the full name of a topic; ``None`` if that cannot be told."""
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
    """Join what is published on the same topic: the rates add up."""
    found: dict[str, Publication] = {}
    for one in publications:
        other = found.get(one.topic)
        found[one.topic] = one if other is None else _joined(one, other)
    return tuple(found.values())


def _joined(one: Publication, other: Publication) -> Publication:
    rates = (one.rate_hz, other.rate_hz)
    known = [rate for rate in rates if rate is not None]
    rate = sum(known) if len(known) == len(rates) else None
    return Publication(
        one.topic,
        other.type or one.type,
        rate,
        certain=one.certain or other.certain,
        never=one.never and other.never,
        sources=one.sources + other.sources,
    )
