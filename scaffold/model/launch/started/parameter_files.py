"""Which nodes read which parameter files, and which sections."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from scaffold import lazy_re
from scaffold.model.facts import fact
from scaffold.model.install.share import share_of
from scaffold.model.launch.started.nodes import StartedNode, consumers, started_nodes
from scaffold.model.launch.unused.unlaunched import is_in_unlaunched_action
from scaffold.model.package import mentions
from scaffold.model.parameters.declared import Declared, declared_by, own_nodes
from scaffold.model.remembered import remembered, remembered_list
from scaffold.record import NamedTuple
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package
    from scaffold.model.parameters.files import Entry, Section
    from scaffold.model.programs.known_nodes import KnownNode

# linear: it matches from the start of a run of these characters only
_FILE_NAME = lazy_re.compile(r"(?<![\w.-])[\w.-]+\.ya?ml")
_LAUNCH_ENDINGS = ("launch.xml", "launch.yaml", "launch.yml", ".launch", ".py")


class FileUse(NamedTuple):
    """The use of a parameter file by a node."""

    nodes: list[StartedNode]
    """The nodes that get it in launch files of the package."""
    complete: bool
    """Whether no other file of the package mentions it."""


class FileValue(NamedTuple):
    """A value in a parameter file."""

    path: str
    entry: Entry
    declared: list[Declared]
    """The declarations in the nodes of the value."""


def values_in_files(package: Package) -> Iterator[FileValue]:
    """Yield the values for nodes in the parameter files of a package."""
    from scaffold.model.parameters.files import parameter_files

    for file in parameter_files(package):
        for section in file.sections:
            nodes = nodes_for(package, file.path, section)
            declared = [declared_by(owner, package) for owner in nodes]
            for entry in section.entries:
                yield FileValue(file.path, entry, declared)


@remembered
def use_of(package: Package, path: str) -> FileUse:
    """Return the nodes that read a parameter file, according to the package itself."""
    installed = share_of(package).files
    result: list[StartedNode] = []
    passed = False
    for node in consumers(package):
        for named, is_handed_on in node.parameter_files:
            if installed.get(named, named) == path and not _is_unlaunched(package, node):
                result.append(node)
                passed = passed or is_handed_on
    launch_files = {node.launch for node in result}
    return FileUse(result, not passed and not _is_mentioned(package, path, launch_files))


def _is_unlaunched(package: Package, node: StartedNode) -> bool:
    """Return whether no LaunchDescription gets a node."""
    at = node.location
    return is_in_unlaunched_action(package, node.launch, at.line, at.column)


def nodes_for(package: Package, path: str, section: Section) -> list[KnownNode]:
    """Return the code of the nodes of a section; empty if uncertain."""
    use = use_of(package, path)
    name = section.name
    owners: list[KnownNode | None]
    if section.is_pattern:
        if not use.nodes:
            return []
        owners = [node.owner(package) for node in use.nodes]
    else:
        owners = [node.owner(package) for node in use.nodes if node.name(package) == name]
        if not owners:
            nodes, complete = own_nodes(package)
            renamed = {
                node.name(package)
                for node in started_nodes(package)
                if node.package != package.name
            }
            owners = [node for node in nodes if node.node_name == name]
            owners = owners if complete and name not in renamed and len(owners) == 1 else []
    result = [owner for owner in owners if owner is not None]
    return list(dict.fromkeys(result)) if len(result) == len(owners) else []


_LOADERS = ("yaml.safe_load", "yaml.load", "yaml.full_load", "ruamel")
"""Words in code that reads YAML itself."""


def is_loaded(package: Package, path: str, owners: Sequence[KnownNode] = (), key: str = "") -> bool:
    """Return whether Python code of the workspace loads a parameter file itself, as YAML.

    Then it may have values only for that code. The code mentions the file, or is that of the nodes
    of the file, which may get its name as a parameter.

    Args:
        package: The package.
        path: The parameter file.
        owners: The nodes of the file.
        key: A string that the code has as well, such as the name of a parameter.
    """
    homes = [(owner.home(package), owner.path) for owner in owners]
    if any(code in _code_loading_yaml(home) and _has(home, code, key) for home, code in homes):
        return True
    name = path.rpartition("/")[2]
    return any(
        mentions(other, code, name) and _has(other, code, key)
        for other in package.workspace
        for code in _code_loading_yaml(other)
    )


def is_only_loaded(package: Package, path: str, owners: Sequence[KnownNode] = ()) -> bool:
    """Return whether code loads a parameter file as YAML, and no launch file passes it to a node.

    Then rcl never reads it. See `is_loaded` for the arguments.
    """
    return not use_of(package, path).nodes and is_loaded(package, path, owners)


def _has(package: Package, code: str, key: str) -> bool:
    """Return whether code contains a string; any code has the empty key."""
    return not key or any(mentions(package, code, f"{quote}{key}{quote}") for quote in "'\"")


@remembered_list
def _code_loading_yaml(package: Package) -> Iterator[str]:
    for path in package.python_files:
        with contextlib.suppress(ViewError):
            if any(mentions(package, path, loader) for loader in _LOADERS):
                yield path


@remembered
def node_names(package: Package) -> set[str]:
    """Return all names of nodes in the code and launch files of the package."""
    names = {str(node.node_name) for node in own_nodes(package)[0]}
    started = (*started_nodes(package), *consumers(package))
    return names | {str(node.name(package)) for node in started}


def _is_mentioned(package: Package, path: str, launch_files: set[str]) -> bool:
    """Return whether a launch file mentions a parameter file in an unknown way."""
    name = path.rpartition("/")[2]
    for other in package.files:
        if other.endswith(_LAUNCH_ENDINGS) and other not in launch_files and other != "setup.py":
            with contextlib.suppress(ViewError):
                if _mentions(package, other, name):
                    return True
    return False


def _mentions(package: Package, path: str, name: str) -> bool:
    if not path.endswith(".py"):
        return name in package.source(path).text
    if _FILE_NAME.fullmatch(name):
        return any(name in word for word in _parameter_files_named_in(package, path))
    return mentions(package, path, name)


@fact
def _parameter_files_named_in(package: Package, path: str) -> frozenset[str]:
    """Return the strings that may be or end with the name of a parameter file; raises ViewError."""
    text = package.source(path).text
    is_any = ".yaml" in text or ".yml" in text
    return frozenset(_FILE_NAME.findall(text) if is_any else ())
