"""Changes several files of a package atomically, even if the process is killed.

New content is first written to a hidden directory, the stage, next to a journal. Each file is then
exchanged with its replacement in one atomic step of the kernel, and the replaced content is
compared with what was read. Removing the journal commits the changes; until then they can be rolled
back, by this process or by the next one that finds the journal.

Files at the root of the repository belong to the same transaction: their paths are relative to the
package, which holds the stage and the journal. All of them must be on one file system: otherwise
the first rename fails and nothing is written.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress

from scaffold.errors import ConflictError
from scaffold.writing import new_files
from scaffold.writing.change import Change, Replacement, join, state
from scaffold.writing.journal import Transaction
from scaffold.writing.lock import locked, try_lock
from scaffold.writing.stage import Stage, has_journal, sweep, temporary_names

RECORD = ".ros2-scaffold.json"
"""The record of a package, written last, so that it never claims too much."""
BASES = ".ros2-scaffold.bases"
"""The sidecar of the record, written just before it."""

_held: set[str] = set()
"""The directories that this process has locked."""


def _ignore(_: str) -> None:
    """Do nothing with a line."""


@contextmanager
def exclusive(directory: str, notify: Callable[[str], None] = _ignore) -> Iterator[None]:
    """Lock a package from the first read to the last write, and recover interrupted runs.

    Args:
        directory: The root of the package.
        notify: Called with a line if another process has to be waited for, and for each run that
            was interrupted.

    Raises:
        LockedError: another process holds the package for too long.
    """
    root = os.path.realpath(directory)
    if root in _held:
        yield
        return
    with locked(directory, notify):
        _held.add(root)
        try:
            _recover(root, directory, notify)
            yield
        finally:
            _held.discard(root)


def is_unfinished(directory: str) -> bool:
    """Return whether a run was interrupted while it changed a package, and not recovered since."""
    if not any(has_journal(directory, name) for name in temporary_names(directory)):
        return False
    try:
        descriptor = try_lock(os.path.realpath(directory))
    except OSError:
        return True
    if descriptor is not None:
        os.close(descriptor)
    return descriptor is not None


def replace_all(root: str, replacements: Sequence[Replacement]) -> None:
    """Change files below a locked directory.

    Args:
        root: The directory, without links.
        replacements: The replacements, one per file.

    Raises:
        ConflictError: a file has changed since it was read, or meanwhile; changes that
            were done are undone.
        OSError: the system refuses; what were done are undone.
    """
    with Stage.made(root) as stage:
        transaction = _staged(root, stage, replacements)
        transaction.refuse_changed()
        transaction.write_journal()
        transaction.run()


def appear(tree: str, root: str, around: Sequence[Replacement]) -> None:
    """Rename a new directory to its destination and change files around it, atomically.

    If the process is killed between the two, the next writer in the directory completes it.

    Args:
        tree: The directory to rename.
        root: The destination.
        around: Changes of files outside, with paths relative to the destination.

    Raises:
        ConflictError: the destination exists, or a file has changed since it was read.
        OSError: the system refuses; what were done are undone.
    """
    if not around:
        _rename_to_free_place(tree, root)
        return
    with _hidden(tree), Stage.made(tree) as stage:
        transaction = _staged(root, stage, around, is_forward=True)
        transaction.refuse_changed()
        transaction.write_journal()
        _rename_to_free_place(tree, root)
        stage.follow(root)
        try:
            transaction.run()
        except BaseException:
            os.rename(root, tree)
            stage.follow(tree)
            raise


def _rename_to_free_place(tree: str, root: str) -> None:
    if os.path.lexists(root):
        raise ConflictError(f"{root} was created in the meantime")
    os.rename(tree, root)


@contextmanager
def _hidden(tree: str) -> Iterator[None]:
    """Lock a directory as soon as it appears, on file systems with locks."""
    with suppress(OSError):
        descriptor = try_lock(tree)
        if descriptor is not None:
            try:
                yield
            finally:
                os.close(descriptor)
            return
    yield


def _staged(
    root: str, stage: Stage, replacements: Sequence[Replacement], *, is_forward: bool = False
) -> Transaction:
    """Write new content to a stage; return the changes to do."""
    last = (BASES, RECORD)
    changes: list[Change] = []
    ordered = sorted(replacements, key=lambda file: (file.path in last, file.path))
    for number, file in enumerate(ordered):
        slot = stage.file(str(number))
        if file.content is not None:
            new_files.write(
                slot,
                file.content,
                executable=file.executable,
                like=join(root, file.path),
                is_durable=True,
            )
        # Some file systems have no executable bits, so the actual mode is used.
        changes.append(Change(file.path, file.before, state(slot)))
    directories = _missing_directories(root, changes)
    return Transaction(root, stage, changes, directories, is_forward=is_forward)


def _recover(root: str, directory: str, notify: Callable[[str], None]) -> None:
    """Recover interrupted runs in a locked directory."""
    for name in temporary_names(root):
        stage = Stage(root, os.path.join(root, name))
        if not has_journal(root, name):
            continue
        transaction = Transaction.of_journal(root, stage)
        if transaction is None:
            notify(
                f"{os.path.join(directory, name)}: left by a run of ros2-scaffold elsewhere, or "
                "by another user; ignored; remove it"
            )
            continue
        notify(
            f"{directory}: an earlier run was interrupted; its changes were {transaction.heal()}"
        )
    sweep(root)


def _missing_directories(root: str, changes: Sequence[Change]) -> list[str]:
    """Return the directories that new files need, outer ones first."""
    missing: set[str] = set()
    for change in changes:
        parent = os.path.dirname(change.path)
        while parent and change.after is not None and not os.path.lexists(join(root, parent)):
            missing.add(parent)
            parent = os.path.dirname(parent)
    return sorted(missing)
