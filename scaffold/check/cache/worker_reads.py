"""Transfers what a worker process read about packages to its parent process."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from scaffold.files.tree import DiskTree
from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from scaffold.files.disk import Answer, Disk, Question
    from scaffold.model.package import Identity, Package


class _Seen(NamedTuple):
    """The content of a Disk."""

    seen: Mapping[Question, Answer]
    is_settled: bool

    @classmethod
    def taken_from(cls, disk: Disk) -> _Seen:
        """Return the accesses since the last call."""
        result = cls(disk.seen, disk.is_settled)
        disk.seen = {}
        return result


class WorkerReads(NamedTuple):
    """What a worker read about a package; packages are indices into a list."""

    at: int
    inside: _Seen
    outside: _Seen
    identity: Identity | None
    used: tuple[int, ...]
    uses_all: bool
    uses_interfaces: bool
    is_repeatable: bool

    @property
    def tells_anything(self) -> bool:
        """Return whether there is anything to transfer."""
        looked = self.inside.seen or self.outside.seen or self.used
        return bool(looked or self.uses_all or self.uses_interfaces or not self.is_repeatable)

    def add_to(self, packages: Sequence[Package]) -> None:
        """Add the accesses of the worker to the package of this process."""
        package = packages[self.at]
        disk_of(package).note(self.inside.seen, is_settled=self.inside.is_settled)
        package.outside.note(self.outside.seen, is_settled=self.outside.is_settled)
        package.is_repeatable &= self.is_repeatable
        if self.identity is not None:
            package.identify(self.identity)
        around = package.workspace
        around.used.update((id(packages[at]), packages[at]) for at in self.used)
        around.uses_all |= self.uses_all
        around.uses_interfaces |= self.uses_interfaces


def take(packages: Sequence[Package]) -> Iterator[WorkerReads]:
    """Yield and forget the accesses since the last call."""
    places = {id(package): at for at, package in enumerate(packages)}
    for at, package in enumerate(packages):
        used, uses_all, uses_interfaces = uses(package, places)
        note = WorkerReads(
            at,
            _Seen.taken_from(disk_of(package)),
            _Seen.taken_from(package.outside),
            package.known_identity,
            tuple(used),
            uses_all,
            uses_interfaces,
            package.is_repeatable,
        )
        package.workspace.used.clear()
        if note.tells_anything:
            yield note


def uses(package: Package, places: Mapping[int, int]) -> tuple[set[int], bool, bool]:
    """Return the indices of the packages that one looked up, and whether all or interfaces.

    Packages without an index, which are not checked themselves, are looked
    through: accesses in them are recorded, but they may in turn have used others.
    """
    result: set[int] = set()
    uses_all = uses_interfaces = False
    seen = {id(package)}
    pending = [package]
    while pending:
        around = pending.pop().workspace
        uses_all |= around.uses_all
        uses_interfaces |= around.uses_interfaces
        for key, used in around.used.items():
            if key in places:
                result.add(places[key])
            elif key not in seen:
                seen.add(key)
                pending.append(used)
    return result, uses_all, uses_interfaces


def disk_of(package: Package) -> Disk:
    """Return the accesses in a package on disk, also below changes in memory."""
    tree = getattr(package.tree, "base", package.tree)
    assert isinstance(tree, DiskTree)  # noqa: S101  discovery makes no others
    return tree.disk
