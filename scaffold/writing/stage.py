"""The hidden directory in which changes of a package are staged."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager, suppress

from scaffold.files import temporary
from scaffold.writing.lock import try_lock

TREE = "tree"
"""The name in a stage of a directory to be created atomically."""
JOURNAL = "journal"
NEW_JOURNAL = "journal.new"
"""The journal while it is being written."""
MARK = "mark"
"""A file that the journal identifies by its inode, which cannot be copied."""
SPARE = ".old"
"""The suffix of a replaced file where files cannot be exchanged atomically."""


class Stage:
    """A hidden directory for staged files, on the same file system as their destination."""

    def __init__(self, parent: str, path: str) -> None:
        self.parent = parent
        self.path = path

    @classmethod
    @contextmanager
    def made(cls, parent: str) -> Iterator[Stage]:
        """Create a stage in a directory, and remove it at the end of the block."""
        stage = cls(parent, os.path.join(parent, temporary.name()))
        os.mkdir(stage.path, 0o700)
        try:
            lock = try_lock(stage.path)
        except OSError:
            lock = None  # no locks on this file system: no cleanup there
        else:
            if lock is None:  # removed before it was locked
                with cls.made(parent) as another:
                    yield another
                return
        try:
            yield stage
        finally:
            if not os.path.lexists(stage.file(JOURNAL)):
                stage.remove()
            if lock is not None:
                os.close(lock)

    def file(self, name: str) -> str:
        """Return the path of a file in it."""
        return os.path.join(self.path, name)

    def follow(self, parent: str) -> None:
        """Update the path after its directory was renamed."""
        self.parent, self.path = parent, os.path.join(parent, os.path.basename(self.path))

    def remove(self) -> bool:
        """Remove it with the files of this module; return whether it is gone."""
        with suppress(OSError):
            names = os.listdir(self.path)
            if not all(_is_of_stage(name) for name in names):
                return False
            for name in names:
                if name == TREE:
                    shutil.rmtree(self.file(name), ignore_errors=True)
                else:
                    os.unlink(self.file(name))
            os.rmdir(self.path)
            return True
        return False


def sweep(parent: str) -> None:
    """Remove the stages of dead processes that were creating directories in ``parent``."""
    for name in temporary_names(parent):
        path = os.path.join(parent, name)
        if has_journal(parent, name):
            continue  # the stage of a package, which only its next writer may recover
        with suppress(OSError):
            descriptor = try_lock(path)
            if descriptor is not None:
                Stage(parent, path).remove()
                os.close(descriptor)


def temporary_names(directory: str) -> list[str]:
    """Return the names in a directory that may be stages."""
    try:
        names = sorted(filter(temporary.is_temporary, os.listdir(directory)))
    except OSError:
        return []
    return [name for name in names if not os.path.islink(os.path.join(directory, name))]


def has_journal(directory: str, name: str) -> bool:
    """Return whether the stage of this name has a journal: its run was interrupted."""
    return os.path.lexists(os.path.join(directory, name, JOURNAL))


def _is_of_stage(name: str) -> bool:
    """Return whether a name is one that this module uses in a stage."""
    number = name
    while number.endswith(SPARE):
        number = number.removesuffix(SPARE)
    return name in {TREE, MARK, JOURNAL, NEW_JOURNAL} or number.isdecimal()
