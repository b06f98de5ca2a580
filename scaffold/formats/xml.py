"""An XML file as elements that know the exact place of every part of them."""

from __future__ import annotations

import codecs
import re
from collections.abc import Callable, Iterator
from xml.parsers import expat

from scaffold.record import NamedTuple
from scaffold.source import Location, ParseError, Source

BLANK = " \t\r\n"
BOM = "\ufeff"
_ATTRIBUTE = re.compile(
    r"""(?<![^ \t\r\n])([^ \t\r\n=]+)[ \t\r\n]*=[ \t\r\n]*(?:"([^"]*)"|'([^']*)')"""
)
_DECLARED_ENCODING = (
    rb"""(?:\xef\xbb\xbf)?<\?xml[^>]*?[ \t\r\n]encoding[ \t\r\n]*=[ \t\r\n]*["']([\w.-]+)"""
)
_ONE_BYTE_CODECS = ("ascii", "cp125", "iso8859-", "koi8-")
_CONTINUATION = bytes(range(0x80, 0xC0))


class Attribute(NamedTuple):
    """An attribute of a start tag."""

    name: str
    value: str
    """With references such as ``&amp;`` replaced."""
    location: Location
    """The place of the value, without its quotes."""
    name_location: Location


class Text(NamedTuple):
    """A stretch of character data, at an offset of the file."""

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
        """What is written like attributes: ``href``, ``schematypens``."""
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

    # -- what it holds

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
        found: dict[str, Attribute] = {}
        locate = self._source.location
        first = self.start + 1 + len(self.tag)
        for match in _ATTRIBUTE.finditer(self._source.text, first, self.open_end):
            name = match[1]
            quoted = 2 if match[2] is not None else 3
            found[name] = Attribute(
                name,
                self._raw.get(name, match[quoted]),
                locate(match.start(quoted), match.end(quoted)),
                locate(match.start(1), match.end(1)),
            )
        return found

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

    # -- where it is

    @property
    def open_end(self) -> int:
        """The offset behind the start tag."""
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
        """The offset behind the element."""
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
        """The place of the text, without blanks around it; of the element for ``<tag/>``."""
        if self.is_empty_tag:
            return self.location
        return self._source.location(*self.text_span)

    @property
    def text_span(self) -> tuple[int, int]:
        """The offsets of the text, without blanks around it."""
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
        """The element as it stands in the file."""
        return self._source.text[self.start : self.end]

    def close_at(self, offset: int) -> None:
        """Note where the end tag is; for the reader."""
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
    """What stands in an XML file."""

    source: Source
    root: Element
    comments: list[Comment]
    instructions: list[Instruction]
    declared_encoding: str | None


def parse(source: Source) -> Document:
    """Read an XML file; nothing outside of it is ever read.

    Raises:
        ParseError: the file is not well-formed, or has a document type declaration.
    """
    return _Reader(source).read()


def decode(path: str, data: bytes) -> Source:
    """Decode an XML file in the encoding that it declares.

    Raises:
        ParseError: the encoding is none for a manifest, or the bytes are not text of it.
    """
    if data.startswith((b"\xff\xfe", b"\xfe\xff")) or b"\0" in data[:4]:
        raise ParseError(Location.start_of(path), "the file is UTF-16 or UTF-32: save it as UTF-8")
    declared = re.match(_DECLARED_ENCODING, data[:1000])
    if declared is None:
        return Source.decode(path, data)
    name = declared[1].decode("ascii")
    if name.lower() in {"utf-8", "utf8"}:
        return Source.decode(path, data)
    line = data.count(b"\n", 0, declared.start(1)) + 1
    column = declared.start(1) - (data.rfind(b"\n", 0, declared.start(1)) + 1) + 1
    at = Location(path, line, column, line, column + len(name))
    try:
        codec = codecs.lookup(name).name
    except LookupError:
        raise ParseError(at, f"the declared encoding {name!r} is not known") from None
    if not codec.startswith(_ONE_BYTE_CODECS):
        raise ParseError(at, f"the declared encoding {name!r} is not supported: save it as UTF-8")
    return Source.decode(path, data, codec)


def _same(offset: int) -> int:
    return offset


class _Offsets:
    """Tells which character a byte of UTF-8 belongs to."""

    STEP = 128

    def __init__(self, data: bytes) -> None:
        self.data = data
        self.counts = [0]
        total = 0
        for first in range(0, len(data), self.STEP):
            total += self._count(first, first + self.STEP)
            self.counts.append(total)

    def __call__(self, offset: int) -> int:
        step, _ = divmod(offset, self.STEP)
        return self.counts[step] + self._count(step * self.STEP, offset)

    def _count(self, start: int, end: int) -> int:
        return len(self.data[start:end].translate(None, _CONTINUATION))


class _Reader:
    """Builds the elements from what expat tells."""

    def __init__(self, source: Source) -> None:
        self.source = source
        self.data = source.text.encode("utf-8", "surrogatepass")
        self.offset = _same if source.text.isascii() else _Offsets(self.data)
        # The text is decoded already: what the declaration says does not matter to expat.
        self.parser = expat.ParserCreate("utf-8")
        self.root: Element | None = None
        self.current: Element | None = None
        self.comments: list[Comment] = []
        self.instructions: list[Instruction] = []
        self.declared_encoding: str | None = None
        self.prefixed = False

    def read(self) -> Document:
        parser = self.parser
        parser.StartElementHandler = self._start_handler()
        parser.EndElementHandler = self._end_handler()
        parser.CharacterDataHandler = self._text_handler()
        parser.CommentHandler = self._comment
        parser.ProcessingInstructionHandler = self._instruction
        parser.XmlDeclHandler = self._declare
        parser.StartDoctypeDeclHandler = self._doctype
        self._run(parser)
        if self.prefixed:
            self._run(expat.ParserCreate("utf-8", " "))
        assert self.root is not None, "expat demands a root element"  # noqa: S101  for mypy
        return Document(
            self.source,
            self.root,
            self.comments,
            self.instructions,
            self.declared_encoding,
        )

    def _run(self, parser: expat.XMLParserType) -> None:
        try:
            parser.Parse(self.data, True)  # noqa: FBT003  the C function takes no keyword
        except expat.ExpatError as error:
            from scaffold.formats.xml_errors import explain

            at = self.offset(parser.ErrorByteIndex)
            raise explain(self.source, error.code, at, self.current) from None
        finally:
            # The handlers hold the reader, which holds the parser.
            parser.StartElementHandler = None
            parser.EndElementHandler = None
            parser.CharacterDataHandler = None

    def _start_handler(self) -> Callable[[str, dict[str, str]], None]:
        parser, offset, source = self.parser, self.offset, self.source

        def start(tag: str, attributes: dict[str, str]) -> None:
            parent = self.current
            at = offset(parser.CurrentByteIndex)
            self.current = element = Element(source, tag, attributes, parent, at)
            if parent is None:
                self.root = element
            else:
                parent.content.append(element)
            if ":" in tag or (attributes and ":" in "".join(attributes)):
                self.prefixed = True

        return start

    def _end_handler(self) -> Callable[[str], None]:
        parser, offset = self.parser, self.offset

        def end(_tag: str) -> None:
            element = self.current
            if element is not None:
                element.close_at(offset(parser.CurrentByteIndex))
                self.current = element.parent

        return end

    def _text_handler(self) -> Callable[[str], None]:
        parser, offset = self.parser, self.offset

        def text(data: str) -> None:
            if self.current is not None:
                self.current.content.append(Text(offset(parser.CurrentByteIndex), data))

        return text

    def _span(self, ending: str) -> tuple[int, int]:
        start = self.offset(self.parser.CurrentByteIndex)
        return start, self.source.text.index(ending, start) + len(ending)

    def _comment(self, text: str) -> None:
        start, end = self._span("-->")
        self.comments.append(Comment(text, self.source.location(start, end), start, end))

    def _instruction(self, target: str, text: str) -> None:
        start, end = self._span("?>")
        at = self.source.location(start, end)
        self.instructions.append(Instruction(target, text, at, start, end))

    def _declare(self, _version: str, encoding: str | None, _standalone: int) -> None:
        self.declared_encoding = encoding

    def _doctype(self, *_: object) -> None:
        at = self.offset(self.parser.CurrentByteIndex)
        start = self.source.text.rindex("<!DOCTYPE", 0, at + len("<!DOCTYPE"))
        raise ParseError(
            self.source.location(start, start + len("<!DOCTYPE")),
            "a document type declaration (<!DOCTYPE) is not allowed: "
            "package.xml has none, and it could make a reader fetch other files",
        )


def _tag_end(text: str, start: int) -> int:
    """Return the offset behind a start tag."""
    at = start
    while True:
        end = text.index(">", at)
        double, single = text.find('"', at, end), text.find("'", at, end)
        if double < 0 and single < 0:
            return end + 1
        opening = min(double, single) if min(double, single) >= 0 else max(double, single)
        at = text.index(text[opening], opening + 1) + 1
