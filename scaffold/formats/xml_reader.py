"""Parses XML with expat; positions are character offsets."""

from __future__ import annotations

import codecs
import re
from collections.abc import Callable
from xml.parsers import expat

from scaffold.formats.xml import Comment, Document, Element, Instruction, Text
from scaffold.formats.xml_errors import explain
from scaffold.source import Location, ParseError, Source

_DECLARED_ENCODING = (
    rb"""(?:\xef\xbb\xbf)?<\?xml[^>]*?[ \t\r\n]encoding[ \t\r\n]*=[ \t\r\n]*["']([\w.-]+)"""
)
_ONE_BYTE_CODECS = ("ascii", "cp125", "iso8859-", "koi8-")
_CONTINUATION = bytes(range(0x80, 0xC0))


def parse(source: Source, *, has_namespaces: bool = True) -> Document:
    """Parse an XML file, without reading anything outside of it.

    Args:
        source: The file.
        has_namespaces: Whether its readers support namespaces, and reject undeclared prefixes.

    Raises:
        ParseError: the file is not well-formed, or has a document type declaration.
    """
    return _Reader(source, has_namespaces=has_namespaces).read()


def decode(path: str, data: bytes) -> Source:
    """Decode an XML file in the encoding that it declares.

    Raises:
        ParseError: the encoding is not allowed in a manifest, or the bytes are invalid in it.
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


def _identity(offset: int) -> int:
    return offset


class _Offsets:
    """Converts byte offsets in UTF-8 to character offsets."""

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
    """Builds the elements from the events of expat."""

    def __init__(self, source: Source, *, has_namespaces: bool) -> None:
        self.has_namespaces = has_namespaces
        self.source = source
        self.data = source.text.encode("utf-8", "surrogatepass")
        self.offset = _identity if source.text.isascii() else _Offsets(self.data)
        # The text is decoded already, so expat ignores the declared encoding.
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
        if self.prefixed and self.has_namespaces:
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
            at = self.offset(parser.ErrorByteIndex)
            raise explain(self.source, error.code, at, self.current) from None
        finally:
            # Breaks the reference cycle of handlers, reader and parser.
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
