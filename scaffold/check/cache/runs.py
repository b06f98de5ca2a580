"""The results of earlier runs of `check`, and what they accessed (docs/adr/0006).

One small file per command line and directory, in the user's cache. A file that is damaged, of
another version of the tool or of another Python is as good as none. This module is imported by
every start and imports next to nothing; ``scaffold.check.cache.results`` knows what packages are.
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
"""Of one run; 800 packages with 30,000 findings take 18 MB."""
ENVIRONMENT = (
    "AMENT_PREFIX_PATH",
    "COLORTERM",
    "COLUMNS",
    "FORCE_COLOR",
    "HOME",
    "LINES",
    "NO_COLOR",
    "PATH",
    "PYTHONPATH",
    "ROS_DISTRO",
    "ROS_HOME",
    "TERM",
    "XDG_CONFIG_HOME",
)
"""The variables that a verdict, or how it is shown, depends on."""

_MAGIC = b"scaffold-run-6\n"


class CachedRun:
    """A remembered run; it contains only what marshal can write.

    Args:
        outside: What was accessed outside of the packages.
        trees: What was accessed in each package; ``None`` for one that is never remembered.
        results: What ``scaffold.check.cache.results`` stores of each package.
        code: The exit code.
        output: What standard output got; ``None`` if something was written elsewhere, too.
        warnings: What was written to standard error: what of the configuration is ignored.
    """

    def __init__(
        self,
        outside: Seen,
        trees: Sequence[Seen | None],
        results: Sequence[tuple[Any, ...]],
        code: int,
        output: str | None,
        warnings: Sequence[str],
    ) -> None:
        self.outside = outside
        self.trees = trees
        self.results = results
        self.code = code
        self.output = output
        self.warnings = warnings
        self._changed: dict[int, list[Question] | None] = {}

    def is_current(self) -> bool:
        """Tell whether nothing has changed since, and the output is all there is to repeat."""
        if self.output is None:
            return False
        return self.is_same_outside() and all(map(self.is_same, range(len(self.trees))))

    def is_same_outside(self) -> bool:
        """Tell whether nothing has changed outside of the packages; the disk is asked once."""
        return self._asked(-1, self.outside) == []

    def is_same(self, at: int) -> bool:
        """Tell whether nothing has changed in the package of a place; the disk is asked once."""
        return self.changed(at) == []

    def changed(self, at: int) -> list[Question] | None:
        """Return what has changed in the package of a place, ``None`` if that is not known."""
        return self._asked(at, self.trees[at])

    def _asked(self, at: int, seen: Seen | None) -> list[Question] | None:
        if at not in self._changed:
            self._changed[at] = None if seen is None else changed(seen)
        return self._changed[at]


class CacheEntry:
    """Where a run is remembered: one place for each command line, directory and environment.

    Made before the run, because a rule that is edited meanwhile must not count as the one used.

    Attributes:
        last: The last run, if this very tool remembered it and nothing damaged it.
    """

    def __init__(self, kept: str, words: Sequence[str]) -> None:
        where = os.getcwd()
        variables = [os.environ.get(name) for name in ENVIRONMENT]
        key = repr((list(words), where, variables, _screen()))
        self._path = os.path.join(kept, digest(key.encode("utf-8", "surrogateescape")))
        self._head = _MAGIC + tool().encode()
        data = cache.read_sealed(self._path, self._head)
        self.last = None if data is None else CachedRun(*marshal.loads(data))  # noqa: S302  own files

    @classmethod
    def of(cls, words: Sequence[str]) -> CacheEntry | None:
        """Return the place for a command line, ``None`` if nothing is to be remembered."""
        kept = cache.directory("runs")
        try:
            return cls(kept, words) if kept is not None else None
        except (OSError, ValueError):
            return None

    def save(self, run: CachedRun) -> None:
        """Store a run."""
        everything: Any = (
            *(run.outside, run.trees, run.results),
            *(run.code, run.output, run.warnings),
        )
        data = marshal.dumps(everything)
        if len(data) <= MAX_BYTES and cache.write_sealed(self._path, self._head, data):
            cache.trim(os.path.dirname(self._path), MAX_RUNS)


def _screen() -> tuple[int, int] | None:
    """Return columns and lines of the terminal that is written to, ``None`` if it is none."""
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
            # Installing, removing or renewing anything touches the directory.
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
