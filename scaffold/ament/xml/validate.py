"""A subprocess that validates XML documents, so that libxml2 can be killed on a timeout.

The ``xmllint`` next to it starts it with limits on time and memory; the argument is the directory
that contains lxml. It reads jobs from standard input and writes one line of JSON for each.
"""

from __future__ import annotations

import json
import marshal
import resource
import signal
import sys
from collections.abc import Iterable
from typing import Any, cast

MOST_SECONDS = 2
"""The limit of CPU time in seconds; a schema for launch files takes some milliseconds."""
MOST_MEMORY = 1_000_000_000
"""Bytes."""
RELAX_NG = "http://relaxng.org/ns/structure/1.0"

Job = tuple[str, bytes, bytes]
"""The kind of a schema, the schema, and the document."""
Complaint = tuple[int, str, bool]
"""A line of the document, the error, and whether the schema itself is unusable."""


def validate(kind: str, schema: bytes, document: bytes) -> Complaint | None:
    """Return the first schema error of a document."""
    from lxml import etree

    def parse(data: bytes) -> etree._Element:
        parser = etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False)
        return etree.fromstring(data, parser)

    try:
        tree = parse(schema)
        rules = etree.RelaxNG(tree) if kind == RELAX_NG else etree.XMLSchema(tree)
    except etree.LxmlError as error:
        return 1, str(error), True
    rules.validate(parse(document).getroottree())
    for entry in cast("Iterable[Any]", rules.error_log):
        return entry.line, entry.message, False
    return None


def main() -> None:
    """Run the jobs from standard input."""
    sys.path.append(sys.argv[1])
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # Python's own handler would wait for libxml2
    resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY, MOST_MEMORY))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    resource.setrlimit(resource.RLIMIT_CPU, (MOST_SECONDS, MOST_SECONDS))
    jobs: list[Job] = marshal.loads(sys.stdin.buffer.read())  # noqa: S302  of our own process
    for job in jobs:
        sys.stdout.write(json.dumps(validate(*job)) + "\n")
        sys.stdout.flush()


if __name__ == "__main__":
    main()
