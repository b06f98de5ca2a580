"""Launch actions that do not run on the target distribution."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING

from scaffold.formats import xml_reader
from scaffold.formats import yaml as yaml_tree
from scaffold.formats.yaml import Mapping, Scalar, Sequence, YamlNode
from scaffold.model.launch.calls import LaunchCall
from scaffold.model.launch.evaluation.conditions_in_markup import Variables
from scaffold.model.launch.evaluation.conditions_in_python import Conditions
from scaffold.model.launch.markup_file import ENDINGS
from scaffold.model.launch.python_file import LaunchFile, launch_paths
from scaffold.source import Location, Source

if TYPE_CHECKING:
    from scaffold.formats.xml import Document
    from scaffold.model.package import Package

Stretch = tuple[int, int, int, int]
"""Line and column of the start and of the end."""
_KEYS = {"if": False, "unless": True}
"""The conditions, with the value that skips an action."""
_VALUES = {"let": "value", "arg": "default"}
"""Elements that set variables."""


def has_conditions(package: Package, path: str) -> bool:
    """Return whether the conditions of a file are those of launch."""
    return path.endswith(ENDINGS) or (path.endswith(".py") and path in launch_paths(package))


def stretches_not_run(package: Package, path: str) -> Iterator[Stretch]:
    """Yield the locations of actions that are not run on the target distribution.

    Raises:
        ViewError: the file cannot be read.
    """
    if path.endswith(".py"):
        yield from _in_python(LaunchFile.of(package, path))
    elif path.endswith(".xml"):
        yield from _in_xml(xml_reader.parse(xml_reader.decode(path, package.data(path))))
    else:
        yield from _in_yaml(Source.decode(path, package.data(path)))


# -- Python


def _in_python(launch: LaunchFile) -> Iterator[Stretch]:
    conditions = Conditions(launch)
    for call in launch.calls:
        node = call.given.get("condition")
        if node is not None and conditions.holds(node) is False:
            yield _stretch(launch.location(call.call))
            yield from _group_actions(launch, call)


def _group_actions(launch: LaunchFile, group: LaunchCall) -> Iterator[Stretch]:
    """Yield the actions of a group that are created before it and only used there."""
    actions = group.given.get("actions")
    for item in actions.elts if isinstance(actions, ast.List) else ():
        if not isinstance(item, ast.Name) or len(launch.module.index.names(item.id)) > 2:  # noqa: PLR2004  set and used
            continue
        made = launch.call_of(item)
        if made is not None:
            yield _stretch(launch.location(made.call))


def _stretch(at: Location) -> Stretch:
    return at.line, at.column, at.end_line, at.end_column


# -- XML and YAML


def _in_xml(document: Document) -> Iterator[Stretch]:
    elements = [document.root, *document.root.descendants()]
    variables = _variables((each.tag, each.get) for each in elements)
    for element in elements:
        if _is_left_out(variables, element.get):
            yield _stretch(element.location)


def _in_yaml(source: Source) -> Iterator[Stretch]:
    mappings = [*yaml_tree.mappings(yaml_tree.parse(source))]
    given = [
        {key.text: value.text for key, value in mapping.pairs if isinstance(value, Scalar)}
        for _, mapping in mappings
    ]
    named = zip(mappings, given, strict=True)
    variables = _variables((tag, words.get) for (tag, _), words in named)
    for (_, mapping), words in zip(mappings, given, strict=True):
        if _is_left_out(variables, words.get):
            yield mapping.location.line, mapping.location.column, *_end(mapping)


def _end(node: YamlNode) -> tuple[int, int]:
    """Return the end of the last text in a node."""
    if isinstance(node, Mapping):
        parts: list[YamlNode] = [part for pair in node.pairs for part in pair]
    else:
        parts = node.items if isinstance(node, Sequence) else []
    own = (node.location.end_line, node.location.end_column)
    return max([own, *map(_end, parts)])


def _variables(elements: Iterable[tuple[str, Callable[[str], str | None]]]) -> Variables:
    """Return the variables set by elements."""
    given: dict[str, list[str]] = {}
    for tag, attribute in elements:
        name = attribute("name") if tag in _VALUES else None
        if name is not None:
            given.setdefault(name, []).append(attribute(_VALUES[tag]) or "")
    return Variables(given)


def _is_left_out(variables: Variables, attribute: Callable[[str], str | None]) -> bool:
    conditions = ((attribute(key), leaving) for key, leaving in _KEYS.items())
    return any(
        text is not None and variables.decide(text) is leaving for text, leaving in conditions
    )
