"""Python style and docstrings of packages, as the target's ament linters report them."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import reduce
from operator import or_
from typing import TYPE_CHECKING

from scaffold import distributions, time_limit
from scaffold.ament import ruff
from scaffold.ament.codes import CODES
from scaffold.ament.files import select
from scaffold.ament.finding import CRASHED, TOO_LARGE, UNFOLLOWED, UNPARSABLE, Finding
from scaffold.ament.findings_cache import StyleCache
from scaffold.ament.flake8.options import AMENT
from scaffold.ament.linters import of_target
from scaffold.ament.settings import Note, PackageSettings, Settings, settings_of
from scaffold.diagnostic import MAX_FINDINGS, Diagnostic, Severity, crash_message
from scaffold.edits import Edit, Fix, Safety
from scaffold.errors import EXHAUSTED, OutOfTimeError, ScaffoldError, exhausted
from scaffold.files.disk import LargeFileError
from scaffold.files.limits import most_bytes, too_large, why_unread
from scaffold.model.package import Package
from scaffold.source import Location, Source, ViewError

if TYPE_CHECKING:
    from scaffold.ament.ruff import RuffDiagnostic


_UNDEFINED = "F821"
"""The common cause of all undefined names of a file: a missing import or part of the file."""
_OWN_CODES = {
    UNPARSABLE: ("unparsable-file", Severity.ERROR),
    CRASHED: ("rule-crashed", Severity.ERROR),
    TOO_LARGE: ("file-too-large", Severity.WARNING),
    UNFOLLOWED: ("style-not-judged", Severity.INFO),
}
"""The codes of the engine reported here, with their names and severities."""


def _identity() -> str:
    """Return the key of this code, Python and ruff, which invalidates all cached findings."""
    top = os.path.dirname(__file__)
    own = []
    for folder, _, files in os.walk(top):
        for name in files:
            if name.endswith(".py"):
                status = os.stat(os.path.join(folder, name))
                place = os.path.relpath(folder, top)
                own.append(f"{place}/{name}:{status.st_size}:{status.st_mtime_ns}")
    own.sort()
    kept = [distribution.name for distribution in distributions.kept()]
    return f"{sys.version_info[:3]}{of_target().identity}{kept}{own}{ruff.identity()}"


class _File:
    """A file to check: read once, checked from the cache, or by ruff and our rules."""

    def __init__(self, path: str, data: bytes, settings: Sequence[Settings]) -> None:
        self.path = path
        self.on_disk = ""
        self.data = data
        self.settings = settings
        self.key = ""
        self.findings: list[Finding] | None = None
        self.ran_out_of_time = False

    @property
    def linters(self) -> int:
        """The linters that check the file."""
        return reduce(or_, (item.linters for item in self.settings), 0)


def _unreadable_file(path: str, settings: Sequence[Settings], why: str) -> _File:
    file = _File(path, b"", settings)
    finding = Finding("E902", 1, 1, why, linters=file.linters)
    linters = reduce(or_, (item.linters_of(finding) for item in settings), 0)
    file.findings = [finding._replace(linters=linters)] if linters else []
    return file


def _too_large(path: str, settings: Sequence[Settings], why: str) -> _File:
    file = _File(path, b"", settings)
    file.findings = [Finding(TOO_LARGE, 1, 1, why, linters=file.linters)]
    return file


class StyleCheck:
    """Checks the Python files of packages; ruff runs in the background from the start.

    Args:
        packages: The packages.
        is_wanted: Whether a file of a package is to be checked.
        is_reference: Whether to use ament's configuration instead of a package's own.
        line_length: The maximum line length for packages that do not run flake8 themselves.
    """

    def __init__(
        self,
        packages: Sequence[Package],
        is_wanted: Callable[[Package, str], bool] = lambda _package, _path: True,
        *,
        is_reference: bool = False,
        line_length: int | None = None,
    ) -> None:
        self._scratch = ""
        self._is_reference = is_reference
        self._default = AMENT
        if line_length is not None:
            self._default = AMENT._replace(max_line_length=line_length)
        self._notes: dict[int, list[Diagnostic]] = {}
        self._is_wanted = is_wanted
        self._run: ruff.Run | None = None
        self._cache = StyleCache(_identity)
        self._files = {id(package): self._read(package) for package in packages}
        self._packages = list(packages)  # keeps their ids from being reused
        wanted = [file for files in self._files.values() for file in files if file.findings is None]
        if wanted:
            self._run = ruff.Run([item.on_disk for item in wanted])
        self._reported: Mapping[str, list[RuffDiagnostic]] | None = None

    def diagnostics(self, package: Package) -> list[Diagnostic]:
        """Return the findings of ament_flake8 and ament_pep257, without duplicates.

        Raises:
            EnvironmentMissingError: ruff does not run.
        """
        return [
            diagnostic
            for diagnostics in self.by_file(package).values()
            for diagnostic in diagnostics
        ]

    def by_file(self, package: Package) -> dict[str, list[Diagnostic]]:
        """Return the diagnostics by path; raises like `diagnostics`.

        Those about the configuration of the package have the path "".
        """
        notes = self._notes.pop(id(package), [])
        by_file: dict[str, list[Diagnostic]] = {"": notes} if notes else {}
        for file in self._files.pop(id(package), ()):
            findings = self._findings(file, package)
            package.is_repeatable &= not file.ran_out_of_time
            diagnostics = by_file[file.path] = list[Diagnostic]()
            counts: dict[str, int] = {}
            for finding in findings:
                counts[finding.code] = count = counts.get(finding.code, 0) + 1
                if count <= MAX_FINDINGS + 1:
                    diagnostics.append(_diagnostic(package, file.path, finding))
        if not self._files:
            self._cache.trim()
        return by_file

    def _findings(self, file: _File, package: Package) -> list[Finding]:
        if file.findings is not None:
            return file.findings
        from scaffold.ament.verdict import check

        def of_ruff() -> Sequence[RuffDiagnostic]:
            return self._results().get(file.on_disk, [])

        try:
            with time_limit.limited():
                parsed = package.parsed_module(file.path)
                findings = check(file.path, file.data, of_ruff, file.settings, parsed)
        except ScaffoldError:
            raise
        except Exception as error:  # noqa: BLE001  one bad file must not end the run for all
            file.ran_out_of_time = isinstance(error, OutOfTimeError)
            return [_failure(error, file.linters)]
        if file.key:
            self._cache.put(file.key, findings)
        return findings

    def _results(self) -> Mapping[str, list[RuffDiagnostic]]:
        if self._reported is None:
            try:
                self._reported = self._run.results() if self._run else {}
            finally:
                self.close()
        return self._reported

    def close(self) -> None:
        """Stop ruff and remove the files written for it; does nothing after a complete run."""
        if self._run is not None:
            self._run.close()
            self._run = None
        if self._scratch:
            import shutil

            shutil.rmtree(self._scratch, ignore_errors=True)
            self._scratch = ""

    def __del__(self) -> None:
        self.close()

    def _read(self, package: Package) -> list[_File]:
        files: list[_File] = []
        own = PackageSettings(package, is_reference=True)
        if not self._is_reference:
            own = settings_of(package)
            self._notes[id(package)] = [_note_diagnostic(note) for note in own.notes]
        links = getattr(package.tree, "broken_links", ())
        for path, linters in select((*package.tree.files, *links), own.named).items():
            settings = (
                own.of(path, linters, self._default) if self._is_wanted(package, path) else []
            )
            if not settings:
                continue
            try:
                data = package.tree.read(path, most_bytes(path))
            except LargeFileError as error:
                files.append(_too_large(path, settings, too_large(error.size, path)))
                continue
            except OSError as error:
                why = "broken symbolic link" if path in links else error.strerror or "not a file"
                files.append(_unreadable_file(path, settings, f"the file cannot be read: {why}"))
                continue
            if reason := why_unread(path, data):
                files.append(_too_large(path, settings, reason))
                continue
            file = _File(path, data, settings)
            if self._cache.is_enabled:
                key = [(item.linters, item.key) for item in settings]
                file.key = self._cache.key(path, key, data)
                file.findings = self._cache.get(file.key)
            if file.findings is None:
                file.on_disk = self._place(package, file, len(files))
            files.append(file)
        return files

    def _place(self, package: Package, file: _File, number: int) -> str:
        """Return the path of the file for ruff.

        A package in memory is written to a temporary directory, and so is a file whose name is
        not valid Unicode: ruff would not report such a name as it is.
        """
        if package.root is not None and _is_text(package.root) and _is_text(file.path):
            return os.path.abspath(os.path.join(package.root, file.path))
        if not self._scratch:
            import tempfile

            self._scratch = os.path.realpath(tempfile.mkdtemp(prefix="ros2-scaffold-"))
        directory = os.path.join(self._scratch, f"{id(package):x}-{number}")
        os.makedirs(directory, exist_ok=True)
        name = file.path.rpartition("/")[2]
        on_disk = os.path.join(directory, name if _is_text(name) else "module.py")
        with open(on_disk, "wb") as out:
            out.write(file.data)
        return on_disk


def _is_text(path: str) -> bool:
    return not any("\ud800" <= character <= "\udfff" for character in path)


def _failure(error: Exception, linters: int) -> Finding:
    """Return the finding for a file that cannot be checked: too complex, or a bug here."""
    if isinstance(error, EXHAUSTED):
        return Finding(UNPARSABLE, 1, 1, exhausted(error), linters=linters)
    return Finding(CRASHED, 1, 1, crash_message("the style check", error), linters=linters)


def _note_diagnostic(note: Note) -> Diagnostic:
    return Diagnostic(UNFOLLOWED, *_OWN_CODES[UNFOLLOWED], *note)


def _diagnostic(package: Package, path: str, finding: Finding) -> Diagnostic:
    if finding.code in _OWN_CODES:
        name, severity = _OWN_CODES[finding.code]
        at = Location.start_of(path)
        return Diagnostic(finding.code, name, severity, at, finding.message)
    code = CODES[finding.code]
    end = (finding.end_line or finding.line, finding.end_column or finding.column)
    location = Location(path, finding.line, finding.column, *max(end, finding[1:3]))
    fix = _fix(package, path, finding) if finding.fix else None
    message = finding.message or code.summary
    severity = Severity.WARNING if finding.is_doubtful else code.severity
    cause = f"undefined names in {path}" if code.code == _UNDEFINED else ""
    return Diagnostic(code.code, code.name, severity, location, message, fix, cause)


def _fix(package: Package, path: str, finding: Finding) -> Fix | None:
    """Return the fix with offsets in the text on disk."""
    try:
        source = package.editable(path)
    except ViewError:
        return None
    if source.has_lone_returns:
        return None
    shift = 1 if source.text.startswith("\ufeff") else 0
    changes = tuple(_edits(source, path, finding, shift))
    safety = Safety.UNSAFE if finding.fix_is_unsafe else Safety.SAFE
    return Fix(finding.fix_title or "Apply the fix of ruff", changes, safety)


def _edits(source: Source, path: str, finding: Finding, shift: int) -> Iterator[Edit]:
    for line, column, end_line, end_column, text in finding.fix:
        start = source.offset(line, column + (shift if line == 1 else 0))
        end = source.offset(end_line, end_column + (shift if end_line == 1 else 0))
        yield Edit(path, start, end, text.replace("\n", source.newline))
