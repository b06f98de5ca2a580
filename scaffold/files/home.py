"""The user's directories for configuration and caches, by the XDG specification.

A relative directory is ignored, as it would be in the checked repository.
"""

from __future__ import annotations

import os

_NAME = "ros2-scaffold"


def configuration() -> str | None:
    """Return the directory of the user's configuration, ``None`` without a home."""
    return _directory("XDG_CONFIG_HOME", ".config")


def cache() -> str | None:
    """Return the directory of the user's cache, ``None`` without a home."""
    return _directory("XDG_CACHE_HOME", ".cache")


def _directory(variable: str, default: str) -> str | None:
    base = os.environ.get(variable, "")
    if not os.path.isabs(base):
        base = os.path.join(os.path.expanduser("~"), default)
    return os.path.join(base, _NAME) if os.path.isabs(base) else None
