"""Plans all writes of a run, and then performs all of them or none.

All verbs that write use a plan. A new directory is written next to its destination under a hidden
name and then renamed. Changes in an existing directory are a transaction, which compares each file
with its content at planning time.
"""

from __future__ import annotations

import errno
import os
import stat
from collections.abc import Collection, Mapping, Sequence
from contextlib import suppress
from typing import TYPE_CHECKING

from scaffold.errors import ConflictError, InputError
from scaffold.files.disk import digest
from scaffold.writing import new_files, patch, transaction
from scaffold.writing.change import Replacement, state_of
from scaffold.writing.planned_file import PlannedFile, State
from scaffold.writing.stage import TREE, Stage, sweep

if TYPE_CHECKING:
    from scaffold.files.tree import DiskTree


class WritePlan:
    """Files to write below a directory, compared with the existing ones."""

    def __init__(self, root: str, files: list[PlannedFile], *, is_new: bool) -> None:
        self.root = root
        self.files = files
        self.is_new = is_new
        """Whether the root does not exist yet."""

    @classmethod
    def of(
        cls,
        root: str | os.PathLike[str],
        files: Mapping[str, bytes | str],
        *,
        executable: Collection[str] = (),
        remove: Collection[str] = (),
        tree: DiskTree | None = None,
    ) -> WritePlan:
        """Compare files with a directory; nothing is written.

        Args:
            root: The directory; it need not exist.
            files: Content by path relative to the root.
            executable: Paths to make executable; one that is not in ``files`` keeps its
                content.
            remove: Paths of files to remove.
            tree: The tree that the content was computed from; files changed since are rejected.

        Raises:
            InputError: a path leads out of the root, or something cannot be read.
            ConflictError: a file is planned where a directory is, or the other way round; or a
                file has changed since the tree was read.
        """
        base = os.path.realpath(root)
        planned: list[PlannedFile] = []
        try:
            for path in sorted({*files, *executable, *remove}):
                target = _resolve(base, path)
                before, mode = _read(target, path)
                if tree is not None:
                    _refuse_changed(tree, path, before)
                content = files.get(path, before if before is not None else b"")
                data = content.encode() if isinstance(content, str) else content
                seen = None if before is None else state_of(before, mode)
                state = _state(before, mode, data, executable=path in executable)
                if path in remove and path not in files:
                    state = State.REMOVED if before is not None else State.SAME
                planned.append(
                    PlannedFile(path, target, data, path in executable, state, before, seen)
                )
        except OSError as error:
            raise InputError(f"{error.filename or root}: {error.strerror}") from error
        _refuse_files_inside_files(planned)
        return cls(base, planned, is_new=not os.path.lexists(base))

    @property
    def changes(self) -> list[PlannedFile]:
        """The files that writing would change."""
        return [file for file in self.files if file.state is not State.SAME]

    @property
    def conflicts(self) -> list[str]:
        """The paths of files that exist and would be changed or removed."""
        return [file.path for file in self.files if file.state in {State.DIFFERING, State.REMOVED}]

    def diff(self, *, hidden: Collection[str] = (), relative_to: str | None = None) -> str:
        """Return the changes as a patch for ``git apply``; see `patch.of`.

        Args:
            hidden: Paths of files to omit.
            relative_to: The directory to which the paths in the patch are relative; by default
                that of `patch.base`.
        """
        base = relative_to or patch.base([self.root])
        return "".join(patch.of(file, base) for file in self.changes if file.path not in hidden)

    def write(self, *, force: bool = False, around: WritePlan | None = None) -> None:
        """Write the changed files.

        Args:
            force: Overwrite and remove files that exist.
            around: The plan of a directory around this one, which is written with it or not at
                all: files at the top of the repository.

        Raises:
            ConflictError: files would be overwritten without ``force``, or another process
                has changed one meanwhile; nothing is written.
            InputError: the system reports an error; existing files are unchanged.
            LockedError: another process is changing the directory.
        """
        plans = [self] if around is None else [self, around]
        for plan in plans:
            if plan.conflicts and not force:
                names = ", ".join(plan.conflicts)
                raise ConflictError(f"would overwrite {names} in {plan.root}; nothing was written")
        try:
            if self.is_new:
                self._write_whole(_replacements(plans[1:], self.root))
            elif any(plan.changes for plan in plans):
                with transaction.exclusive(self.root):
                    transaction.replace_all(self.root, _replacements(plans, self.root))
        except OSError as error:
            message = f"{_write_error(error, self.root, around)}; nothing was written"
            raise InputError(message) from error

    def _write_whole(self, around: Sequence[Replacement]) -> None:
        """Write a directory next to its destination and rename it."""
        parent = os.path.dirname(self.root)
        while not os.path.lexists(parent):
            parent = os.path.dirname(parent)
        sweep(parent)
        with Stage.made(parent) as stage:
            place = stage.file(TREE)
            os.mkdir(place)
            new_files.adopt(place, parent)
            for file in self.changes:
                _write_new(place, file)
            _make_directories(os.path.dirname(self.root))
            transaction.appear(place, self.root, around)


def _replacements(plans: Sequence[WritePlan], root: str) -> list[Replacement]:
    """Return the changes by real path, as two paths may be symlinks to one file."""
    result: dict[str, Replacement] = {}
    for plan in plans:
        for file in plan.changes:
            path = os.path.relpath(file.target, root).replace(os.sep, "/")
            content = None if file.state is State.REMOVED else file.content
            new = Replacement(path, file.seen, content, file.executable)
            if result.setdefault(path, new) != new:
                raise ConflictError(
                    f"{file.path} in {plan.root} is the same file as another one with different "
                    "content; nothing was written"
                )
    return list(result.values())


def _write_error(error: OSError, root: str, around: WritePlan | None) -> str:
    """Return the message about a file or directory that cannot be written."""
    name = error.filename2 or error.filename
    for file in around.changes if around is not None else ():
        is_there = f"{file.target}{os.sep}".startswith(f"{name}{os.sep}")
        if is_there and not f"{root}{os.sep}".startswith(f"{name}{os.sep}"):
            if error.errno == errno.EXDEV:
                return f"{file.target} is on a different file system than {root}: add it by hand"
            return f"{name} cannot be written: {error.strerror}"
    return f"{root} cannot be written: {error.strerror}"


def target_outside(root: str, path: str) -> str | None:
    """Return the real path of a file if it is not below the root, due to symlinks."""
    base = os.path.realpath(root)
    target = os.path.realpath(os.path.join(base, *path.split("/")))
    return None if os.path.commonpath([base, target]) == base != target else target


def _resolve(base: str, path: str) -> str:
    """Return the real path of a path relative to ``base``."""
    parts = path.split("/")
    if any(part in {"", ".", ".."} or "\0" in part or "\\" in part for part in parts):
        raise InputError(f"{path!r} is not a path below {base}")
    outside = target_outside(base, path)
    if outside is not None:
        raise InputError(f"{path!r} leads out of {base}, to {outside}")
    return os.path.realpath(os.path.join(base, *parts))


def _read(target: str, path: str) -> tuple[bytes | None, int]:
    """Return the content and the mode of a file; no content if it does not exist."""
    if os.path.isdir(target):
        raise ConflictError(f"{path} should be a file, but is a directory")
    try:
        # Opening a pipe would block.
        with open(os.open(target, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC), "rb") as file:
            mode = os.fstat(file.fileno()).st_mode
            if not stat.S_ISREG(mode):
                raise ConflictError(f"{path} should be a file, but is a device or pipe")
            return file.read(), mode
    except FileNotFoundError:
        return None, 0
    except NotADirectoryError as error:
        message = f"{path} should be in a directory, but that is a file"
        raise ConflictError(message) from error


def _refuse_changed(tree: DiskTree, path: str, before: bytes | None) -> None:
    """Raise if a file has changed since its new content was computed."""
    seen = tree.digest_read(path)
    if seen is not None and seen != (digest(before) if before is not None else ""):
        raise ConflictError(
            f"{path} in {tree.root} changed after it was read; nothing was written; run the "
            "command again"
        )


def _state(before: bytes | None, mode: int, content: bytes, *, executable: bool) -> State:
    if before is None:
        return State.NEW
    if before == content and (mode & stat.S_IXUSR or not executable):
        return State.SAME
    return State.DIFFERING


def _refuse_files_inside_files(planned: list[PlannedFile]) -> None:
    paths = {file.path for file in planned if file.state is not State.REMOVED}
    for path in paths:
        parts = path.split("/")
        for depth in range(1, len(parts)):
            if "/".join(parts[:depth]) in paths:
                raise ConflictError(
                    f"{'/'.join(parts[:depth])} should be both a file and a directory"
                )


def _write_new(root: str, file: PlannedFile) -> None:
    """Write a file of a new directory."""
    path = os.path.join(root, *file.path.split("/"))
    _make_directories(os.path.dirname(path))
    new_files.write(path, file.content, executable=file.executable, like=path, is_durable=False)


def _make_directories(directory: str) -> None:
    missing: list[str] = []
    while not os.path.lexists(directory):
        missing.append(directory)
        directory = os.path.dirname(directory)
    for path in reversed(missing):
        # Another process may create a package in the same new directory.
        with suppress(FileExistsError):
            new_files.make_directory(path)
