"""Parameter files: their nodes and values.

Values are parsed as rcl_yaml_param_parser does, not as PyYAML does: the two differ in which words
are booleans, numbers or strings.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

from scaffold.formats import yaml as yaml_tree
from scaffold.formats.yaml import Alias, Mapping, Scalar, Sequence, YamlNode
from scaffold.model.remembered import remembered
from scaffold.record import NamedTuple
from scaffold.source import ParseError, TooLargeError, ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package
    from scaffold.source import Location

KEY = "ros__parameters"
ENDINGS = (".yaml", ".yml")
_NEAR = r"(?i)(?:ros[_\- .]*)?param(?:eter)?s?"
_MENTION = r"(?im)^[ \t]*[\"']?ros[_\- .]*param(?:eter)?s?[\"']?[ \t]*:"
_WORDS = ("y", "yes", "true", "on", "n", "no", "false", "off")
BOOLEANS = frozenset({form for word in _WORDS for form in (word, word.capitalize(), word.upper())})
"""The words that rcl reads as booleans."""
_LONGEST_NUMBER = 100
_INTEGER = r"[+-]?(?:0[xX][0-9a-fA-F]+|0[0-7]*|[1-9][0-9]*)"
_DOUBLE = (
    r"[+-]?(?:(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][+-]?\d+)?|(?i:inf|infinity|nan)|\.(?:inf|Inf|INF))"
    r"|\.(?:nan|NaN|NAN)|[+-]?0[xX](?:[0-9a-fA-F]+(?:\.[0-9a-fA-F]*)?|\.[0-9a-fA-F]+)[pP][+-]?\d{1,4}"
)


class Entry(NamedTuple):
    """One parameter."""

    name: str
    """The name, with those of the mappings around it: ``limits.speed``."""
    key: Scalar
    value: YamlNode

    @property
    def location(self) -> Location:
        """The place of the key."""
        return self.key.location


class Section(NamedTuple):
    """The parameters under one ``ros__parameters``."""

    node: str
    """The keys above, joined: ``/robot1/talker``, ``/**``."""
    key: Scalar
    """The key above ``ros__parameters``."""
    entries: list[Entry]

    @property
    def is_pattern(self) -> bool:
        """Whether it matches nodes of any name."""
        return self.name in {"*", "**"}

    @property
    def name(self) -> str:
        """The name of the node without its namespace."""
        return self.node.rpartition("/")[2]

    def fits(self, full_name: str) -> bool:
        """Return whether it matches a node, ``/robot1/talker``."""
        expression = ""
        for part in self.node.strip("/").split("/"):
            expression += {"**": r"(?:/\w+)*", "*": r"/\w+"}.get(part, f"/{re.escape(part)}")
        return re.fullmatch(expression, full_name) is not None


class Misplaced(NamedTuple):
    """A value that is not under ``ros__parameters``."""

    key: Scalar
    node_key: Scalar | None
    """The key above it that is a misspelled ``ros__parameters``."""
    depth: int
    """The number of keys above that one."""
    above: tuple[str, ...]
    """The keys above it."""


class Refused(NamedTuple):
    """Valid YAML that rcl rejects."""

    location: Location
    message: str


class ParameterFile:
    """A parameter file that could be read."""

    def __init__(self, path: str, roots: list[YamlNode]) -> None:
        self.path = path
        self.sections: list[Section] = []
        self.misplaced: list[Misplaced] = []
        self.refused: list[Refused] = []
        for root in roots:
            if isinstance(root, Mapping):
                self._read(root, (), None)

    def _read(self, mapping: Mapping, above: tuple[Scalar, ...], node_key: Scalar | None) -> None:
        for key, value in mapping.pairs:
            if key.text == KEY and node_key is None:
                self._read_section(key, value, above)
            elif isinstance(value, Mapping):
                is_near = node_key is None and re.fullmatch(_NEAR, key.text) and not _has_key(value)
                self._read(value, (*above, key), key if is_near else node_key)
            else:
                depth = above.index(node_key) if node_key is not None else len(above)
                names = tuple(item.text for item in above)
                self.misplaced.append(Misplaced(key, node_key, depth, names))

    def _read_section(self, key: Scalar, value: YamlNode, above: tuple[Scalar, ...]) -> None:
        if not above:
            self.refused.append(
                Refused(key.location, f"no node name above {KEY!r}: rcl rejects the file")
            )
        elif isinstance(value, Mapping):
            node = "/" + "/".join(item.text.strip("/") for item in above).strip("/")
            section = Section(node, above[-1], list(_entries(value, "")))
            self.sections.append(section)
            for entry in section.entries:
                self.refused.extend(_refused(entry.name, entry.key, entry.value))
        elif isinstance(value, Scalar):
            self.refused.append(
                Refused(key.location, f"no parameters under {KEY!r}: rcl rejects the file")
            )


def _has_key(mapping: Mapping) -> bool:
    """Return whether a mapping is that of a node, even if its key is ``parameters``."""
    return any(key.text == KEY for key, _ in mapping.pairs)


def parameter_file(package: Package, path: str) -> ParameterFile | None:
    """Return a parameter file; ``None`` if it cannot be read as YAML."""
    return _read(package, path)[0]


def parameter_files(package: Package) -> Iterator[ParameterFile]:
    """Yield the parameter files of a package that can be read as YAML."""
    for path in parameter_paths(package):
        file = parameter_file(package, path)
        if file is not None:
            yield file


def mistake(package: Package, path: str) -> ParseError | None:
    """Return why a file cannot be read as YAML."""
    return _read(package, path)[1]


@remembered
def _read(package: Package, path: str) -> tuple[ParameterFile | None, ParseError | None]:
    try:
        return ParameterFile(path, yaml_tree.parse(package.source(path))), None
    except TooLargeError:
        return None, None
    except ParseError as error:
        return None, error
    except ViewError:
        return None, None


@remembered
def parameter_paths(package: Package) -> list[str]:
    """Return the files that are parameter files, or look like misspelled ones."""
    return [
        path for path in package.files if path.endswith(ENDINGS) and _is_candidate(package, path)
    ]


def _is_candidate(package: Package, path: str) -> bool:
    if not {"test", "tests"}.isdisjoint(path.split("/")) or path.startswith("."):
        return False
    try:
        data = package.bytes_of(path, yaml_tree.MAX_LENGTH)
    except OSError:
        return False
    if b"aram" not in data.lower():
        return False
    try:
        text = data.decode()
    except UnicodeDecodeError:
        return False
    return KEY in text or re.search(_MENTION, text) is not None


def _entries(mapping: Mapping, prefix: str) -> Iterator[Entry]:
    pending = [(prefix, mapping.pairs)]
    for start, pairs in pending:  # grows on the way
        for key, value in pairs:
            name = f"{start}.{key.text}" if start else key.text
            if isinstance(value, Mapping):
                pending.append((name, value.pairs))
            else:
                yield Entry(name, key, value)


def _refused(name: str, key: Scalar, value: YamlNode) -> Iterator[Refused]:
    """Yield values that rcl rejects: null, aliases, several nested lists."""
    for item in value.items if isinstance(value, Sequence) else (value,):
        if is_empty(item):
            at = key.location if item is value else item.location
            yield Refused(
                at, f"{name!r} has no value: rcl rejects the file; write '' for an empty string"
            )
        elif isinstance(item, Alias):
            yield Refused(
                item.location,
                f"{name!r} is the alias *{item.name}: rcl rejects the file; write the value",
            )
    inner = value.items if isinstance(value, Sequence) else ()
    lists = [item for item in inner if isinstance(item, Sequence)]
    if len(lists) > 1:
        message = f"{name!r} is a list of lists: rcl rejects the file; flatten it"
        yield Refused(lists[0].location, message)
    elif lists and len(inner) > 1:  # a single list in a list is read as that list
        message = f"{name!r} mixes values and a list: rcl reads only some of them; flatten it"
        yield Refused(lists[0].location, message)


# -- types


def scalar_type(node: Scalar) -> str | None:
    """Return the type of a value for rcl; ``None`` if launch substitutes it first."""
    if "$(" in node.text or is_empty(node):
        return None
    if not node.is_plain or node.tag == "tag:yaml.org,2002:str":
        return "string"
    return text_type(node.text)


def is_empty(node: YamlNode) -> bool:
    """Return whether the value is missing."""
    return isinstance(node, Scalar) and node.is_plain and node.start == node.end


def text_type(text: str) -> str:
    """Return the type of an unquoted word."""
    if text in BOOLEANS:
        return "bool"
    if len(text) > _LONGEST_NUMBER:
        return "string"
    if re.fullmatch(_INTEGER, text) and abs(_integer(text)) < 2**63:
        return "integer"
    is_double = re.fullmatch(_DOUBLE, text) is not None and not _overflows(text)
    return "double" if is_double else "string"


def number_of(node: YamlNode) -> float | None:
    """Return the number that rcl reads from a value."""
    kind = scalar_type(node) if isinstance(node, Scalar) else None
    return number_in(node.text, kind) if kind and isinstance(node, Scalar) else None


def number_in(text: str, kind: str) -> float | None:
    """Return the number of a word with a type; ``None`` for other types and unusual notations."""
    if kind == "integer":
        return _integer(text)
    try:
        return float(text) if kind == "double" else None
    except ValueError:
        return None


def value_type(node: YamlNode) -> str | None:
    """Return the type of a value for rcl: ``double``, ``string_array`` ..."""
    if isinstance(node, Scalar):
        return scalar_type(node)
    if isinstance(node, Sequence):
        kinds = {scalar_type(item) if isinstance(item, Scalar) else None for item in node.items}
        kind = kinds.pop() if len(kinds) == 1 else None
        return f"{kind}_array" if kind else None
    return None


def mixed(node: YamlNode) -> tuple[Scalar, str, Scalar, str] | None:
    """Return the first two items of a list that are of different types, with their types."""
    if not isinstance(node, Sequence):
        return None
    first: tuple[Scalar, str] | None = None
    for item in node.items:
        kind = scalar_type(item) if isinstance(item, Scalar) else None
        if kind is None or not isinstance(item, Scalar):
            return None
        if first is None:
            first = item, kind
        elif first[1] != kind:
            return (*first, item, kind)
    return None


def _overflows(text: str) -> bool:
    is_decimal = text[-1].isdigit() and "x" not in text.lower()
    return is_decimal and abs(float(text)) == float("inf")


def _integer(text: str) -> int:
    sign = -1 if text.startswith("-") else 1
    digits = text.lstrip("+-")
    base = 16 if digits[:2].lower() == "0x" else 8 if digits.startswith("0") else 10
    return sign * int(digits, base)
