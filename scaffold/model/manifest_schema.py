"""The project's own schemas of package.xml: the second opinion on its structure.

The rules decide without them, faster and with better messages; `check --reference` and the tests
hold both against each other, and other XML files that say they are a manifest are held against
them. lxml takes 25 ms to import, so nothing here runs in a plain `check`.
"""

from __future__ import annotations

import os
from functools import lru_cache
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from lxml import etree

_DATA = os.path.join(os.path.dirname(os.path.dirname(__file__)), "data")


def violations(data: bytes, number: int) -> list[tuple[int, str]]:
    """Return the lines of a manifest that the schema of a format refuses, in libxml2's words.

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
    return [(entry.line, entry.message) for entry in schema.error_log] or [(1, "is refused")]


@lru_cache(maxsize=3)
def _schema(number: int) -> etree.RelaxNG:
    from lxml import etree

    if number not in {1, 2, 3}:
        raise ValueError(f"package.xml has no format {number}")
    return etree.RelaxNG(file=os.path.join(_DATA, f"manifest_format{number}.rng"))
