"""Types of packages: one run of the type checker over all of them, started in the background."""

from __future__ import annotations

import os
import re
import shutil
import sys
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence

from scaffold import distributions
from scaffold.model.package import Package
from scaffold.model.reads import Reads, recorded
from scaffold.types import environment, python_modules, ty
from scaffold.types.added_lines import Extended
from scaffold.types.arguments import with_arguments
from scaffold.types.findings_cache import Cache
from scaffold.types.marks import MARK
from scaffold.types.own_code import is_about_own
from scaffold.types.passed import callers
from scaffold.types.sources import Source, Sources
from scaffold.types.stubs import INCOMPLETE, partial_libraries
from scaffold.types.ty import TyDiagnostic, UnavailableError
from scaffold.types.unannotated import without_annotations

_CHANGED = frozenset({"collections", "random"})
"""Modules of Python of which people use what is no longer there."""
_DIFFERENT = frozenset(
    {"ast", "asyncio", "contextlib", "datetime", "enum", "itertools", "math", "pkgutil", "queue"}
    | {"sqlite3", "typing", "unittest", "uuid", "warnings"}
)
"""Those of which people use what some of the Pythons that distributions come with do not have."""
_OF_MODULES = frozenset({"import-not-found", "missing-module-member"})
_STR = r'`(?:str|Literal\["[^`]*"\])`'
_NUMBER = r"`(?:int\*?|float\*?|Literal\[-?\d+\])`"
_NAMELESS = re.compile(
    r"Object of type `(?:str|int|float|bool|bytes|CoroutineType\[.*\])` has no attribute `\w+`"
    r"|Too many positional arguments: expected \d+, got \d+"
    r"|(?:Not enough|Too many) values to unpack: Expected \d+.*"
    r"|(?:Object of type|Cannot subscript object of type) `(?:int|float|bool)`"
    r"(?: is not (?:callable|iterable)| with no .*)"
    r"|Operator `[^`]+` is not supported between objects of type `array\[\w+\]` and .*"
    rf"|Operator `\+` is not supported between objects of type (?:{_STR} and {_NUMBER}"
    rf"|{_NUMBER} and {_STR})"
)
"""Matches reports of interest that name nothing of ROS."""
# linear: a line has 20 kB at most
_SUPPRESSION = re.compile(rb"noqa:[^\n]*\bTY[0-9]", re.IGNORECASE)


_INVALID = "invalid-syntax"
_LATE_GLOBAL = "prior to global declaration"
"""What is said about an added `global` after a use of the name, which leaves the types right."""
_COPY = "_ros2_"
"""What the name of the copy of a file begins with."""


class _File:
    """A file to check: answered from the cache or by the type checker.

    Args:
        source: The file.
        callers: The other modules that call its functions.
        reached: It and they and all that these import, by place.
        key: What it has in the cache.
        diagnostics: What the cache has.
        is_relevant: Whether it is checked also if its callers give it nothing.
    """

    def __init__(
        self,
        source: Source,
        callers: Sequence[Source],
        reached: Mapping[str, Source],
        key: str,
        diagnostics: list[TyDiagnostic] | None,
        *,
        is_relevant: bool,
    ) -> None:
        self.source = source
        self.callers = callers
        self.reached = reached
        self.key = key
        self.diagnostics = diagnostics
        self.is_relevant = is_relevant
        self.place = source.place
        """Where the type checker finds it with what its callers give it."""


class TypeCheck:
    """Checks the Python files of packages; the type checker runs from the start.

    Args:
        packages: The packages.
        is_wanted: Tells by package and path whether a file is to be checked.
    """

    def __init__(
        self,
        packages: Sequence[Package],
        is_wanted: Callable[[Package, str], bool] = lambda _package, _path: True,
    ) -> None:
        self.failure = ""
        """Why types are not checked; empty if they are."""
        self._scratch = ""
        self._run: ty.Run | None = None
        self._written: dict[str, Extended] = {}
        """What it reads, by place."""
        self._plain: dict[str, bytes] = {}
        """The files in which lines were added, without these, by place."""
        self._files: dict[int, list[_File]] = {}
        """Until what is reported about them is collected; by the number of the package."""
        self._diagnostics: dict[int, dict[str, list[TyDiagnostic]]] = {}
        self._reached: dict[int, dict[str, Reads]] = {}
        self._suppressing: set[int] = set()
        self._packages = list(packages)  # so that no other gets its number
        try:
            self._start(is_wanted)
        except (UnavailableError, OSError) as error:
            self.failure = str(error)
            self.close()

    def _start(self, is_wanted: Callable[[Package, str], bool]) -> None:
        wanted = [
            (package, path)
            for package in self._packages
            for path in package.python_files
            if is_wanted(package, path)
        ]
        if not wanted:
            return
        home = self._environment()
        target = distributions.target()
        entries = os.listdir(os.path.join(home, environment.packages(target)))
        partial = partial_libraries()
        stubbed = frozenset(name.removesuffix(".pyi") for name in entries) - INCOMPLETE - partial
        self._stubbed = stubbed
        self._cache = Cache(
            f"{ty.identity()} {environment.identity(target)} {sys.version_info[:2]}"
        )
        sources = Sources()
        asked: list[_File] = []
        for package, path in wanted:
            source = sources.get(package, path)
            if source is None:
                continue
            reads = Reads()
            with recorded(reads):
                found = [sources.get(package, other) for other in callers(package, path)]
            calling = [item for item in found if item is not None]
            reached = {**sources.reached(source)}
            roots = frozenset[str]().union(*(item.roots for item in reached.values()))
            is_relevant = _is_relevant(source, roots, stubbed)
            for caller in calling:
                reached.update(sources.reached(caller))
            if _SUPPRESSION.search(source.data):
                self._suppressing.add(id(package))
            else:
                reads.files.update(
                    item.package.full_path(item.path) for item in reached.values() if item.path
                )
                self._reached.setdefault(id(package), {})[path] = reads
            if not (is_relevant or calling) or _is_shadowed(source, stubbed | partial):
                continue
            key = self._cache.key(source, reached)
            known = self._cache.get(key)
            file = _File(source, calling, reached, key, known, is_relevant=is_relevant)
            self._files.setdefault(id(package), []).append(file)
            if file.diagnostics is None:
                asked.append(file)
        if asked:
            self._home = home
            self._run = self._started("project", asked, _annotated)

    def _started(
        self, name: str, asked: Sequence[_File], content: Callable[[Source], bytes]
    ) -> ty.Run:
        """Start the type checker on some files, with all that they import next to them."""
        mirrored = {place: item for file in asked for place, item in file.reached.items()}
        project = self._directory(name)
        texts = {place: content(source) for place, source in mirrored.items()}
        self._written = {
            place: with_arguments(text, mirrored[place].dotted)
            if mirrored[place].path
            else Extended(text, ())  # a stub
            for place, text in texts.items()
        }
        self._plain = {
            place: text for place, text in texts.items() if self._written[place].data != text
        }
        for file in asked:
            file.place = self._place(file, texts[file.source.place])
        _write(project, {place: written.data for place, written in self._written.items()})
        places = [
            file.place for file in asked if file.is_relevant or file.place != file.source.place
        ]
        return ty.Run(project, self._home, places or [asked[0].place])

    def _place(self, file: _File, text: bytes) -> str:
        """Return where a file is to be checked; write what its callers give it into a copy.

        What others see of it must not depend on who else calls it.
        """
        source = file.source
        received = [
            call
            for caller in file.callers
            for call in self._written[caller.place].passed
            if call.function.startswith(f"{source.dotted}.")
        ]
        extended = with_arguments(text, source.dotted, received) if received else None
        if extended is None or extended.data == self._written[source.place].data:
            return source.place
        folder, _, name = source.place.rpartition("/")
        place = f"{folder}/{_COPY}{name}"
        self._written[place] = extended
        self._plain[place] = text
        return place

    def _results(self) -> Mapping[str, list[TyDiagnostic]]:
        """Return what is reported about lines of the user, by the place of the file."""
        assert self._run is not None  # noqa: S101  it has been started
        reported = dict(self._run.results())
        broken = [place for place in self._plain if any(map(_is_broken, reported.get(place, ())))]
        if broken:
            self._written.update((place, Extended(self._plain[place], ())) for place in broken)
            _write(self._run.project, {place: self._plain[place] for place in broken})
            self._run = ty.Run(self._run.project, self._home, broken)
            reported |= {place: [] for place in broken} | dict(self._run.results())
        return {
            place: [*_of_user(diagnostics, self._written[place])]
            for place, diagnostics in reported.items()
        }

    def _environment(self) -> str:
        return environment.directory(distributions.target(), self._directory)

    def _directory(self, name: str) -> str:
        if not self._scratch:
            self._scratch = os.path.realpath(tempfile.mkdtemp(prefix="ros2-scaffold-"))
        return os.path.join(self._scratch, name)

    def reached_by(self, package: Package) -> Mapping[str, Reads]:
        """Return what the reports about each file depend on.

        Files with a comment that names a code of types are left out: whether it suppresses
        anything is to be found out in each run.
        """
        return self._reached.get(id(package), {})

    def may_suppress(self, package: Package) -> bool:
        """Tell whether a comment in a package names a code of types."""
        return id(package) in self._suppressing

    def by_file(self, package: Package) -> dict[str, list[TyDiagnostic]]:
        """Return what the type checker reported about the files of a package, by path."""
        if self._files:
            self._collect()
            for number, files in self._files.items():
                self._diagnostics[number] = {
                    file.source.path: file.diagnostics for file in files if file.diagnostics
                }
            self._files.clear()  # with the texts of all files
        if self.failure:
            return {}
        return self._diagnostics.get(id(package), {})

    def _collect(self) -> None:
        if self._run is None:
            return
        asked = [
            file for files in self._files.values() for file in files if file.diagnostics is None
        ]
        try:
            reported = self._results()
            for file in asked:
                diagnostics = reported.get(file.place, ())
                stubbed = self._stubbed - _roots(file.reached, are_stubs=False)
                stubbed |= _roots(file.reached, are_stubs=True)
                sources = file.reached.values()
                file.diagnostics = [
                    item
                    for item in diagnostics
                    if _concerns(item, stubbed) or is_about_own(item, sources)
                ]
            self._confirm(
                [file for file in asked if any(map(_may_be_annotated, file.diagnostics or ()))]
            )
        except (UnavailableError, OSError) as error:
            self.failure = str(error)
            return
        finally:
            self.close()
        for file in asked:
            self._cache.put(file.key, file.diagnostics or ())
        self._cache.trim()

    def _confirm(self, files: Sequence[_File]) -> None:
        """Keep what is reported without the annotations of the user's code as well."""
        if not files:
            return
        self._run = self._started("unannotated", files, _unannotated)
        reported = self._results()
        for file in files:
            again = {item[:3] for item in reported.get(file.place, ())}
            file.diagnostics = [
                item
                for item in file.diagnostics or ()
                if item[:3] in again or not _may_be_annotated(item)
            ]

    def close(self) -> None:
        """End the type checker and remove what was written for it."""
        if self._run is not None:
            self._run.close()
            self._run = None
        if self._scratch:
            shutil.rmtree(self._scratch, ignore_errors=True)
            self._scratch = ""

    def __del__(self) -> None:
        self.close()


def _is_relevant(source: Source, roots: frozenset[str], stubbed: frozenset[str]) -> bool:
    """Tell whether anything that is imported is known well enough to judge its use."""
    if not source.imports.isdisjoint(python_modules.later_modules()):
        return True
    known = stubbed | python_modules.removed() | _CHANGED
    if distributions.target().python != distributions.named(distributions.DEFAULT).python:
        known |= _DIFFERENT
    return not roots.isdisjoint(known)


def _is_shadowed(source: Source, stubbed: frozenset[str]) -> bool:
    """Tell whether a program imports a file next to it in place of a library."""
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
    """Return the importable packages that are code of the workspace, or its interfaces."""
    return frozenset(
        place.split("/")[1]
        for place, source in reached.items()
        if bool(source.path) is not are_stubs and place.startswith(f"{ty.LIBRARY}/")
    )


def _concerns(item: TyDiagnostic, stubbed: frozenset[str]) -> bool:
    """Tell whether a report is about a library, and of interest."""
    if item.kind in _OF_MODULES or item.message.startswith("Module `"):
        module, name = [*re.findall(r"`([\w.]+)`", item.message), "", ""][:2]
        root = module.partition(".")[0]
        if item.kind == "import-not-found":
            return root in stubbed or python_modules.is_of_another(module)
        if python_modules.still_has(module, name):
            return False
        return root in stubbed or root in sys.stdlib_module_names
    return MARK in item.message or _NAMELESS.fullmatch(item.message) is not None


def _is_broken(item: TyDiagnostic) -> bool:
    """Tell whether a report is that a file does not parse."""
    return item.kind == _INVALID and _LATE_GLOBAL not in item.message


def _may_be_annotated(item: TyDiagnostic) -> bool:
    """Tell whether a report may be the consequence of an annotation."""
    return item.kind not in _OF_MODULES


def _of_user(diagnostics: Sequence[TyDiagnostic], written: Extended) -> Iterator[TyDiagnostic]:
    """Yield what is reported about lines that are the user's, with their numbers."""
    for item in diagnostics:
        line = written.original_line(item.line)
        if line:
            end = written.original_line(item.end_line)
            yield item._replace(line=line, end_line=end)


def _annotated(source: Source) -> bytes:
    """Return a file with the types of its callbacks."""
    return source.with_callback_types if source.path else source.data


def _unannotated(source: Source) -> bytes:
    """Return a file with no other annotations; nothing of one that does not parse."""
    if not source.path:
        return source.data
    return without_annotations(source.with_callback_types) or b""


def _write(project: str, mirrored: Mapping[str, bytes]) -> None:
    for folder in {os.path.dirname(place) for place in mirrored}:
        os.makedirs(os.path.join(project, folder), exist_ok=True)
    for place, data in mirrored.items():
        with open(os.path.join(project, place), "wb") as file:
            file.write(data)
