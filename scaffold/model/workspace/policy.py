"""Project settings that rules read, such as allowed licenses."""

from __future__ import annotations

from scaffold.record import NamedTuple


class Policy(NamedTuple):
    """The policy of a project."""

    licenses: tuple[str, ...] = ()
    """SPDX identifiers of the allowed licenses; empty for any."""
    implicit: tuple[str, ...] = ()
    """Packages, rosdep keys and Python modules that need not be declared."""
