"""Foreign files, maintained by others, which `check` excludes by default.

These are git submodules, files that git ignores, vendored code, and the copies that editors and
file synchronization leave behind. They are checked if the user names them or a directory in them.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

from scaffold import lazy_re
from scaffold.formats.gitignore import IgnoreFile

if TYPE_CHECKING:
    from scaffold.files.disk import Disk

SUBMODULES, GITIGNORED, VENDORED, COPIES = "submodules", "gitignored", "vendored", "copies"
WHERE = {
    SUBMODULES: "in submodules",
    GITIGNORED: "ignored by git",
    VENDORED: "of vendored code",
    COPIES: "left by editors or synchronization",
}
"""The description of each kind in the report."""
ENVIRONMENTS = "environments"
"""Virtual environments, which are never checked."""

_COPIES = lazy_re.compile(
    r".+\.sync-conflict-|.*~$|\.#|#.*#$|.*\.(?:orig|rej)$|\..*\.sw[op]$", re.DOTALL
)
_VENDORED = frozenset(
    {"3rdparty", "3rd_party", "third_party", "third-party", "thirdparty", "vendor", "vendored"}
)
_LICENSES = ("LICENSE", "LICENCE", "COPYING")
"""Prefixes of license files, which vendored code includes."""
_MAX_BYTES = 200_000
"""The size limit of git files with patterns or paths."""


class Foreign:
    """Decides which files are foreign.

    Args:
        kinds: The kinds of foreign files, keys of `WHERE`.
    """

    def __init__(self, kinds: Sequence[str] = ()) -> None:
        self.kinds = frozenset(kinds)
        self._given: set[str] = set()
        self._around: dict[str, tuple[str, str]] = {}
        self.packages: list[str] = []
        """The kind of each skipped foreign package."""
        self._kinds: dict[tuple[str, bool], str] = {}
        self._named: dict[tuple[str, bool], bool] = {}
        self._repositories: dict[str, str] = {}
        self._submodules: dict[str, frozenset[str]] = {}
        self._patterns: dict[str, IgnoreFile | None] = {}
        self._tracked: dict[str, frozenset[str] | None] = {}

    def kind_of(self, disk: Disk, path: str, *, is_directory: bool) -> str:
        """Return the kind of a foreign path; empty if it is not foreign.

        Args:
            disk: Records accesses.
            path: The path, without links.
            is_directory: Whether it is a directory.
        """
        if not self.kinds or path in self._given:
            return ""
        top, kind = self._kind_around(disk, os.path.dirname(path))
        if not top or kind:
            return kind
        return self._own_kind(disk, path, top, is_directory=is_directory)

    def name(self, paths: Iterable[str]) -> None:
        """Register the real paths given by the user: directories above them are not foreign."""
        self._given.update(paths)
        for cache in (self._around, self._kinds, self._named):
            cache.clear()

    def _kind_around(self, disk: Disk, directory: str) -> tuple[str, str]:
        """Return the path given by the user at or above a directory, and its kind."""
        if directory not in self._around:
            parent = os.path.dirname(directory)
            if directory in self._given:
                result = directory, ""
            elif parent == directory:
                result = "", ""
            else:
                top, kind = self._kind_around(disk, parent)
                if top and not kind:
                    kind = self._own_kind(disk, directory, top, is_directory=True)
                result = top, kind
            self._around[directory] = result
        return self._around[directory]

    def _own_kind(self, disk: Disk, path: str, top: str, *, is_directory: bool) -> str:
        key = path, is_directory
        if key not in self._kinds:
            self._kinds[key] = self._judge(disk, path, top, is_directory=is_directory)
        return self._kinds[key]

    def _judge(self, disk: Disk, path: str, top: str, *, is_directory: bool) -> str:
        name = os.path.basename(path)
        if not is_directory and COPIES in self.kinds and _COPIES.match(name):
            return COPIES
        if is_directory and SUBMODULES in self.kinds and self._is_submodule(disk, path):
            return SUBMODULES
        if GITIGNORED in self.kinds:
            repository = self._repository_of(disk, os.path.dirname(path))
            is_named = self._is_named(disk, path, top, is_directory=is_directory)
            if is_named and self._is_untracked(disk, repository, path):
                return GITIGNORED
        if not is_directory or VENDORED not in self.kinds:
            return ""
        is_within = not _VENDORED.isdisjoint(path[len(top) :].split("/"))
        return VENDORED if is_within and disk.entries(path, *_LICENSES) else ""

    # -- git

    def _is_submodule(self, disk: Disk, path: str) -> bool:
        repository = self._repository_of(disk, os.path.dirname(path))
        # git only reads the file at the top of a checkout
        places = [repository] if repository else _parents(os.path.dirname(path))
        return any(path in self._submodules_of(disk, place) for place in places)

    def _submodules_of(self, disk: Disk, directory: str) -> frozenset[str]:
        if directory not in self._submodules:
            text = _text(disk, os.path.join(directory, ".gitmodules"))
            pairs = (line.partition("=") for line in text.splitlines())
            self._submodules[directory] = frozenset(
                os.path.normpath(os.path.join(directory, path.strip()))
                for key, _, path in pairs
                if key.strip() == "path" and path.strip()
            )
        return self._submodules[directory]

    def _is_named(self, disk: Disk, path: str, top: str, *, is_directory: bool) -> bool:
        """Return whether a pattern matches a path, or a directory above it and below another."""
        key = path, is_directory
        if key not in self._named:
            self._named[key] = False
            parent = os.path.dirname(path)
            repository = self._repository_of(disk, parent)
            is_inside = parent not in {top, repository}
            if is_inside and repository and self._is_named(disk, parent, top, is_directory=True):
                self._named[key] = True
            elif repository:
                self._named[key] = self._is_matched(
                    disk, repository, path, is_directory=is_directory
                )
        return self._named[key]

    def _is_matched(self, disk: Disk, repository: str, path: str, *, is_directory: bool) -> bool:
        result = False
        for directory in _between(repository, os.path.dirname(path)):
            decided = self._decides(disk, directory, path, is_directory=is_directory)
            result = result if decided is None else decided
        return result

    def _decides(self, disk: Disk, directory: str, path: str, *, is_directory: bool) -> bool | None:
        if directory not in self._patterns:
            text = _text(disk, os.path.join(directory, ".gitignore"))
            self._patterns[directory] = IgnoreFile(text) if text else None
        patterns = self._patterns[directory]
        if patterns is None:
            return None
        return patterns.decides(os.path.relpath(path, directory), is_directory=is_directory)

    def _repository_of(self, disk: Disk, directory: str) -> str:
        """Return the top of the checkout around a directory; empty without one."""
        if directory not in self._repositories:
            parent = os.path.dirname(directory)
            if disk.exists(os.path.join(directory, ".git")):
                self._repositories[directory] = directory
            else:
                repository = "" if parent == directory else self._repository_of(disk, parent)
                self._repositories[directory] = repository
        return self._repositories[directory]

    def _is_untracked(self, disk: Disk, repository: str, path: str) -> bool:
        """Return whether an ignored path is not tracked by git."""
        if repository not in self._tracked:
            self._tracked[repository] = _tracked(disk, repository)
        tracked = self._tracked[repository]
        return tracked is not None and os.path.relpath(path, repository) not in tracked


def _tracked(disk: Disk, repository: str) -> frozenset[str] | None:
    """Return the tracked files with their directories; ``None`` if unknown."""
    from subprocess import SubprocessError

    from scaffold.programs import git

    disk.stamp(_index_of(disk, repository))
    try:
        done = git.run("ls-files", "-z", directory=repository)
    except (OSError, SubprocessError):
        return None
    if done.returncode:
        return None
    result: set[str] = set()
    for path in os.fsdecode(done.stdout).split("\0"):
        above = path
        while above and above not in result:
            result.add(above)
            above = os.path.dirname(above)
    return frozenset(result)


def _index_of(disk: Disk, repository: str) -> str:
    """Return the index file of a checkout."""
    place = os.path.join(repository, ".git")
    if not disk.is_directory(place):
        matched = re.match(r"gitdir:\s*(.+)", _text(disk, place))
        place = os.path.join(repository, matched[1].strip()) if matched else place
    return os.path.join(place, "index")


def _text(disk: Disk, path: str) -> str:
    try:
        return disk.read(path, _MAX_BYTES).decode(errors="replace")
    except OSError:
        return ""


# -- paths


def _parents(path: str) -> Iterator[str]:
    while True:
        yield path
        parent = os.path.dirname(path)
        if parent == path:
            return
        path = parent


def _downwards(top: str, path: str) -> list[str]:
    """Return the paths from below a directory down to another path."""
    result = []
    for at in _parents(path):
        if at == top:
            break
        result.append(at)
    return result[::-1]


def _between(top: str, directory: str) -> list[str]:
    """Return a directory and those from it down to another."""
    return [top, *_downwards(top, directory)]
