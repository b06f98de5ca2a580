"""The distribution of ROS 2 that packages are checked for, and what is known of it."""

from __future__ import annotations

from scaffold.changes import (
    Change,
    of_kind,
    of_program,
    removed_interface,
    removed_name,
    removed_package,
)
from scaffold.distributions import ENDED, NAMES, Distribution, refusal, target

__all__ = [
    "ENDED",
    "NAMES",
    "Change",
    "Distribution",
    "of_kind",
    "of_program",
    "refusal",
    "removed_interface",
    "removed_name",
    "removed_package",
    "target",
]
