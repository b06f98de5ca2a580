"""Packages of the same workspace that are not checked, but may be depended on.

If only one package is checked, for example by a hook, its dependencies on others are checked as
if all were checked. They are searched only for unknown names, by their manifests; other files of
them are read when a rule needs them.
"""

from __future__ import annotations

import os
import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from functools import cached_property

from scaffold.files.tree import MANIFEST
from scaffold.model.discovery.colcon import package_directories, packages_in
from scaffold.model.package import Package
from scaffold.model.workspace.workspace import Workspace

MOST_DIRECTORIES = 2000
"""The size limit of a searched workspace, so that a search is fast."""
_NAME = rb"<name>\s*([A-Za-z][\w-]*)\s*</name>"


class UncheckedPackages:
    """The packages in and below some directories, except the checked ones.

    Args:
        beside: Directories with packages directly inside, not searched recursively.
        sources: Directories to search recursively.
        own: The real directories of the checked packages.
        workspace: The workspace of the packages, which records all accesses.
    """

    def __init__(
        self,
        beside: Sequence[str],
        sources: Sequence[str],
        own: Collection[str],
        workspace: Workspace[Package],
    ) -> None:
        self._beside = beside
        self._sources = sources
        self._own = own
        self._workspace = workspace
        self._packages: dict[str, Package] = {}

    @cached_property
    def directories(self) -> Mapping[str, str]:
        """The directories of the packages by name; empty if there are too many directories."""
        result: dict[str, str] = {}
        for directory in self._names():
            name = None if directory in self._own else self._name_of(directory)
            if name is not None:
                result.setdefault(name, directory)
        return result

    def _names(self) -> Iterator[str]:
        disk = self._workspace.disk
        for top in self._beside:
            yield from packages_in(disk, top, most=MOST_DIRECTORIES)
        for top in self._sources:
            yield from package_directories(disk, top, most=MOST_DIRECTORIES)

    def _name_of(self, directory: str) -> str | None:
        from scaffold.files.limits import most_bytes

        try:
            path = os.path.join(directory, MANIFEST)
            data = self._workspace.disk.read(path, most_bytes(MANIFEST))
        except OSError:
            return None
        matched = re.search(_NAME, data)
        return matched[1].decode() if matched else None

    def get(self, name: str) -> Package | None:
        """Return the package with a name, if it exists."""
        if name not in self._packages and name in self.directories:
            self._packages[name] = Package.at(
                self.directories[name], self._workspace, self._workspace.disk
            )
        return self._packages.get(name)

    def __iter__(self) -> Iterator[Package]:
        for name in self.directories:
            package = self.get(name)
            if package is not None:
                yield package
