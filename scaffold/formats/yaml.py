"""YAML documents as trees with locations, built from parser events.

Aliases are not expanded, so that no file grows exponentially; nothing is
constructed from tags.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Protocol

from scaffold.record import NamedTuple
from scaffold.source import Location, ParseError, Source

if TYPE_CHECKING:
    import yaml

MAX_LENGTH = 2_000_000
"""The length limit in characters; a longer file is data, and not read."""
MAX_DEPTH = 60


class _Mark(Protocol):
    """A position, with the attributes common to both parsers of PyYAML."""

    @property
    def line(self) -> int:
        """From 0."""

    @property
    def column(self) -> int:
        """From 0."""


class Scalar(NamedTuple):
    """A single value, as text."""

    text: str
    is_plain: bool
    """Whether it is unquoted, so that its form decides its type; also blocks, as in rcl."""
    tag: str | None
    location: Location
    start: int
    end: int


class Sequence(NamedTuple):
    """A list."""

    items: list[YamlNode]
    location: Location


class Mapping(NamedTuple):
    """Pairs of keys and values, including duplicate keys."""

    pairs: list[tuple[Scalar, YamlNode]]
    """Keys that are not scalars are skipped."""
    location: Location


class Alias(NamedTuple):
    """``*name``: a reference to an anchor."""

    name: str
    location: Location


YamlNode = Scalar | Sequence | Mapping | Alias


def parse(source: Source) -> list[YamlNode]:
    """Read a file; return the root of every document.

    Raises:
        ParseError: it is not YAML, too large, or nested too deeply.
    """
    if len(source.text) > MAX_LENGTH:
        raise ParseError(Location.start_of(source.path), "too large to be read")
    import yaml

    loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    reader = _Reader(source)
    try:
        for event in yaml.parse(source.text, Loader=loader):
            reader.take(event)
    except yaml.MarkedYAMLError as error:
        raise _explained(source, error) from None
    except yaml.YAMLError as error:
        at = Location.start_of(source.path)
        raise ParseError(at, f"not YAML: {str(error).splitlines()[0]}") from None
    except (ValueError, RecursionError):
        raise ParseError(Location.start_of(source.path), "cannot be read as YAML") from None
    return reader.roots


def mappings(roots: Iterable[YamlNode]) -> Iterator[tuple[str, Mapping]]:
    """Yield the mappings in documents, each with the key of its value; empty for a root."""
    pending: list[tuple[str, YamlNode]] = [("", root) for root in roots]
    for key, node in pending:  # grows on the way
        if isinstance(node, Sequence):
            pending += [(key, item) for item in node.items]
        elif isinstance(node, Mapping):
            yield key, node
            pending += [(inner.text, value) for inner, value in node.pairs]


def _explained(source: Source, error: yaml.MarkedYAMLError) -> ParseError:
    mark = error.problem_mark or error.context_mark
    line = mark.line + 1 if mark is not None else 1
    line = min(line, len(source.lines))
    at = source.line_location(line)
    for number in (line, line - 1, line + 1):
        text = source.lines[number - 1] if 0 < number <= len(source.lines) else ""
        indent = text[: len(text) - len(text.lstrip())]
        if "\t" in indent:
            place = source.offset(number, indent.index("\t") + 1)
            at = source.location(place, place + 1)
            return ParseError(at, "line is indented with a tab; YAML allows only spaces")
    context = f" {error.context}" if error.context else ""
    return ParseError(at, f"not YAML: {error.problem}{context}")


class _Reader:
    """Builds the tree from events, without recursion."""

    def __init__(self, source: Source) -> None:
        self.source = source
        self.roots: list[YamlNode] = []
        self.open: list[Sequence | Mapping] = []
        self.keys: list[YamlNode | None] = []

    def take(self, event: yaml.Event) -> None:
        import yaml

        if isinstance(event, yaml.ScalarEvent):
            self._scalar(event)
        elif isinstance(event, yaml.AliasEvent):
            self._add(Alias(event.anchor or "", self._location(event)))
        elif isinstance(event, yaml.SequenceStartEvent):
            self._open_node(Sequence([], self._location(event)))
        elif isinstance(event, yaml.MappingStartEvent):
            self._open_node(Mapping([], self._location(event)))
        elif isinstance(event, yaml.CollectionEndEvent):
            self.keys.pop()
            self.open.pop()

    def _scalar(self, event: yaml.ScalarEvent) -> None:
        start, end = self._offset(event.start_mark), self._offset(event.end_mark)
        at = self.source.location(start, end)
        is_plain = event.style not in {"'", '"'}
        self._add(Scalar(event.value, is_plain, event.tag, at, start, end))

    def _open_node(self, node: Sequence | Mapping) -> None:
        if len(self.open) >= MAX_DEPTH:
            raise ParseError(node.location, "nested too deeply to be read")
        self._add(node)
        self.open.append(node)
        self.keys.append(None)

    def _add(self, node: YamlNode) -> None:
        if not self.open:
            self.roots.append(node)
            return
        holder = self.open[-1]
        if isinstance(holder, Sequence):
            holder.items.append(node)
            return
        key = self.keys[-1]
        if key is None:
            self.keys[-1] = node
            return
        if isinstance(key, Scalar):
            holder.pairs.append((key, node))
        self.keys[-1] = None

    def _offset(self, mark: _Mark | None) -> int:
        if mark is None:
            return 0
        # The parsers do not count a byte order mark.
        skipped = 1 if mark.line == 0 and self.source.text.startswith("\ufeff") else 0
        return self.source.offset(mark.line + 1, mark.column + 1 + skipped)

    def _location(self, event: yaml.Event) -> Location:
        start = self._offset(event.start_mark)
        return self.source.location(start, start)
