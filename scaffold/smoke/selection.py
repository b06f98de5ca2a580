"""Selects the packages to run, and their dependencies to build."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from difflib import get_close_matches

from scaffold.errors import InputError
from scaffold.model.package import Package
from scaffold.source import ViewError

MOST_NAMED = 10


def named(packages: Sequence[Package], names: Sequence[str], flag: str) -> set[str]:
    """Validate names of packages and return them.

    Raises:
        InputError: there is no such package.
    """
    existing = sorted(package.name for package in packages)
    for name in names:
        if name not in existing:
            matches = get_close_matches(name, existing, 1)
            shown = ", ".join(existing[:MOST_NAMED]) + (
                ", ..." if len(existing) > MOST_NAMED else ""
            )
            hint = f"did you mean {matches[0]!r}?" if matches else f"there are {shown}"
            raise InputError(f"{flag}: there is no package {name!r}; {hint}")
    return set(names)


def with_dependencies(packages: Sequence[Package], names: Collection[str]) -> set[str]:
    """Return names of packages and of their dependencies among the given packages."""
    by_name = {package.name: package for package in packages}
    result: set[str] = set()
    waiting = [*names]
    while waiting:
        name = waiting.pop()
        if name in by_name and name not in result:
            result.add(name)
            waiting += needed_by(by_name[name])
    return result


def needed_by(package: Package) -> set[str]:
    """Return the names of the packages that a manifest declares as dependencies."""
    try:
        return {*package.manifest.declared_names}
    except ViewError:
        return set()
