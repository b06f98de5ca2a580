"""The packages that ``*.repos`` files list for ``vcs import``."""

from __future__ import annotations

import os
import re
from typing import TYPE_CHECKING

from scaffold.model.discovery.colcon import repository_around

if TYPE_CHECKING:
    from collections.abc import Iterator

    from scaffold.model.package import Package

_PLACES = ("", ".github")
"""Directories of a repository with such files."""
_ENTRY = re.compile(r"^ {1,8}(?:[\w.-]{1,99}/){0,9}([\w.-]{1,99}):[ \t]*$", re.MULTILINE)
"""Matches the key of an entry; its last part is the directory, and mostly the package."""
_MAX_BYTES = 100_000


def is_fetched(package: Package, name: str) -> bool:
    """Return whether a file of the repository lists a package to fetch as source."""
    return name in package.remember("fetched as source", lambda: frozenset(_names(package)))


def _names(package: Package) -> Iterator[str]:
    disk = package.outside
    top = repository_around(disk, disk.real(package.directory)) if package.directory else None
    for place in _PLACES if top else ():
        directory = os.path.join(top or "", place)
        for file in disk.names(directory)[0]:
            if not file.endswith(".repos"):
                continue
            try:
                text = disk.read(os.path.join(directory, file), _MAX_BYTES).decode(
                    "utf-8", "replace"
                )
            except OSError:
                continue
            yield from _ENTRY.findall(text)
