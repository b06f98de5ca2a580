"""Validates the directory for a new package."""

from __future__ import annotations

import os

from scaffold.errors import ConflictError, InputError
from scaffold.files.disk import Disk
from scaffold.files.tree import MANIFEST
from scaffold.model.discovery import colcon
from scaffold.model.package import Package


def check(destination: str, package: str) -> None:
    """Raise if colcon would not find the package, or would find two with its name.

    Args:
        destination: The directory in which the package's directory will be created.
        package: Its name.

    Raises:
        ConflictError: the place is inside a package, or another package has the name.
        InputError: the destination is not a directory.
    """
    top = os.path.realpath(destination)
    while not os.path.lexists(top):
        top = os.path.dirname(top)
    if not os.path.isdir(top):
        raise InputError(f"{destination}: {top} is not a directory")
    if outer := colcon.package_around(Disk(), top):
        raise ConflictError(
            f"{outer} is a package, and colcon does not search for packages inside of packages"
        )
    own = os.path.join(os.path.realpath(destination), package)
    for other in neighbors(top):
        directory = os.path.realpath(other)
        if directory != own and Package.at(directory).name == package:
            raise ConflictError(f"{directory} is already a package named {package!r}")


def workspace(destination: str) -> str | None:
    """Return the workspace of a directory, where colcon is started."""
    sources = colcon.sources_at(Disk(), os.path.realpath(destination))
    return os.path.dirname(sources) if sources else None


def neighbors(top: str) -> list[str]:
    """Return the packages of the workspace around a directory, and those in it."""
    disk = Disk()
    sources = colcon.sources_at(disk, top)
    packages = colcon.package_directories(disk, sources) if sources else []
    beside = (os.path.join(top, name) for name in disk.names(top)[1])
    return [*packages, *(item for item in beside if disk.is_file(os.path.join(item, MANIFEST)))]
