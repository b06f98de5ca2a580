"""The Python style linters of the target distribution, with their versions.

They are in ``[linters]`` in the profile of a distribution. Checks whose behavior changed ask for
the version of a linter, or whether a plugin is installed.
"""

from __future__ import annotations

from collections.abc import Mapping

from scaffold import distributions
from scaffold.distributions import Distribution
from scaffold.record import NamedTuple


class Linters(NamedTuple):
    """The linters of a distribution."""

    versions: Mapping[str, tuple[int, ...]]
    """The versions by package."""
    python: tuple[int, int]
    """The Python version that they run on, which affects strings and builtins."""

    def has(self, name: str) -> bool:
        """Return whether a linter or plugin is installed."""
        return name in self.versions

    def since(self, name: str, *version: int) -> bool:
        """Return whether a linter is installed in at least a version."""
        return self.versions.get(name, ()) >= version

    @property
    def identity(self) -> str:
        """A key for cached results."""
        return f"{self.python}{sorted(self.versions.items())}"


_OF: dict[Distribution, Linters] = {}


def of_target() -> Linters:
    """Return the linters of the target."""
    return of(distributions.target())


def of(distribution: Distribution) -> Linters:
    """Return the linters of a distribution."""
    if distribution not in _OF:
        versions = {
            name: tuple(map(int, version.split(".")))
            for name, version in distribution.fact("linters").items()
        }
        _OF[distribution] = Linters(versions, distribution.python)
    return _OF[distribution]
