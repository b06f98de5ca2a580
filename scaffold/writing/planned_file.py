"""A file in a plan, and the effect of writing it."""

from __future__ import annotations

from enum import Enum

from scaffold.record import NamedTuple


class State(Enum):
    """The effect of writing a file."""

    NEW = "new"
    """There is no such file."""
    DIFFERING = "differing"
    """There is one with other content, or without its executable bits."""
    SAME = "same"
    """The file exists with the same content."""
    REMOVED = "removed"
    """The file is to go."""


class PlannedFile(NamedTuple):
    """One file of a plan."""

    path: str
    """Relative to the root, with ``/`` between the parts."""
    target: str
    """Where its content really is: links are followed, as long as they stay inside the root."""
    content: bytes
    executable: bool
    """Whether it gets executable bits; the bits that a file has are kept."""
    state: State
    before: bytes | None
    """What it holds when the plan is made; ``None`` for a new file."""
    seen: str | None
    """The same with its executable bit, to be compared before the file is replaced."""

    @property
    def is_removed(self) -> bool:
        """Whether the file is to go."""
        return self.state is State.REMOVED
