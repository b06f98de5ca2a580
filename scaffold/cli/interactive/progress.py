"""A progress bar for long work on a terminal, removed afterward."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, NoReturn, TypeVar, final

if TYPE_CHECKING:
    from tqdm import tqdm

Item = TypeVar("Item")

_PARTS = "{desc}: {percentage:3.0f}%|{bar}| {elapsed}"
WORTH_IT = 40
"""The number of items from which a bar is shown."""


def shown(items: Iterable[Item], total: int, unit: str) -> Iterator[Item]:
    """Yield the items; a bar counts them when standard error is a terminal."""
    if total < WORTH_IT or not sys.stderr.isatty():
        yield from items
        return
    from tqdm import tqdm

    yield from tqdm(items, total=total, unit=f" {unit}", leave=False, file=sys.stderr)


@final
class Bar:
    """A bar for work in several parts of unknown length.

    It is a context manager: the bar is removed at its end.
    """

    def __init__(self) -> None:
        self._bar: tqdm[NoReturn] | None = None

    def begin(self, label: str, total: int) -> None:
        """Start another part of the work."""
        if not sys.stderr.isatty():
            return
        if self._bar is None:
            from tqdm import tqdm

            self._bar = tqdm(
                desc=label, leave=False, file=sys.stderr, bar_format=_PARTS, mininterval=0.2
            )
        self._bar.set_description(label, refresh=False)
        self._bar.reset(total)

    def step(self) -> None:
        """Count one of the total as done."""
        if self._bar is not None:
            self._bar.update()

    def __enter__(self) -> Bar:
        return self

    def __exit__(self, *details: object) -> None:
        if self._bar is not None:
            self._bar.close()
            self._bar = None
