"""Files that belong at the root of the git repository around a package.

GitHub reads workflows there, pre-commit its configuration, and editors a dev container. A template
lists such files as ``repository``. If a package is below the root of a repository, their paths
begin with `MARK`; otherwise they are files of the package, which may become a repository.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from shlex import quote
from typing import TYPE_CHECKING, TypeVar

from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from scaffold.generate.edit.addition import ByHand
    from scaffold.writing.plan import WritePlan

_T = TypeVar("_T")

MARK = ":/"
"""The prefix of a path relative to the top of the repository, as in git."""
PRE_COMMIT = ".pre-commit-config.yaml"
_GIT = ".git"


class Place(NamedTuple):
    """Where a package is in a git repository."""

    top: str = ""
    """The real path of the top of the repository; empty without a repository."""
    way: str = ""
    """The relative path of the package, or of the directory in which a new one is created."""
    is_parent: bool = False
    """Whether the package is yet to be created in that directory."""

    def subdirectory(self, package: str) -> str:
        """Return the path from the top to a package; empty at the top and without a repository."""
        if not self.top or not self.is_parent:
            return self.way
        return f"{self.way}/{package}" if self.way else package


NOWHERE = Place()


def place_of(package: str | None, *, is_parent: bool = False) -> Place:
    """Return where a package is, or where a new one will be.

    Git is not run, since it may run programs from the configuration of a repository.

    Args:
        package: The directory of the package; ``None`` for one in memory.
        is_parent: Whether it is the directory in which the package will be created.
    """
    if package is None:
        return NOWHERE
    directory = os.path.realpath(package)
    top = _repository_top(directory)
    if top is None:
        return NOWHERE
    way = os.path.relpath(directory, top).replace(os.sep, "/")
    return Place(top, "" if way == "." else way, is_parent)


def place_of_files(directory: str | None) -> Place:
    """Return a directory as a place for `read`, with or without a repository."""
    return NOWHERE if directory is None else Place(os.path.realpath(directory))


def inside(files: Mapping[str, _T]) -> dict[str, _T]:
    """Return the files in the directory of the package."""
    return {path: value for path, value in files.items() if not path.startswith(MARK)}


def above(files: Mapping[str, _T]) -> dict[str, _T]:
    """Return the files at the top of the repository, with paths relative to it."""
    return {
        path.removeprefix(MARK): value for path, value in files.items() if path.startswith(MARK)
    }


def is_below(path: str) -> bool:
    """Return whether a path, which may be from a record, stays below its start."""
    parts = path.removeprefix(MARK).split("/")
    return not any(part in {"", ".", ".."} or "\0" in part for part in parts)


def read(place: Place, path: str) -> bytes | None:
    """Return a file at the top of a repository; ``None`` if there is no regular file.

    Args:
        place: The repository.
        path: Relative to its top.
    """
    if not place.top or not is_below(path):
        return None
    file = os.path.realpath(os.path.join(place.top, *path.split("/")))
    if os.path.commonpath([file, place.top]) != place.top:
        return None
    with suppress(OSError):
        if os.path.isfile(file):
            with open(file, "rb") as stream:
                return stream.read()
    return None


def plan(place: Place, files: Mapping[str, bytes | str]) -> WritePlan | None:
    """Return the plan for files at the top of a repository; ``None`` if there are none.

    Args:
        place: The repository.
        files: Content by path, relative to the top.

    Raises:
        InputError: a file cannot be read, or a symlink leads out of the repository.
        ConflictError: a directory has the path of a file.
    """
    from scaffold.writing.plan import WritePlan

    return WritePlan.of(place.top, files) if files else None


def unread(place: Place, paths: Sequence[str], package: str) -> Iterator[str]:
    """Yield notes on files that no tool reads at their place.

    Args:
        place: The repository.
        paths: Files in the package that belong at the top of a repository.
        package: The directory of the package.
    """
    if paths and not place.top:
        verb = "is" if len(paths) == 1 else "are"
        package = os.path.normpath(package)
        yield (
            f"{', '.join(sorted(paths))} {verb} read only at the top of a git repository, and "
            f"{package} is not in one; run `git init {quote(package)}`"
        )


def left_to_owners(
    place: Place,
    package: str,
    files: Mapping[str, str],
    read_existing: Callable[[str], bytes | None],
) -> dict[str, ByHand | None]:
    """Return the files that are not written, with what the user has to add to them.

    The value is ``None`` where nothing is missing.

    Args:
        place: The repository.
        package: The name of the package.
        files: The files that would be written.
        read_existing: Returns the current content of a file.
    """
    left: dict[str, ByHand | None] = {}
    for path, text in files.items():
        before = read_existing(path) if is_shared(path) else None
        if before is not None and before != text.encode():
            name = path.removeprefix(MARK)
            way = place.subdirectory(package) if name != path else ""
            left[path] = left_to_owner(os.path.relpath(name, way or "."), before, text)
    return left


def is_shared(path: str) -> bool:
    """Return whether a file may have entries of others, so that it is never overwritten.

    A pre-commit configuration has other hooks, and edits of YAML are not safe.
    """
    return os.path.basename(path) == PRE_COMMIT


def left_to_owner(path: str, existing: bytes, text: str) -> ByHand | None:
    """Return what the user has to add to a shared file; ``None`` if nothing is missing.

    Args:
        path: Relative to the package.
        existing: The current content.
        text: The content for this package alone.
    """
    from scaffold.generate.edit.addition import ByHand
    from scaffold.generate.edit.pre_commit import missing_entry

    entry = missing_entry(existing, text)
    reason = "the file has other hooks and cannot be edited safely"
    return ByHand(path, f"add to `repos`: {entry}", reason) if entry else None


def _repository_top(directory: str) -> str | None:
    """Return the innermost parent that is a repository, a worktree or a submodule."""
    while not _is_git(os.path.join(directory, _GIT)):
        parent = os.path.dirname(directory)
        if parent == directory:
            return None
        directory = parent
    return directory


def _is_git(path: str) -> bool:
    if os.path.isdir(path):
        return os.path.lexists(os.path.join(path, "HEAD"))
    prefix = b"gitdir:"
    with suppress(OSError):
        if os.path.isfile(path):
            with open(path, "rb") as file:
                return file.read(len(prefix)) == prefix
    return False
