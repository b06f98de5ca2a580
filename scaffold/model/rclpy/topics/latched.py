"""Well-known latched topics, whose last message late subscribers must get."""

from __future__ import annotations

import os
from collections.abc import Mapping
from functools import cache

from scaffold.distributions import DATA

_TABLE = os.path.join(DATA, "conventions.tsv")
_LATCHED = ("latched", "transient_local")


@cache
def latched_topics() -> Mapping[str, str]:
    """Return the types of well-known topics that are transient local, by their names."""
    result: dict[str, str] = {}
    with open(_TABLE, encoding="utf-8") as file:
        for line in file:
            if not line.startswith("#"):
                type_, topic, offered, *_ = line.split("\t")
                if offered.startswith(_LATCHED):
                    result[topic] = type_.removeprefix("* ")
    return result
