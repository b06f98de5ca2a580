"""XML files that name a schema: whether they fit it, as far as that can be told safely.

The schemas of package.xml are known by their addresses. Another schema is a file of a stranger: it
may name further files, which libxml2 would open by itself, so one that does is left alone; and it
may take libxml2 any time, so the others are tried in a process that is ended in time.
"""

from __future__ import annotations

import json
import marshal
import os
import posixpath
import re
import sys
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from scaffold.model import manifest_schema, xml_validate
from scaffold.model.disk import LargeFileError
from scaffold.model.source import Location
from scaffold.model.xml_files import of_package
from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from lxml import etree

    from scaffold.model.package import Package

XML_SCHEMA = "http://www.w3.org/2001/XMLSchema"
RELAX_NG = xml_validate.RELAX_NG
HINT = "{http://www.w3.org/2001/XMLSchema-instance}noNamespaceSchemaLocation"
MOST_BYTES = 200_000
"""Of a schema; that of package.xml has 30 kB."""
MOST_SECONDS = 4
"""Of waiting for all schemas of a package."""
_READS_OTHERS = frozenset(
    {f"{{{XML_SCHEMA}}}{name}" for name in ("include", "import", "redefine", "override")}
    | {f"{{{RELAX_NG}}}{name}" for name in ("include", "externalRef")}
)


class Verdict(NamedTuple):
    """What is known of an XML file and one schema that it names."""

    location: Location
    message: str
    is_checked: bool
    """False if the schema was left alone, and the message says why."""


class _Use(NamedTuple):
    """An XML file and a schema that it names."""

    path: str
    data: bytes
    kind: str
    href: str


def verdicts(package: Package) -> Sequence[Verdict]:
    """Return what there is to say of the schemas that XML files other than package.xml name.

    Of a file that does not fit, the first place where it does not.
    """
    return package.remember("xml_schemas", lambda: _verdicts(package))


def _verdicts(package: Package) -> list[Verdict]:
    uses = [use for path in of_package(package) for use in _uses(package, path)]
    told: dict[_Use, Verdict | None] = {}
    jobs: dict[_Use, xml_validate.Job] = {}
    for use in uses:
        verdict = _judge(package, use)
        if isinstance(verdict, bytes):
            jobs[use] = (use.kind, verdict, use.data)
        else:
            told[use] = verdict
    validated = dict(_validated(jobs))
    if any(verdict and not verdict.is_checked for verdict in validated.values()):
        package.is_repeatable = False  # another time there may be time
    told.update(validated)
    found: list[Verdict] = []
    complained: set[str] = set()
    for use in uses:
        verdict = told[use]
        if verdict is None or (verdict.is_checked and use.path in complained):
            continue
        if verdict.is_checked:
            complained.add(use.path)
        found.append(verdict)
    return found


def _uses(package: Package, path: str) -> Iterator[_Use]:
    """Yield the schemas that a well-formed file names."""
    try:
        data = package.tree.read(path) if path != "package.xml" else b""
    except OSError:
        return
    if b"xml-model" not in data and b"noNamespaceSchemaLocation" not in data:
        return  # nearly all files: nothing to import for
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
    """Return the kinds and places of the schemas that a document names."""
    found: list[tuple[str, str]] = []
    for node in root.itersiblings(preceding=True):
        if getattr(node, "target", "") == "xml-model":
            words = dict(re.findall(r"""\b(\w+)\s*=\s*["']([^"']*)["']""", node.text or ""))
            if "href" in words and words.get("schematypens") in {XML_SCHEMA, RELAX_NG}:
                found.append((words["schematypens"], words["href"]))
    hint = root.get(HINT)
    return [*found, (XML_SCHEMA, str(hint))] if hint is not None else found


def _judge(package: Package, use: _Use) -> Verdict | bytes | None:
    """Return what can be said without libxml2, or the schema that it has to look at."""
    manifest = re.search(r"package_format([123])\.xsd\Z", use.href)
    if manifest:
        wrong = manifest_schema.violations(use.data, int(manifest[1]))
        return (
            _wrong(use, wrong[0][0], f"is no package.xml: {_shown(wrong[0][1])}") if wrong else None
        )
    if "://" in use.href:
        return _left(use, "it is on the network")
    target = posixpath.normpath(posixpath.join(posixpath.dirname(use.path), use.href))
    try:
        schema = _read(package, target)
    except LargeFileError as error:
        return _left(use, f"its {error.size // 1000} kB are more than {MOST_BYTES // 1000} kB")
    except (OSError, ValueError):
        return _wrong(use, 1, f"names the schema {use.href}, but there is no file {target}")
    root = _parse(schema)
    if root is not None and _reads_others(root):
        return _left(use, "it names other files")
    return schema


def _reads_others(root: etree._Element) -> bool:
    """Tell whether a schema makes its reader open other files."""
    document = root.getroottree().docinfo
    has_type = document.internalDTD is not None
    return has_type or any(element.tag in _READS_OTHERS for element in root.iter())


def _read(package: Package, path: str) -> bytes:
    if not path.startswith(".."):
        return package.tree.read(path, MOST_BYTES)
    if package.root is None:
        raise FileNotFoundError(path)
    # beside the package, in the same repository
    return package.outside.read(os.path.join(package.root, path), MOST_BYTES)


def _validated(jobs: Mapping[_Use, xml_validate.Job]) -> Iterator[tuple[_Use, Verdict | None]]:
    """Yield what libxml2 says of documents, as far as it comes in time."""
    lines = _run(list(jobs.values())) if jobs else []
    for at, use in enumerate(jobs):
        if at >= len(lines):
            yield use, _left(use, "it takes too long, or too much memory")
            continue
        complaint = json.loads(lines[at])
        if complaint is None:
            yield use, None
            continue
        line, message, is_unusable = complaint
        said = f"names the schema {use.href}, which cannot be used" if is_unusable else ""
        yield use, _wrong(use, line, f"{said or f'does not fit {use.href}'}: {_shown(message)}")


def _run(jobs: list[xml_validate.Job]) -> list[bytes]:
    """Return the lines that the program for it writes until it ends or is ended."""
    import subprocess

    from lxml import etree

    library = os.path.dirname(os.path.dirname(os.path.abspath(etree.__file__)))
    with subprocess.Popen(
        [sys.executable, "-I", xml_validate.__file__, library],
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


def _wrong(use: _Use, line: int, message: str) -> Verdict:
    return Verdict(Location.start_of(use.path, max(line, 1)), message, is_checked=True)


def _left(use: _Use, why: str) -> Verdict:
    message = f"names the schema '{use.href}', which is not looked at: {why}"
    return Verdict(Location.start_of(use.path), message, is_checked=False)


def _shown(message: str) -> str:
    return message.partition("\n")[0].rstrip(". ")
