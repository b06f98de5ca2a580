"""A finding of ``doctor``."""

from __future__ import annotations

from scaffold.diagnostic import Severity
from scaffold.record import NamedTuple


class Finding(NamedTuple):
    """Something that is wrong, or worth to know, and what helps."""

    severity: Severity
    message: str
    fix: str
    """A command, with a comment where there is more to say."""
