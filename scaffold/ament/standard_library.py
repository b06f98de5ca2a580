"""The modules of the standard library of the target's Python, where its linters ask for them."""

from __future__ import annotations

from functools import cache

from scaffold import distributions
from scaffold.distributions import Distribution


def modules() -> frozenset[str]:
    """Return the names of the modules: ``sys.stdlib_module_names`` of that Python."""
    return _modules(distributions.target())


@cache
def _modules(distribution: Distribution) -> frozenset[str]:
    with open(distribution.path("standard_library.txt"), encoding="utf-8") as file:
        return frozenset(file.read().split())
