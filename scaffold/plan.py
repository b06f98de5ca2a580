"""Writing files: everything is decided first, then all of it happens or nothing.

``new`` and ``fix`` write through it. A new directory appears whole: it is written beside its
place under a hidden name and renamed. In an existing one each file is replaced by a rename, and
a failure puts back what was there.
"""

from __future__ import annotations

import os
import shutil
import stat
from collections.abc import Callable, Collection, Mapping
from contextlib import suppress
from enum import Enum

from scaffold.errors import ConflictError, InputError
from scaffold.record import NamedTuple

_EXECUTABLE = stat.S_IXUSR | stat.S_IXGRP | stat.S_IXOTH


class State(Enum):
    """What writing a file would do."""

    NEW = "new"
    """There is no such file."""
    DIFFERING = "differing"
    """There is one with other content, or without its executable bits."""
    SAME = "same"
    """There is one that says the same."""
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
    """What it holds now; ``None`` for a new file."""

    @property
    def is_removed(self) -> bool:
        """Whether the file is to go."""
        return self.state is State.REMOVED


class WritePlan:
    """Files to write below a directory, compared with what is there."""

    def __init__(self, root: str, files: list[PlannedFile], *, is_new: bool) -> None:
        self.root = root
        self.files = files
        self.is_new = is_new
        """Whether the root is not there yet."""

    @classmethod
    def of(
        cls,
        root: str | os.PathLike[str],
        files: Mapping[str, bytes | str],
        *,
        executable: Collection[str] = (),
        remove: Collection[str] = (),
    ) -> WritePlan:
        """Compare files with a directory; nothing is written.

        Args:
            root: The directory; it need not exist.
            files: Content by path relative to the root.
            executable: Paths that get executable bits; one that is not in ``files`` keeps its
                content.
            remove: Paths of files to remove.

        Raises:
            InputError: a path leads out of the root, or something cannot be read.
            ConflictError: a file is planned where a directory is, or the other way round.
        """
        base = os.path.realpath(root)
        planned: list[PlannedFile] = []
        try:
            for path in sorted({*files, *executable, *remove}):
                target = _resolve(base, path)
                before = _read(target, path)
                content = files.get(path, before if before is not None else b"")
                data = content.encode() if isinstance(content, str) else content
                state = _state(target, before, data, executable=path in executable)
                if path in remove and path not in files:
                    state = State.REMOVED if before is not None else State.SAME
                planned.append(PlannedFile(path, target, data, path in executable, state, before))
        except OSError as error:
            raise InputError(f"{error.filename or root}: {error.strerror}") from error
        _refuse_files_inside_files(planned)
        return cls(base, planned, is_new=not os.path.lexists(base))

    @property
    def changes(self) -> list[PlannedFile]:
        """The files that writing would touch."""
        return [file for file in self.files if file.state is not State.SAME]

    @property
    def conflicts(self) -> list[str]:
        """The paths of files that exist and would be changed or removed."""
        return [file.path for file in self.files if file.state in {State.DIFFERING, State.REMOVED}]

    def diff(self, *, hidden: Collection[str] = (), relative_to: str | None = None) -> str:
        """Return the changes as a patch that ``git apply`` takes; see `patch.of`.

        Args:
            hidden: Paths of files that nobody reads.
            relative_to: The directory to which the paths in the patch are relative; by default
                that of `patch.base`.
        """
        from scaffold import patch

        base = relative_to or patch.base([self.root])
        return "".join(patch.of(file, base) for file in self.changes if file.path not in hidden)

    def write(self, *, force: bool = False) -> None:
        """Write what differs.

        Args:
            force: Overwrite and remove files that exist.

        Raises:
            ConflictError: files would be overwritten and ``force`` was not given; nothing is
                written.
            InputError: the system refuses; what was there is as it was.
        """
        if self.conflicts and not force:
            names = ", ".join(self.conflicts)
            raise ConflictError(f"would overwrite {names} in {self.root}; nothing was written")
        try:
            if self.is_new:
                self._write_whole()
            else:
                self._write_each()
        except OSError as error:
            message = f"{self.root} cannot be written: {error.strerror}; nothing was written"
            raise InputError(message) from error

    def _write_whole(self) -> None:
        """Write a directory beside its place and rename it."""
        parent = os.path.dirname(self.root)
        while not os.path.lexists(parent):
            parent = os.path.dirname(parent)
        stage = _hidden(parent, os.path.basename(self.root))
        undo: list[Callable[[], None]] = [lambda: shutil.rmtree(stage, ignore_errors=True)]
        with _Undone(undo):
            os.mkdir(stage)
            for file in self.changes:
                target = os.path.join(stage, *file.path.split("/"))
                os.makedirs(os.path.dirname(target), exist_ok=True)
                _write(target, file)
            _make_directories(os.path.dirname(self.root), undo)
            if os.path.lexists(self.root):
                raise ConflictError(f"{self.root} has appeared in the meantime")
            os.rename(stage, self.root)

    def _write_each(self) -> None:
        """Write all files under hidden names, then rename each."""
        undo: list[Callable[[], None]] = []
        with _Undone(undo):
            staged: list[tuple[str, PlannedFile]] = []
            for file in self.changes:
                directory = os.path.dirname(file.target)
                _make_directories(directory, undo)
                if file.state is State.REMOVED:
                    continue
                name = _hidden(directory, os.path.basename(file.target))
                undo.append(_remover(name))
                _write(name, file)
                staged.append((name, file))
            for name, file in staged:
                undo.append(_restorer(file))
                os.replace(name, file.target)
            for file in self.changes:
                if file.state is State.REMOVED:
                    undo.append(_restorer(file))
                    os.unlink(file.target)


class _Undone:
    """Runs the collected steps backwards when the block fails, however it fails."""

    def __init__(self, steps: list[Callable[[], None]]) -> None:
        self._steps = steps

    def __enter__(self) -> None:
        """Do nothing."""

    def __exit__(self, kind: type[BaseException] | None, *rest: object) -> None:
        if kind is not None:
            for step in reversed(self._steps):
                with suppress(OSError):
                    step()


def _resolve(base: str, path: str) -> str:
    """Return where a path relative to ``base`` really leads."""
    parts = path.split("/")
    if any(part in {"", ".", ".."} or "\0" in part or "\\" in part for part in parts):
        raise InputError(f"{path!r} is not a path below {base}")
    target = os.path.realpath(os.path.join(base, *parts))
    if os.path.commonpath([base, target]) != base or target == base:
        raise InputError(f"{path!r} leads out of {base}, to {target}")
    return target


def _read(target: str, path: str) -> bytes | None:
    if os.path.isdir(target):
        raise ConflictError(f"{path} is to be a file, and a directory is in its place")
    try:
        with open(target, "rb") as file:
            return file.read()
    except FileNotFoundError:
        return None
    except NotADirectoryError as error:
        message = f"{path} is to be in a directory, and a file is in its place"
        raise ConflictError(message) from error


def _state(target: str, before: bytes | None, content: bytes, *, executable: bool) -> State:
    if before is None:
        return State.NEW
    is_executable = bool(os.stat(target).st_mode & stat.S_IXUSR)
    if before == content and (is_executable or not executable):
        return State.SAME
    return State.DIFFERING


def _refuse_files_inside_files(planned: list[PlannedFile]) -> None:
    paths = {file.path for file in planned if file.state is not State.REMOVED}
    for path in paths:
        parts = path.split("/")
        for depth in range(1, len(parts)):
            if "/".join(parts[:depth]) in paths:
                raise ConflictError(f"{'/'.join(parts[:depth])} is to be a file and a directory")


def _hidden(directory: str, name: str) -> str:
    """Return a name that colcon, git status and globs do not take for the real thing."""
    return os.path.join(directory, f".{name[:100]}.{os.urandom(4).hex()}.tmp")


def _write(name: str, file: PlannedFile) -> None:
    """Write a new file with the bits of the one it replaces, and executable ones if wanted."""
    with open(name, "xb") as stream:
        stream.write(file.content)
    mode = os.stat(file.target if file.before is not None else name).st_mode
    mask = _EXECUTABLE & ~_umask() if file.executable else 0
    os.chmod(name, stat.S_IMODE(mode) | mask)


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask


def _make_directories(directory: str, undo: list[Callable[[], None]]) -> None:
    missing: list[str] = []
    while not os.path.lexists(directory):
        missing.append(directory)
        directory = os.path.dirname(directory)
    for one in reversed(missing):
        os.mkdir(one)
        undo.append(lambda one=one: os.rmdir(one))  # type: ignore[misc]  # a default binds it now


def _remover(path: str) -> Callable[[], None]:
    return lambda: os.unlink(path)


def _restorer(file: PlannedFile) -> Callable[[], None]:
    """Return what puts a file back as it is now."""
    if file.before is None:
        return _remover(file.target)
    before = file.before
    mode = stat.S_IMODE(os.stat(file.target).st_mode)

    def restore() -> None:
        name = _hidden(os.path.dirname(file.target), os.path.basename(file.target))
        with open(name, "xb") as stream:
            stream.write(before)
        os.chmod(name, mode)
        try:
            os.replace(name, file.target)
        except OSError:
            os.unlink(name)
            raise

    return restore
