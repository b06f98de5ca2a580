"""The packages of a workspace by name, and the dependencies of results on them."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Generic

from scaffold.files.disk import Disk
from scaffold.model.workspace.member import AnyMember
from scaffold.model.workspace.policy import Policy

if TYPE_CHECKING:
    from scaffold.model.interfaces.definitions import Definitions
    from scaffold.model.workspace.member import Member, Neighbors
    from scaffold.model.workspace.rosdep import RosdepKeys


class Workspace(Generic[AnyMember]):
    """The packages of a workspace, with their declarations and definitions."""

    def __init__(
        self,
        packages: Iterable[AnyMember] = (),
        disk: Disk | None = None,
        policy: Policy | None = None,
    ) -> None:
        self._packages = list(packages)
        self.policy = policy or Policy()
        """The settings of the configuration that rules use."""
        self.disk = disk or Disk()
        """Records accesses outside of the packages."""
        self.around: Neighbors[AnyMember] | None = None
        """The unchecked packages of the same workspace on disk."""
        self._near: dict[str, Workspace[AnyMember]] = {}

    def add(self, package: AnyMember) -> None:
        """Add a package, before the first use of the workspace."""
        self._packages.append(package)

    def forget(self) -> None:
        """Drop data derived from the packages, after the files of one have changed."""
        for name in ("all_by_name", "by_name", "interfaces"):
            self.__dict__.pop(name, None)
        self._near.clear()
        for package in self._packages:
            package.forget()
            package.forget_others()

    def __iter__(self) -> Iterator[AnyMember]:
        return iter(self._packages)

    @cached_property
    def all_by_name(self) -> Mapping[str, list[AnyMember]]:
        """The packages by the name in their manifest."""
        result: dict[str, list[AnyMember]] = {}
        for package in self._packages:
            result.setdefault(package.name, []).append(package)
        return result

    @cached_property
    def by_name(self) -> Mapping[str, AnyMember]:
        """The packages by the name in their manifest; the first of a name wins."""
        return {name: packages[0] for name, packages in self.all_by_name.items()}

    def get(self, name: str) -> AnyMember | None:
        """Return the package with a name, if it is in the workspace."""
        package = self.by_name.get(name)
        return self.around.get(name) if package is None and self.around is not None else package

    def near(self, directory: str) -> Workspace[AnyMember]:
        """Return the workspace with the closest package of each name.

        A repository may have several workspaces with packages of the same name.
        """
        if len(self.by_name) == len(self._packages):
            return self
        if directory not in self._near:
            closest: dict[str, AnyMember] = {}
            for package in self._packages:
                other = closest.get(package.name)
                if other is None or _shared(package, directory) > _shared(other, directory):
                    closest[package.name] = package
            near = self._near[directory] = Workspace(closest.values(), self.disk, self.policy)
            near.around = self.around
        return self._near[directory]

    @cached_property
    def interfaces(self) -> Definitions:
        """The interfaces that these packages can use; their own come first."""
        from scaffold.model.workspace.definitions import definitions_for

        return definitions_for(self)

    @cached_property
    def rosdep(self) -> RosdepKeys | None:
        """The rosdep keys of this machine; ``None`` if unknown."""
        from scaffold.model.workspace.rosdep import cached_keys

        return cached_keys(self.disk)


def _shared(package: Member, directory: str) -> int:
    """Return the length of the common path of a package and a directory."""
    try:
        return len(os.path.commonpath((package.directory, directory)))
    except ValueError:  # an absolute and a relative path
        return 0


class WorkspaceView(Generic[AnyMember]):
    """The workspace as seen by one of its packages; records which others it uses.

    Args:
        workspace: The workspace.
        directory: The directory of the package.
    """

    def __init__(self, workspace: Workspace[AnyMember], directory: str) -> None:
        self._workspace = workspace
        self._directory = directory
        self.used: dict[int, AnyMember] = {}
        """The packages that were looked up, by identity, including unchecked ones."""
        self.uses_all = False
        self.uses_interfaces = False
        """Whether interface definitions of any package were looked up."""

    def get(self, name: str) -> AnyMember | None:
        """Return the package with a name, if it is in the workspace."""
        result = self._workspace.near(self._directory).get(name)
        if result is not None:
            self.used[id(result)] = result
        return result

    def __iter__(self) -> Iterator[AnyMember]:
        self.uses_all = True
        yield from self._workspace.near(self._directory)
        yield from self._workspace.around or ()

    def forget(self) -> None:
        """Drop data derived from the packages, but keep the recorded uses."""
        self.__dict__.pop("interfaces", None)

    def is_hidden(self, package: AnyMember) -> bool:
        """Return whether another package of the workspace with the same name takes precedence."""
        return self._workspace.get(package.name) not in {None, package}

    def namesakes(self, package: AnyMember) -> list[AnyMember]:
        """Return the other checked packages with the name of a package."""
        others = self._workspace.all_by_name.get(package.name, ())
        return [other for other in others if other.directory != package.directory]

    @property
    def names(self) -> list[str]:
        """The sorted names of the packages, which are part of the cache key of every package."""
        around = self._workspace.around
        return sorted({*self._workspace.by_name, *(around.directories if around else ())})

    @property
    def policy(self) -> Policy:
        """The settings of the configuration that rules use."""
        return self._workspace.policy

    @property
    def disk(self) -> Disk:
        """Records accesses outside of the packages."""
        return self._workspace.disk

    @property
    def rosdep(self) -> RosdepKeys | None:
        """The rosdep keys of this machine; ``None`` if unknown."""
        return self._workspace.rosdep

    @cached_property
    def interfaces(self) -> Definitions:
        """The interfaces that these packages can use."""
        from scaffold.model.interfaces.definitions import WatchedDefinitions

        def tell() -> None:
            self.uses_interfaces = True

        return WatchedDefinitions(self._workspace.near(self._directory).interfaces, tell)
