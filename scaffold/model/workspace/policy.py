"""Project settings that rules read, such as allowed licenses."""

from __future__ import annotations

from scaffold.record import NamedTuple


class Policy(NamedTuple):
    """The policy of a project."""

    licenses: tuple[str, ...] = ()
    """SPDX identifiers of the licenses that packages may have; empty for any."""
    implicit: tuple[str, ...] = ()
    """Packages, rosdep keys and Python modules that are there without being declared."""
