"""Exit codes of ``ros2-scaffold``; ``docs/exit-codes.md`` explains them to users."""

from __future__ import annotations

CLEAN = 0
"""Done, and no findings."""

FINDINGS = 1
"""Done, and there is something the user should look at."""

USAGE_ERROR = 2
"""The user's input or environment is at fault; stderr says what, in one line."""

INTERNAL_ERROR = 3
"""A defect of this tool or of the content it comes with."""

INTERRUPTED = 130
"""Ctrl-C, as shells count it: 128 + SIGINT."""

BROKEN_PIPE = 141
"""The reader of the output went away, as shells count it: 128 + SIGPIPE."""
