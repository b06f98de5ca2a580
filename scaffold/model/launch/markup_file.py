"""Launch files in XML and YAML: nodes and packages, with locations."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

from scaffold.formats import xml_reader
from scaffold.formats import yaml as yaml_tree
from scaffold.formats.xml import Attribute
from scaffold.formats.yaml import Mapping, Scalar, Sequence
from scaffold.model.remembered import remembered
from scaffold.record import NamedTuple
from scaffold.source import Location, Source, ViewError

if TYPE_CHECKING:
    from scaffold.formats.xml import Document, Element
    from scaffold.model.package import Package

_FIND = r"\$\(find-pkg-share ([\w-]+)\)((?:/[\w.+-]+)*)(.?)"


class MarkupElement(NamedTuple):
    """An element of a launch file."""

    tag: str
    location: Location
    attributes: dict[str, Attribute]
    parameters: list[dict[str, Attribute]]
    """The attributes of its parameters; in YAML, those without quotes."""
    remappings: list[tuple[Attribute, Attribute | None]]
    """The remapped names, with their targets."""
    has_parameter_files: bool
    nested: dict[str, Location]
    """The keys of YAML whose values are lists or mappings: what XML has as elements."""
    arguments: list[Attribute]
    """The names of the arguments that an include gives."""


_ARGUMENTS = frozenset({"args", "ros_args"})
"""Attributes that may hold parameters."""
ENDINGS = ("launch.xml", "launch.yaml", "launch.yml")


class MarkupNode(NamedTuple):
    """A ``<node pkg="…" exec="…"/>``."""

    path: str
    package: Attribute | None
    executable: Attribute | None
    name: Attribute | None
    location: Location
    parameters: list[tuple[Attribute, Attribute]]
    """Name and value of single parameters without a type."""
    remappings: list[tuple[Attribute, Attribute | None]]
    """The remapped names, with their targets."""
    parameter_names: frozenset[str] | None
    """The given parameters; ``None`` if files or arguments may give others."""
    arguments: Attribute | None
    """The command-line arguments."""


class MarkupPath(NamedTuple):
    """A ``$(find-pkg-share package)/path`` in an attribute."""

    package: str
    path: str
    """The path relative to the share directory; empty if not fully known."""
    location: Location


class MarkupFile(NamedTuple):
    """A launch file in XML or YAML."""

    path: str
    nodes: list[MarkupNode]
    paths: list[MarkupPath]
    attributes: list[Attribute]
    commands: list[Attribute]
    """The command lines of ``<executable cmd="…"/>``."""
    containers: list[MarkupNode]
    """Each ``<node_container pkg="…" exec="…"/>``."""
    elements: list[MarkupElement]
    """All elements of the file."""

    def default_of(self, argument: str) -> Attribute | None:
        """Return the default of a launch argument that nothing else in the file sets."""
        setters = [
            element.attributes
            for element in self.elements
            if element.tag in {"arg", "let"} and element.attributes.get("name") is not None
        ]
        named = [given for given in setters if given["name"].value == argument]
        return named[0].get("default") if len(named) == 1 else None


@remembered
def markup_files(package: Package) -> list[MarkupFile]:
    """Return the launch files in XML and YAML that can be read; tests are skipped."""
    result = [_read(package, path) for path in markup_paths(package)]
    return [file for file in result if file is not None]


def markup_paths(package: Package) -> list[str]:
    """Return the launch files in XML and YAML, also those that cannot be read."""
    return [path for path in package.files if path.endswith(ENDINGS) and not _in_tests(path)]


def is_known(attribute: Attribute | None) -> bool:
    """Return whether an attribute has a value without substitutions."""
    return attribute is not None and "$(" not in attribute.value and attribute.value != ""


def _in_tests(path: str) -> bool:
    return not {"test", "tests"}.isdisjoint(path.split("/"))


def _read(package: Package, path: str) -> MarkupFile | None:
    nodes: list[MarkupNode] = []
    attributes: list[Attribute] = []
    commands: list[Attribute] = []
    containers: list[MarkupNode] = []
    try:
        elements = _elements(package, path)
    except ViewError:
        return None  # another rule reports malformed files
    for element in elements:
        attributes.extend(element.attributes.values())
        if element.tag == "node":
            nodes.append(_node(path, element))
        if element.tag == "node_container":
            containers.append(_node(path, element))
        if element.tag == "executable" and "cmd" in element.attributes:
            commands.append(element.attributes["cmd"])
    paths = [item for attribute in attributes for item in _paths(attribute)]
    return MarkupFile(path, nodes, paths, attributes, commands, containers, elements)


def _node(path: str, element: MarkupElement) -> MarkupNode:
    given = element.attributes
    package, executable, name = (given.get(key) for key in ("pkg", "exec", "name"))
    pairs = [
        (parameter["name"], parameter["value"])
        for parameter in element.parameters
        if "type" not in parameter and "name" in parameter and "value" in parameter
    ]
    names = [parameter["name"].value for parameter in element.parameters if "name" in parameter]
    is_open = element.has_parameter_files or not _ARGUMENTS.isdisjoint(given)
    parameter_names = None if is_open else frozenset(names)
    arguments = given.get("args")
    return MarkupNode(
        path,
        package,
        executable,
        name,
        element.location,
        pairs,
        element.remappings,
        parameter_names,
        arguments,
    )


def _elements(package: Package, path: str) -> list[MarkupElement]:
    """Return all elements of a launch file."""
    if path.endswith(".xml"):
        root = _document(package, path).root
        return [_of_xml(descendant) for descendant in root.descendants()]
    roots = yaml_tree.parse(Source.decode(path, package.data(path)))
    return [_of_yaml(tag, node) for tag, node in yaml_tree.mappings(roots)]


def _of_xml(element: Element) -> MarkupElement:
    parameters = [child.attributes for child in element.children if child.tag == "param"]
    remaps = [child.attributes for child in element.children if child.tag == "remap"]
    return MarkupElement(
        element.tag,
        element.name_location,
        element.attributes,
        parameters,
        _renamed(remaps),
        any("name" not in given for given in parameters),
        {},
        _names(child.attributes for child in element.children if child.tag in {"arg", "let"}),
    )


def _of_yaml(tag: str, node: Mapping) -> MarkupElement:
    children: dict[str, list[Mapping]] = {"arg": [], "let": [], "param": [], "remap": []}
    for key, value in node.pairs:
        if key.text in children and isinstance(value, Sequence):
            children[key.text] += [item for item in value.items if isinstance(item, Mapping)]
    parameters = [dict(_scalars(item)) for item in children["param"] if _is_plain(item)]
    remaps = [dict(_scalars(item)) for item in children["remap"]]
    return MarkupElement(
        tag,
        node.location,
        dict(_scalars(node)),
        parameters,
        _renamed(remaps),
        len(parameters) < len(children["param"])
        or any("name" not in given for given in parameters),
        {key.text: key.location for key, value in node.pairs if not isinstance(value, Scalar)},
        _names(dict(_scalars(item)) for item in (*children["arg"], *children["let"])),
    )


def _names(given: Iterable[dict[str, Attribute]]) -> list[Attribute]:
    return [attributes["name"] for attributes in given if "name" in attributes]


def _is_plain(node: Mapping) -> bool:
    """Return whether no value of a mapping is in quotes."""
    return all(isinstance(value, Scalar) and value.is_plain for _, value in node.pairs)


def _scalars(node: Mapping) -> Iterator[tuple[str, Attribute]]:
    """Yield the values of a mapping as attributes."""
    for key, value in node.pairs:
        if isinstance(value, Scalar):
            yield key.text, Attribute(key.text, value.text, value.location, key.location)


def _document(package: Package, path: str) -> Document:
    return xml_reader.parse(xml_reader.decode(path, package.data(path)))


def _paths(attribute: Attribute) -> Iterator[MarkupPath]:
    at = attribute.location
    for item in re.finditer(_FIND, attribute.value):
        place = at
        if at.end_column - at.column == len(attribute.value):  # without references, on one line
            start = at.column + item.start()
            place = Location(at.path, at.line, start, at.line, at.column + item.end(2))
        path = "" if item[3] else item[2].strip("/")
        yield MarkupPath(item[1], path, place)


def _renamed(
    remaps: Iterable[dict[str, Attribute]],
) -> list[tuple[Attribute, Attribute | None]]:
    pairs = [(given["from"], given.get("to")) for given in remaps if "from" in given]
    return [
        (source, target)
        for source, target in pairs
        if target is None or changes_name(source.value, target.value)
    ]


def changes_name(source: str, target: object) -> bool:
    """Return whether a remapping changes a name, as some have the same name twice."""
    return not isinstance(target, str) or source.lstrip("/") != target.lstrip("/")
