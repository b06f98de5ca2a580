"""Findings and reports of earlier runs, with what they accessed (docs/adr/0006).

There are two small files per run in the user's cache: one with the findings, keyed by everything
that affects findings, and one with the report, which also depends on the display options. Damaged
files, and those of other versions of the tool or of Python, are ignored. Every start imports this
module, so it imports almost nothing; ``scaffold.check.cache.results`` handles packages.
"""

from __future__ import annotations

import marshal
import os
import sys

from scaffold.configuration.content import built_in
from scaffold.files import cache
from scaffold.files.disk import changed, digest, stamp

TYPE_CHECKING = False  # the one of typing is slow to import
if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence
    from typing import Any

    from scaffold.files.disk import Answer, Question

    Seen = Mapping[Question, Answer]

MAX_RUNS = 400
MAX_BYTES = 50_000_000
"""The size limit of a run; 800 packages with 30,000 findings take 18 MB."""
ENVIRONMENT = (
    "AMENT_PREFIX_PATH",
    "HOME",
    "PATH",
    "PYTHONPATH",
    "ROS_DISTRO",
    "ROS_HOME",
    "XDG_CONFIG_HOME",
)
"""The variables that findings depend on."""
SCREEN = ("COLORTERM", "COLUMNS", "FORCE_COLOR", "LINES", "NO_COLOR", "TERM")
"""The variables that only affect how they are shown."""

_MAGIC = b"scaffold-run-9\n"


class CachedRun:
    """The findings of a run, in types that marshal can write.

    Args:
        number: Identifies the run.
        outside: The accesses outside of the packages.
        trees: The accesses in each package; ``None`` for one that is never stored.
        results: The data of ``scaffold.check.cache.results`` for each package.
    """

    def __init__(
        self,
        number: bytes,
        outside: Seen,
        trees: Sequence[Seen | None],
        results: Sequence[tuple[Any, ...]],
    ) -> None:
        self.number = number
        self.outside = outside
        self.trees = trees
        self.results = results
        self._changed: dict[int, list[Question] | None] = {}

    def is_current(self) -> bool:
        """Return whether nothing has changed since."""
        return self.is_same_outside() and all(map(self.is_same, range(len(self.trees))))

    def is_same_outside(self) -> bool:
        """Return whether nothing has changed outside of the packages; the disk is read once."""
        return self._changed_questions(-1, self.outside) == []

    def is_same(self, at: int) -> bool:
        """Return whether nothing has changed in the package with an index; reads the disk once."""
        return self.changed(at) == []

    def changed(self, at: int) -> list[Question] | None:
        """Return the changes in the package with an index, ``None`` if unknown."""
        return self._changed_questions(at, self.trees[at])

    def _changed_questions(self, at: int, seen: Seen | None) -> list[Question] | None:
        if at not in self._changed:
            self._changed[at] = None if seen is None else changed(seen)
        return self._changed[at]


class CachedReport:
    """The report of a run.

    Args:
        shown: The runs of its findings: the names of their files, and their ids.
        code: The exit code.
        output: The standard output.
        warnings: The standard error about ignored configuration.
        notes: The standard error about what was left out, if the output does not have it.
    """

    def __init__(
        self,
        shown: Sequence[tuple[str, bytes]],
        code: int,
        output: str,
        warnings: Sequence[str],
        notes: Sequence[str],
    ) -> None:
        self.shown = shown
        self.code = code
        self.output = output
        self.warnings = warnings
        self.notes = notes


class RunEntry:
    """The cache entry for the findings of a run.

    Attributes:
        name: The name of the file.
        last: The last run, if it was stored by the same tool and is not damaged.
    """

    def __init__(self, kept: str, name: str, head: bytes) -> None:
        self.name = name
        self._path = os.path.join(kept, name)
        self._head = head
        data = cache.read_sealed(self._path, head)
        self.last = None if data is None else CachedRun(*marshal.loads(data))  # noqa: S302  own files

    def save(
        self, outside: Seen, trees: Sequence[Seen | None], results: Sequence[tuple[Any, ...]]
    ) -> None:
        """Store a run; see `CachedRun`."""
        number = os.urandom(8)
        self.last = CachedRun(number, outside, trees, results)
        _write(self._path, self._head, (number, outside, trees, results))


class ReportEntry:
    """The cache entry for a report: one per command line, directory and environment.

    It is created before the run, as a rule edited meanwhile must invalidate it.
    """

    def __init__(self, kept: str, words: Sequence[str]) -> None:
        self._kept = kept
        self._head = _MAGIC + tool().encode()
        shown = [os.environ.get(name) for name in SCREEN]
        self._path = os.path.join(kept, _name(["report", *words, repr((shown, _screen()))]))
        self._runs: dict[str, RunEntry] = {}

    @classmethod
    def of(cls, words: Sequence[str]) -> ReportEntry | None:
        """Return the entry for a command line, ``None`` if nothing is to be cached."""
        kept = cache.directory("runs")
        try:
            return cls(kept, words) if kept is not None else None
        except (OSError, ValueError):
            return None

    def current(self) -> CachedReport | None:
        """Return the last report, if none of its dependencies has changed since."""
        data = cache.read_sealed(self._path, self._head)
        if data is None:
            return None
        report = CachedReport(*marshal.loads(data))  # noqa: S302  own files
        for name, number in report.shown:
            run = self._run(name).last
            if run is None or run.number != number or not run.is_current():
                return None
        return report

    def run(self, words: Sequence[str]) -> RunEntry:
        """Return the entry for the findings of a run.

        Args:
            words: Their key, besides files, directory and environment.
        """
        return self._run(_name(["findings", *words]))

    def save(
        self,
        shown: Sequence[RunEntry],
        code: int,
        output: str,
        warnings: Sequence[str],
        notes: Sequence[str],
    ) -> None:
        """Store a report on saved runs; see `CachedReport`."""
        numbers = [(entry.name, entry.last.number) for entry in shown if entry.last is not None]
        _write(self._path, self._head, (numbers, code, output, (*warnings,), (*notes,)))

    def _run(self, name: str) -> RunEntry:
        if name not in self._runs:
            self._runs[name] = RunEntry(self._kept, name, self._head)
        return self._runs[name]


def _name(words: Sequence[str]) -> str:
    variables = [os.environ.get(name) for name in ENVIRONMENT]
    return digest(repr((words, os.getcwd(), variables)).encode("utf-8", "surrogateescape"))


def _write(path: str, head: bytes, everything: Any) -> None:  # noqa: ANN401  for marshal
    data = marshal.dumps(everything)
    if len(data) <= MAX_BYTES and cache.write_sealed(path, head, data):
        cache.trim(os.path.dirname(path), MAX_RUNS)


def _screen() -> tuple[int, int] | None:
    """Return columns and lines of the output terminal, ``None`` if it is none."""
    try:
        columns, lines = os.get_terminal_size(sys.stdout.fileno())
    except (OSError, ValueError):
        return None
    return columns, lines


def tool() -> str:
    """Return a digest of the tool: every file of the engine and the rules, and Python's packages.

    They are identified by size and times, which an edit between two runs changes.
    """
    parts = [sys.version, sys.executable]
    engine = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
    for top in (engine, os.path.join(built_in(), "rules")):
        parts += _stamps(top)
    for entry in sys.path:
        if entry.endswith(("site-packages", "dist-packages")):
            # Installing, removing or updating a package touches the directory.
            parts.append(f"{entry} {stamp(entry)}")
    return digest("\n".join(parts).encode("utf-8", "surrogateescape"))


def _stamps(top: str) -> Iterator[str]:
    with os.scandir(top) as entries:
        for entry in entries:
            if entry.is_dir():
                if entry.name != "__pycache__":
                    yield from _stamps(entry.path)
            else:
                yield f"{entry.path} {stamp(entry.path)}"
