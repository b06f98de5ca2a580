"""The keywords of setup(), as data."""

from __future__ import annotations

import ast
from fnmatch import fnmatchcase

from scaffold.model.python.evaluation.values import UNKNOWN, Unknown
from scaffold.record import NamedTuple
from scaffold.source import Location


class Keyword(NamedTuple):
    """A keyword argument of setup()."""

    name: str
    value: object
    """The value; ``UNKNOWN`` if it cannot be evaluated."""
    node: ast.expr
    """The expression of the value; the call of setup() for a value of setup.cfg."""
    location: Location
    """The place of the value."""


class FindPackages(NamedTuple):
    """``find_packages(...)``: the packages are found at build time."""

    where: str | Unknown
    exclude: tuple[str, ...] | Unknown
    include: tuple[str, ...] | Unknown
    namespace: bool
    """Whether directories without ``__init__.py`` are included."""
    location: Location

    def leaves_out(self, name: str) -> bool | Unknown:
        """Return whether the patterns exclude a package of this name."""
        if isinstance(self.include, Unknown) or isinstance(self.exclude, Unknown):
            return UNKNOWN
        is_taken = any(fnmatchcase(name, pattern) for pattern in self.include)
        return not is_taken or any(fnmatchcase(name, pattern) for pattern in self.exclude)
