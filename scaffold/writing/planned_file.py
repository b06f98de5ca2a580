"""A file in a plan, and the effect of writing it."""

from __future__ import annotations

from enum import Enum

from scaffold.record import NamedTuple


class State(Enum):
    """The effect of writing a file."""

    NEW = "new"
    """There is no such file."""
    DIFFERING = "differing"
    """The file has other content, or lacks its executable bits."""
    SAME = "same"
    """The file exists with the same content."""
    REMOVED = "removed"
    """The file will be removed."""


class PlannedFile(NamedTuple):
    """One file of a plan."""

    path: str
    """The path relative to the root, with ``/`` as separator."""
    target: str
    """The real path: symlinks are followed within the root."""
    content: bytes
    executable: bool
    """Whether to set executable bits; existing bits are kept."""
    state: State
    before: bytes | None
    """The content at planning time; ``None`` for a new file."""
    seen: str | None
    """The state at planning time, to be compared before the file is replaced."""

    @property
    def is_removed(self) -> bool:
        """Whether the file will be removed."""
        return self.state is State.REMOVED
