"""Whether a new package may stand where the user wants it."""

from __future__ import annotations

import os
from collections.abc import Iterator

from scaffold.errors import ConflictError, InputError
from scaffold.model.package import Package
from scaffold.model.tree import MANIFEST

SOURCES = "src"
"""The directory of a workspace with the packages."""


def check(destination: str, package: str) -> None:
    """Raise if colcon would not find a package there, or would find two of its name.

    Args:
        destination: The directory that the package's own directory is to be made in.
        package: Its name.

    Raises:
        ConflictError: the place is inside a package, or another package has the name.
        InputError: the destination is no directory.
    """
    top = os.path.realpath(destination)
    while not os.path.lexists(top):
        top = os.path.dirname(top)
    if not os.path.isdir(top):
        raise InputError(f"{destination}: {top} is not a directory")
    _refuse_nested(top)
    own = os.path.join(os.path.realpath(destination), package)
    for other in _neighbours(top):
        directory = os.path.realpath(other.directory)
        if directory != own and other.name == package:
            raise ConflictError(f"{directory} is a package with the name {package!r} already")


def workspace(destination: str) -> str | None:
    """Return the workspace of a directory: the parent of the innermost ``src`` above it."""
    sources = _sources(os.path.realpath(destination))
    return os.path.dirname(sources) if sources else None


def _sources(directory: str) -> str | None:
    below = os.path.join(directory, SOURCES)
    if os.path.isdir(below):
        return below
    while os.path.basename(directory) != SOURCES:
        if directory == os.path.dirname(directory):
            return None
        directory = os.path.dirname(directory)
    return directory


def _refuse_nested(directory: str) -> None:
    while True:
        if os.path.isfile(os.path.join(directory, MANIFEST)):
            raise ConflictError(
                f"{directory} is a package, and colcon does not look for others inside of it"
            )
        parent = os.path.dirname(directory)
        if parent == directory:
            return
        directory = parent


def _neighbours(top: str) -> Iterator[Package]:
    """Yield the packages of the workspace; outside of one, those beside the new package."""
    sources = _sources(top)
    if sources is not None:
        from scaffold.model import discovery

        try:
            yield from (target.package for target in discovery.find([sources]))
        except InputError:  # none yet
            return
    for name in sorted(os.listdir(top)):
        if os.path.isfile(os.path.join(top, name, MANIFEST)):
            yield Package.at(os.path.join(top, name))
