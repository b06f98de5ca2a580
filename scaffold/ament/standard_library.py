"""The standard library modules of a Python version, as the linters look them up."""

from __future__ import annotations

from functools import cache

from scaffold import distributions
from scaffold.distributions import Distribution


def of_target() -> frozenset[str]:
    """Return the names of the modules: ``sys.stdlib_module_names`` of that Python."""
    return modules(distributions.target())


@cache
def modules(distribution: Distribution) -> frozenset[str]:
    """Return the same for a distribution."""
    with open(distribution.path("standard_library.txt"), encoding="utf-8") as file:
        return frozenset(file.read().split())
