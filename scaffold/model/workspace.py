"""The packages of a workspace, by name."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from functools import cached_property
from typing import TYPE_CHECKING

from scaffold.model.disk import Disk

if TYPE_CHECKING:
    from scaffold.model.interfaces import Definitions
    from scaffold.model.package import Package


class Workspace:
    """What the packages around one declare and define."""

    def __init__(self, packages: Iterable[Package] = (), disk: Disk | None = None) -> None:
        self._packages = list(packages)
        self.disk = disk or Disk()
        """What is looked at outside of the packages."""

    def add(self, package: Package) -> None:
        """Add a package; only before the first look at the workspace."""
        self._packages.append(package)

    def __iter__(self) -> Iterator[Package]:
        return iter(self._packages)

    @cached_property
    def by_name(self) -> Mapping[str, Package]:
        """The packages by the name in their manifest; the first of a name wins."""
        found: dict[str, Package] = {}
        for package in self._packages:
            found.setdefault(package.name, package)
        return found

    def get(self, name: str) -> Package | None:
        """Return the package of a name, if it is in the workspace."""
        return self.by_name.get(name)

    @cached_property
    def interfaces(self) -> Definitions:
        """The interfaces that these packages can use; their own come first."""
        from scaffold.model.interfaces import Definitions

        return Definitions.around(self)
