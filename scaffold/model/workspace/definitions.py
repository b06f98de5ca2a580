"""The definitions of interfaces in a workspace, in installed packages and in the bundle."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Protocol

from scaffold import distributions
from scaffold.model.cmake.rosidl import generations_of
from scaffold.model.interfaces.definitions import Definitions
from scaffold.model.interfaces.sources import (
    BundleSource,
    DefinitionSource,
    KnownPackage,
    PrefixSource,
    Text,
    is_test_data,
)
from scaffold.model.interfaces.syntax import SECTIONS
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.files.disk import Disk
    from scaffold.model.workspace.member import Member


class _Workspace(Protocol):
    disk: Disk

    @property
    def by_name(self) -> Mapping[str, Member]: ...

    def get(self, name: str) -> Member | None: ...


def definitions_for(
    workspace: _Workspace | None = None, prefixes: Sequence[str] | None = None
) -> Definitions:
    """Return the definitions in a workspace, in installed packages and in the bundle.

    Args:
        workspace: The packages that are checked or generated together.
        prefixes: The install prefixes; ``None``: those of ``AMENT_PREFIX_PATH``.
    """
    if prefixes is None:
        listed = os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep)
        prefixes = [path for path in listed if path and not _is_of_another(path)]
    sources: list[DefinitionSource] = []
    if workspace is not None:
        sources.append(WorkspaceSource(workspace))
    if prefixes:
        sources.append(PrefixSource(prefixes, workspace.disk if workspace else None))
    return Definitions([*sources, BundleSource()])


def _is_of_another(prefix: str) -> bool:
    """Return whether a prefix is an installation of a distribution other than the target."""
    name = os.path.basename(prefix.rstrip(os.sep))
    return name in distributions.NAMES and name != distributions.target().name


class WorkspaceSource:
    """The packages that are checked together."""

    def __init__(self, workspace: _Workspace) -> None:
        self._workspace = workspace
        self._by_name: dict[str, _WorkspacePackage | None] = {}

    def package(self, name: str) -> KnownPackage | None:
        """Return a package that defines interfaces."""
        if name not in self._by_name:
            package = self._workspace.get(name)
            self._by_name[name] = _WorkspacePackage.of(package) if package is not None else None
        return self._by_name[name]

    def packages(self) -> Sequence[str]:
        """Return the sorted names of the packages."""
        return sorted(name for name in self._workspace.by_name if self.package(name) is not None)


class _WorkspacePackage:
    def __init__(self, package: Member, paths: Mapping[str, Mapping[str, list[str]]]) -> None:
        self._package = package
        self._paths = paths

    @classmethod
    def of(cls, package: Member) -> _WorkspacePackage | None:
        """Return the interfaces of a package; ``None`` if it has none."""
        paths: dict[str, dict[str, list[str]]] = {kind: {} for kind in SECTIONS}
        for path in package.files:
            stem, dot, ending = path.rpartition("/")[2].rpartition(".")
            kind = path.split("/")[-2] if ending == "idl" and "/" in path else ending
            if dot and kind in SECTIONS and not is_test_data(path):
                paths[kind].setdefault(stem, []).append(path)
        return cls(package, paths) if any(paths.values()) else None

    def names(self, kind: str) -> Sequence[str] | None:
        """Return the names; a package with interfaces from elsewhere may have more."""
        return sorted(self._paths[kind]) if self._is_complete else None

    @cached_property
    def _is_complete(self) -> bool:
        """Whether all interfaces are from files in the package, and not shadowed in Python."""
        package = self._package
        if any(package.has_directory(f"{package.name}/{kind}") for kind in SECTIONS):
            return False
        try:
            calls = generations_of(package.cmake)
        except ViewError:
            return False
        return bool(calls) and all(
            call.is_complete and all(package.has(file.path) for file in call.files)
            for call in calls
        )

    def text(self, kind: str, name: str) -> Text | None:
        """Return a definition, unless it is IDL or there are several."""
        paths = self._paths[kind].get(name, [])
        standard = f"{kind}/{name}.{kind}"
        path = standard if standard in paths else paths[0] if len(paths) == 1 else ""
        if not path.endswith(f".{kind}"):
            return None
        try:
            source = self._package.source(path)
        except ViewError:
            return None
        directory = self._package.directory
        return Text(source, os.path.join(directory, path) if directory not in {"", "."} else path)
