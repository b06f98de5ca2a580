"""Packages from outside of the repository: in ``*.repos`` files, and those of C++ headers."""

from __future__ import annotations

import os
import re
from contextlib import suppress
from typing import TYPE_CHECKING

from scaffold import lazy_re
from scaffold.model.discovery.colcon import repository_around
from scaffold.source import ViewError

if TYPE_CHECKING:
    from collections.abc import Iterator

    from scaffold.model.package import Package

_PLACES = ("", ".github")
"""Directories of a repository with such files."""
_ENTRY = lazy_re.compile(r"^ {1,8}(?:[\w.-]{1,99}/){0,9}([\w.-]{1,99}):[ \t]*$", re.MULTILINE)
"""Matches the key of an entry; its last part is the directory, and mostly the package."""
_CPP = (".cpp", ".cc", ".cxx", ".hpp", ".hh", ".h")
_MAX_BYTES = 100_000


def is_fetched(package: Package, name: str) -> bool:
    """Return whether a file of the repository lists a package to fetch as source."""
    return name in package.remember("fetched as source", lambda: frozenset(_names(package)))


def is_included(package: Package, name: str) -> bool:
    """Return whether C++ code of the workspace includes headers of a package, so that it exists."""
    header = re.compile(rb"#[ \t]*include[ \t]*[<\"]%b/" % re.escape(name).encode())

    def find() -> bool:
        for other in package.workspace:
            for path in other.files:
                if path.endswith(_CPP):
                    with suppress(ViewError):
                        if header.search(other.data(path)):
                            return True
        return False

    return package.remember(("included", name), find)


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
