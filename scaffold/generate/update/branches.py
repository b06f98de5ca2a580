"""The rendered bases of a package in which two merged branches each added a part."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from scaffold.errors import InputError
from scaffold.generate.parts import ADD
from scaffold.generate.update.bases import hash_of
from scaffold.generate.update.provenance import Provenance

Parts = Sequence[Mapping[str, Any]]
Drafted = Callable[[Parts], Mapping[str, str]]
"""Renders a package with other parts than it has."""

_MOST_PARTS = 8
"""Each way to split the parts is rendered, at worst."""


def joined(old: Provenance, drafted: Drafted) -> Provenance:
    """Return the record with the files as the templates would have given them for both branches.

    That is known where the templates of today give what the record of each branch has; elsewhere
    the files keep the lines of both.

    Args:
        old: The record after a merge of branches, or any other.
        drafted: Renders the package with the templates of today.
    """
    parts = old.answers.get(ADD, [])
    if not old.merged or len(parts) > _MOST_PARTS:
        return old
    try:
        if any(_gave(old, drafted(ours), drafted(theirs)) for ours, theirs in _sides(parts)):
            now = drafted(parts)
            common = {path: now[path] for path in old.merged if path in now}
            lost = {path: hashes for path, hashes in old.lost.items() if path not in common}
            return old._replace(rendered={**old.rendered, **common}, lost=lost)
    except InputError:  # the parts of one branch alone are not accepted
        pass
    return old


def _sides(parts: Parts) -> Iterator[tuple[Parts, Parts]]:
    """Return what the two branches may have had: git writes common parts first."""
    for common in reversed(range(len(parts) - 1)):
        for end in range(common + 1, len(parts)):
            yield parts[:end], [*parts[:common], *parts[end:]]


def _gave(old: Provenance, ours: Mapping[str, str], theirs: Mapping[str, str]) -> bool:
    """Tell whether two branches with these files were merged."""
    return all(
        {hash_of(side.get(path, "").encode()) for side in (ours, theirs)} == set(hashes)
        for path, hashes in old.merged.items()
    )
