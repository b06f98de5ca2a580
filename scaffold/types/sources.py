"""Copies the Python files of a workspace to where they are importable once installed.

The Python package with the name of the ROS package is importable by all files; other files
(programs, tests, launch files) are not importable. The imports of a file are found in its text, and
determine which files the type checker reads.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from functools import cached_property

from scaffold import lazy_re
from scaffold.files.disk import digest
from scaffold.files.limits import most_bytes, why_unread
from scaffold.model.interfaces.syntax import SECTIONS
from scaffold.model.package import Package
from scaffold.types.environment import marked
from scaffold.types.rewriting.callbacks import with_callback_types
from scaffold.types.stubs.libraries import interface_stub_files
from scaffold.types.ty import LIBRARY

# linear: an open bracket is followed for 4 kB at most, and spaces for a line
_IMPORT = lazy_re.compile(
    rb"""[ \t]*
    (?: from [ \t]+ (?P<base>[.\w]+) [ \t]+ import [ \t]* (?P<names>\([^)]{0,4000}\)|[^\n#;]*)
      | from [ \t]* (?P<dots>\.+) [ \t]* import [ \t]* (?P<siblings>\([^)]{0,4000}\)|[^\n#;]*)
      | import [ \t]+ (?P<modules>[^\n#;]+) )""",
    re.VERBOSE,
)
_OF_PYTHON = "_py"
"""The suffix of a ROS package that its Python package lacks: ``tf2_ros_py``."""
_LATER = lazy_re.compile(rb"[;:][ \t]*(?=(?:from|import)[ \t])")
"""Matches what is before a second statement on a line."""
_WORD = lazy_re.compile(rb"[\w.]+")
_CLASS = lazy_re.compile(rb"\bclass (\w+)")


class Source:
    """A file as a type checker sees it.

    Args:
        package: The package of the file.
        path: Its path in the package; empty for stubs, which are generated.
        place: Its path for the type checker.
        module: The package that relative imports start from; empty if it is not importable.
        data: The content.
    """

    def __init__(self, package: Package, path: str, place: str, module: str, data: bytes) -> None:
        self.package = package
        self.path = path
        self.place = place
        self.data = data
        self.digest = digest(data)
        self.imports = frozenset(name for name, _ in imported_names(data, module))
        """Dotted names of modules, or of names in modules."""
        self.roots = frozenset(name.partition(".")[0] for name in self.imports)

    @property
    def dotted(self) -> str:
        """The dotted module name; empty if it cannot be imported."""
        parts = self.place.removesuffix(".py").split("/")
        return ".".join(parts[1:]) if parts[0] == LIBRARY else ""

    @cached_property
    def classes(self) -> frozenset[str]:
        """The names of the classes that it may define."""
        return frozenset(map(bytes.decode, _CLASS.findall(self.data)))

    @cached_property
    def with_callback_types(self) -> bytes:
        """The content with annotated callbacks.

        Tabs are single spaces and lines end as on Unix, so that columns do not change: Python
        only accepts indentation whose meaning does not depend on the width of tabs.
        """
        return with_callback_types(self.data.replace(b"\r\n", b"\n").replace(b"\t", b" "))


def imported_names(data: bytes, module: str) -> Iterator[tuple[str, str]]:
    """Yield all imports as absolute dotted names, each with its local name.

    Args:
        data: The content of a file.
        module: The package that its relative imports start from; empty if there is none.
    """
    if b"import" not in data:
        return
    text = _LATER.sub(b"\n", data.replace(b"\\\r\n", b" ").replace(b"\\\n", b" "))
    for match in _import_statements(text):
        if match["modules"] is not None:
            for part in match["modules"].split(b","):
                name, called = _name_and_alias(part)
                if name:
                    yield name, called
            continue
        base = (match["base"] or match["dots"]).decode("utf-8", "replace")
        names = match["names"] if match["base"] else match["siblings"]
        absolute = _absolute(base, module)
        if absolute is None:
            continue
        yield absolute, ""
        for part in re.sub(rb"#[^\n]*", b"", names).strip(b"( )").split(b","):
            name, called = _name_and_alias(part)
            if name:
                yield f"{absolute}.{name}", called


def _import_statements(text: bytes) -> Iterator[re.Match[bytes]]:
    """Yield the imports; trying the expression at each line takes twice as long."""
    at = text.find(b"import")
    while at >= 0:
        match = _IMPORT.match(text, text.rfind(b"\n", 0, at) + 1)
        if match is not None:
            yield match
            at = match.end()
        line_end = text.find(b"\n", at)
        at = text.find(b"import", line_end) if line_end >= 0 else -1


def _name_and_alias(part: bytes) -> tuple[str, str]:
    """Return an imported name and its alias: ``pose`` and ``p`` for ``pose as p``."""
    words = [word.decode("utf-8", "replace") for word in _WORD.findall(part)]
    return (words[0], words[-1]) if words else ("", "")


def _absolute(base: str, module: str) -> str | None:
    """Return a module as an absolute name; ``None`` for a relative one that cannot be imported."""
    name = base.lstrip(".")
    level = len(base) - len(name)
    if not level:
        return name
    parts = module.split(".")
    if not module or level > len(parts):
        return None
    above = parts[: len(parts) - level + 1]
    return ".".join([*above, name] if name else above)


class Sources:
    """The files of a workspace, each read once."""

    def __init__(self) -> None:
        self._packages: dict[int, _PackageSources] = {}
        self._looked_up: dict[tuple[int, str], Package | None] = {}
        self._imported: dict[tuple[int, str], list[Source]] = {}

    def get(self, package: Package, path: str) -> Source | None:
        """Return a file of a package; ``None`` if it cannot be read or is too large."""
        return self._sources_of(package).source(path)

    def reached(self, source: Source) -> Mapping[str, Source]:
        """Return a file and everything that it imports, directly or not, by place.

        Everything that is looked up counts as used by the package of the file.
        """
        result = {source.place: source}
        pending = [source]
        while pending:
            for other in self._directly(source.package, pending.pop()):
                if other.place not in result:
                    result[other.place] = other
                    pending.append(other)
        return result

    def are_others(self, user: Package, roots: Iterable[str]) -> bool:
        """Return whether code of a package refers to a package that is not importable here.

        Such a package has the name of another one in another workspace of the repository.

        Args:
            user: The package.
            roots: The top-level modules that the code imports.
        """
        packages = [self._package(user, root) for root in roots]
        return any(item is not None and user.workspace.is_hidden(item) for item in packages)

    def _directly(self, user: Package, source: Source) -> list[Source]:
        key = (id(user), source.place)
        if key not in self._imported:
            sources: dict[str, Source] = {}
            for name in source.imports:
                package = self._package(user, name.partition(".")[0])
                if package is not None:
                    sources.update(
                        (item.place, item) for item in self._sources_of(package).modules(name)
                    )
            self._imported[key] = list(sources.values())
        return self._imported[key]

    def _package(self, user: Package, root: str) -> Package | None:
        """Return the package of the workspace that has a top-level module."""
        key = (id(user), root)
        if key not in self._looked_up:
            names = (root, f"{root}{_OF_PYTHON}")
            candidates = [user if user.name == name else user.workspace.get(name) for name in names]
            packages = [item for item in candidates if item is not None]
            if user not in packages and _has_module(user, root):
                packages = []  # the package itself, even if another workspace has one of this name
            importable = [item for item in packages if self._sources_of(item).provides(root)]
            self._looked_up[key] = next(iter(importable or packages), None)
        return self._looked_up[key]

    def _sources_of(self, package: Package) -> _PackageSources:
        if id(package) not in self._packages:
            self._packages[id(package)] = _PackageSources(package)
        return self._packages[id(package)]


def _has_module(package: Package, root: str) -> bool:
    """Return whether a package has an importable package of a name, with code in it."""
    return any(package.has(f"{above}{root}/__init__.py") for above in ("", "src/"))


class _PackageSources:
    """The files of a package."""

    def __init__(self, package: Package) -> None:
        self._package = package
        self._sources: dict[str, Source | None] = {}
        self._stubs: list[Source] | None = None
        self._files = frozenset(package.tree.files)
        self._root = package.name.removesuffix(_OF_PYTHON)
        self._above = self._find_above()
        # Files in a directory of this name cannot be imported.
        place = f"{package.name} {package.directory}".encode("utf-8", "surrogateescape")
        self._outside = f"files-{digest(place)[:16]}"

    def _find_above(self) -> str | None:
        """Return the directory above the importable package, with its slash; ``None`` without."""
        name = self._package.name
        if not name.isidentifier() or self._package.workspace.is_hidden(self._package):
            return None  # another package of the same name is imported instead
        for root in dict.fromkeys((name, self._root)):
            for above in ("", "src/"):
                start = f"{above}{root}/"
                if any(path.startswith(start) and path.endswith(".py") for path in self._files):
                    self._root = root
                    return above
        return None

    def provides(self, root: str) -> bool:
        """Return whether the package has an importable package of this name."""
        return self._above is not None and self._root == root

    def source(self, path: str) -> Source | None:
        """Return a file; ``None`` if it cannot be read or is too large."""
        if path not in self._sources:
            self._sources[path] = self._read(path)
        return self._sources[path]

    def _read(self, path: str) -> Source | None:
        try:
            path.encode()
            data = self._package.tree.read(path, most_bytes(path))
        except (OSError, UnicodeEncodeError):
            return None
        if why_unread(path, data):
            return None
        place, module = self._place(path)
        return Source(self._package, path, place, module, data)

    def _place(self, path: str) -> tuple[str, str]:
        name = path if path.endswith(".py") else f"{path}.py"
        start = None if self._above is None else f"{self._above}{self._root}/"
        if start is None or not path.startswith(start):
            return f"{self._outside}/{name}", ""
        place = name[len(self._above or "") :]
        # Relative imports of a module and of __init__.py start from the same package.
        return f"{LIBRARY}/{place}", place.rpartition("/")[0].replace("/", ".")

    def modules(self, name: str) -> Iterator[Source]:
        """Yield the files that importing a dotted name may read."""
        yield from self._interfaces(name)
        if self._above is None:
            return
        parts = name.split(".")
        for depth in range(1, len(parts) + 1):
            start = self._above + "/".join(parts[:depth])
            for path in (f"{start}.py", f"{start}/__init__.py"):
                source = self.source(path) if path in self._files else None
                if source is not None:
                    yield source

    def _interfaces(self, name: str) -> list[Source]:
        """Return the stubs of the interfaces that the package defines."""
        parts = name.split(".")
        if len(parts) < 2 or parts[1] not in SECTIONS:  # noqa: PLR2004  package and kind
            return []
        if self._stubs is None:
            endings = tuple(f".{kind}" for kind in SECTIONS)
            self._stubs = []
            if any(path.endswith(endings) for path in self._files):
                files = interface_stub_files(self._package)
                self._stubs = [
                    Source(
                        self._package,
                        "",
                        f"{LIBRARY}/{path}",
                        path.rpartition("/")[0].replace("/", "."),
                        marked(path, text).encode(),
                    )
                    for path, text in files.items()
                    if self._above is None or path != f"{self._package.name}/__init__.pyi"
                ]
        return self._stubs
