"""Edits of files, and fixes made of them."""

from __future__ import annotations

from enum import Enum

from scaffold.record import NamedTuple


class Safety(Enum):
    """Whether a fix may change what the package does."""

    SAFE = "safe"
    """The package behaves as before, or as its author plainly intended."""
    UNSAFE = "unsafe"
    """To be reviewed by the author; only applied with ``--unsafe-fixes``."""


class Edit(NamedTuple):
    """Replace the characters from offset ``start`` to before ``end`` of a file."""

    path: str
    start: int
    end: int
    text: str


class CreateFile(NamedTuple):
    """Write a file that does not exist."""

    path: str
    text: str


class MakeExecutable(NamedTuple):
    """Set the executable bits of a file."""

    path: str


class Remove(NamedTuple):
    """Remove a file."""

    path: str


Change = Edit | CreateFile | MakeExecutable | Remove


class Fix(NamedTuple):
    """Changes that resolve a diagnostic, applied together or not at all."""

    title: str
    changes: tuple[Change, ...]
    safety: Safety = Safety.SAFE

    def __hash__(self) -> int:
        """Hash only the start: thousands of diagnostics may share one fix of a whole file."""
        return hash((self.title, self.changes[:1]))
