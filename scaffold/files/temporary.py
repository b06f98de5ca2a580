"""Temporary files and directories with unpredictable names; existing ones are not reused."""

from __future__ import annotations

import os

_PREFIX = ".ros2-scaffold."
_SUFFIX = ".tmp"
_HEX_DIGITS = 32


def name() -> str:
    """Return a new name; colcon, globs and the checker skip hidden files."""
    return f"{_PREFIX}{os.urandom(_HEX_DIGITS // 2).hex()}{_SUFFIX}"


def is_temporary(name: str) -> bool:
    """Return whether ``name`` could have created this name."""
    middle = name.removeprefix(_PREFIX).removesuffix(_SUFFIX)
    is_whole = name == f"{_PREFIX}{middle}{_SUFFIX}"
    return is_whole and len(middle) == _HEX_DIGITS and set(middle) <= {*"0123456789abcdef"}


def create(path: str) -> int:
    """Create a file that only its owner can read, and return its descriptor for writing.

    Raises:
        OSError: the file cannot be created, or the name exists, even as a symlink.
    """
    flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW | os.O_CLOEXEC
    return os.open(path, flags, 0o600)
