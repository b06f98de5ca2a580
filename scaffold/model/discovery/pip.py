"""What files of requirements ask pip for: those of a package, and of the repository around it."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

from scaffold.model.catalog import module_of_key
from scaffold.model.discovery.colcon import repository_around

if TYPE_CHECKING:
    from scaffold.model.package import Package

_PLACES = ("", "docker", ".devcontainer")
"""Directories of a repository that have files of requirements."""
_FILE = re.compile(r"(?:^|/)requirements[^/]*\.txt$")
_NAME = re.compile(r"^[ \t]*([A-Za-z0-9][\w.-]*)", re.MULTILINE)
_MAX_BYTES = 100_000


def is_in_requirements(package: Package, module: str) -> bool:
    """Tell whether a file of requirements names the package that a module comes from."""
    names = package.remember("names for pip", lambda: frozenset(_names(package)))
    return any(name == module.lower() or module_of_key(name) == module for name in names)


def _names(package: Package) -> Iterator[str]:
    texts = [package.data(path) for path in package.files if _FILE.search(path)]
    for data in (*texts, *_of_repository(package)):
        for name in _NAME.findall(data.decode(errors="replace")):
            yield name.lower()


def _of_repository(package: Package) -> Iterator[bytes]:
    disk = package.outside
    top = repository_around(disk, disk.real(package.directory)) if package.directory else None
    for place in _PLACES if top else ():
        directory = os.path.join(top or "", place)
        for name in disk.entries(directory, "REQUIREMENTS"):
            try:
                yield disk.read(os.path.join(directory, name), _MAX_BYTES)
            except OSError:
                continue
