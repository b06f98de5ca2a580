"""Where interface definitions come from: workspace, installed packages, bundle."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from typing import Protocol

from scaffold import distributions
from scaffold.files.disk import Disk
from scaffold.model.interfaces.syntax import SECTIONS
from scaffold.record import NamedTuple
from scaffold.source import Source

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


def is_test_data(path: str) -> bool:
    """Return whether a file is test data and never generated."""
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
