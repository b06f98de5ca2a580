"""The files of a package, and parsed views of them, each created once."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from fnmatch import filter as filter_names
from fnmatch import fnmatchcase
from typing import Any, TypeVar

from scaffold.errors import EXHAUSTED, OutOfTimeError, exhausted
from scaffold.files.disk import MAX_BYTES, LargeFileError
from scaffold.files.limits import most_bytes, too_large, why_unread
from scaffold.files.tree import CMAKE_LISTS, MANIFEST, SETUP_CFG, SETUP_PY, DiskTree, Tree
from scaffold.model import reads
from scaffold.model.facts import FactStore
from scaffold.model.reads import Reads
from scaffold.source import Location, MissingFileError, ParseError, Source, TooLargeError, ViewError

View = TypeVar("View")

_FILES_OF_VIEWS = {
    "manifest": MANIFEST,
    "cmake": CMAKE_LISTS,
    "setup_py": SETUP_PY,
    "setup_cfg": SETUP_CFG,
}


class PackageFiles(FactStore):
    """The files of a package, with cached views and facts."""

    def __init__(self, tree: Tree, directory: str) -> None:
        super().__init__(directory)
        self.tree = tree
        self.is_repeatable = True
        """False if findings may change without a change of recorded accesses."""
        self._views: dict[object, object] = {}
        self._reads: dict[object, Reads] = {}
        """The dependencies of the cached views."""
        self._refused: dict[str, ParseError] = {}

    @property
    def root(self) -> str | None:
        """The directory on disk, or ``None`` for a package in memory."""
        return self.tree.root if isinstance(self.tree, DiskTree) else None

    @property
    def place(self) -> str | None:
        """Its directory on disk, even if changes to it are in memory; see ``root``."""
        return getattr(self.tree, "place", self.root)

    @property
    def files(self) -> tuple[str, ...]:
        """All files, relative to the root."""
        return tuple(self.tree.files)

    def has(self, path: str) -> bool:
        """Return whether a file exists."""
        return path in self._file_set

    def has_directory(self, path: str) -> bool:
        """Return whether a directory exists (or is the root: ``""`` or ``"."``)."""
        return path in {"", "."} or path in self.tree.directories

    def glob(self, pattern: str) -> list[str]:
        """Return the files that match, where ``*`` matches anything but ``/``."""
        files = self._by_depth.get(pattern.count("/"), ())
        head, star, tail = pattern.partition("*")
        if not star or any(wildcard in head + tail for wildcard in "*?["):
            return filter_names(files, pattern)
        shortest = len(head) + len(tail)
        return [
            path
            for path in files
            if len(path) >= shortest and path.startswith(head) and path.endswith(tail)
        ]

    def listed(self, pattern: str, mode: str) -> list[str] | None:
        """Return what ``file()`` of CMake lists.

        Args:
            pattern: The pattern.
            mode: ``GLOB``, which also lists directories, or ``GLOB_RECURSE``.

        Returns:
            The paths; ``None`` if unknown.
        """
        if mode == "GLOB":
            depth = pattern.count("/")
            directories = [path for path in self.tree.directories if path.count("/") == depth]
            return [*self.glob(pattern), *filter_names(directories, pattern)]
        directory, _, name = pattern.rpartition("/")
        inside = f"{directory}/" if directory else ""
        if not {"*", "?", "["}.isdisjoint(directory):
            return None
        return [
            path
            for path in self.tree.files
            if path.startswith(inside) and fnmatchcase(path.rpartition("/")[2], name)
        ]

    def is_executable(self, path: str) -> bool:
        """Return whether a file has an executable bit."""
        return self.tree.is_executable(path)

    def source(self, path: str) -> Source:
        """Return the decoded text of a file.

        Raises:
            MissingFileError: there is no such file, or it cannot be read.
            ParseError: the file is not UTF-8.
        """
        self._note(path)
        return self._view(("source", path), lambda: Source.decode(path, self._read(path)))

    def data(self, path: str) -> bytes:
        """Return the bytes of a file, to be decoded by the caller.

        Raises:
            MissingFileError: there is no such file.
            ParseError: it cannot be read.
            TooLargeError: it is larger than people write.
        """
        self._note(path)
        return self._view(("data", path), lambda: self._read(path))

    def bytes_of(self, path: str, most: int = MAX_BYTES) -> bytes:
        """Return the content of a file without a view; raises OSError."""
        self._note(path)
        return self.tree.read(path, most)

    def start_of(self, path: str) -> Location:
        """Return the location of findings about a whole or missing file."""
        return Location.start_of(path)

    # -- views

    @property
    def parse_errors(self) -> list[ParseError]:
        """The parse errors of the views requested so far."""
        return [error for error in self._views.values() if isinstance(error, ParseError)]

    def remember(self, key: object, build: Callable[[], View]) -> View:
        """Return the result of ``build``, which is called once per key.

        For data shared by several rules and not in a view of this class. What it reads only when
        it is used, it must record itself, like ``RclpyFile``.
        """
        made_of = self._reads.get(key)
        if made_of is None:
            made_of = self._reads[key] = Reads()
        reads.note_view(made_of)
        if ("derived", key) in self._views:
            return self._view(("derived", key), build)
        with reads.recorded(made_of):
            return self._view(("derived", key), build)

    def refuse(self, path: str, message: str) -> bool:
        """Mark a file as unparsable, for errors found later.

        Returns:
            Whether it was not marked before.
        """
        if path in self._refused:
            return False
        self._refused[path] = ParseError(Location.start_of(path), message)
        errors = {key: view for key, view in self._views.items() if isinstance(view, ViewError)}
        self._views = {**errors, ("source", path): self._refused[path]}
        self.forget_facts()
        return True

    def forget(self) -> None:
        """Drop the facts, the views and the list of files, to be computed again."""
        self._facts.clear()
        self.forget_views()

    def forget_views(self, kept: Collection[str] = ()) -> None:
        """Drop the views and the list of files, but no facts, which other packages may need.

        Args:
            kept: The files, by ``full_path``, to keep parsed.
        """
        if self._refused:  # whose facts are recorded
            self._facts.clear()
            self._refused.clear()
            kept = ()
        modules = {("module", path.removeprefix(self.full_path(""))) for path in kept}
        self._views = {
            key: view
            for key, view in self._views.items()
            if key in modules and not isinstance(view, ViewError)
        }
        self._reads.clear()
        if isinstance(self.tree, DiskTree):
            self.tree.forget()

    def full_path(self, path: str) -> str:
        """Return the path of a file that is unique among packages."""
        return f"{self.directory}/{path}"

    def _note(self, path: str) -> None:
        if reads.is_followed(path):
            reads.note_file(self.full_path(path))

    @property
    def _by_depth(self) -> Mapping[int, Sequence[str]]:
        """The files by depth."""

        def build() -> dict[int, list[str]]:
            result: dict[int, list[str]] = {}
            for path in self.tree.files:
                result.setdefault(path.count("/"), []).append(path)
            return result

        return self._view("by_depth", build)

    @property
    def _file_set(self) -> frozenset[str]:
        return self._view("file_set", lambda: frozenset(self.tree.files))

    def _read(self, path: str) -> bytes:
        if not self.has(path):
            raise MissingFileError(path)
        if path in self._refused:
            raise self._refused[path]
        at = Location.start_of(path)
        try:
            data = self.tree.read(path, most_bytes(path))
        except LargeFileError as error:
            raise TooLargeError(at, too_large(error.size, path)) from error
        except OSError as error:
            reason = error.strerror or str(error)
            raise ParseError(at, f"cannot be read: {reason}") from error
        reason = why_unread(path, data)
        if reason:
            raise TooLargeError(at, reason)
        return data

    def _path_of(self, key: object) -> str | None:
        """Return the file of a view, if its key has one."""
        words = key if isinstance(key, tuple) else (key,)
        for word in words:
            if isinstance(word, tuple):
                path = self._path_of(word)
                if path is not None:
                    return path
            elif isinstance(word, str):
                path = _FILES_OF_VIEWS.get(word, word)
                if path in self.tree.files:
                    return path
        return None

    def _view(self, key: object, build: Callable[[], View]) -> View:
        """Build a view once; an error is cached and raised again."""
        if key not in self._views:
            try:
                self._views[key] = build()
            except ViewError as error:
                self._views[key] = error
            except EXHAUSTED as error:
                path = self._path_of(key)
                if path is None:
                    raise
                self.is_repeatable &= not isinstance(error, OutOfTimeError)
                self._views[key] = ParseError(Location.start_of(path), exhausted(error))
        view: Any = self._views[key]
        if isinstance(view, ViewError):
            raise view
        return view  # type: ignore[no-any-return]  # what build made
