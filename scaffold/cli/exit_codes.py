"""Exit codes of ``ros2-scaffold``; ``docs/exit-codes.md`` explains them to users."""

from __future__ import annotations

CLEAN = 0
"""Done, and no findings."""

FINDINGS = 1
"""Done, with findings."""

USAGE_ERROR = 2
"""An error in the user's input or environment; stderr has one line about it."""

INTERNAL_ERROR = 3
"""A defect of this tool or of the content it comes with."""

INTERRUPTED = 130
"""Ctrl-C, as in shells: 128 + SIGINT."""

BROKEN_PIPE = 141
"""The reader closed the output, as in shells: 128 + SIGPIPE."""
