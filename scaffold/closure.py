"""What follows from some items, directly or not."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable
from typing import TypeVar

Item = TypeVar("Item", bound=Hashable)


def closure(starts: Iterable[Item], following: Callable[[Item], Iterable[Item]]) -> set[Item]:
    """Return what follows from some items: what they lead to, what that leads to, and so on.

    The starts are among the results only if something leads to them.

    Args:
        starts: The items.
        following: Returns what an item leads to; called once for each.
    """
    result: set[Item] = set()
    seen = {*starts}
    pending = [*seen]
    while pending:
        items = {*following(pending.pop())}
        pending += items - seen
        seen |= items
        result |= items
    return result
