"""A progress bar where people wait: on a terminal, for long work, and gone afterwards."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator
from typing import TypeVar

Item = TypeVar("Item")

WORTH_IT = 40
"""Items from which on people would wonder whether anything happens."""


def shown(items: Iterable[Item], total: int, unit: str) -> Iterator[Item]:
    """Yield the items; a bar counts them when standard error is a terminal."""
    if total < WORTH_IT or not sys.stderr.isatty():
        yield from items
        return
    from tqdm import tqdm

    yield from tqdm(items, total=total, unit=f" {unit}", leave=False, file=sys.stderr)
