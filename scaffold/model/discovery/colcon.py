"""Finds packages as colcon does: below a directory, and in the workspace around it."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from scaffold.files.tree import BUILD_DIRECTORIES, ENVIRONMENT, MANIFEST

if TYPE_CHECKING:
    from scaffold.files.disk import Disk
    from scaffold.model.package_files import PackageFiles

SOURCES = "src"
"""The directory of a workspace with the packages."""
IGNORE_MARKERS = ("COLCON_IGNORE", "AMENT_IGNORE", "CATKIN_IGNORE")
"""Files that hide a directory from colcon."""

_RESULTS = ("install", "build")
"""Directories that colcon creates next to the sources."""


def package_directories(
    disk: Disk, top: str, *, ignored: bool = False, most: int | None = None
) -> list[str]:
    """Return the directories at and below one that hold a package.

    Packages are not searched for others. Of a package, only its manifest and the
    markers are accessed, so that the result does not depend on its other files.

    Args:
        disk: Records what was accessed.
        top: The directory; it is searched whether it is hidden from colcon or not.
        ignored: Whether to search ignored directories as well.
        most: The maximum number of directories to search; a larger tree counts as empty.
    """
    if disk.is_file(os.path.join(top, MANIFEST)):
        return [top]
    result: list[str] = []
    pending = [top]
    for parent in pending:
        for name in disk.names(parent)[1]:
            path = os.path.join(parent, name)
            if name.startswith(".") or not (ignored or _is_visible(disk, path)):
                continue
            if disk.is_file(os.path.join(path, ENVIRONMENT)):
                continue
            if disk.is_file(os.path.join(path, MANIFEST)):
                result.append(path)
            elif name not in BUILD_DIRECTORIES:
                pending.append(path)
        if most is not None and len(pending) + len(result) > most:
            return []
    return sorted(result)


def is_ignored(package: PackageFiles) -> bool:
    """Return whether a marker hides a package from colcon."""
    return any(map(package.has, IGNORE_MARKERS))


def _is_visible(disk: Disk, directory: str) -> bool:
    return not any(disk.exists(os.path.join(directory, marker)) for marker in IGNORE_MARKERS)


def package_around(disk: Disk, directory: str) -> str | None:
    """Return the innermost package at or above a directory.

    Args:
        disk: Records what was accessed.
        directory: An absolute path.
    """
    for parent in _parents(directory):
        if disk.is_file(os.path.join(parent, MANIFEST)):
            return parent
    return None


def sources_around(disk: Disk, directory: str) -> str | None:
    """Return the source directory of the workspace at or above a directory.

    It is the one next to the results of colcon, else the innermost one named ``src``.

    Args:
        disk: Records what was accessed.
        directory: An absolute path without links.
    """
    candidates = [upward for upward in _parents(directory) if os.path.basename(upward) == SOURCES]
    for sources in candidates if len(candidates) > 1 else ():
        top = os.path.dirname(sources)
        if any(disk.is_directory(os.path.join(top, result)) for result in _RESULTS):
            return sources
    return candidates[0] if candidates else None


def sources_at(disk: Disk, directory: str) -> str | None:
    """Return the sources of the workspace around a directory.

    Those below it, else those around it.

    Args:
        disk: Records what was accessed.
        directory: An absolute path without links.
    """
    below = os.path.join(directory, SOURCES)
    return below if disk.is_directory(below) else sources_around(disk, directory)


def packages_around(disk: Disk, directory: str, *, most: int) -> list[str]:
    """Return the packages of the workspace around a directory.

    Without a directory ``src``, these are the packages side by side there, and all in the git
    repository around it.

    Args:
        disk: Records what was accessed.
        directory: An absolute path without links.
        most: The maximum number of directories of a repository to search.
    """
    sources = sources_at(disk, directory)
    if sources is not None:
        return package_directories(disk, sources)
    around = package_around(disk, directory)
    beside = os.path.dirname(around) if around is not None else directory
    directories = packages_in(disk, beside, most=most)
    top = repository_around(disk, directory)
    if top is not None:
        directories += package_directories(disk, top, most=most)
    return sorted({*directories})


def packages_in(disk: Disk, directory: str, *, most: int) -> list[str]:
    """Return the packages side by side in a directory, none if it has too many directories."""
    names = disk.directories_with(directory, MANIFEST, most)
    paths = [os.path.join(directory, name) for name in names if not name.startswith(".")]
    return [path for path in paths if _is_visible(disk, path)]


def repository_around(disk: Disk, directory: str) -> str | None:
    """Return the top of the git repository at or above a directory."""
    tops = (item for item in _parents(directory) if disk.exists(os.path.join(item, ".git")))
    return next(tops, None)


def _parents(directory: str) -> list[str]:
    result = [directory]
    while result[-1] != os.path.dirname(result[-1]):
        result.append(os.path.dirname(result[-1]))
    return result
