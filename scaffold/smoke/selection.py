"""Selects the packages to run, and those to build because others need them."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from difflib import get_close_matches

from scaffold.errors import InputError
from scaffold.model.package import Package
from scaffold.source import ViewError

MOST_NAMED = 10


def named(packages: Sequence[Package], names: Sequence[str], flag: str) -> set[str]:
    """Return names that are those of packages.

    Raises:
        InputError: there is no such package.
    """
    known = sorted(package.name for package in packages)
    for name in names:
        if name not in known:
            near = get_close_matches(name, known, 1)
            shown = ", ".join(known[:MOST_NAMED]) + (", ..." if len(known) > MOST_NAMED else "")
            hint = f"did you mean {near[0]!r}?" if near else f"there are {shown}"
            raise InputError(f"{flag}: there is no package {name!r}; {hint}")
    return set(names)


def with_dependencies(packages: Sequence[Package], names: Collection[str]) -> set[str]:
    """Return names of packages and of all that they need, as far as it is among the packages."""
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
