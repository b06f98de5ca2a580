"""The finding of a style check, before it becomes a diagnostic."""

from __future__ import annotations

from scaffold.record import NamedTuple

FLAKE8 = 1
"""Reported by ament_flake8."""
PEP257 = 2
"""Reported by ament_pep257."""

UNPARSABLE = "SC001"
"""The engine's own code for a file that only this tool cannot read."""
TOO_LARGE = "SC004"
"""The engine's own code for a file that is too large to be checked."""
CRASHED = "SC002"
"""The engine's own code for a defect of this tool."""
UNFOLLOWED = "SC006"
"""The engine's own code for an unsupported style configuration."""

Replacement = tuple[int, int, int, int, str]
"""Line and column of the start, of the end (both from 1, the end exclusive), and the new text."""


class Finding(NamedTuple):
    """A code at a place of one file; only plain values, so that it can be cached.

    Lines and columns count from 1, as in the text with universal newlines and without a byte
    order mark. ``end_line`` is 0 if the end is unknown.
    """

    code: str
    line: int
    column: int
    message: str = ""
    """The message; empty for the summary of the code."""
    end_line: int = 0
    end_column: int = 0
    fix: tuple[Replacement, ...] = ()
    fix_title: str = ""
    linters: int = FLAKE8
    fix_is_unsafe: bool = False
    """Whether the fix may change what the code does, or its words."""
    is_doubtful: bool = False
    """Whether the code may work nevertheless, so that it is a warning."""
