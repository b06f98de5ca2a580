"""Released packages and their dependencies, from their manifests."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from functools import cache

from scaffold.closure import closure
from scaffold.distributions import ALIASES, DATA, target


@cache
def _lines() -> Mapping[str, str]:
    with open(os.path.join(DATA, "dependencies.txt"), encoding="utf-8") as file:
        return dict(line.split(":", 1) for line in file)


@cache
def _by_distribution() -> Mapping[tuple[str, str], str]:
    """Return the lines for some distributions only."""
    return {
        (name, distribution): brought
        for place, brought in _lines().items()
        for name, _, distributions in (place.partition(" "),)
        for distribution in distributions.split()
    }


def is_released(name: str) -> bool:
    """Return whether some distribution has a package of this name."""
    return name in _lines()


@cache
def _lacking() -> Mapping[str, Sequence[str]]:
    """Return the distributions without a rule for a name, by name."""
    with open(os.path.join(DATA, "rosdep_keys.txt"), encoding="utf-8") as file:
        lines = (line.rstrip().partition(":") for line in file)
        return {name: lacking.split() for name, _, lacking in lines}


def is_rosdep_key(name: str) -> bool:
    """Return whether rosdep had a rule for a name, on any system, when the data were written."""
    return name in _lacking()


def has_rosdep_rule(name: str) -> bool:
    """Return whether a known key or package has a rule for Ubuntu on the target."""
    distribution = ALIASES.get(target().name, target().name)
    return distribution not in _lacking().get(name, ())


def dependencies(name: str) -> Iterable[str]:
    """Return the run and export dependencies of a released package on the target.

    Another distribution is used for a package that the target does not have, as users
    build it from source.
    """
    usual = _lines().get(name, "")
    return _by_distribution().get((name, target().name), usual).split()


def transitive_dependencies(names: Iterable[str]) -> set[str]:
    """Return the transitive dependencies of declared packages."""
    return closure(names, dependencies)
