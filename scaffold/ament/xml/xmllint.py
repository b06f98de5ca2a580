"""Reimplementation of ament_xmllint: XML files are well-formed and match their schemas."""

from __future__ import annotations

import json
import marshal
import os
import posixpath
import re
import sys
from collections.abc import Iterator, Mapping
from functools import lru_cache
from typing import TYPE_CHECKING
from xml.parsers import expat

from scaffold.ament.files import broken_links, lintable
from scaffold.ament.xml import validate
from scaffold.distributions import DATA
from scaffold.files.disk import LargeFileError
from scaffold.model.package import Package
from scaffold.model.remembered import remembered
from scaffold.record import NamedTuple
from scaffold.source import Location, ParseError, Source

if TYPE_CHECKING:
    from lxml import etree


MAX_DEPTH = 256
"""The nesting depth at which libxml2, and so xmllint, stops."""
MAX_TEXT = 10_000_000
"""The length of one text at which it stops, in bytes."""


def of_package(package: Package) -> list[str]:
    """Return the paths that ament_xmllint checks, including dangling symlinks."""
    return [path for path in (*lintable(package), *broken_links(package)) if _is_xml(path)]


def mistake(package: Package, path: str) -> tuple[Location, str] | None:
    """Return the first place where an XML file is not well-formed, and the error."""
    try:
        data = package.bytes_of(path)
    except OSError as error:
        return Location.start_of(path), f"cannot be read: {error.strerror or error}"
    return check(path, data)


def check(path: str, data: bytes) -> tuple[Location, str] | None:
    """Return the first error in an XML file.

    Prefixes of namespaces may be undeclared, as in xmllint; nothing outside of the file is
    read, so references to entities of another file are accepted.
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
    """The file exceeds a limit of xmllint."""


class _Reader:
    """Parses a file only to find errors."""

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
            raise _Limit(f"more than {MAX_DEPTH} elements inside of each other: xmllint stops here")

    def _end(self, _tag: str) -> None:
        self.length = 0
        self.depth -= 1

    def _text(self, text: str) -> None:
        self.length += len(text)
        if self.length > MAX_TEXT:
            raise _Limit(f"more than {MAX_TEXT} characters in one piece: xmllint stops here")

    def _declare(self, version: str, _encoding: str | None, _standalone: int) -> None:
        major, _, minor = version.partition(".")
        if major != "1" or not (minor.isascii() and minor.isdigit()):
            raise _Limit(f"XML has no version {version}: write 1.0")


def _explain(path: str, data: bytes, error: expat.ExpatError) -> tuple[Location, str]:
    """Return the error in our own words if the text can be decoded, else in those of expat."""
    from scaffold.formats import xml_reader

    try:
        text = data.decode("utf-8")
        xml_reader.parse(Source(path, text))
    except ParseError as parse_error:
        if "DOCTYPE" not in parse_error.message:
            message = parse_error.message.replace("package.xml", path).replace(
                " such as <package>", ""
            )
            return parse_error.location, message
    except UnicodeDecodeError:
        pass
    at = Location(path, error.lineno, error.offset + 1, error.lineno, error.offset + 2)
    return at, expat.errors.messages[error.code]


def _is_xml(path: str) -> bool:
    name = path.rpartition("/")[2]
    return name.endswith(".xml") and name != ".xml"


XML_SCHEMA = "http://www.w3.org/2001/XMLSchema"
RELAX_NG = validate.RELAX_NG
HINT = "{http://www.w3.org/2001/XMLSchema-instance}noNamespaceSchemaLocation"
MAX_BYTES = 200_000
"""The maximum size of a schema; that of package.xml has 30 kB."""
MOST_SECONDS = 4
"""The time limit for all schemas of a package."""
_READS_OTHERS = frozenset(
    {f"{{{XML_SCHEMA}}}{name}" for name in ("include", "import", "redefine", "override")}
    | {f"{{{RELAX_NG}}}{name}" for name in ("include", "externalRef")}
)


class Verdict(NamedTuple):
    """The result of validating an XML file with one of its schemas."""

    location: Location
    message: str
    is_checked: bool
    """Whether the schema was used; otherwise the message says why not."""


class _Use(NamedTuple):
    """An XML file and one of its schemas."""

    path: str
    data: bytes
    kind: str
    href: str


@remembered
def verdicts(package: Package) -> list[Verdict]:
    """Return the verdicts on XML files other than package.xml with their schemas.

    For an invalid file, the first error.
    """
    uses = [use for path in of_package(package) for use in _uses(package, path)]
    verdict_of: dict[_Use, Verdict | None] = {}
    jobs: dict[_Use, validate.Job] = {}
    for use in uses:
        verdict = _judge(package, use)
        if isinstance(verdict, bytes):
            jobs[use] = (use.kind, verdict, use.data)
        else:
            verdict_of[use] = verdict
    validated = dict(_validated(jobs))
    if any(verdict and not verdict.is_checked for verdict in validated.values()):
        package.is_repeatable = False  # the next run may have more time
    verdict_of.update(validated)
    result: list[Verdict] = []
    complained: set[str] = set()
    for use in uses:
        verdict = verdict_of[use]
        if verdict is None or (verdict.is_checked and use.path in complained):
            continue
        if verdict.is_checked:
            complained.add(use.path)
        result.append(verdict)
    return result


def _uses(package: Package, path: str) -> Iterator[_Use]:
    """Yield the schemas of a well-formed file."""
    try:
        data = package.bytes_of(path) if path != "package.xml" else b""
    except OSError:
        return
    if b"xml-model" not in data and b"noNamespaceSchemaLocation" not in data:
        return  # nearly all files: avoids imports
    root = _parse(data)
    for kind, href in _named(root) if root is not None else ():
        yield _Use(path, data, kind, href)


def _parse(data: bytes) -> etree._Element | None:
    from lxml import etree

    parser = etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False)
    try:
        return etree.fromstring(data, parser)
    except (etree.XMLSyntaxError, ValueError):
        return None


def _named(root: etree._Element) -> list[tuple[str, str]]:
    """Return the kinds and locations of the schemas of a document."""
    result: list[tuple[str, str]] = []
    for node in root.itersiblings(preceding=True):
        if getattr(node, "target", "") == "xml-model":
            words = dict(re.findall(r"""\b(\w+)\s*=\s*["']([^"']*)["']""", node.text or ""))
            if "href" in words and words.get("schematypens") in {XML_SCHEMA, RELAX_NG}:
                result.append((words["schematypens"], words["href"]))
    hint = root.get(HINT)
    return [*result, (XML_SCHEMA, str(hint))] if hint is not None else result


def _judge(package: Package, use: _Use) -> Verdict | bytes | None:
    """Return the verdict if libxml2 is not needed, or the schema to validate with."""
    manifest = re.search(r"package_format([123])\.xsd\Z", use.href)
    if manifest:
        wrong = violations(use.data, int(manifest[1]))
        return (
            _invalid(use, wrong[0][0], f"is no package.xml: {_first_line(wrong[0][1])}")
            if wrong
            else None
        )
    if "://" in use.href:
        return _unchecked(use, "it is not a local file")
    target = posixpath.normpath(posixpath.join(posixpath.dirname(use.path), use.href))
    try:
        schema = _read(package, target)
    except LargeFileError as error:
        return _unchecked(use, f"its {error.size // 1000} kB are more than {MAX_BYTES // 1000} kB")
    except (OSError, ValueError):
        return _invalid(use, 1, f"names the schema {use.href}, but there is no file {target}")
    root = _parse(schema)
    if root is not None and _reads_others(root):
        return _unchecked(use, "it includes other files")
    return schema


def _reads_others(root: etree._Element) -> bool:
    """Return whether a schema includes other files."""
    document = root.getroottree().docinfo
    has_type = document.internalDTD is not None
    return has_type or any(element.tag in _READS_OTHERS for element in root.iter())


def _read(package: Package, path: str) -> bytes:
    if not path.startswith(".."):
        return package.bytes_of(path, MAX_BYTES)
    if package.root is None:
        raise FileNotFoundError(path)
    # next to the package, in the same repository
    return package.outside.read(os.path.join(package.root, path), MAX_BYTES)


def _validated(jobs: Mapping[_Use, validate.Job]) -> Iterator[tuple[_Use, Verdict | None]]:
    """Yield the verdicts of libxml2 on documents that it finishes in time."""
    lines = _run(list(jobs.values())) if jobs else []
    for at, use in enumerate(jobs):
        if at >= len(lines):
            yield use, _unchecked(use, "it takes too long, or too much memory")
            continue
        complaint = json.loads(lines[at])
        if complaint is None:
            yield use, None
            continue
        line, message, is_unusable = complaint
        problem = f"names the schema {use.href}, which cannot be used" if is_unusable else ""
        yield (
            use,
            _invalid(use, line, f"{problem or f'does not fit {use.href}'}: {_first_line(message)}"),
        )


def _run(jobs: list[validate.Job]) -> list[bytes]:
    """Return the output lines of the validator until it ends or is killed."""
    import subprocess

    from lxml import etree

    library = os.path.dirname(os.path.dirname(os.path.abspath(etree.__file__)))
    with subprocess.Popen(
        [sys.executable, "-I", validate.__file__, library],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
    ) as process:
        try:
            output, _ = process.communicate(marshal.dumps(jobs), timeout=MOST_SECONDS)
        except subprocess.TimeoutExpired:
            process.kill()
            output, _ = process.communicate()
    return [line for line in output.splitlines(keepends=True) if line.endswith(b"\n")]


def _invalid(use: _Use, line: int, message: str) -> Verdict:
    return Verdict(Location.start_of(use.path, max(line, 1)), message, is_checked=True)


def _unchecked(use: _Use, why: str) -> Verdict:
    message = f"names the schema '{use.href}', which is not checked: {why}"
    return Verdict(Location.start_of(use.path), message, is_checked=False)


def _first_line(message: str) -> str:
    return message.partition("\n")[0].rstrip(". ")


def violations(data: bytes, number: int) -> list[tuple[int, str]]:
    """Return the lines of a manifest rejected by the schema of a format, with messages of libxml2.

    Args:
        data: The file.
        number: The format, 1 to 3.

    Raises:
        ValueError: the file is not well-formed, or the format does not exist.
    """
    from lxml import etree

    schema = _schema(number)
    parser = etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False)
    try:
        document = etree.fromstring(data, parser).getroottree()
    except etree.XMLSyntaxError as error:
        raise ValueError(str(error)) from error
    if schema.validate(document):
        return []
    return [(entry.line, entry.message) for entry in schema.error_log] or [(1, "is rejected")]


@lru_cache(maxsize=3)
def _schema(number: int) -> etree.RelaxNG:
    from lxml import etree

    if number not in {1, 2, 3}:
        raise ValueError(f"package.xml has no format {number}")
    return etree.RelaxNG(file=os.path.join(DATA, f"manifest_format{number}.rng"))
