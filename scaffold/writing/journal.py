"""The changes listed in a journal, and which of them are done.

A change is done if the stage contains the old content, and not done if it contains the new content.
Undoing a change is the same step with both exchanged.
"""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from contextlib import suppress

from scaffold.errors import ConflictError
from scaffold.files import temporary
from scaffold.files.disk import Disk
from scaffold.writing import new_files, rename
from scaffold.writing.change import (
    Change,
    ChangedError,
    join,
    leads_out,
    refusal,
    shown,
    state,
)
from scaffold.writing.stage import JOURNAL, MARK, NEW_JOURNAL, SPARE, Stage


class Transaction:
    """The changes in a journal, and which of them are done."""

    def __init__(
        self,
        root: str,
        stage: Stage,
        changes: list[Change],
        directories: list[str],
        *,
        is_forward: bool,
    ) -> None:
        self.root = root
        self.stage = stage
        self.changes = changes
        self.directories = directories
        """Those that are made for new files, relative to the root, outer ones first."""
        self.is_forward = is_forward
        """Whether the journal alone, once it can be seen, is a reason to complete the changes."""
        self._numbers = {change.path: number for number, change in enumerate(changes)}

    # -- the journal

    def write_journal(self) -> None:
        """Write the changes that are about to be made to disk, to survive this process."""
        os.close(temporary.create(self.stage.file(MARK)))
        entries = {
            "mark": self._mark_identity(),
            "changes": [list(change) for change in self.changes],
            "directories": self.directories,
            "is_forward": self.is_forward,
        }
        aside = self.stage.file(NEW_JOURNAL)
        with open(temporary.create(aside), "w", encoding="ascii") as file:
            json.dump(entries, file)
            file.flush()
            os.fsync(file.fileno())
        os.rename(aside, self.stage.file(JOURNAL))
        _sync_directory(self.stage.path)

    @classmethod
    def of_journal(cls, root: str, stage: Stage) -> Transaction | None:
        """Return the transaction of a journal; ``None`` if this machine did not write it there.

        A journal may come with a repository or a copy. Then its mark, which cannot be checked
        out or copied, is another one, and the journal is not trusted. Nor is that of
        another user which leads out of the package, to files that only this user may change.
        """
        transaction = cls(root, stage, [], [], is_forward=False)
        try:
            with open(stage.file(JOURNAL), encoding="ascii") as file:
                entries = json.load(file)
            if entries["mark"] != transaction._mark_identity():
                return None
            changes = [Change(*entry) for entry in entries["changes"]]
            if any(
                map(leads_out, [change.path for change in changes] + entries["directories"])
            ) and (not Disk().is_own(stage.file(MARK))):
                return None
            is_forward = bool(entries["is_forward"])
            return cls(root, stage, changes, entries["directories"], is_forward=is_forward)
        except (OSError, ValueError, TypeError, KeyError, RecursionError):
            return None

    def _mark_identity(self) -> list[int]:
        status = os.lstat(self.stage.file(MARK))
        root = os.stat(self.stage.parent)
        return [status.st_ino, status.st_ctime_ns, status.st_uid, root.st_ino]

    # -- what was done

    def target(self, change: Change) -> str:
        """Return the place of the file."""
        return join(self.root, change.path)

    def _current_state(self, change: Change) -> str | None:
        return state(self.target(change))

    def _slot(self, change: Change) -> str:
        """Return the path in the stage that a change exchanges with its file."""
        slot = self.stage.file(str(self._numbers[change.path]))
        # Without an atomic exchange, two steps are needed, and another name for the old file.
        spare = f"{slot}{SPARE}"
        return spare if os.path.lexists(spare) and not os.path.lexists(slot) else slot

    def _is_done(self, change: Change) -> bool:
        """Return whether the stage contains the old content."""
        slot = self._slot(change)
        if change.before is None and os.path.lexists(slot):
            target = self.target(change)
            return os.path.lexists(target) and os.path.samefile(slot, target)
        return state(slot) == change.before

    def _is_edited(self, change: Change) -> bool:
        """Return whether another process has changed the file."""
        return self._current_state(change) not in {change.before, change.after}

    # -- doing and undoing

    def refuse_changed(self) -> None:
        """Raise ConflictError if a file has changed since it was read."""
        changed = [
            change.path for change in self.changes if state(self.target(change)) != change.before
        ]
        if changed:
            raise ConflictError(refusal(self.root, changed, ()))

    def run(self) -> None:
        """Do all changes; if one fails, undo those that are done.

        Raises:
            ConflictError: another process has changed a file.
            OSError: the system refuses.
        """
        try:
            for directory in self.directories:
                new_files.make_directory(join(self.root, directory))
            for change in self.changes:
                self._exchange(change)
            self._compare_again()
        except ChangedError as error:
            raise ConflictError(refusal(self.root, [error.path], self.undo())) from error
        except BaseException:
            self.undo()
            raise
        self.close()

    def _compare_again(self) -> None:
        """Raise ChangedError if a replaced file was changed through an open descriptor."""
        for change in self.changes:
            if change.before is not None and state(self._slot(change)) != change.before:
                raise ChangedError(change.path)

    def heal(self) -> str:
        """Complete or undo the changes of another process; return the outcome for a message.

        It is undone, unless all of it is done, the user has edited the results,
        or it is the rest of a new package.
        """
        edited = [change for change in self.changes if self._is_edited(change)]
        pending = [change for change in self.changes if not self._is_done(change)]
        if not pending or self.is_forward or (edited and all(map(self._is_done, edited))):
            outcome, left = "completed", self.complete()
        else:
            outcome, left = "undone", self.undo(touch=True)
        left = sorted({*left, *(change.path for change in edited)})
        names = ", ".join(shown(self.root, path) for path in left)
        return f"{outcome}; edited since, not restored: {names}" if left else outcome

    def complete(self) -> list[str]:
        """Do the remaining changes; return the files that were skipped because they were edited."""
        for directory in self.directories:
            if not os.path.lexists(join(self.root, directory)):
                new_files.make_directory(join(self.root, directory))
        pending = [change for change in self.changes if not self._is_done(change)]
        left = self._swap_each(
            [item for item in pending if self._current_state(item) != item.after]
        )
        self.close()
        return left

    def undo(self, *, touch: bool = False) -> list[str]:
        """Undo the done changes; return the files that were skipped because they were edited.

        Args:
            touch: Whether to set a new modification time, as the new files may have been built.
        """
        done = [change for change in reversed(self.changes) if self._is_done(change)]
        done = [change for change in done if self._current_state(change) != change.before]
        for change in done:
            if touch and change.before is not None:
                with suppress(OSError):
                    os.utime(self._slot(change))
        left = self._swap_each([change.reversed() for change in done])
        for directory in reversed(self.directories):
            with suppress(OSError):
                os.rmdir(join(self.root, directory))
        self.close()
        return left

    def close(self) -> None:
        """Commit by removing the journal."""
        os.unlink(self.stage.file(JOURNAL))

    def _swap_each(self, changes: Sequence[Change]) -> list[str]:
        left: list[str] = []
        for change in changes:
            try:
                self._exchange(change)
            except ChangedError:
                left.append(change.path)
        return left

    def _exchange(self, change: Change) -> None:
        """Exchange a file and its slot in the stage.

        Raises:
            ChangedError: the file has changed, and is kept.
        """
        slot, target = self._slot(change), self.target(change)
        try:
            if change.before is None:
                rename.move(slot, target)
                return
            if change.after is None:
                rename.move(target, slot)
            else:
                rename.exchange(slot, target, f"{slot}{SPARE}")
        except (FileExistsError, FileNotFoundError, NotADirectoryError, IsADirectoryError) as error:
            raise ChangedError(change.path) from error
        if state(slot) == change.before:
            return
        if change.after is None:
            rename.move(slot, target)
        else:
            rename.exchange(slot, target, f"{slot}{SPARE}")
        raise ChangedError(change.path)


def _sync_directory(path: str) -> None:
    with suppress(OSError):
        descriptor = os.open(path, os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)
