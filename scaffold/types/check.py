"""Runs the type checker once over all packages, in the background."""

from __future__ import annotations

import os
import re
import shutil
import sys
import tempfile
from collections.abc import Callable, Collection, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from functools import cached_property

from scaffold import distributions, lazy_re
from scaffold.model.package import Package
from scaffold.model.python.module import is_collected
from scaffold.model.reads import Reads, recorded
from scaffold.types import environment, python_modules, ty
from scaffold.types.findings_cache import ReportCache, Reported
from scaffold.types.own_code import (
    is_about_own,
    own_name,
    with_own_marked,
    with_own_name,
)
from scaffold.types.passed_types import Types, signature
from scaffold.types.project import Checked, Project
from scaffold.types.rewriting.passed import callers
from scaffold.types.rewritten import rewriting
from scaffold.types.sources import Source, Sources
from scaffold.types.stubs.libraries import INCOMPLETE, partial_libraries
from scaffold.types.stubs.marks import MARK
from scaffold.types.ty import TyDiagnostic, UnavailableError

_CHANGED = frozenset({"collections", "random"})
"""Standard library modules with removed names that people still use."""
_DIFFERENT = frozenset(
    {"ast", "asyncio", "contextlib", "datetime", "enum", "itertools", "math", "pkgutil", "queue"}
    | {"sqlite3", "typing", "unittest", "uuid", "warnings"}
)
"""Standard library modules with names that only some of the supported Pythons have."""
_OF_MODULES = frozenset({"import-not-found", "missing-module-member"})
_STR = r'`(?:str|Literal\["[^`]*"\])`'
_CONTAINER = r"(?:dict|list|set|tuple|array)\[[^`]*\]"
_PLAIN = rf"`(?:str|bytes|int\*?|float\*?|Literal\[[^`]*\]|{_CONTAINER})`"
_NAMELESS = lazy_re.compile(
    rf"Object of type `(?:str|int|float|bool|bytes|CoroutineType\[.*\]|{_CONTAINER})`"
    r" has no attribute `\w+`"
    r"|Too many positional arguments: expected \d+, got \d+"
    r"|No arguments? provided for required parameters? (?:`\w+`(?:, )?)+"
    r"|(?:Not enough|Too many) values to unpack: Expected \d+.*"
    r"|(?:Object of type|Cannot subscript object of type) `(?:int|float|bool)`"
    r"(?: is not (?:callable|iterable)| with no .*)"
    r"|Operator `[^`]+` is not supported between objects of type `array\[\w+\]` and .*"
    r"|Operator `[^`]+` is not supported between (?:two )?objects of type "
    rf"{_PLAIN}(?: and {_PLAIN})?"
    rf"|Argument expression after \*\* must be a mapping type: Found {_PLAIN}"
    rf"|Argument to bound method `bytes\.\w+` is incorrect: Expected `.+`, found {_STR}"
)
"""Matches relevant reports that do not name anything of ROS."""
# linear: a line has 20 kB at most
_SUPPRESSION = lazy_re.compile(rb"noqa:[^\n]*\bTY[0-9]", re.IGNORECASE)


class _File:
    """A file to check: from the cache or by the type checker.

    Args:
        checked: The file.
        key: Its cache key.
        own_key: Its cache key without its callers.
        known: The cached reports.
    """

    def __init__(self, checked: Checked, key: str, own_key: str, known: Reported | None) -> None:
        self.checked = checked
        self.key = key
        self.own_key = own_key
        self.diagnostics = None if known is None else known.diagnostics
        self.is_confirmed = known is None or known.is_confirmed
        """Whether no report can be the consequence of an annotation."""
        self.silent_for = ""
        """The argument types of its callers with which nothing was reported; empty if unknown."""
        self.is_silent = False
        """Whether nothing is reported, however the files of its callers are edited."""


class TypeCheck:
    """Checks the Python files of packages; the type checker starts immediately.

    Args:
        packages: The packages.
        is_wanted: Tells by package and path whether to check a file.
        recalling: Returns the context manager in which a package is inspected.
        is_any_wrong: Tells by package and path whether any of the reports leads to a finding.
    """

    def __init__(
        self,
        packages: Sequence[Package],
        is_wanted: Callable[[Package, str], bool] = lambda _package, _path: True,
        recalling: Callable[[Package], AbstractContextManager[None]] = lambda _: nullcontext(),
        is_any_wrong: Callable[[Package, str, Sequence[TyDiagnostic]], bool] = lambda *_: True,
    ) -> None:
        self.failure = ""
        """Why types are not checked; empty if they are checked."""
        self._scratch = ""
        self._project: Project | None = None
        self._types: dict[str, Types] = {}
        """The types that modules pass to others, by place."""
        self._passing: dict[str, Mapping[str, Source]] = {}
        """The modules whose passed types are unknown, each with the files that it reaches."""
        self._asked: list[_File] = []
        self._waiting: list[_File] = []
        """Files without reports, unless their callers pass other types now."""
        self._files: dict[int, list[_File]] = {}
        """The files whose reports are not collected yet, by the id of the package."""
        self._diagnostics: dict[int, dict[str, Sequence[TyDiagnostic]]] = {}
        self._reached: dict[int, dict[str, Reads]] = {}
        self._suppressing: set[int] = set()
        self._packages = list(packages)  # keeps its id from being reused
        self._sources = Sources()
        self._is_any_wrong = is_any_wrong
        try:
            for package in self._packages:
                with recalling(package):
                    for path in package.python_files:
                        if is_wanted(package, path):
                            self._add(package, path)
            if self._asked or self._passing:
                self._project = self._started("project", self._asked, self._passing)
        except (UnavailableError, OSError) as error:
            self.failure = str(error)
            self.close()

    @cached_property
    def _environment(self) -> str:
        """The environment with the stubs."""
        return environment.directory(distributions.target(), self._directory)

    @cached_property
    def _stubbed(self) -> frozenset[str]:
        """The importable packages that have stubs."""
        entries = os.listdir(
            os.path.join(self._environment, environment.packages(distributions.target()))
        )
        names = frozenset(name.removesuffix(".pyi") for name in entries)
        return names - INCOMPLETE - partial_libraries()

    @cached_property
    def _cache(self) -> ReportCache:
        target = environment.identity(distributions.target())
        return ReportCache(f"{ty.identity()} {target} {sys.version_info[:2]}")

    def _add(self, package: Package, path: str) -> None:
        """Look up the cached reports of a file, and schedule it for the type checker otherwise."""
        stubbed, sources = self._stubbed, self._sources
        source = sources.get(package, path)
        if source is None:
            return
        reads = Reads()
        with recorded(reads):
            candidates = [sources.get(*caller) for caller in callers(package, path)]
        calling = [item for item in candidates if item is not None]
        own = sources.reached(source)
        roots = frozenset[str]().union(*(item.roots for item in own.values()))
        is_test = len(own) > 1 and is_collected(path.rpartition("/")[2])
        is_relevant = is_test or _is_relevant(source, roots, stubbed)
        of_callers = {caller.place: sources.reached(caller) for caller in calling}
        reached = {**own}
        for others in of_callers.values():
            reached.update(others)
        if _SUPPRESSION.search(source.data):
            self._suppressing.add(id(package))
        else:
            reads.files.update(
                item.package.full_path(item.path) for item in reached.values() if item.path
            )
            self._reached.setdefault(id(package), {})[path] = reads
        if not (is_relevant or calling) or _is_shadowed(source, stubbed | partial_libraries()):
            return
        if sources.are_others(package, roots):
            return
        key = self._cache.key(source, reached)
        own_key = self._cache.key(source, own, "silent") if calling else ""
        checked = Checked(source, calling, reached, is_relevant=is_relevant)
        file = _File(checked, key, own_key, self._cache.get(key))
        self._files.setdefault(id(package), []).append(file)
        if file.diagnostics is None and not self._is_silent(file, of_callers):
            self._asked.append(file)

    def _is_silent(self, file: _File, of_callers: Mapping[str, Mapping[str, Source]]) -> bool:
        """Return whether nothing is reported about a file; its argument types may follow later."""
        callers = file.checked.callers
        for caller in callers:
            if caller.place not in self._types and caller.place not in self._passing:
                reached = of_callers[caller.place]
                types = self._cache.get_value(self._cache.key(caller, reached, "passed"))
                if types is None:
                    self._passing[caller.place] = reached
                else:
                    self._types[caller.place] = types
        file.silent_for = (self._cache.get_value(file.own_key) or "") if callers else ""
        if not file.silent_for:
            return False
        if any(caller.place in self._passing for caller in callers):
            self._waiting.append(file)
            return True
        if self._signature(file) == file.silent_for:
            file.diagnostics = []
        return file.diagnostics is not None

    def _signature(self, file: _File) -> str:
        """Return a signature of the argument types of a file; empty if they are not known."""
        checked = file.checked
        types = [self._types[caller.place] for caller in checked.callers]
        received = signature(checked.source, types)
        roots = [sorted(_roots(checked.reached, are_stubs=are)) for are in (True, False)]
        return f"{received} {roots}" if received else ""

    def _started(
        self,
        name: str,
        asked: Sequence[_File],
        passing: Mapping[str, Mapping[str, Source]] | None = None,
        *,
        is_annotated: bool = True,
    ) -> Project:
        """Start the type checker on files, with everything that they import next to them."""
        checked = [file.checked for file in asked]
        rewrite = rewriting(self._cache, is_annotated=is_annotated)
        return Project(self._directory(name), self._environment, checked, rewrite, passing)

    def _directory(self, name: str) -> str:
        if not self._scratch:
            self._scratch = os.path.realpath(tempfile.mkdtemp(prefix="ros2-scaffold-"))
        return os.path.join(self._scratch, name)

    def reached_by(self, package: Package) -> Mapping[str, Reads]:
        """Return the signature of what the reports about each file depend on.

        Files with a comment that names a type rule are left out: whether it suppresses
        anything must be determined in each run.
        """
        return self._reached.get(id(package), {})

    def may_suppress(self, package: Package) -> bool:
        """Return whether a comment in a package names a type rule."""
        return id(package) in self._suppressing

    def by_file(self, package: Package) -> Mapping[str, Sequence[TyDiagnostic]]:
        """Return the reports of the type checker about the files of a package, by path."""
        if self._files:
            self._collect()
            for number, files in self._files.items():
                self._diagnostics[number] = {
                    file.checked.source.path: file.diagnostics for file in files if file.diagnostics
                }
            for kept in (self._files, self._asked, self._waiting, self._passing):
                kept.clear()
            self._sources = Sources()  # without the texts of all files
        if self.failure:
            return {}
        return self._diagnostics.get(id(package), {})

    def _collect(self) -> None:
        if self.failure:
            return
        asked: list[_File] = []
        try:
            if self._project is not None:
                self._read(self._asked)
                self._learn()
                late = [file for file in self._waiting if self._signature(file) != file.silent_for]
                if late:
                    self._project = self._started("late", late)
                    self._read(late)
                asked += (*self._asked, *self._waiting)
            asked += self._confirm()
        except (UnavailableError, OSError) as error:
            self.failure = str(error)
            return
        finally:
            self.close()
        self._store(dict.fromkeys(asked))

    def _read(self, files: Sequence[_File]) -> None:
        """Read the reports about files, and keep the relevant ones."""
        assert self._project is not None  # noqa: S101  it has been started
        for file in files:
            source, reached = file.checked.source, file.checked.reached
            reported = [
                with_own_name(item, source, reached.values())
                for item in self._project.reports(file.checked)
            ]
            stubbed = self._stubbed - _roots(reached, are_stubs=False)
            stubbed |= _roots(reached, are_stubs=True)
            file.diagnostics = [
                with_own_marked(item, reached.values())
                for item in reported
                if _is_library_report(item, stubbed) or is_about_own(item, source, reached.values())
            ]
            file.is_confirmed = not any(map(_may_be_annotated, file.diagnostics))
            file.is_silent = not (file.diagnostics or any(map(own_name, reported)))

    def _learn(self) -> None:
        """Read the types that modules pass to others."""
        assert self._project is not None  # noqa: S101  it has been started
        for place, reached in self._passing.items():
            types = self._types[place] = self._project.passed_types(place, reached)
            self._cache.put_value(self._cache.key(reached[place], reached, "passed"), types)

    def _store(self, files: Collection[_File]) -> None:
        """Cache the reports about the files that were checked."""
        for file in files:
            self._cache.put(file.key, Reported(file.diagnostics or (), file.is_confirmed))
            if file.is_silent and file.checked.callers:
                self._cache.put_value(file.own_key, self._signature(file))
        self._cache.trim()

    def _confirm(self) -> list[_File]:
        """Keep the reports that also appear without the annotations of the user's code.

        The second run is skipped for files whose reports lead to no finding, and for those without
        annotations.

        Returns:
            The files that were confirmed.
        """
        files = [
            file
            for files in self._files.values()
            for file in files
            if not file.is_confirmed and self._is_wrong(file)
        ]
        if not files:
            return []
        annotated = [file for file in files if self._is_annotated(file)]
        if annotated:
            self._project = self._started("unannotated", annotated, is_annotated=False)
        for file in annotated:
            assert self._project is not None  # noqa: S101  it was started for these files
            again = {item[:3] for item in self._project.reports(file.checked)}
            file.diagnostics = [
                item
                for item in file.diagnostics or ()
                if item[:3] in again or not _may_be_annotated(item)
            ]
        for file in files:
            file.is_confirmed = True
        return files

    def _is_annotated(self, file: _File) -> bool:
        """Return whether a file, or one that it depends on, has annotations of the user."""
        annotated, unannotated = (rewriting(self._cache, is_annotated=is_) for is_ in (True, False))
        reached = file.checked.reached.values()
        return any(unannotated(source).text != annotated(source).text for source in reached)

    def _is_wrong(self, file: _File) -> bool:
        source = file.checked.source
        return self._is_any_wrong(source.package, source.path, file.diagnostics or ())

    def close(self) -> None:
        """Stop the type checker and remove its files."""
        if self._project is not None:
            self._project.close()
            self._project = None
        if self._scratch:
            shutil.rmtree(self._scratch, ignore_errors=True)
            self._scratch = ""

    def __del__(self) -> None:
        self.close()


def _is_relevant(source: Source, roots: frozenset[str], stubbed: frozenset[str]) -> bool:
    """Return whether a file imports anything whose use can be checked."""
    if not source.imports.isdisjoint(python_modules.later_modules()):
        return True
    known = stubbed | python_modules.removed() | _CHANGED
    if distributions.target().python != distributions.named(distributions.DEFAULT).python:
        known |= _DIFFERENT
    return not roots.isdisjoint(known)


def _is_shadowed(source: Source, stubbed: frozenset[str]) -> bool:
    """Return whether a program imports a file next to it instead of a library."""
    if source.place.startswith(ty.LIBRARY):
        return False
    above = source.path.rpartition("/")[0]
    start = f"{above}/" if above else ""
    package = source.package
    return any(
        package.has(f"{start}{root}.py") or package.has(f"{start}{root}/__init__.py")
        for root in source.roots & (stubbed | sys.stdlib_module_names)
    )


def _roots(reached: Mapping[str, Source], *, are_stubs: bool) -> frozenset[str]:
    """Return the importable packages of the workspace: code and interfaces."""
    return frozenset(
        place.split("/")[1]
        for place, source in reached.items()
        if bool(source.path) is not are_stubs and place.startswith(f"{ty.LIBRARY}/")
    )


def _is_library_report(item: TyDiagnostic, stubbed: frozenset[str]) -> bool:
    """Return whether a report is about a library and relevant."""
    if item.kind in _OF_MODULES or item.message.startswith("Module `"):
        module, name = [*re.findall(r"`([\w.]+)`", item.message), "", ""][:2]
        root = module.partition(".")[0]
        if item.kind == "import-not-found":
            return root in stubbed or python_modules.is_of_another(module)
        if python_modules.still_has(module, name):
            return False
        return root in stubbed or root in sys.stdlib_module_names
    return MARK in item.message or _NAMELESS.fullmatch(item.message) is not None


def _may_be_annotated(item: TyDiagnostic) -> bool:
    """Return whether a report may be the consequence of an annotation."""
    return item.kind not in _OF_MODULES
