"""Where interface definitions come from: workspace, installed packages, bundle."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Protocol

from scaffold import distributions
from scaffold.files.disk import Disk
from scaffold.model.cmake.rosidl import generations
from scaffold.model.interfaces.syntax import SECTIONS
from scaffold.record import NamedTuple
from scaffold.source import Source, ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package
    from scaffold.model.workspace.workspace import Workspace


MAX_BYTES = 500_000
"""The size limit of a definition; the largest released one has 20 kB."""


class Text(NamedTuple):
    """The text of a definition."""

    source: Source
    origin: str
    """Its origin, for messages: a path, or package, version and distribution."""


class KnownPackage(Protocol):
    """A package whose interfaces are known."""

    def names(self, kind: str) -> Sequence[str] | None:
        """Return the sorted names of a kind; ``None`` if there may be more."""

    def text(self, kind: str, name: str) -> Text | None:
        """Return a definition; ``None`` if there is no readable one."""


class DefinitionSource(Protocol):
    """A place with packages."""

    def package(self, name: str) -> KnownPackage | None:
        """Return a package that defines interfaces; ``None`` if there is none of this name."""

    def packages(self) -> Sequence[str]:
        """Return the sorted names of the packages."""


# -- the workspace


class WorkspaceSource:
    """The packages that are checked together."""

    def __init__(self, workspace: Workspace) -> None:
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
    def __init__(self, package: Package, paths: Mapping[str, Mapping[str, list[str]]]) -> None:
        self._package = package
        self._paths = paths

    @classmethod
    def of(cls, package: Package) -> _WorkspacePackage | None:
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
            calls = generations(package)
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


def is_test_data(path: str) -> bool:
    """Tell whether a file is test data and never generated."""
    return not {"test", "tests", "testing", "templates"}.isdisjoint(path.split("/")[:-1])


# -- installed packages


class PrefixSource:
    """The packages installed below the prefixes of ``AMENT_PREFIX_PATH``."""

    def __init__(self, prefixes: Sequence[str], disk: Disk | None = None) -> None:
        self._prefixes = prefixes
        self._disk = disk or Disk()
        self._by_name: dict[str, _InstalledPackage | None] = {}

    def package(self, name: str) -> KnownPackage | None:
        """Return an installed package that defines interfaces."""
        if name not in self._by_name:
            self._by_name[name] = next(self._installed(name), None)
        return self._by_name[name]

    def _installed(self, name: str) -> Iterator[_InstalledPackage]:
        if not name or os.sep in name or name in {".", ".."}:
            return
        for prefix in self._prefixes:
            share = os.path.join(prefix, "share", name)
            if any(self._disk.is_directory(os.path.join(share, kind)) for kind in SECTIONS):
                yield _InstalledPackage(share, self._disk)

    def packages(self) -> Sequence[str]:
        """Return the sorted names of the packages, as registered in the ament index."""
        result: set[str] = set()
        for prefix in self._prefixes:
            index = os.path.join(prefix, "share", "ament_index", "resource_index")
            result.update(self._disk.entries(os.path.join(index, "rosidl_interfaces")))
        return sorted(name for name in result if self.package(name) is not None)


class _InstalledPackage:
    def __init__(self, share: str, disk: Disk) -> None:
        self._share = share
        self._disk = disk
        self._names: dict[str, Sequence[str]] = {}

    def names(self, kind: str) -> Sequence[str] | None:
        if kind not in self._names:
            endings = (f".{kind}", ".idl")
            files = self._disk.entries(os.path.join(self._share, kind))
            stems = {file.rpartition(".")[0] for file in files if file.endswith(endings)}
            self._names[kind] = sorted(stems)
        return self._names[kind]

    def text(self, kind: str, name: str) -> Text | None:
        if name not in (self.names(kind) or ()):
            return None
        path = os.path.join(self._share, kind, f"{name}.{kind}")
        try:
            text = self._disk.read(path, MAX_BYTES).decode()
        except (OSError, UnicodeDecodeError):
            return None
        return Text(Source(path, text.replace("\r\n", "\n").replace("\r", "\n")), path)


# -- the bundle


class BundleSource:
    """The common interfaces of the target distribution, shipped with the tool.

    The file is made by ``scripts/bundle_interfaces.py``: a line ``@ package version`` starts a
    package, a line ``= kind name`` a definition.
    """

    def __init__(self) -> None:
        self._distribution = distributions.target()
        self._by_name: dict[str, _BundledPackage] = {}

    def package(self, name: str) -> KnownPackage | None:
        """Return a package of the bundle."""
        if name not in self._by_name and name in self._chunks:
            title = self._distribution.title
            self._by_name[name] = _BundledPackage(name, self._chunks[name], title)
        return self._by_name.get(name)

    def packages(self) -> Sequence[str]:
        """Return the sorted names of the packages."""
        return sorted(self._chunks)

    @cached_property
    def _chunks(self) -> Mapping[str, str]:
        with open(self._distribution.path("interfaces.txt"), encoding="utf-8") as file:
            chunks = file.read().split("\n@ ")[1:]
        return {chunk.partition(" ")[0]: chunk for chunk in chunks}


class _BundledPackage:
    def __init__(self, name: str, chunk: str, title: str) -> None:
        head, *definitions = chunk.split("\n= ")
        self._origin = f"{name} {head.partition(' ')[2]} of ROS 2 {title}"
        self._path = f"share/{name}"
        self._texts: dict[str, dict[str, str]] = {kind: {} for kind in SECTIONS}
        for definition in definitions:
            title, _, text = definition.partition("\n")
            kind, _, interface = title.partition(" ")
            self._texts[kind][interface] = text

    def names(self, kind: str) -> Sequence[str] | None:
        return sorted(self._texts[kind])

    def text(self, kind: str, name: str) -> Text | None:
        text = self._texts[kind].get(name)
        if text is None:
            return None
        return Text(Source(f"{self._path}/{kind}/{name}.{kind}", text), self._origin)
