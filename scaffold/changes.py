"""What distributions removed, deprecated or changed: ``scaffold/data/changes.toml``.

The keys of an entry: ``removed`` and ``deprecated`` are the first distributions for which this is
true, and ``changed`` is the first one with the new meaning. ``use`` is the last component of the
replacement, in which ``*`` is the text that the ``*`` at the end of the old name matched. ``since``
is the first distribution that has the replacement (if absent, all have it), or for a call, the
first one that accepts the argument. ``advice`` is text for the user. With ``having`` or
``without``, an entry is about calls with or without that argument. ``numpy.dtype.name`` is the
string ``"name"`` used as a dtype.
"""

from __future__ import annotations

import os
from functools import cache
from typing import Any

from scaffold import distributions, toml
from scaffold.distributions import Distribution, named
from scaffold.record import NamedTuple

_FILE = "changes.toml"
EARLIEST = distributions.ORDER[0]


class Change(NamedTuple):
    """A name or a call that was removed, deprecated or changed."""

    names: tuple[str, ...]
    """Full names; a last one may end in ``*``."""
    removed: Distribution | None
    deprecated: Distribution | None
    changed: Distribution | None
    use: str
    since: Distribution
    advice: str
    source: str
    """The origin: a repository and the number of a pull request, or a release."""
    having: str = ""
    """The keyword that affected calls have."""
    position: int | None = None
    """Its position; ``None`` if it is keyword-only."""
    value: str = ""
    """The source of its value in affected calls; empty for any."""
    without: str = ""
    """The keyword that affected calls lack."""
    raises: str = ""
    """The exception of affected calls; code that catches it is prepared for the change."""
    is_of_node: bool = False
    """Whether only calls with a node, or a method of one, are affected."""
    unless: str = ""
    """A word in files that are prepared for the change."""

    @property
    def is_of_call(self) -> bool:
        """Whether it is about calls with or without an argument; the name itself is unchanged."""
        return bool(self.having or self.without)

    @property
    def is_removed(self) -> bool:
        """Whether it is removed on the target."""
        return _is_past(self.removed)

    @property
    def is_deprecated(self) -> bool:
        """Whether it is deprecated on the target."""
        return not self.is_removed and _is_past(self.deprecated)

    @property
    def is_changed(self) -> bool:
        """Whether its meaning on the target differs from that on the source distribution."""
        origin = distributions.origin()
        if origin is None or self.changed is None or origin.place < self.since.place:
            return False
        return origin.place < self.changed.place <= distributions.target().place

    @property
    def has_replacement(self) -> bool:
        """Whether the replacement exists on the target and the kept distributions."""
        kept = distributions.kept()
        lowest = min(distribution.place for distribution in (distributions.target(), *kept))
        return bool(self.use) and self.since.place <= lowest

    @property
    def state(self) -> str:
        """The description of the change, for a message."""
        if self.is_removed and self.removed is not None:
            return f"was removed in {self.removed.title}"
        if self.deprecated is None:
            return ""
        last = f", and {self.removed.title} removes it" if self.removed is not None else ""
        return f"is deprecated since {self.deprecated.title}{last}"

    def instead(self, replacement: str) -> str:
        """Return the advice, for a message.

        Args:
            replacement: The replacement; empty if there is none.
        """
        if not replacement:
            return self.advice
        if self.has_replacement:
            return f"use {replacement}"
        use = f"use {replacement}, which is new in {self.since.title}"
        older = [item for item in distributions.kept() if item.place < self.since.place]
        if not older:
            return f"{use}: older ones need a branch"
        return f"{use}: nothing suits {distributions.titles(older)} as well, so write a branch"


def _is_past(first: Distribution | None) -> bool:
    return first is not None and first.place <= distributions.target().place


@cache
def _entries() -> dict[str, list[dict[str, Any]]]:
    return toml.read_toml(os.path.join(distributions.DATA, _FILE))


@cache
def of_kind(kind: str) -> tuple[Change, ...]:
    """Return the changes of a kind, which is the name of a table of the file."""
    return tuple(_change(entry) for entry in _entries()[kind])


def removed_name(name: str) -> Change | None:
    """Return why a name does not exist on the target.

    Args:
        name: The full name, without ``*``.
    """
    return next(
        (
            item
            for item in of_kind("name")
            if name in item.names and item.is_removed and not item.is_of_call
        ),
        None,
    )


def removed_package(name: str) -> Change | None:
    """Return why a package of an older distribution does not exist on the target."""
    return next(
        (item for item in of_kind("package") if name in item.names and item.is_removed), None
    )


def of_program(name: str) -> Change:
    """Return the change for users who start a program.

    Args:
        name: The name of an entry of the kind ``launch``.
    """
    return next(item for item in of_kind("launch") if item.names[0] == name)


def removed_interface(name: str) -> Change | None:
    """Return why an interface, or a field of one, does not exist on the target.

    Args:
        name: ``package/msg/Name``, or that with ``.field``.
    """
    return next(
        (item for item in of_kind("interface") if item.names[0] == name and item.is_removed), None
    )


def _change(entry: dict[str, Any]) -> Change:
    def when(key: str) -> Distribution | None:
        return named(entry[key], _FILE) if key in entry else None

    names = entry.get("names") or [entry.get("name") or entry["function"]]
    return Change(
        tuple(names),
        when("removed"),
        when("deprecated"),
        when("changed"),
        entry.get("use", ""),
        named(entry.get("since", EARLIEST), _FILE),
        entry.get("advice", ""),
        entry["source"],
        entry.get("having", ""),
        entry.get("position"),
        entry.get("value", ""),
        entry.get("without", ""),
        entry.get("raises", ""),
        entry.get("of_node", False),
        entry.get("unless", ""),
    )
