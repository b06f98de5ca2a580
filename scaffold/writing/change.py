"""A change of a file: its state before and after, and its name in messages."""

from __future__ import annotations

import os
import stat
from collections.abc import Sequence

from scaffold.files.disk import digest
from scaffold.record import NamedTuple

_OTHER = "other"
"""The state of irregular and unreadable files."""


class Change(NamedTuple):
    """The change of one file; states are as returned by ``state``."""

    path: str
    """The path relative to the root, without symlinks; it may lead out of the root with ``..``."""
    before: str | None
    after: str | None

    def reversed(self) -> Change:
        """Return the change that undoes this one."""
        return Change(self.path, self.after, self.before)


class ChangedError(Exception):
    """A file has changed since it was read."""

    def __init__(self, path: str) -> None:
        super().__init__(path)
        self.path = path


class Replacement(NamedTuple):
    """The new content of a file."""

    path: str
    """The path relative to the root, without symlinks; it may lead out of the root with ``..``."""
    before: str | None
    """The state when it was read."""
    content: bytes | None
    """The content; ``None`` to remove the file."""
    executable: bool


def state(path: str) -> str | None:
    """Return the state of a file: its content and whether it is executable.

    ``None`` if there is no file. Anything irregular or unreadable has the state ``_OTHER``.
    """
    try:
        descriptor = os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC)
    except FileNotFoundError:
        return None
    except OSError:
        return _OTHER
    with open(descriptor, "rb") as file:
        status = os.fstat(descriptor)
        if not stat.S_ISREG(status.st_mode):
            return _OTHER
        return state_of(file.read(), status.st_mode)


def state_of(content: bytes, mode: int) -> str:
    """Return the state of a file with this content and mode."""
    return f"{digest(content)}{'+x' if mode & stat.S_IXUSR else ''}"


def join(root: str, path: str) -> str:
    """Join a path to a root, which need not exist; the path may lead out of it."""
    return os.path.normpath(os.path.join(root, *path.split("/")))


def leads_out(path: str) -> bool:
    """Return whether a relative path leads out of its root."""
    return os.path.isabs(path) or ".." in path.split("/")


def shown(root: str, path: str) -> str:
    """Return the name of a file for messages: relative to the root, unless outside."""
    return join(root, path) if leads_out(path) else path


def refusal(root: str, changed: Sequence[str], left: Sequence[str]) -> str:
    """Return the message for files that another process has changed."""
    message = f"{_names(root, changed)} changed after it was read"
    if left:
        return f"{message}; everything was undone except {_names(root, left)}, which changed too"
    return f"{message}; nothing was written; run the command again"


def _names(root: str, paths: Sequence[str]) -> str:
    """Return the names of files for a message, those of the root first."""
    inside = [path for path in paths if not leads_out(path)]
    outside = [join(root, path) for path in paths if leads_out(path)]
    return ", ".join([*([f"{', '.join(inside)} in {root}"] if inside else []), *outside])
