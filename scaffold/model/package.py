"""A package: its files, and lazily parsed views of them."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from fnmatch import filter as filter_names
from typing import TYPE_CHECKING, Any, TypeVar, cast

from scaffold.errors import EXHAUSTED, OutOfTimeError, exhausted
from scaffold.files.disk import MAX_BYTES, LargeFileError
from scaffold.files.limits import most_bytes, too_large, why_unread
from scaffold.files.tree import (
    CMAKE_LISTS,
    MANIFEST,
    SETUP_CFG,
    SETUP_PY,
    DiskTree,
    MemoryTree,
    Tree,
)
from scaffold.model import reads
from scaffold.model.facts import Fact, fact
from scaffold.model.reads import Reads
from scaffold.record import NamedTuple
from scaffold.source import Location, MissingFileError, ParseError, Source, TooLargeError, ViewError

if TYPE_CHECKING:
    import os

    from scaffold.files.disk import Disk
    from scaffold.formats.ini import IniFile
    from scaffold.model.cmake.lists import CMakeLists
    from scaffold.model.facts import Key
    from scaffold.model.manifest.manifest import Manifest
    from scaffold.model.python.module import PythonModule
    from scaffold.model.setup_py.setup_py import SetupPy
    from scaffold.model.workspace.workspace import Workspace, WorkspaceView

View = TypeVar("View")

_FILES_OF_VIEWS = {
    "manifest": MANIFEST,
    "cmake": CMAKE_LISTS,
    "setup_py": SETUP_PY,
    "setup_cfg": SETUP_CFG,
}
_INTERFACES = (".msg", ".srv", ".action", ".idl")


class Identity(NamedTuple):
    """What all that is found in a package, or in others of its workspace, may depend on."""

    name: str
    may_define_interfaces: bool
    build_type: str
    is_for_ros1: bool


class Package:
    """A ROS 2 package as rules see it.

    A view that cannot be had raises ViewError: MissingFileError when its file is not there,
    ParseError when it cannot be parsed. Rules let it pass: the runner silences the rule and
    reports the parse error once.
    """

    def __init__(
        self, tree: Tree, *, directory: str = "", workspace: Workspace | None = None
    ) -> None:
        self.tree = tree
        self.directory = directory
        """Path of the root as the user wrote it; empty for a package in memory."""
        self._workspace = workspace
        self.is_repeatable = True
        """False when the verdict may change although nothing does that was noted."""
        self._neighbourhood: WorkspaceView | None = None
        self._identity: Identity | None = None
        self._views: dict[object, object] = {}
        self._reads: dict[object, Reads] = {}
        """What the remembered views were made of."""
        self._facts: dict[Key, Fact] = {}
        self._recalls: list[Callable[[Key], Fact | None]] = []
        self._refused: dict[str, ParseError] = {}

    @classmethod
    def at(
        cls,
        directory: str | os.PathLike[str],
        workspace: Workspace | None = None,
        disk: Disk | None = None,
    ) -> Package:
        """Return the package in a directory.

        Args:
            directory: The directory.
            workspace: What is around it.
            disk: Records what was accessed in it, if the package itself is not to.
        """
        tree = DiskTree(directory, disk)
        return cls(tree, directory=tree.root, workspace=workspace)

    @classmethod
    def of(cls, files: Mapping[str, str | bytes], executable: tuple[str, ...] = ()) -> Package:
        """Return a package in memory."""
        return cls(MemoryTree(files, executable))

    # -- files

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
        """Tell whether a file exists."""
        return path in self._file_set

    def has_directory(self, path: str) -> bool:
        """Tell whether a directory exists (or is the root: ``""`` or ``"."``)."""
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

    def is_executable(self, path: str) -> bool:
        """Tell whether a file has an executable bit."""
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
        """Return the bytes of a file, for what decodes them in its own way.

        Raises:
            MissingFileError: there is no such file.
            ParseError: it cannot be read.
            TooLargeError: it is larger than people write.
        """
        self._note(path)
        return self._view(("data", path), lambda: self._read(path))

    def bytes_of(self, path: str, most: int = MAX_BYTES) -> bytes:
        """Return what is in a file that no view is wanted of; raises OSError."""
        self._note(path)
        return self.tree.read(path, most)

    def editable(self, path: str) -> Source:
        """Return the text that the offsets of edits count in, in the file's own encoding."""
        if path == MANIFEST:
            return self.manifest.source
        try:
            return self._decoded(path) if path.endswith(".py") else self.source(path)
        except ParseError:
            return self.source(path)

    def start_of(self, path: str) -> Location:
        """Return the place for what concerns a whole file, or a file that is missing."""
        return Location.start_of(path)

    # -- views

    @property
    def manifest(self) -> Manifest:
        """package.xml."""
        self._note(MANIFEST)
        return self._manifest

    @property
    def _manifest(self) -> Manifest:
        """The same for what is part of the identity: other changes of the file do not matter."""

        def parse() -> Manifest:
            from scaffold.model.manifest.manifest import Manifest

            return Manifest.parse(self._bytes_as_declared(MANIFEST))

        return self._view("manifest", parse)

    @property
    def cmake(self) -> CMakeLists:
        """CMakeLists.txt, unless it is not used: colcon builds ament_python with setup.py."""

        def parse() -> CMakeLists:
            from scaffold.model.cmake.lists import CMakeLists

            if self.build_type == "ament_python" and self.has(SETUP_PY):
                raise MissingFileError(CMAKE_LISTS)
            lists = CMakeLists.parse(self.source(CMAKE_LISTS))
            for at, message in lists.errors:
                raise ParseError(at, message)
            return lists

        self._note(CMAKE_LISTS)
        return self._view("cmake", parse)

    @property
    def setup_py(self) -> SetupPy:
        """setup.py."""

        def parse() -> SetupPy:
            from scaffold.model.setup_py.setup_py import SetupPy

            return SetupPy.parse(self.module(SETUP_PY))

        self._note(SETUP_PY)
        return self._view("setup_py", parse)

    @property
    def setup_cfg(self) -> IniFile:
        """setup.cfg."""
        self._note(SETUP_CFG)

        def parse() -> IniFile:
            from scaffold.formats.ini import IniFile

            return IniFile.parse(self.source(SETUP_CFG))

        return self._view("setup_cfg", parse)

    def module(self, path: str) -> PythonModule:
        """A Python file."""

        def parse() -> PythonModule:
            from scaffold.model.python.module import PythonModule

            return PythonModule.parse_bytes(path, self._read(path))

        self._note(path)
        return self._view(("module", path), parse)

    def parsed_module(self, path: str) -> PythonModule | None:
        """Return a Python file if somebody has asked for it before."""
        view = self._views.get(("module", path))
        return None if isinstance(view, ViewError) else cast("PythonModule | None", view)

    def imports(self, path: str) -> frozenset[str]:
        """Return the top-level packages that a Python file imports, a fact; raises ViewError."""
        return imports(self, path)

    def is_mentioned_once(self, word: str, path: str) -> bool:
        """Tell whether a word of a Python file occurs nowhere else in the package, a fact."""
        return is_mentioned_once(self, word, path)

    def modules(
        self, paths: Iterable[str] | None = None, mentioning: Sequence[str] = ()
    ) -> Iterator[PythonModule]:
        """All Python files that can be parsed; the others are reported by the runner.

        Args:
            paths: Only these.
            mentioning: Words without which a file is of no interest; it is not even parsed.
        """
        for path in self.python_files if paths is None else paths:
            try:
                if not mentioning or mentions(self, path, *mentioning):
                    yield self.module(path)
            except ViewError:
                continue

    @property
    def python_files(self) -> tuple[str, ...]:
        """The files that are Python by their name or, for scripts, by their first line."""
        return self._view("python_files", lambda: tuple(filter(self._is_python, self.files)))

    # -- identity

    @property
    def name(self) -> str:
        """The name in the manifest; without one, the name of the directory."""

        def find() -> str:
            try:
                name = self._manifest.name
            except ViewError:
                name = ""
            return name or self.directory.rstrip("/").rpartition("/")[2]

        return self._view("name", find)

    @property
    def identity(self) -> Identity:
        """See `Identity`; it is kept when the views are dropped."""
        if self._identity is None:
            defines = any(path.endswith(_INTERFACES) for path in self.tree.files)
            try:
                is_for_ros1 = self._manifest.catkin is not None
            except ViewError:
                is_for_ros1 = False
            self._identity = Identity(self.name, defines, self.build_type, is_for_ros1)
        return self._identity

    @property
    def known_identity(self) -> Identity | None:
        """The identity, if somebody asked for it before."""
        return self._identity

    def identify(self, identity: Identity) -> None:
        """Take over what another process or an earlier run found out."""
        self._identity = identity

    @property
    def build_type(self) -> str:
        """``ament_cmake``, ``ament_python`` ...: as declared, else as the files show."""
        try:
            declared = self._manifest.build_type
        except ViewError:
            declared = None
        if declared:
            return declared
        return "ament_cmake" if self.has(CMAKE_LISTS) else "ament_python"

    @property
    def workspace(self) -> WorkspaceView:
        """The packages around this one, itself included."""
        if self._neighbourhood is None:
            from scaffold.model.workspace.workspace import Workspace, WorkspaceView

            around = self._workspace or Workspace([self], self.outside)
            self._neighbourhood = WorkspaceView(around)
        return self._neighbourhood

    @property
    def outside(self) -> Disk:
        """The files around the package: the only way for a rule to look at them."""
        if self._workspace is not None:
            return self._workspace.disk
        if isinstance(self.tree, DiskTree):
            return self.tree.disk
        from scaffold.files.disk import Disk

        return Disk()

    @property
    def known_workspace(self) -> Workspace | None:
        """The workspace given from outside, if any."""
        return self._workspace

    @property
    def parse_errors(self) -> list[ParseError]:
        """What could not be parsed among the views asked for so far."""
        return [error for error in self._views.values() if isinstance(error, ParseError)]

    def remember(self, key: object, build: Callable[[], View]) -> View:
        """Return what ``build`` makes of the package; it is built once per key.

        For facts that several rules share and no view of this class has. What it reads only when
        it is used, it must note itself, as ``RclpyFile`` does.
        """
        made_of = self._reads.get(key)
        if made_of is None:
            made_of = self._reads[key] = Reads()
        reads.note_view(made_of)
        if ("derived", key) in self._views:
            return self._view(("derived", key), build)
        with reads.recorded(made_of):
            return self._view(("derived", key), build)

    def fact(self, key: Key, make: Callable[[], View]) -> View:
        """Return a fact; see `scaffold.model.facts.fact`."""
        fact = self._facts.get(key) or self._recall(key)
        if fact is None:
            fact = Fact(self.directory, key)
            fact.make(make)
            self._facts[key] = fact
        reads.note_fact(fact)
        if fact.error is not None:
            raise fact.error
        value: Any = fact.value
        return value  # type: ignore[no-any-return]  # what make made

    def known_fact(self, key: Key) -> Fact | None:
        """Return a fact that was asked for, or that is known from an earlier run."""
        return self._facts.get(key) or self._recall(key)

    @property
    def facts(self) -> Sequence[Fact]:
        """The facts that were asked for."""
        return [*self._facts.values()]

    def assume_facts(self, recall: Callable[[Key], Fact | None]) -> None:
        """Take over what an earlier run found out, as far as it is the same."""
        self._recalls.append(recall)

    def forget_facts(self) -> None:
        """Drop the facts, and what an earlier run knew of them."""
        self._facts.clear()
        self._recalls.clear()

    def end_assumptions(self) -> None:
        """Drop what an earlier run knew of the facts, and those that are made of such facts."""
        self._recalls.clear()
        self._facts = {key: fact for key, fact in self._facts.items() if fact.is_of_files}

    def _recall(self, key: Key) -> Fact | None:
        for recall in self._recalls:
            fact = recall(key)
            if fact is not None:
                self._facts[key] = fact
                return fact
        return None

    def refuse(self, path: str, message: str) -> bool:
        """Count a file as unparsable from now on, for what only a look at its contents shows.

        Returns:
            Whether it was not refused before.
        """
        if path in self._refused:
            return False
        self._refused[path] = ParseError(Location.start_of(path), message)
        errors = {key: view for key, view in self._views.items() if isinstance(view, ViewError)}
        self._views = {**errors, ("source", path): self._refused[path]}
        self.forget_facts()
        return True

    def forget(self) -> None:
        """Drop the facts, the views and the list of files: they are made again when asked for."""
        self._facts.clear()
        self.forget_views()

    def forget_views(self, kept: Collection[str] = ()) -> None:
        """Drop the views and the list of files, but no facts: other packages may ask for those.

        Args:
            kept: The files, by ``full_path``, that stay parsed.
        """
        if self._refused:  # which the facts know of
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
        if self._workspace is None:
            self._neighbourhood = None
        if isinstance(self.tree, DiskTree):
            self.tree.forget()

    def change(self, tree: Tree) -> None:
        """Put other files in place of those of the package; see `Workspace.forget`."""
        self.tree = tree
        self._identity = None
        self._recalls.clear()
        self.forget()

    # -- inside

    def _decoded(self, path: str) -> Source:
        from scaffold.model.python.parsing import decode

        self._note(path)
        return self._view(("decoded", path), lambda: decode(path, self._read(path)))

    def full_path(self, path: str) -> str:
        """Return how a file is called where there are several packages."""
        return f"{self.directory}/{path}"

    def _note(self, path: str) -> None:
        if reads.is_followed(path):
            reads.note_file(self.full_path(path))

    @property
    def _by_depth(self) -> Mapping[int, Sequence[str]]:
        """The files by the number of directories that they lie in."""

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

    def _bytes_as_declared(self, path: str) -> Source:
        from scaffold.model.manifest.manifest import decode

        return decode(path, self._read(path))

    def _is_python(self, path: str) -> bool:
        name = path.rpartition("/")[2]
        if name.endswith(".py"):
            return True
        if "." in name or not self.is_executable(path):
            return False
        try:
            first = self._read(path)[:128].partition(b"\n")[0]
        except ViewError:
            return False
        return first.startswith(b"#!") and b"python" in first

    def _path_of(self, key: object) -> str | None:
        """Return the file that a view is built from, if its key names one."""
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
        """Build a view once; an error is remembered and raised again."""
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


@fact
def imports(package: Package, path: str) -> frozenset[str]:
    """Return the top-level packages that a Python file imports; raises ViewError."""
    return frozenset(package.module(path).imports_by_root)


@fact
def mentions(package: Package, path: str, *words: str) -> bool:
    """Tell whether a file contains all of some words; raises ViewError."""
    data = package.data(path)
    return all(word.encode() in data for word in words)


@fact
def is_mentioned_once(package: Package, word: str, path: str) -> bool:
    """Tell whether a word of a Python file occurs nowhere else: in no call, import or text."""
    searched = word.encode()
    if package.data(path).count(searched) != 1:
        return False  # without a look at other files, so that edits of those do not matter
    for other in package.python_files:
        with suppress(ViewError):
            if other != path and searched in package.data(other):
                return False
    return True
