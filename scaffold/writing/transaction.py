"""Changing files of a package: all of them or none, even if the process is killed.

What is written waits in a hidden directory, the stage, next to a journal. Each file is then
exchanged with the one that it replaces: new content goes to its place and the old file to the
stage in one step of the kernel, and what came out is compared with what was read. Removing the
journal is what makes the changes final; until then they can be taken back, by the process itself
or by the next one that finds the journal.

A change is done when the stage holds what was before, and not done when it holds what comes after.
The same step with both swapped undoes it.

Files at the top of the repository belong to the same transaction: their paths lead there from the
package, and its stage and journal are theirs. All of them are on one file system, or the first
rename fails and nothing is written.
"""

from __future__ import annotations

import json
import os
import shutil
import stat
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress

from scaffold.errors import ConflictError
from scaffold.files import temporary
from scaffold.files.disk import Disk, digest
from scaffold.record import NamedTuple
from scaffold.writing import new_files, rename
from scaffold.writing.lock import locked, try_lock

TREE = "tree"
"""What a stage calls the directory that is to appear whole."""
RECORD = ".ros2-scaffold.json"
"""The file that says how a package was made: it changes last, so that it never claims too much."""
BASES = ".ros2-scaffold.bases"
"""The sidecar of the record; it changes just before it."""

_JOURNAL = "journal"
_NEW_JOURNAL = "journal.new"
_MARK = "mark"
_SPARE = ".old"
_OTHER = "other"
"""The state of what is not a regular file or cannot be read."""

_held: set[str] = set()
"""The directories that this process has locked."""


def _ignore(_: str) -> None:
    """Do nothing with a line."""


class Change(NamedTuple):
    """What happens to one file; states are as ``state`` returns them."""

    path: str
    """Relative to the root, without links; it may lead out of the root with ``..``."""
    before: str | None
    after: str | None

    def reversed(self) -> Change:
        """Return the change that undoes this one."""
        return Change(self.path, self.after, self.before)


class ChangedError(Exception):
    """A file is not what it was when it was read."""

    def __init__(self, path: str) -> None:
        super().__init__(path)
        self.path = path


class Replacement(NamedTuple):
    """What a file is to become."""

    path: str
    """Relative to the root, without links; it may lead out of the root with ``..``."""
    before: str | None
    """Its state when it was read."""
    content: bytes | None
    """``None`` if the file is to go."""
    executable: bool


@contextmanager
def exclusive(directory: str, notify: Callable[[str], None] = _ignore) -> Iterator[None]:
    """Lock a package from the first read to the last write, and recover interrupted runs.

    Args:
        directory: The root of the package.
        notify: Gets a line when another process has to be waited for, and one for each run that
            was cut off.

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
    """Tell whether a run was interrupted while it changed a package, and not recovered since."""
    if not any(_has_journal(directory, name) for name in _temporary_names(directory)):
        return False
    try:
        descriptor = try_lock(os.path.realpath(directory))
    except OSError:
        return True
    if descriptor is not None:
        os.close(descriptor)
    return descriptor is not None


def state(path: str) -> str | None:
    """Return what tells the state of a file: its content and whether it is executable.

    ``None`` if there is no file. Anything irregular or unreadable is not a file of ours.
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


class Stage:
    """A hidden directory for what is written, on the file system of the place that it is for."""

    def __init__(self, parent: str, path: str) -> None:
        self.parent = parent
        self.path = path

    @classmethod
    @contextmanager
    def made(cls, parent: str) -> Iterator[Stage]:
        """Make a stage in a directory, and remove it when the block ends."""
        stage = cls(parent, os.path.join(parent, temporary.name()))
        os.mkdir(stage.path, 0o700)
        try:
            lock = try_lock(stage.path)
        except OSError:
            lock = None  # no locks on this file system: no cleanup there
        else:
            if lock is None:  # swept before it was locked
                with cls.made(parent) as another:
                    yield another
                return
        try:
            yield stage
        finally:
            if not os.path.lexists(stage.file(_JOURNAL)):
                stage.remove()
            if lock is not None:
                os.close(lock)

    def file(self, name: str) -> str:
        """Return the path of a file in it."""
        return os.path.join(self.path, name)

    def follow(self, parent: str) -> None:
        """Note that the directory which it is in has another name now."""
        self.parent, self.path = parent, os.path.join(parent, os.path.basename(self.path))

    def remove(self) -> bool:
        """Remove it with what this module has put into it; tell whether that was all."""
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
    """Remove the stages of dead processes that made directories in ``parent``."""
    for name in _temporary_names(parent):
        path = os.path.join(parent, name)
        if _has_journal(parent, name):
            continue  # a package's own, not for anybody but its next writer
        with suppress(OSError):
            descriptor = try_lock(path)
            if descriptor is not None:
                Stage(parent, path).remove()
                os.close(descriptor)


def replace_all(root: str, replacements: Sequence[Replacement]) -> None:
    """Change files below a directory whose lock is held.

    Args:
        root: The directory, without links.
        replacements: Each is of another file.

    Raises:
        ConflictError: a file is not what it was when it was read, or has changed meanwhile; what
            was done has been undone.
        OSError: the system refuses; what was done has been undone.
    """
    with Stage.made(root) as stage:
        transaction = _staged(root, stage, replacements)
        transaction.refuse_changed()
        transaction.write_journal()
        transaction.run()


def appear(tree: str, root: str, around: Sequence[Replacement]) -> None:
    """Rename a new directory to its place and change files around it: both or nothing.

    If the process is killed between the two, the next writer in the directory completes it.

    Args:
        tree: The directory where it was made.
        root: Its place.
        around: Changes of files outside; their paths are relative to the place.

    Raises:
        ConflictError: the place is taken, or a file has changed since it was read.
        OSError: the system refuses; what was done has been undone.
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
        raise ConflictError(f"{root} has appeared in the meantime")
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
) -> _Transaction:
    """Write new content into a stage; return what is to be done."""
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
                like=_join(root, file.path),
                is_durable=True,
            )
        # Some file systems have no executable bits: the actual mode is the result.
        changes.append(Change(file.path, file.before, state(slot)))
    directories = _missing_directories(root, changes)
    return _Transaction(root, stage, changes, directories, is_forward=is_forward)


class _Transaction:
    """The changes that a journal lists, and how far they are done."""

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
        os.close(temporary.create(self.stage.file(_MARK)))
        entries = {
            "mark": self._mark(),
            "changes": [list(change) for change in self.changes],
            "directories": self.directories,
            "is_forward": self.is_forward,
        }
        aside = self.stage.file(_NEW_JOURNAL)
        with open(temporary.create(aside), "w", encoding="ascii") as file:
            json.dump(entries, file)
            file.flush()
            os.fsync(file.fileno())
        os.rename(aside, self.stage.file(_JOURNAL))
        _sync_directory(self.stage.path)

    @classmethod
    def of_journal(cls, root: str, stage: Stage) -> _Transaction | None:
        """Return the transaction of a journal; ``None`` if this machine did not write it there.

        A journal may come with a repository or a copy. Then its mark, which cannot be checked
        out or copied, is another one, and the journal is not trusted. Nor is that of
        another user which leads out of the package, to files that only this user may change.
        """
        transaction = cls(root, stage, [], [], is_forward=False)
        try:
            with open(stage.file(_JOURNAL), encoding="ascii") as file:
                entries = json.load(file)
            if entries["mark"] != transaction._mark():
                return None
            changes = [Change(*entry) for entry in entries["changes"]]
            if any(
                map(_leads_out, [change.path for change in changes] + entries["directories"])
            ) and (not Disk().is_own(stage.file(_MARK))):
                return None
            is_forward = bool(entries["is_forward"])
            return cls(root, stage, changes, entries["directories"], is_forward=is_forward)
        except (OSError, ValueError, TypeError, KeyError, RecursionError):
            return None

    def _mark(self) -> list[int]:
        status = os.lstat(self.stage.file(_MARK))
        root = os.stat(self.stage.parent)
        return [status.st_ino, status.st_ctime_ns, status.st_uid, root.st_ino]

    # -- what was done

    def target(self, change: Change) -> str:
        """Return the place of the file."""
        return _join(self.root, change.path)

    def _now(self, change: Change) -> str | None:
        return state(self.target(change))

    def _slot(self, change: Change) -> str:
        """Return the place in the stage that a change exchanges its file with."""
        slot = self.stage.file(str(self._numbers[change.path]))
        # Without an exchange the kernel needs two steps, and the old file another name.
        spare = f"{slot}{_SPARE}"
        return spare if os.path.lexists(spare) and not os.path.lexists(slot) else slot

    def _is_done(self, change: Change) -> bool:
        """Tell whether the stage holds what was before."""
        slot = self._slot(change)
        if change.before is None and os.path.lexists(slot):
            target = self.target(change)
            return os.path.lexists(target) and os.path.samefile(slot, target)
        return state(slot) == change.before

    def _is_edited(self, change: Change) -> bool:
        """Tell whether somebody else has changed the file."""
        return self._now(change) not in {change.before, change.after}

    # -- forward and back

    def refuse_changed(self) -> None:
        """Raise ConflictError if a file is not what it was when it was read."""
        changed = [
            change.path for change in self.changes if state(self.target(change)) != change.before
        ]
        if changed:
            raise ConflictError(_refusal(self.root, changed, ()))

    def run(self) -> None:
        """Do all changes; if one fails, undo those that are done.

        Raises:
            ConflictError: somebody else has changed a file.
            OSError: the system refuses.
        """
        try:
            for directory in self.directories:
                new_files.make_directory(_join(self.root, directory))
            for change in self.changes:
                self._swap(change)
            self._compare_again()
        except ChangedError as error:
            raise ConflictError(_refusal(self.root, [error.path], self.undo())) from error
        except BaseException:
            self.undo()
            raise
        self.close()

    def _compare_again(self) -> None:
        """Raise ChangedError if an old file was changed after the exchange, by who had it open."""
        for change in self.changes:
            if change.before is not None and state(self._slot(change)) != change.before:
                raise ChangedError(change.path)

    def heal(self) -> str:
        """Complete or undo the changes of another process; return the outcome for a message.

        It is undone, unless all of it is done, or the user went on working with what came of it,
        or it is what is left of a new package.
        """
        edited = [change for change in self.changes if self._is_edited(change)]
        pending = [change for change in self.changes if not self._is_done(change)]
        if not pending or self.is_forward or (edited and all(map(self._is_done, edited))):
            outcome, left = "completed", self.complete()
        else:
            outcome, left = "undone", self.undo(touch=True)
        left = sorted({*left, *(change.path for change in edited)})
        names = ", ".join(_shown(self.root, path) for path in left)
        return f"{outcome}; edited since, left alone: {names}" if left else outcome

    def complete(self) -> list[str]:
        """Do what is not done; return the files that were left because they were edited."""
        for directory in self.directories:
            if not os.path.lexists(_join(self.root, directory)):
                new_files.make_directory(_join(self.root, directory))
        pending = [change for change in self.changes if not self._is_done(change)]
        left = self._swap_each([item for item in pending if self._now(item) != item.after])
        self.close()
        return left

    def undo(self, *, touch: bool = False) -> list[str]:
        """Undo what is done; return the files that were left because they were edited.

        Args:
            touch: Give the files a new time: somebody may have built with the others.
        """
        done = [change for change in reversed(self.changes) if self._is_done(change)]
        done = [change for change in done if self._now(change) != change.before]
        for change in done:
            if touch and change.before is not None:
                with suppress(OSError):
                    os.utime(self._slot(change))
        left = self._swap_each([change.reversed() for change in done])
        for directory in reversed(self.directories):
            with suppress(OSError):
                os.rmdir(_join(self.root, directory))
        self.close()
        return left

    def close(self) -> None:
        """Make it final: without a journal there is nothing to complete or undo."""
        os.unlink(self.stage.file(_JOURNAL))

    def _swap_each(self, changes: Sequence[Change]) -> list[str]:
        left: list[str] = []
        for change in changes:
            try:
                self._swap(change)
            except ChangedError:
                left.append(change.path)
        return left

    def _swap(self, change: Change) -> None:
        """Exchange a file and its slot in the stage.

        Raises:
            ChangedError: the file is not what it should be; it was left as it is.
        """
        slot, target = self._slot(change), self.target(change)
        try:
            if change.before is None:
                rename.move(slot, target)
                return
            if change.after is None:
                rename.move(target, slot)
            else:
                rename.exchange(slot, target, f"{slot}{_SPARE}")
        except (FileExistsError, FileNotFoundError, NotADirectoryError, IsADirectoryError) as error:
            raise ChangedError(change.path) from error
        if state(slot) == change.before:
            return
        if change.after is None:
            rename.move(slot, target)
        else:
            rename.exchange(slot, target, f"{slot}{_SPARE}")
        raise ChangedError(change.path)


def _recover(root: str, directory: str, notify: Callable[[str], None]) -> None:
    """Recover interrupted runs in a directory whose lock is held."""
    for name in _temporary_names(root):
        stage = Stage(root, os.path.join(root, name))
        if not _has_journal(root, name):
            continue
        transaction = _Transaction.of_journal(root, stage)
        if transaction is None:
            notify(
                f"{os.path.join(directory, name)}: left by a run of ros2-scaffold in another "
                "place or by somebody else; ignored: remove it"
            )
            continue
        notify(f"{directory}: an earlier run was cut off; its changes were {transaction.heal()}")
    sweep(root)


def _temporary_names(directory: str) -> list[str]:
    """Return the names in a directory that stages may have."""
    try:
        names = sorted(filter(temporary.is_temporary, os.listdir(directory)))
    except OSError:
        return []
    return [name for name in names if not os.path.islink(os.path.join(directory, name))]


def _has_journal(directory: str, name: str) -> bool:
    return os.path.lexists(os.path.join(directory, name, _JOURNAL))


def _is_of_stage(name: str) -> bool:
    """Tell whether this module gives this name to what it puts into a stage."""
    number = name
    while number.endswith(_SPARE):
        number = number.removesuffix(_SPARE)
    return name in {TREE, _MARK, _JOURNAL, _NEW_JOURNAL} or number.isdecimal()


def _missing_directories(root: str, changes: Sequence[Change]) -> list[str]:
    """Return the directories that new files need, outer ones first."""
    missing: set[str] = set()
    for change in changes:
        parent = os.path.dirname(change.path)
        while parent and change.after is not None and not os.path.lexists(_join(root, parent)):
            missing.add(parent)
            parent = os.path.dirname(parent)
    return sorted(missing)


def _join(root: str, path: str) -> str:
    """Return a path below a root, or around it; the root need not be there, as a new package."""
    return os.path.normpath(os.path.join(root, *path.split("/")))


def _leads_out(path: str) -> bool:
    return os.path.isabs(path) or ".." in path.split("/")


def _shown(root: str, path: str) -> str:
    return _join(root, path) if _leads_out(path) else path


def _sync_directory(path: str) -> None:
    with suppress(OSError):
        descriptor = os.open(path, os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)


def _refusal(root: str, changed: Sequence[str], left: Sequence[str]) -> str:
    """Return the message for files that somebody else has changed."""
    message = f"{_names(root, changed)} changed after it was read"
    if left:
        return f"{message}; all was undone but {_names(root, left)}, which changed as well"
    return f"{message}; nothing was written: run this again"


def _names(root: str, paths: Sequence[str]) -> str:
    """Return the names of files for a message, those of the root first."""
    inside = [path for path in paths if not _leads_out(path)]
    outside = [_join(root, path) for path in paths if _leads_out(path)]
    return ", ".join([*([f"{', '.join(inside)} in {root}"] if inside else []), *outside])
