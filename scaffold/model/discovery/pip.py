"""Requirements for pip: in pyproject.toml, and in requirements files."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

from scaffold import lazy_re
from scaffold.model.catalog import module_of_key
from scaffold.model.discovery.colcon import repository_around

if TYPE_CHECKING:
    from scaffold.model.package import Package

_PLACES = ("", "docker", ".devcontainer")
"""Directories of a repository with requirements files."""
_NAME = lazy_re.compile(r"^[ \t]*([A-Za-z0-9][\w.-]*)", re.MULTILINE)
# linear: few lines of a file start with a key
_PROJECT = lazy_re.compile(r"^[\w-]+\s*=\s*\[(.*?)\][ \t]*$", re.MULTILINE | re.DOTALL)
_QUOTED = lazy_re.compile(r"""["']([A-Za-z0-9][\w.-]*)""")
_MAX_BYTES = 100_000


def is_in_requirements(package: Package, module: str) -> bool:
    """Return whether the package of a module is listed for pip."""
    names = package.remember("names for pip", lambda: frozenset(_names(package)))
    plain = module.lower().replace("_", "-")
    usual = {plain, plain.replace("-", "_"), f"python-{plain}", f"py{plain}", f"{plain}-python"}
    return not usual.isdisjoint(names) or any(module_of_key(name) == module for name in names)


def _names(package: Package) -> Iterator[str]:
    yield from _of_project(package)
    texts = [package.data(path) for path in package.files if _is_of_requirements(path)]
    for data in (*texts, *_of_repository(package)):
        for name in _NAME.findall(data.decode(errors="replace")):
            yield name.lower()


def _is_of_requirements(path: str) -> bool:
    return path.endswith(".txt") and "requirements" in path.rpartition("/")[2]


def _of_project(package: Package) -> Iterator[str]:
    text = package.source("pyproject.toml").text if package.has("pyproject.toml") else ""
    for listed in _PROJECT.findall(text):
        for name in _QUOTED.findall(listed):
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
