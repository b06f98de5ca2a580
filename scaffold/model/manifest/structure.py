"""The allowed elements of package.xml, their order and number: formats 1 to 3.

The findings are those of the schemas that ament_xmllint uses, with two deliberate exceptions: in a
version, only a dot separates numbers (the pattern of the schemas accepts any character), and
document type declarations are rejected.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator
from functools import cached_property
from itertools import groupby

from scaffold.formats.xml import BLANK, Attribute, Element, Text
from scaffold.model.manifest.manifest import Manifest
from scaffold.record import NamedTuple
from scaffold.source import Location

_MAX_UNKNOWN = 1000  # reported elements; each is compared with all known ones
FORMATS = (1, 2, 3)
PLAIN = ("name", "version", "description", "maintainer", "license", "url", "author")
REQUIRED = PLAIN[:5]
ONCE = frozenset({"name", "version", "description", "export"})
GROUPS = ("group_depend", "member_of_group")
_EVER = ("build_depend", "buildtool_depend", "test_depend", "conflict", "replace")
_SINCE_2 = ("build_export_depend", "buildtool_export_depend", "exec_depend", "depend", "doc_depend")
_DEPENDENCIES = {1: (*_EVER, "run_depend"), 2: (*_EVER, *_SINCE_2), 3: (*_EVER, *_SINCE_2)}
_LIMITS = ("version_lt", "version_lte", "version_eq", "version_gte", "version_gt")
LIMITS = frozenset(_LIMITS)
_SCHEMA_INSTANCE = "http://www.w3.org/2001/XMLSchema-instance"
_SCHEMA_ATTRIBUTES = frozenset({"noNamespaceSchemaLocation", "schemaLocation"})


class Unknown(NamedTuple):
    """An element that the format does not allow at this place."""

    element: Element
    since: int | None
    """The later format that has it, if any."""


class Misplaced(NamedTuple):
    """Adjacent elements of one kind at the wrong place."""

    elements: list[Element]
    after: Element | None
    """The element that they belong after."""
    before: Element | None
    """And before this one."""


class Structure:
    """The structure of a manifest; every property is a list of errors of one kind."""

    def __init__(self, manifest: Manifest) -> None:
        self.manifest = manifest
        self.root = manifest.root
        self.format = manifest.format if manifest.format in FORMATS else FORMATS[-1]
        self.dependency_tags = _DEPENDENCIES[self.format]
        self.sections = _sections(self.format)
        """The indices of the sections of tags."""
        self.is_manifest = self.root.tag == "package"

    @cached_property
    def children(self) -> list[Element]:
        """The elements below the root; none if the root is another element."""
        return self.root.children if self.is_manifest else []

    @cached_property
    def known(self) -> list[Element]:
        """The elements below the root that the format has."""
        return [child for child in self.children if child.tag in self.sections]

    # -- elements

    @cached_property
    def unknown(self) -> list[Unknown]:
        """The elements that the format does not have."""
        elements = [] if self.is_manifest else [self.root]
        elements += [child for child in self.children if child.tag not in self.sections]
        return [
            Unknown(element, self._first_format(element.tag)) for element in elements[:_MAX_UNKNOWN]
        ]

    def _first_format(self, tag: str) -> int | None:
        return next((n for n in FORMATS if n > self.format and tag in _sections(n)), None)

    @cached_property
    def missing(self) -> list[str]:
        """The tags of elements that every manifest has."""
        present = {child.tag for child in self.known}
        return [tag for tag in REQUIRED if tag not in present] if self.is_manifest else []

    @cached_property
    def repeated(self) -> list[tuple[Element, Element]]:
        """The elements that may occur once, with the first of their kind."""
        first: dict[str, Element] = {}
        for child in self.known:
            first.setdefault(child.tag, child)
        return [
            (child, first[child.tag])
            for child in self.known
            if child.tag in ONCE and first[child.tag] is not child
        ]

    @cached_property
    def misplaced(self) -> list[Misplaced]:
        """The smallest set of elements to move for the right order."""
        again = {id(element) for element, _ in self.repeated}
        row = [child for child in self.known if id(child) not in again]
        numbers = [self.sections[child.tag] for child in row]
        kept = _longest_run(numbers)
        if len(kept) == len(row):
            return []
        staying = [row[index] for index in kept]
        order = [numbers[index] for index in kept]
        misplaceds: list[Misplaced] = []
        stays = frozenset(kept)
        # Adjacent and of one section: one error.
        keyed = groupby(range(len(row)), lambda i: (i in stays, numbers[i]))
        for (stay, number), indices in keyed:
            if not stay:
                at = bisect_right(order, number)
                after = staying[at - 1] if at else None
                before = staying[at] if at < len(staying) else None
                misplaceds.append(Misplaced([row[index] for index in indices], after, before))
        return misplaceds

    @cached_property
    def nested(self) -> list[tuple[Element, Element]]:
        """Elements inside of text-only elements, with their parents."""
        return [
            (child.children[0], child)
            for child in self.known
            if child.tag not in {"description", "export"} and child.children
        ]

    @cached_property
    def stray_texts(self) -> list[Location]:
        """Text between elements, in the root and in ``export``."""
        parents = [self.root] if self.is_manifest else []
        parents += [child for child in self.known if child.tag == "export"]
        return sorted(at for parent in parents for at in self._stray_text(parent))

    def _stray_text(self, parent: Element) -> Iterator[Location]:
        for is_text, items in groupby(parent.content, lambda item: isinstance(item, Text)):
            runs = [i for i in items if isinstance(i, Text) and i.text.strip(BLANK)]
            if is_text and runs:
                start = runs[0].start + len(runs[0].text) - len(runs[0].text.lstrip(BLANK))
                end = max(runs[-1].start + len(runs[-1].text.rstrip(BLANK)), start + 1)
                yield self.manifest.source.location(start, end)

    # -- attributes

    @cached_property
    def unknown_attributes(self) -> list[tuple[Element, Attribute]]:
        """The attributes that the format does not have there."""
        elements = [self.root, *self.known] if self.is_manifest else []
        return [
            (element, attribute)
            for element in elements
            for attribute in element.attributes.values()
            if not self._is_allowed(element, attribute)
        ]

    def _is_allowed(self, element: Element, attribute: Attribute) -> bool:
        name = attribute.name
        if name in self.attributes(element):
            return True
        prefix, colon, local = name.partition(":")
        if not colon:
            return name == "xmlns" and not attribute.value
        bound = element.get(f"xmlns:{prefix}") or self.root.get(f"xmlns:{prefix}")
        is_schema = bound == _SCHEMA_INSTANCE and local in _SCHEMA_ATTRIBUTES
        return prefix == "xmlns" or is_schema

    def attributes(self, element: Element) -> tuple[str, ...]:
        """Return the names of the attributes that an element may have in this format."""
        return ("format",) if element is self.root else self._attributes.get(element.tag, ())

    @cached_property
    def _attributes(self) -> dict[str, tuple[str, ...]]:
        newest = self.format == FORMATS[-1]
        limits = (*_LIMITS, "condition") if newest else _LIMITS
        result: dict[str, tuple[str, ...]] = dict.fromkeys(self.dependency_tags, limits)
        result |= {"maintainer": ("email",), "author": ("email",), "url": ("type",)}
        if newest:
            result |= {"license": ("file",), **dict.fromkeys(GROUPS, ("condition",))}
        return result

    # -- values

    def values(self, tag: str) -> Iterator[tuple[Element, str]]:
        """Yield the text-only elements with a tag, and their normalized text."""
        for child in self.known:
            if child.tag == tag and not child.children:
                text = "".join(item.text for item in child.content if isinstance(item, Text))
                yield child, collapse(text)


def collapse(text: str) -> str:
    """Normalize XML whitespace, not that of Unicode, as schemas do for every value."""
    for character in "\t\r\n":
        text = text.replace(character, " ")
    return " ".join(word for word in text.split(" ") if word)


def _sections(number: int) -> dict[str, int]:
    rows: list[tuple[str, ...]] = [(tag,) for tag in PLAIN]
    rows.append(_DEPENDENCIES[number])
    if number == FORMATS[-1]:
        rows += [(tag,) for tag in GROUPS]
    rows.append(("export",))
    return {tag: place for place, tags in enumerate(rows) for tag in tags}


def _longest_run(numbers: list[int]) -> list[int]:
    """Return the indices of a longest non-decreasing subsequence."""
    tails: list[int] = []
    ends: list[int] = []
    before: list[int] = []
    for index, number in enumerate(numbers):
        at = bisect_right(tails, number)
        before.append(ends[at - 1] if at else -1)
        tails[at : at + 1] = [number]
        ends[at : at + 1] = [index]
    result: list[int] = []
    at = ends[-1] if ends else -1
    while at >= 0:
        result.append(at)
        at = before[at]
    return result[::-1]
