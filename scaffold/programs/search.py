"""Finds programs on the PATH, except in the current directory."""

from __future__ import annotations

import os


def find(name: str) -> str | None:
    """Return the path of a program, ``None`` if there is none.

    An empty or relative entry of the PATH is skipped. A surplus colon creates an empty entry.
    """
    for directory in os.environ.get("PATH", os.defpath).split(os.pathsep):
        candidate = os.path.join(directory, name)
        if os.path.isabs(directory) and os.path.isfile(candidate) and os.access(candidate, os.X_OK):
            return candidate
    return None
