"""A finding of ``doctor``."""

from __future__ import annotations

from scaffold.diagnostic import Severity
from scaffold.record import NamedTuple


class Finding(NamedTuple):
    """A problem or a hint, with its remedy."""

    severity: Severity
    message: str
    fix: str
    """A command, possibly with a comment."""
