"""XML elements with the exact location of each part."""

from __future__ import annotations

import re
from collections.abc import Iterator

from scaffold import lazy_re
from scaffold.record import NamedTuple
from scaffold.source import Location, Source

BLANK = " \t\r\n"
BOM = "\ufeff"
_ATTRIBUTE = lazy_re.compile(
    r"""(?<![^ \t\r\n])([^ \t\r\n=]+)[ \t\r\n]*=[ \t\r\n]*(?:"([^"]*)"|'([^']*)')"""
)


class Attribute(NamedTuple):
    """An attribute of a start tag."""

    name: str
    value: str
    """The value with references such as ``&amp;`` replaced."""
    location: Location
    """The location of the value, without quotes."""
    name_location: Location


class Text(NamedTuple):
    """Character data at an offset of the file."""

    start: int
    text: str


class Comment(NamedTuple):
    """A comment."""

    text: str
    location: Location
    start: int
    end: int


class Instruction(NamedTuple):
    """A processing instruction such as ``<?xml-model …?>``."""

    target: str
    text: str
    location: Location
    start: int
    end: int

    @property
    def pseudo_attributes(self) -> dict[str, str]:
        """The pseudo-attributes: ``href``, ``schematypens``."""
        return {
            match[1]: match[2] if match[2] is not None else match[3]
            for match in _ATTRIBUTE.finditer(self.text)
        }


class Element:
    """An element; offsets are characters of the source's text."""

    __slots__ = ("_close", "_open_end", "_raw", "_source", "content", "parent", "start", "tag")

    def __init__(
        self,
        source: Source,
        tag: str,
        raw_attributes: dict[str, str],
        parent: Element | None,
        start: int,
    ) -> None:
        self.tag = tag
        self.parent = parent
        self.content: list[Element | Text] = []
        """Children and character data in the order of the file."""
        self.start = start
        self._source = source
        self._raw = raw_attributes
        self._close = start
        self._open_end = -1

    def __repr__(self) -> str:
        return f"<{self.tag}> at {self.location}"

    # -- content

    @property
    def children(self) -> list[Element]:
        """The child elements."""
        return [item for item in self.content if isinstance(item, Element)]

    @property
    def text(self) -> str:
        """All character data inside, joined and stripped."""
        return "".join(run.text for run in self._runs()).strip()

    @property
    def own_text(self) -> str:
        """The character data directly inside, not inside a child, joined and stripped."""
        return "".join(item.text for item in self.content if isinstance(item, Text)).strip()

    def get(self, attribute: str) -> str | None:
        """Return the value of an attribute."""
        return self._raw.get(attribute)

    @property
    def attributes(self) -> dict[str, Attribute]:
        """The attributes by name, in the order of the file."""
        result: dict[str, Attribute] = {}
        locate = self._source.location
        first = self.start + 1 + len(self.tag)
        for match in _ATTRIBUTE.finditer(self._source.text, first, self.open_end):
            name = match[1]
            quoted = 2 if match[2] is not None else 3
            result[name] = Attribute(
                name,
                self._raw.get(name, match[quoted]),
                locate(match.start(quoted), match.end(quoted)),
                locate(match.start(1), match.end(1)),
            )
        return result

    def all(self, tag: str) -> list[Element]:
        """Return the children with a tag."""
        return [item for item in self.content if isinstance(item, Element) and item.tag == tag]

    def one(self, tag: str) -> Element | None:
        """Return the first child with a tag."""
        for item in self.content:
            if isinstance(item, Element) and item.tag == tag:
                return item
        return None

    def descendants(self) -> Iterator[Element]:
        """Yield all elements inside, in the order of the file."""
        pending = [iter(self.content)]
        while pending:
            for item in pending[-1]:
                if isinstance(item, Element):
                    yield item
                    pending.append(iter(item.content))
                    break
            else:
                pending.pop()

    # -- locations

    @property
    def open_end(self) -> int:
        """The offset after the start tag."""
        if self._open_end < 0:
            self._open_end = _tag_end(self._source.text, self.start)
        return self._open_end

    @property
    def is_empty_tag(self) -> bool:
        """Whether it is written ``<tag/>``."""
        return self._source.text[self.open_end - 2] == "/"

    @property
    def close_start(self) -> int:
        """The offset of the end tag; of the end for ``<tag/>``."""
        return self._close

    @property
    def end(self) -> int:
        """The offset after the element."""
        if self.is_empty_tag:
            return self.open_end
        return self._source.text.index(">", self._close) + 1

    @property
    def location(self) -> Location:
        """The place of the whole element."""
        return self._source.location(self.start, self.end)

    @property
    def name_location(self) -> Location:
        """The place of the tag's name in the start tag."""
        return self._source.location(self.start + 1, self.start + 1 + len(self.tag))

    @property
    def text_location(self) -> Location:
        """The place of the text, without spaces around it; of the element for ``<tag/>``."""
        if self.is_empty_tag:
            return self.location
        return self._source.location(*self.text_span)

    @property
    def text_span(self) -> tuple[int, int]:
        """The offsets of the text, without spaces around it."""
        runs = [run for run in self._runs() if run.text.strip(BLANK)]
        if not runs:
            return self.open_end, self.open_end
        first, last = runs[0], runs[-1]
        lead = len(first.text) - len(first.text.lstrip(BLANK))
        reference = re.compile(r"&[^;<>&\s]+;").match(self._source.text, last.start)
        length = len(last.text.rstrip(BLANK))
        return first.start + lead, reference.end() if reference else last.start + length

    @property
    def raw(self) -> str:
        """The source text of the element."""
        return self._source.text[self.start : self.end]

    def close_at(self, offset: int) -> None:
        """Set the offset of the end tag; for the reader."""
        self._close = offset

    def _runs(self) -> Iterator[Text]:
        pending = [iter(self.content)]
        while pending:
            for item in pending[-1]:
                if isinstance(item, Text):
                    yield item
                else:
                    pending.append(iter(item.content))
                    break
            else:
                pending.pop()


class Document(NamedTuple):
    """The contents of an XML file."""

    source: Source
    root: Element
    comments: list[Comment]
    instructions: list[Instruction]
    declared_encoding: str | None


def _tag_end(text: str, start: int) -> int:
    """Return the offset after a start tag."""
    at = start
    while True:
        end = text.index(">", at)
        double, single = text.find('"', at, end), text.find("'", at, end)
        if double < 0 and single < 0:
            return end + 1
        opening = min(double, single) if min(double, single) >= 0 else max(double, single)
        at = text.index(text[opening], opening + 1) + 1
