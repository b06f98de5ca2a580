"""Reads TOML, on every supported Python."""

from __future__ import annotations

import sys
from typing import Any

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

TOMLDecodeError = tomllib.TOMLDecodeError
loads = tomllib.loads


def read_toml(path: str) -> dict[str, Any]:
    """Return a file of data."""
    with open(path, "rb") as file:
        return tomllib.load(file)
