"""The target distribution of ROS 2 and its properties."""

from __future__ import annotations

from scaffold.changes import (
    Change,
    of_kind,
    of_program,
    removed_interface,
    removed_name,
    removed_package,
)
from scaffold.distributions import ENDED, NAMES, Distribution, target

__all__ = [
    "ENDED",
    "NAMES",
    "Change",
    "Distribution",
    "of_kind",
    "of_program",
    "removed_interface",
    "removed_name",
    "removed_package",
    "target",
]
