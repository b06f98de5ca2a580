"""Former codes of rules that were merged into others or moved to another area."""

from __future__ import annotations

import os
from functools import cache

from scaffold.distributions import DATA

_FILE = os.path.join(DATA, "renamed_codes.txt")


@cache
def renamed_codes() -> dict[str, str]:
    """Return the current codes by former ones."""
    with open(_FILE, encoding="utf-8") as file:
        return dict(line.split() for line in file if not line.startswith("#"))


def new_codes(prefix: str) -> list[str]:
    """Return the codes that replace former ones with a prefix, two letters and some digits."""
    if not prefix[2:].isdigit():
        return []
    return sorted({new for old, new in renamed_codes().items() if old.startswith(prefix)})
