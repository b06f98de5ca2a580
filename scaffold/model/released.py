"""Released packages and their dependencies, from their manifests."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from functools import cache

from scaffold.distributions import DATA, target


@cache
def _lines() -> Mapping[str, str]:
    with open(os.path.join(DATA, "dependencies.txt"), encoding="utf-8") as file:
        return dict(line.split(":", 1) for line in file)


@cache
def _by_distribution() -> Mapping[tuple[str, str], str]:
    """Return the lines that hold for some distributions only."""
    return {
        (name, distribution): brought
        for place, brought in _lines().items()
        for name, _, distributions in (place.partition(" "),)
        for distribution in distributions.split()
    }


def is_released(name: str) -> bool:
    """Tell whether some distribution has a package of this name."""
    return name in _lines()


def dependencies(name: str) -> Iterable[str]:
    """Return what a released package depends on when it runs or exports, on the target.

    What another distribution has stands in for a package that the target does not have: people
    build it from source.
    """
    usual = _lines().get(name, "")
    return _by_distribution().get((name, target().name), usual).split()


def transitive_dependencies(names: Iterable[str]) -> set[str]:
    """Return what comes along with declared packages, on every machine that has these."""
    result: set[str] = set()
    pending = list(names)
    while pending:
        brought = set(dependencies(pending.pop())) - result
        result |= brought
        pending += brought
    return result
