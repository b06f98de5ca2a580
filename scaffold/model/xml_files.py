"""The XML files of a package, and whether they can be read."""

from __future__ import annotations

from xml.parsers import expat

from scaffold.errors import ParseError
from scaffold.model.ament_files import broken_links, lintable
from scaffold.model.package import Package
from scaffold.model.source import Location, Source

MAX_DEPTH = 256
"""Elements inside of each other that libxml2, and with it xmllint, goes along with."""
MAX_TEXT = 10_000_000
"""Bytes in one piece that it takes."""


def of_package(package: Package) -> list[str]:
    """Return the paths that ament_xmllint looks at, links that lead nowhere among them."""
    return [path for path in (*lintable(package), *broken_links(package)) if _is_xml(path)]


def mistake(package: Package, path: str) -> tuple[Location, str] | None:
    """Return the first place where an XML file is not well-formed, and what is wrong there."""
    try:
        data = package.tree.read(path)
    except OSError as error:
        return Location.start_of(path), f"cannot be read: {error.strerror or error}"
    return check(path, data)


def check(path: str, data: bytes) -> tuple[Location, str] | None:
    """Return the first mistake in an XML file.

    Prefixes of namespaces may be undeclared, as xmllint has it; nothing outside of the file is
    read, so references to entities of another file are let pass.
    """
    reader = _Reader()
    try:
        reader.parser.Parse(data, True)  # noqa: FBT003  the C function takes no keyword
    except expat.ExpatError as error:
        return _explain(path, data, error)
    except (_Limit, ValueError, LookupError) as error:
        at = Location.start_of(path, max(reader.parser.CurrentLineNumber, 1))
        return at, str(error)
    return None


class _Limit(Exception):  # noqa: N818  ends the reading; no one else sees it
    """The file is beyond what xmllint reads."""


class _Reader:
    """Reads a file for its mistakes only."""

    def __init__(self) -> None:
        self.parser = parser = expat.ParserCreate()
        self.depth = 0
        self.length = 0
        parser.StartElementHandler = self._start
        parser.EndElementHandler = self._end
        parser.CharacterDataHandler = self._text
        parser.XmlDeclHandler = self._declare

    def _start(self, _tag: str, _attributes: dict[str, str]) -> None:
        self.length = 0
        self.depth += 1
        if self.depth > MAX_DEPTH:
            raise _Limit(f"more than {MAX_DEPTH} elements inside of each other: no reader goes on")

    def _end(self, _tag: str) -> None:
        self.length = 0
        self.depth -= 1

    def _text(self, text: str) -> None:
        self.length += len(text)
        if self.length > MAX_TEXT:
            raise _Limit(f"more than {MAX_TEXT} characters in one piece: no reader goes on")

    def _declare(self, version: str, _encoding: str | None, _standalone: int) -> None:
        major, _, minor = version.partition(".")
        if major != "1" or not (minor.isascii() and minor.isdigit()):
            raise _Limit(f"XML has no version {version}: write 1.0")


def _explain(path: str, data: bytes, error: expat.ExpatError) -> tuple[Location, str]:
    """Put the mistake in our own words where the text can be decoded, else in expat's."""
    from scaffold.model import xml_tree

    try:
        text = data.decode("utf-8")
        xml_tree.parse(Source(path, text))
    except ParseError as found:
        if "DOCTYPE" not in found.message:
            said = found.message.replace("package.xml", path).replace(" such as <package>", "")
            return found.location, said
    except UnicodeDecodeError:
        pass
    at = Location(path, error.lineno, error.offset + 1, error.lineno, error.offset + 2)
    return at, expat.errors.messages[error.code]


def _is_xml(path: str) -> bool:
    name = path.rpartition("/")[2]
    return name.endswith(".xml") and name != ".xml"
