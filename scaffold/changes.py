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

from scaffold import distributions
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
    """Where it was decided: a repository and the number of a pull request, or a release."""
    having: str = ""
    """The keyword with which a call is meant."""
    position: int | None = None
    """Its place among the arguments without names; ``None`` where it always has its name."""
    value: str = ""
    """What that keyword is given, as it is written; empty if that does not matter."""
    without: str = ""
    """The keyword without which a call is meant."""
    raises: str = ""
    """The exception by which a call fails now; code that catches it is ready for the change."""
    is_of_node: bool = False
    """Whether only calls are meant that are given a method of a node, or a node."""
    unless: str = ""
    """A word of files that are ready for the change."""

    @property
    def is_of_call(self) -> bool:
        """Whether it is about calls that have an argument, or lack one; the name itself stays."""
        return bool(self.having or self.without)

    @property
    def is_removed(self) -> bool:
        """Whether the target does not have it any more."""
        return _is_past(self.removed)

    @property
    def is_deprecated(self) -> bool:
        """Whether the target still has it, but deprecates it."""
        return not self.is_removed and _is_past(self.deprecated)

    @property
    def is_changed(self) -> bool:
        """Whether it means something else on the target than where the code comes from."""
        origin = distributions.origin()
        if origin is None or self.changed is None or origin.place < self.since.place:
            return False
        return origin.place < self.changed.place <= distributions.target().place

    @property
    def has_replacement(self) -> bool:
        """Whether what takes its place is on the target, and on what is to be kept."""
        kept = distributions.kept()
        lowest = min(distribution.place for distribution in (distributions.target(), *kept))
        return bool(self.use) and self.since.place <= lowest

    @property
    def state(self) -> str:
        """What happened to it, for a message."""
        if self.is_removed and self.removed is not None:
            return f"was removed in {self.removed.title}"
        if self.deprecated is None:
            return ""
        last = f", and {self.removed.title} removes it" if self.removed is not None else ""
        return f"is deprecated since {self.deprecated.title}{last}"

    def instead(self, replacement: str) -> str:
        """Return what to do, for a message.

        Args:
            replacement: The name that takes its place; empty if there is none.
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
    return distributions.read_toml(os.path.join(distributions.DATA, _FILE))


@cache
def of_kind(kind: str) -> tuple[Change, ...]:
    """Return the changes of a kind, which is the name of a table of the file."""
    return tuple(_change(entry) for entry in _entries()[kind])


def removed_name(name: str) -> Change | None:
    """Return why the target does not have a name.

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
    """Return why the target does not have a package that an older distribution has."""
    return next(
        (item for item in of_kind("package") if name in item.names and item.is_removed), None
    )


def of_program(name: str) -> Change:
    """Return what changed for those who start a program.

    Args:
        name: What an entry of the kind ``launch`` has as its name.
    """
    return next(item for item in of_kind("launch") if item.names[0] == name)


def removed_interface(name: str) -> Change | None:
    """Return why the target does not have an interface, or a field of one.

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
