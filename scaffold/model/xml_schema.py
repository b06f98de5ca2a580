"""XML files that name a schema: whether they fit it, as far as that can be told offline."""

from __future__ import annotations

import os
import posixpath
import re
from typing import TYPE_CHECKING, Any, cast

from scaffold.model import manifest_schema
from scaffold.model.package import Package
from scaffold.model.source import Location

if TYPE_CHECKING:
    from collections.abc import Iterable

    from lxml import etree

XML_SCHEMA = "http://www.w3.org/2001/XMLSchema"
RELAX_NG = "http://relaxng.org/ns/structure/1.0"
HINT = "{http://www.w3.org/2001/XMLSchema-instance}noNamespaceSchemaLocation"


def complaint(package: Package, path: str, data: bytes) -> tuple[Location, str] | None:
    """Return the first place where a well-formed XML file does not fit the schema it names.

    A schema on the network is not fetched; what the file has to do with it stays unknown.
    """
    from lxml import etree

    parser = etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False)
    try:
        root = etree.fromstring(data, parser)
    except etree.XMLSyntaxError:
        return None
    for kind, href in _named(root):
        said = _check(package, path, data, root, kind, href)
        if said is not None:
            line, message = said
            return Location.start_of(path, max(line, 1)), message
    return None


def _named(root: etree._Element) -> list[tuple[str, str]]:
    """Return the kinds and places of the schemas that a document names."""
    found: list[tuple[str, str]] = []
    for node in root.itersiblings(preceding=True):
        if getattr(node, "target", "") == "xml-model":
            words = dict(re.findall(r"""(\w+)\s*=\s*["']([^"']*)["']""", node.text or ""))
            if "href" in words and words.get("schematypens") in {XML_SCHEMA, RELAX_NG}:
                found.append((words["schematypens"], words["href"]))
    hint = root.get(HINT)
    return [*found, (XML_SCHEMA, str(hint))] if hint is not None else found


def _check(
    package: Package, path: str, data: bytes, root: etree._Element, kind: str, href: str
) -> tuple[int, str] | None:
    manifest = re.search(r"package_format([123])\.xsd$", href)
    if manifest:
        wrong = manifest_schema.violations(data, int(manifest[1]))
        return (wrong[0][0], f"is no package.xml: {_shown(wrong[0][1])}") if wrong else None
    if "://" in href:
        return None
    target = posixpath.normpath(posixpath.join(posixpath.dirname(path), href))
    content = _read(package, target)
    if content is None:
        return 1, f"names the schema {href}, but there is no file {target}"
    base = os.path.join(package.root or "", target)
    package.is_repeatable = False  # the schema may include others, which lxml reads
    return _validate(root, kind, href, (content, base))


def _validate(
    root: etree._Element, kind: str, href: str, file: tuple[bytes, str]
) -> tuple[int, str] | None:
    from lxml import etree

    parser = etree.XMLParser(resolve_entities=False, no_network=True)
    try:
        document = etree.fromstring(file[0], parser, base_url=file[1])
        schema = etree.RelaxNG(document) if kind == RELAX_NG else etree.XMLSchema(document)
    except etree.LxmlError as error:
        return 1, f"names the schema {href}, which cannot be used: {_shown(str(error))}"
    schema.validate(root.getroottree())
    for entry in cast("Iterable[Any]", schema.error_log):
        return entry.line, f"does not fit {href}: {_shown(entry.message)}"
    return None


def _read(package: Package, path: str) -> bytes | None:
    try:
        return package.tree.read(path)
    except OSError:
        pass
    if package.root is None or not path.startswith(".."):
        return None
    try:  # beside the package, in the same repository
        return package.outside.read(os.path.join(package.root, path))
    except OSError:
        return None


def _shown(message: str) -> str:
    return message.partition("\n")[0].rstrip(". ")
