"""The packages beside those that are checked, in the same colcon workspace.

Who gives one package, such as a hook does, still has the others around it: what it takes from them
is judged as if all had been given. They are looked for only when a name is not known otherwise,
by their manifests alone; more of one is read only when a rule needs it.
"""

from __future__ import annotations

import os
import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING

from scaffold.model.tree import BUILD_DIRECTORIES, IGNORE_MARKERS, MANIFEST

if TYPE_CHECKING:
    from scaffold.model.disk import Disk
    from scaffold.model.package import Package
    from scaffold.model.workspace import Workspace

SOURCES = "src"
"""The directory of a workspace with the packages."""
MOST_DIRECTORIES = 2000
"""A larger workspace is not searched: that would take longer than the check of a package."""
_NAME = rb"<name>\s*([A-Za-z][\w-]*)\s*</name>"


def sources_around(disk: Disk, directory: str) -> str | None:
    """Return the directory with the sources of the workspace that a package lies in.

    The one beside the results of colcon, else the innermost that is called ``src``.

    Args:
        disk: Notes what was looked at.
        directory: Of the package, without links.
    """
    found: list[str] = []
    parent = os.path.dirname(directory)
    while parent != os.path.dirname(parent):
        if os.path.basename(parent) == SOURCES:
            found.append(parent)
        parent = os.path.dirname(parent)
    for sources in found if len(found) > 1 else ():
        if any(disk.is_directory(os.path.join(os.path.dirname(sources), n)) for n in _RESULTS):
            return sources
    return found[0] if found else None


_RESULTS = ("install", "build")


class Surroundings:
    """The packages below some directories, except for those that are checked.

    Args:
        sources: The directories.
        own: The directories of the packages that are checked, without links.
        workspace: What the packages belong to; all that is read of them is noted there.
    """

    def __init__(self, sources: Sequence[str], own: Collection[str], workspace: Workspace) -> None:
        self._sources = sources
        self._own = own
        self._workspace = workspace
        self._packages: dict[str, Package] = {}

    @cached_property
    def directories(self) -> Mapping[str, str]:
        """Where the packages are, by name; none if there are too many directories."""
        found: dict[str, str] = {}
        for top in self._sources:
            for directory in _package_directories(self._workspace.disk, top):
                name = None if directory in self._own else self._name_of(directory)
                if name is not None:
                    found.setdefault(name, directory)
        return found

    def _name_of(self, directory: str) -> str | None:
        try:
            data = self._workspace.disk.read(os.path.join(directory, MANIFEST))
        except OSError:
            return None
        found = re.search(_NAME, data)
        return found[1].decode() if found else None

    def get(self, name: str) -> Package | None:
        """Return the package of a name, if it is there."""
        if name not in self._packages and name in self.directories:
            from scaffold.model.package import Package

            self._packages[name] = Package.at(
                self.directories[name], self._workspace, self._workspace.disk
            )
        return self._packages.get(name)

    def __iter__(self) -> Iterator[Package]:
        for name in self.directories:
            found = self.get(name)
            if found is not None:
                yield found


def _package_directories(disk: Disk, top: str) -> list[str]:
    """Return where packages are, the way colcon looks for them."""
    found: list[str] = []
    pending = [top]
    for directory in pending:
        files, children, _ = disk.names(directory)
        if not set(IGNORE_MARKERS).isdisjoint(files):
            continue
        if MANIFEST in files:
            found.append(directory)
            continue
        pending += [
            os.path.join(directory, name)
            for name in children
            if not name.startswith(".") and name not in BUILD_DIRECTORIES
        ]
        if len(pending) > MOST_DIRECTORIES:
            return []
    return found
