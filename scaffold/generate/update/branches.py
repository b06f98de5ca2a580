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
"""Renders the package with a given list of parts."""

_MAX_PARTS = 8
"""The maximum number of parts, as in the worst case each way to split them is rendered."""


def joined(old: Provenance, drafted: Drafted) -> Provenance:
    """Return the record with the files that the templates would have given for both branches.

    This is known if the current templates reproduce the record of each branch; otherwise
    the files have the lines of both.

    Args:
        old: The record, possibly after a merge of branches.
        drafted: Renders the package with the current templates.
    """
    parts = old.answers.get(ADD, [])
    if not old.merged or len(parts) > _MAX_PARTS:
        return old
    try:
        if any(_is_merge_of(old, drafted(ours), drafted(theirs)) for ours, theirs in _sides(parts)):
            now = drafted(parts)
            common = {path: now[path] for path in old.merged if path in now}
            lost = {path: hashes for path, hashes in old.lost.items() if path not in common}
            return old._replace(rendered={**old.rendered, **common}, lost=lost)
    except InputError:  # the parts of a single branch are invalid
        pass
    return old


def _sides(parts: Parts) -> Iterator[tuple[Parts, Parts]]:
    """Return the possible parts of the two branches: git writes common parts first."""
    for common in reversed(range(len(parts) - 1)):
        for end in range(common + 1, len(parts)):
            yield parts[:end], [*parts[:common], *parts[end:]]


def _is_merge_of(old: Provenance, ours: Mapping[str, str], theirs: Mapping[str, str]) -> bool:
    """Return whether the merged record is that of two branches with these files."""
    return all(
        {hash_of(side.get(path, "").encode()) for side in (ours, theirs)} == set(hashes)
        for path, hashes in old.merged.items()
    )
