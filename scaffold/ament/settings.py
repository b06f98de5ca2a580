"""The linter configurations with which the tests of a package check its files.

For a linter that no test of the package runs, ament's default configuration applies.
"""

from __future__ import annotations

import argparse
import os
from collections.abc import Callable, Iterator, Sequence
from fnmatch import fnmatch
from itertools import zip_longest
from typing import TYPE_CHECKING, NoReturn

from scaffold.ament.calls import Arguments, Call, directory_of, linter_calls
from scaffold.ament.finding import FLAKE8, PEP257, Finding
from scaffold.ament.flake8 import options as flake8
from scaffold.ament.flake8.options import EXCLUDED, Options, OptionsError, matches, normal
from scaffold.ament.linters import of_target
from scaffold.ament.pep257 import codes as pep257
from scaffold.ament.use import linter_tests
from scaffold.model.reads import Reads, recorded
from scaffold.record import NamedTuple
from scaffold.source import Location

if TYPE_CHECKING:
    from scaffold.model.package import Package

UNKNOWN = "\0"
"""A placeholder for an unknown argument."""
MAX_BYTES = 200_000
"""The size limit of a configuration file."""
_OF_BOTH = sorted(pep257.AMENT & pep257.CONVENTIONS["pep257"])


class Settings(NamedTuple):
    """The linters that check a file, and their configurations."""

    linters: int = FLAKE8 | PEP257
    flake8: Options = flake8.AMENT
    pep257: frozenset[str] = pep257.AMENT
    """The codes reported by ament_pep257."""

    def linters_of(self, finding: Finding) -> int:
        """Return the linters that report a finding."""
        linters = finding.linters & self.linters
        if linters & FLAKE8 and not self.flake8.reports(finding.code):
            linters &= ~FLAKE8
        if finding.code in pep257.ALL:
            if not of_target().has("flake8-docstrings"):
                linters &= ~FLAKE8
            if finding.code not in self.pep257:
                linters &= ~PEP257
        return linters

    @property
    def key(self) -> str:
        """A key for cached findings; empty for ament's configuration."""
        if self[1:] == Settings()[1:]:
            return ""
        options = self.flake8._replace(exclude=(), extend_exclude=(), filename=())
        return f"{options}{sorted(self.pep257)}"


class Note(NamedTuple):
    """An unsupported part of a package's configuration, and the consequence."""

    location: Location
    message: str


class _Run(NamedTuple):
    """A run of a linter: its options, and the files that it checks."""

    asked: Options | frozenset[str]
    covers: Callable[[str], bool]
    """Tells whether it checks an absolute path."""
    named: tuple[str, ...] = ()
    """The absolute paths passed to it."""


class PackageSettings:
    """The configurations for each file of a package.

    Args:
        package: The package.
        is_reference: Whether to use the configuration that ament ships with for all files.
    """

    def __init__(self, package: Package, *, is_reference: bool = False) -> None:
        self._package = package
        self._directory = directory_of(package)
        self.notes: list[Note] = []
        self._runs: dict[int, list[_Run]] = {FLAKE8: [], PEP257: []}
        if not is_reference:
            self._runs = {
                FLAKE8: [*self._read("flake8", self._flake8_run)],
                PEP257: [*self._read("pep257", self._pep257_run)],
            }

    @property
    def tests(self) -> set[str]:
        """The tests in Python that run a linter."""
        names = ("ament_flake8", "ament_pep257")
        return {test.path for name in names for test, _ in linter_tests(self._package, name)}

    @property
    def named(self) -> list[str]:
        """The files that are passed to flake8 by name, whatever their extension."""
        inside = os.path.join(self._directory, "")
        paths = (path for run in self._runs[FLAKE8] for path in run.named)
        return [path[len(inside) :] for path in paths if path.startswith(inside)]

    def is_tested(self, path: str, code: str) -> bool:
        """Return whether a test of the package would report a code in a file."""
        full = os.path.join(self._directory, path)
        for run in (*self._runs[FLAKE8], *self._runs[PEP257]):
            if not run.covers(full):
                continue
            if isinstance(run.asked, frozenset):
                if code in run.asked or code.startswith("E9"):
                    return True
            elif run.asked.for_file(full, self._directory).reports(code):
                convention = pep257.CONVENTIONS.get(run.asked.docstring_convention, pep257.ALL)
                if code not in pep257.ALL or code in convention:
                    return True
        return False

    def of(
        self, path: str, linters: int = FLAKE8 | PEP257, default: Options = flake8.AMENT
    ) -> list[Settings]:
        """Return the settings for a file: a finding is kept when any of them reports it.

        Args:
            path: The file.
            linters: The linters that would check it.
            default: The default options, if no test of the package runs flake8.
        """
        full = os.path.join(self._directory, path)
        asked: dict[int, list[Options | frozenset[str]]] = {}
        for linter, usual in ((FLAKE8, default), (PEP257, pep257.AMENT)):
            runs = self._runs[linter]
            asked[linter] = [run.asked for run in runs if run.covers(full)] if runs else [usual]
            if not linters & linter:
                asked[linter] = []
        options = dict.fromkeys(
            item.for_file(full, self._directory)
            for item in asked[FLAKE8]
            if isinstance(item, Options)
        )
        codes = dict.fromkeys(item for item in asked[PEP257] if isinstance(item, frozenset))
        if not self._runs[PEP257] and options and codes:
            # A linter that is not run does not report codes that flake8 ignores.
            ignored = [code for code in _OF_BOTH if not any(item.reports(code) for item in options)]
            codes = {pep257.AMENT.difference(ignored): None}
        return [
            Settings(
                (FLAKE8 if flake8_options else 0) | (0 if reported is None else PEP257),
                flake8_options or flake8.AMENT,
                pep257.AMENT if reported is None else reported,
            )
            for flake8_options, reported in zip_longest(options, codes)
        ]

    def _read(self, linter: str, read: Callable[[Call], _Run | None]) -> Iterator[_Run]:
        for call in linter_calls(self._package, linter):
            try:
                run = read(call)
            except _StopError as error:
                self._note(call, f"ament_{linter} stops: {error}; using ament's configuration")
            else:
                if run is not None:
                    yield run

    def _note(self, call: Call, message: str) -> None:
        note = Note(call.location, message)
        if note not in self.notes:
            self.notes.append(note)

    # -- ament_flake8

    def _flake8_run(self, call: Call) -> _Run | None:
        parser = _Parser()
        parser.add_argument("--config")
        parser.add_argument("--linelength", type=_number)
        parser.add_argument("paths", nargs="*", default=["."])
        parser.add_argument("--exclude", nargs="*", default=[])
        parser.add_argument("--xunit-file")
        given = parser.parse(call.arguments)
        paths = self._without_unknown(given.paths)
        if not paths:
            return None  # it checks generated files
        options = flake8.AMENT if given.config is None else self._configured(call, given.config)
        if given.linelength == _UNKNOWN_NUMBER:
            self._note(call, "the maximum line length cannot be determined: ament's is used")
        elif given.linelength is not None:
            options = options._replace(max_line_length=given.linelength)
        excludes = self._excludes(call, given.exclude)
        patterns = [normal(pattern, self._directory) for pattern in excludes]
        patterns += options.exclude if options.exclude != EXCLUDED else ()
        patterns += options.extend_exclude

        def covers(path: str) -> bool:
            return any(self._is_walked(path, top, patterns, options.filename) for top in paths)

        return _Run(options, covers, tuple(map(self._full, paths)))

    def _configured(self, call: Call, path: str) -> Options:
        if path == UNKNOWN:
            self._note(call, "the configuration of flake8 cannot be determined: ament's is used")
            return flake8.AMENT
        place = self._full(path)
        try:
            text = self._content(place)
        except OSError:
            raise _StopError(f"its configuration {path!r} cannot be read") from None
        except UnicodeDecodeError:
            raise _StopError(f"its configuration {path!r} is not UTF-8") from None
        try:
            options, notes = flake8.read(text, os.path.dirname(place))
        except OptionsError as error:
            raise _StopError(f"in {path!r}, {error}") from None
        for note in notes:
            self._note(call, f"{path}: {note}")
        return options

    def _content(self, place: str) -> str:
        inside = os.path.join(self._directory, "")
        if place.startswith(inside):
            data = self._package.bytes_of(place[len(inside) :], MAX_BYTES)
        else:
            data = self._package.outside.read(place, MAX_BYTES)
        return data.decode()

    def _is_walked(
        self, path: str, given: str, excluded: Sequence[str], names: Sequence[str]
    ) -> bool:
        """Return whether flake8 reaches a file from one of its paths."""
        top = self._full(given)
        is_plain = os.path.basename(given) in {".", ".."}
        if matches(top, [pattern for pattern in excluded if not is_plain or "/" in pattern]):
            return False
        if path == top:
            return True
        below = os.path.join(top, "")
        if not path.startswith(below):
            return False
        parts = path[len(below) :].split("/")
        ways = [below + "/".join(parts[: depth + 1]) for depth in range(len(parts))]
        if any(matches(way, excluded) for way in ways):
            return False
        written = os.path.join(given, path[len(below) :])
        return any(fnmatch(written, pattern) for pattern in names)

    # -- ament_pep257

    def _pep257_run(self, call: Call) -> _Run | None:
        parser = _Parser()
        group = parser.add_mutually_exclusive_group()
        group.add_argument("--ignore", nargs="+", default=[])
        group.add_argument("--select", nargs="+", default=[])
        group.add_argument("--convention", choices=("ament", *pep257.CONVENTIONS), default="ament")
        parser.add_argument("--add-ignore", nargs="+", default=[])
        parser.add_argument("--add-select", nargs="+", default=[])
        parser.add_argument("paths", nargs="*", default=["."])
        parser.add_argument("--exclude", nargs="*", default=[])
        parser.add_argument("--xunit-file")
        given = parser.parse(call.arguments)
        paths = [self._full(path) for path in self._without_unknown(given.paths)]
        if not paths:
            return None
        lists = (given.ignore, given.select, given.add_ignore, given.add_select)
        if any(UNKNOWN in words for words in lists):
            self._note(call, "the codes that pep257 reports cannot be determined: ament's are used")
            codes = pep257.AMENT
        else:
            codes = pep257.chosen(*lists, convention=given.convention)
        excludes = [self._full(path) for path in self._excludes(call, given.exclude)]

        def covers(path: str) -> bool:
            return _is_below(path, paths) and not _is_below(path, excludes)

        return _Run(codes, covers)

    # -- both

    def _excludes(self, call: Call, given: Sequence[str]) -> list[str]:
        if UNKNOWN in given:
            self._note(call, "the excluded files cannot be determined: they are checked, too")
        return self._without_unknown(given)

    @staticmethod
    def _without_unknown(words: Sequence[str]) -> list[str]:
        return [word for word in words if word != UNKNOWN]

    def _full(self, path: str) -> str:
        return os.path.normpath(os.path.join(self._directory, path))


class _StopError(Exception):
    """The linter would fail before checking any file."""


class _Parser(argparse.ArgumentParser):
    """Parses a command line as the linter does."""

    def __init__(self) -> None:
        super().__init__(add_help=False)

    def parse(self, arguments: Arguments) -> argparse.Namespace:
        """Return the parsed arguments; raises _StopError."""
        return self.parse_args([UNKNOWN if word is None else word for word in arguments])

    def error(self, message: str) -> NoReturn:
        raise _StopError(message)


_UNKNOWN_NUMBER = -1


def _number(word: str) -> int:
    return _UNKNOWN_NUMBER if word == UNKNOWN else int(word)


def _is_below(path: str, tops: Sequence[str]) -> bool:
    return any(path == top or path.startswith(os.path.join(top, "")) for top in tops)


def settings_of(package: Package) -> PackageSettings:
    """Return the settings of a package; read once."""
    return package.remember("style settings", lambda: PackageSettings(package))


def files_of_settings(package: Package) -> frozenset[str]:
    """Return the files that configure style, by ``Package.full_path``.

    All Python tests are examined, but only those that run a linter are returned.
    """
    looked_at = Reads()
    with recorded(looked_at):
        tests = map(package.full_path, settings_of(package).tests)
    files, _ = looked_at.all()
    return frozenset(tests) | {path for path in files if not path.endswith(".py")}
