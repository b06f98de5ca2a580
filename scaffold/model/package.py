"""A package: lazily parsed views of its files, and what is around it."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from typing import TYPE_CHECKING, cast

from scaffold.files.tree import (
    CMAKE_LISTS,
    MANIFEST,
    SETUP_CFG,
    SETUP_PY,
    DiskTree,
    MemoryTree,
    Tree,
)
from scaffold.model.facts import fact
from scaffold.model.package_files import PackageFiles
from scaffold.record import NamedTuple
from scaffold.source import MissingFileError, ParseError, Source, ViewError

if TYPE_CHECKING:
    import os

    from scaffold.files.disk import Disk
    from scaffold.formats.ini import IniFile
    from scaffold.model.cmake.lists import CMakeLists
    from scaffold.model.manifest.manifest import Manifest
    from scaffold.model.python.module import PythonModule
    from scaffold.model.setup_py.setup_py import SetupPy
    from scaffold.model.workspace.workspace import Workspace, WorkspaceView

_INTERFACES = (".msg", ".srv", ".action", ".idl")


class Identity(NamedTuple):
    """The properties of a package on which findings in other packages may depend."""

    name: str
    may_define_interfaces: bool
    build_type: str
    is_for_ros1: bool


class Package(PackageFiles):
    """A ROS 2 package as rules see it.

    An unavailable view raises ViewError: MissingFileError if its file does not exist,
    ParseError when it cannot be parsed. Rules let it pass: the runner silences the rule and
    reports the parse error once.
    """

    def __init__(
        self, tree: Tree, *, directory: str = "", workspace: Workspace[Package] | None = None
    ) -> None:
        super().__init__(tree, directory)
        self._workspace = workspace
        self._neighborhood: WorkspaceView[Package] | None = None
        self._identity: Identity | None = None

    @classmethod
    def at(
        cls,
        directory: str | os.PathLike[str],
        workspace: Workspace[Package] | None = None,
        disk: Disk | None = None,
    ) -> Package:
        """Return the package in a directory.

        Args:
            directory: The directory.
            workspace: The workspace around it.
            disk: Records accesses to it, if not the package itself.
        """
        tree = DiskTree(directory, disk)
        return cls(tree, directory=tree.root, workspace=workspace)

    @classmethod
    def of(cls, files: Mapping[str, str | bytes], executable: tuple[str, ...] = ()) -> Package:
        """Return a package in memory."""
        return cls(MemoryTree(files, executable))

    # -- files

    def editable(self, path: str) -> Source:
        """Return the text that the offsets of edits refer to, in the file's own encoding."""
        if path == MANIFEST:
            return self.manifest.source
        if path.endswith(".py"):
            with suppress(ParseError):
                return self._decoded(path)
        return self.source(path)

    def _decoded(self, path: str) -> Source:
        from scaffold.model.python.parsing import decode

        self._note(path)
        return self._view(("decoded", path), lambda: decode(path, self._read(path)))

    # -- views

    @property
    def manifest(self) -> Manifest:
        """package.xml."""
        self._note(MANIFEST)
        return self._manifest

    @property
    def _manifest(self) -> Manifest:
        """The manifest for the identity, which does not depend on its other content."""

        def parse() -> Manifest:
            from scaffold.model.manifest.manifest import Manifest, decode

            return Manifest.parse(decode(MANIFEST, self._read(MANIFEST)))

        return self._view("manifest", parse)

    @property
    def cmake(self) -> CMakeLists:
        """CMakeLists.txt, if used: colcon builds ament_python with setup.py."""

        def parse() -> CMakeLists:
            from scaffold.model.cmake.inclusion import splice_included
            from scaffold.model.cmake.lists import CMakeLists

            if self.build_type == "ament_python" and self.has(SETUP_PY):
                raise MissingFileError(CMAKE_LISTS)
            lists = CMakeLists.parse(self.source(CMAKE_LISTS))
            for at, message in lists.errors:
                raise ParseError(at, message)
            splice_included(self, lists)
            return lists

        self._note(CMAKE_LISTS)
        return self.remember("cmake", parse)

    @property
    def setup_py(self) -> SetupPy:
        """setup.py, with the keywords that setup.cfg adds."""

        def parse() -> SetupPy:
            from scaffold.model.setup_py.setup_py import SetupPy

            cfg = None
            if self.has(SETUP_CFG):
                with suppress(ViewError):
                    cfg = self.setup_cfg
            return SetupPy(self.module(SETUP_PY), self, cfg)

        self._note(SETUP_PY)
        return self.remember("setup_py", parse)

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
        """Return a Python file if it has been parsed already."""
        view = self._views.get(("module", path))
        return None if isinstance(view, ViewError) else cast("PythonModule | None", view)

    def imports(self, path: str) -> frozenset[str]:
        """Return the top-level packages that a Python file imports, a fact; raises ViewError."""
        return imports(self, path)

    def is_mentioned_once(self, word: str, path: str) -> bool:
        """Return whether a word of a Python file occurs nowhere else in the package, a fact."""
        return is_mentioned_once(self, word, path)

    def modules(
        self, paths: Iterable[str] | None = None, mentioning: Sequence[str] = ()
    ) -> Iterator[PythonModule]:
        """All Python files that can be parsed; the others are reported by the runner.

        Args:
            paths: Only these.
            mentioning: Words without which a file is skipped without parsing.
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
        """The identity, if it has been computed already."""
        return self._identity

    def identify(self, identity: Identity) -> None:
        """Use the identity computed by another process or an earlier run."""
        self._identity = identity

    @property
    def build_type(self) -> str:
        """``ament_cmake``, ``ament_python`` ...: as declared, or implied by the files."""
        try:
            declared = self._manifest.build_type
        except ViewError:
            declared = None
        if declared:
            return declared
        return "ament_cmake" if self.has(CMAKE_LISTS) else "ament_python"

    @property
    def workspace(self) -> WorkspaceView[Package]:
        """The packages around this one, itself included."""
        if self._neighborhood is None:
            from scaffold.model.workspace.workspace import Workspace, WorkspaceView

            around = self._workspace or Workspace([self], self.outside)
            self._neighborhood = WorkspaceView(around, self.directory)
        return self._neighborhood

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
    def known_workspace(self) -> Workspace[Package] | None:
        """The workspace given from outside, if any."""
        return self._workspace

    # -- changes

    def forget_views(self, kept: Collection[str] = ()) -> None:
        """Drop the views, and the packages around this one if no workspace was given."""
        super().forget_views(kept)
        if self._workspace is None:
            self._neighborhood = None

    def forget_others(self) -> None:
        """Drop what derives from the packages around this one."""
        self.workspace.forget()

    def change(self, tree: Tree) -> None:
        """Replace the files of the package; see `Workspace.forget`."""
        self.tree = tree
        self._identity = None
        self._recalls.clear()
        self.forget()


@fact
def imports(package: Package, path: str) -> frozenset[str]:
    """Return the top-level packages that a Python file imports; raises ViewError."""
    return frozenset(package.module(path).imports_by_root)


@fact
def mentions(package: Package, path: str, *words: str) -> bool:
    """Return whether a file contains all of some words; raises ViewError."""
    data = package.data(path)
    return all(word.encode() in data for word in words)


@fact
def is_mentioned_once(package: Package, word: str, path: str) -> bool:
    """Return whether a word of a Python file occurs nowhere else: in no call, import or text."""
    searched = word.encode()
    if package.data(path).count(searched) != 1:
        return False  # without reading other files, so that edits of those do not matter
    for other in package.python_files:
        with suppress(ViewError):
            if other != path and searched in package.data(other):
                return False
    return True
