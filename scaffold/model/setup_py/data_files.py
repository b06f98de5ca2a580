"""The entries of ``data_files`` in setup.py: where files are installed."""

from __future__ import annotations

import ast

from scaffold.model.python.evaluation.evaluator import Element, Evaluator
from scaffold.model.python.evaluation.values import UNKNOWN, Glob, Unknown
from scaffold.model.python.module import PythonModule
from scaffold.record import NamedTuple
from scaffold.source import Location


class DataFile(NamedTuple):
    """One ``(destination, [sources])`` of data_files."""

    destination: str | Unknown
    sources: tuple[str | Glob | Unknown, ...]
    complete: bool
    """Whether these are all sources."""
    location: Location
    node: ast.expr
    destination_location: Location
    source_locations: tuple[Location, ...]
    """The locations of the sources."""
    conditional: bool = False
    """Added under a condition or in a loop."""
    malformed: str | None = None
    """The error, if it is malformed."""


def data_file(module: PythonModule, evaluator: Evaluator, element: Element) -> DataFile:
    """Return an item of the list as an entry, which may be malformed."""
    node, at = element.node, module.location(element.origin or element.node)
    entry = _evaluated(element.value, node, at)
    match node:
        case _ if element.origin is not None:
            pass  # the names in it have other values here
        case ast.Tuple(elts=[_, _]) | ast.List(elts=[_, _]):
            entry = _written(module, evaluator, node)
        case _ if lacks_comma(evaluator, node):
            problem = "a comma is missing before the files"
            entry = _evaluated((), node, at)._replace(malformed=problem)
    return entry._replace(conditional=element.conditional)


def lacks_comma(evaluator: Evaluator, node: ast.expr) -> bool:
    """Return whether a comma is missing in a pair: the list of files indexes the directory."""
    return any(
        isinstance(part.slice, ast.Constant | ast.Tuple)
        and isinstance(evaluator.evaluate(part.value), str)
        for part in ast.walk(node)
        if isinstance(part, ast.Subscript)
    )


def _written(module: PythonModule, evaluator: Evaluator, node: ast.Tuple | ast.List) -> DataFile:
    """Return an entry that is written as a pair."""
    first, second = node.elts
    destination, place = evaluator.text(first), module.location(first)
    elements = evaluator.elements(second)
    entry = DataFile(
        destination,
        sources=tuple(_source(item.value) for item in elements.items),
        complete=elements.complete,
        location=module.location(node),
        node=node,
        destination_location=place,
        source_locations=tuple(module.location(item.node) for item in elements.items),
    )
    if isinstance(evaluator.evaluate(second), str):
        problem = "the files are a string, not a list"
        return entry._replace(sources=(), source_locations=(), complete=False, malformed=problem)
    return entry._replace(complete=entry.complete and UNKNOWN not in entry.sources)


def _evaluated(value: object, node: ast.expr, at: Location) -> DataFile:
    """Return an entry of which only the value is known."""
    sources: tuple[str | Glob | Unknown, ...] = ()
    destination: str | Unknown = UNKNOWN
    is_pair = False
    match value:
        case (str() | Unknown() as destination, list() | tuple() as values):
            sources = tuple(map(_source, values))
            is_pair = True
        case (str() | Unknown() as destination, Glob() | Unknown() as files):
            sources = (_source(files),)
            is_pair = True
    problem = "not a pair of a directory and a list of files"
    return DataFile(
        destination,
        sources,
        complete=is_pair and UNKNOWN not in sources,
        location=at,
        node=node,
        destination_location=at,
        source_locations=(at,) * len(sources),
        malformed=None if is_pair or isinstance(value, Unknown | Glob) else problem,
    )


def _source(value: object) -> str | Glob | Unknown:
    return value if isinstance(value, str | Glob) else UNKNOWN
