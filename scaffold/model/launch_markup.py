"""What launch files in XML say: nodes and packages, with places."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

from scaffold.errors import ViewError
from scaffold.model import xml_tree
from scaffold.model.source import Location

if TYPE_CHECKING:
    from scaffold.model.package import Package
    from scaffold.model.xml_tree import Attribute, Document, Element

_FIND = r"\$\(find-pkg-share ([\w-]+)\)((?:/[\w.+-]+)*)(.?)"


class MarkupNode(NamedTuple):
    """A ``<node pkg="…" exec="…"/>``."""

    path: str
    package: Attribute | None
    executable: Attribute | None
    name: Attribute | None
    location: Location


class MarkupPath(NamedTuple):
    """A ``$(find-pkg-share package)/path`` in an attribute."""

    package: str
    path: str
    """Relative to the share directory; empty when it is not known to its end."""
    location: Location


class MarkupFile(NamedTuple):
    """A launch file in XML."""

    path: str
    nodes: list[MarkupNode]
    paths: list[MarkupPath]
    attributes: list[Attribute]


def markup_files(package: Package) -> list[MarkupFile]:
    """Return the launch files in XML that can be read; tests are left out."""

    def read() -> list[MarkupFile]:
        paths = [path for path in package.files if path.endswith("launch.xml")]
        found = [_read(package, path) for path in paths if not _in_tests(path)]
        return [file for file in found if file is not None]

    return package.remember("launch_markup", read)


def is_known(attribute: Attribute | None) -> bool:
    """Tell whether the value of an attribute is given and has no substitutions."""
    return attribute is not None and "$(" not in attribute.value and attribute.value != ""


def _in_tests(path: str) -> bool:
    return not {"test", "tests"}.isdisjoint(path.split("/"))


def _read(package: Package, path: str) -> MarkupFile | None:
    try:
        document = _document(package, path)
    except ViewError:
        return None  # another rule reports what is not well-formed
    nodes: list[MarkupNode] = []
    attributes: list[Attribute] = []
    for element in document.root.descendants():
        given = element.attributes
        attributes.extend(given.values())
        if element.tag == "node":
            nodes.append(_node(path, element, given))
    paths = [found for attribute in attributes for found in _paths(attribute)]
    return MarkupFile(path, nodes, paths, attributes)


def _document(package: Package, path: str) -> Document:
    try:
        data = package.tree.read(path)
    except OSError as error:
        raise ViewError(path) from error
    return xml_tree.parse(xml_tree.decode(path, data))


def _node(path: str, element: Element, given: dict[str, Attribute]) -> MarkupNode:
    return MarkupNode(
        path, given.get("pkg"), given.get("exec"), given.get("name"), element.name_location
    )


def _paths(attribute: Attribute) -> Iterator[MarkupPath]:
    at = attribute.location
    for found in re.finditer(_FIND, attribute.value):
        place = at
        if at.end_column - at.column == len(attribute.value):  # no references, on one line
            start = at.column + found.start()
            place = Location(at.path, at.line, start, at.line, at.column + found.end(2))
        path = "" if found[3] else found[2].strip("/")
        yield MarkupPath(found[1], path, place)
