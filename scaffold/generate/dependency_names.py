"""Validates the names of dependencies that the user gives."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Sequence
from difflib import get_close_matches
from functools import cached_property
from typing import TYPE_CHECKING

from scaffold.changes import removed_package
from scaffold.errors import InputError
from scaffold.files.disk import Disk
from scaffold.model import catalog
from scaffold.model.workspace.rosdep import RosdepKeys, cached_keys

if TYPE_CHECKING:
    from scaffold.diagnostic import Diagnostic

_PYTHON = "python3-"
_SHORT = 5
"""Length from which a different digit is not a typo: turtlebot4 is not turtlebot3."""
_SHORTEST = 3
_MAX_HINTS = 3

_RULES = frozenset({"dependency-misspelled", "dependency-of-ros1", "dependency-unresolvable"})
"""The rules about names; they do not know the workspace of a new package."""


def notes(names: Iterable[str], origin: str, directory: str) -> Iterator[str]:
    """Yield a note for each name that is unknown on this machine.

    Args:
        names: The dependencies.
        origin: Where the user named them, for messages.
        directory: Where the package will be; the packages around it are known.

    Raises:
        InputError: a name is certainly wrong: misspelled, from ROS 1, or one
            that rosdep's cache lacks.
    """
    surroundings = _Here(directory)
    for name in names:
        if name in _names() or surroundings.has(name):
            continue
        heir = catalog.ROS1_PACKAGES.get(name)
        if heir:
            raise InputError(f"{origin}: {name!r} is from ROS 1; ROS 2 has {heir} instead")
        change = removed_package(name)
        if change is not None:
            raise InputError(f"{origin}: {name!r} {change.state}; {change.advice}")
        resolves = surroundings.rosdep.resolves(name) if surroundings.rosdep is not None else None
        if resolves:
            continue
        slips = [
            other for other in sorted({*_names(), *surroundings.packages}) if _is_slip(name, other)
        ]
        hints = slips or get_close_matches(
            name, {*_names(), *surroundings.packages}, _MAX_HINTS, 0.75
        )
        hint = f"; did you mean {' or '.join(map(repr, hints[:_MAX_HINTS]))}?" if hints else ""
        if slips or resolves is False:
            raise InputError(f"{origin}: there is no package or rosdep key {name!r}{hint}")
        yield (
            f"{name!r} is not a package of the workspace, not installed and not widely "
            f"known{hint or ';'} "
            "`rosdep resolve` shows whether it can be installed"
        )


def is_about(diagnostic: Diagnostic, names: Sequence[str]) -> bool:
    """Return whether the checker only doubts a name that `notes` has accepted."""
    return diagnostic.name in _RULES and any(repr(name) in diagnostic.message for name in names)


_NAMES: set[str] = set()


def _names() -> set[str]:
    """Return the names that are known everywhere: common packages and keys of Python modules."""
    if not _NAMES:
        _NAMES.update(catalog.ROS_PACKAGES, catalog.BUILD_TOOLS, catalog.module_keys())
    return _NAMES


def _is_slip(name: str, other: str) -> bool:
    """Return whether a name differs from another one by a typo only."""
    if name.startswith(_PYTHON) and other.startswith(_PYTHON):
        # Short names of Python modules are similar by chance: pip, pil.
        return catalog.is_near(name.removeprefix(_PYTHON), other.removeprefix(_PYTHON))
    if catalog.is_near(name, other):
        return True
    return _SHORTEST <= len(name) < _SHORT and catalog.is_one_slip(name, other)


class _Here:
    """The packages and rosdep keys of the machine and the workspace."""

    def __init__(self, directory: str) -> None:
        self._directory = directory

    def has(self, name: str) -> bool:
        """Return whether a package is installed, or in the workspace."""
        prefixes = os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep)
        paths = (
            os.path.join(prefix, "share", name, "package.xml") for prefix in prefixes if prefix
        )
        return any(map(os.path.isfile, paths)) or name in self.packages

    @cached_property
    def packages(self) -> frozenset[str]:
        """The names of the packages of the workspace, and of those next to the new one."""
        from scaffold.generate import destination
        from scaffold.model.package import Package

        neighbors = destination.neighbors(os.path.realpath(self._directory))
        return frozenset(Package.at(directory).name or "" for directory in neighbors)

    @cached_property
    def rosdep(self) -> RosdepKeys | None:
        """The keys of rosdep's cache, if the machine has one."""
        return cached_keys(Disk())
