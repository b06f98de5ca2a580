"""Records the files and facts from which a view of a package, or a finding, was derived.

Changes of content in files of the usual formats invalidate only what depends on those files; any
other change in a package invalidates everything in it.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable
from typing import Any

from scaffold.files.tree import CMAKE_LISTS, SETUP_CFG
from scaffold.model.fact_values import decode, encode
from scaffold.record import NamedTuple
from scaffold.source import ViewError

Key = tuple[Hashable, ...]
"""The provider of a fact and its arguments besides the package."""
FactId = tuple[str, Key]
"""The directory of the package, and the key."""

_UNSET = object()
_FAILED = "!"
_FOLLOWED = (".py", ".xml", ".yaml", ".yml", ".urdf", ".xacro", CMAKE_LISTS, SETUP_CFG)
"""The extensions of files that are only read through views of the package."""
_recorders: list[Reads] = []


class Reads:
    """The files that a result depends on, directly or through views.

    A view may read more files when it is used; they count for everything derived from it, even if
    it was derived before.
    """

    __slots__ = ("facts", "files", "views")

    def __init__(self) -> None:
        self.files: set[str] = set()
        """The files whose content was accessed."""
        self.facts: set[Fact] = set()
        """The facts used instead of files."""
        self.views: set[Reads] = set()

    def all(self) -> tuple[frozenset[str], frozenset[Fact]]:
        """Return files and facts, including those of views."""
        seen = {self}
        pending = [self]
        while pending:
            for view in pending.pop().views:
                if view not in seen:
                    seen.add(view)
                    pending.append(view)
        files = frozenset[str]().union(*(reads.files for reads in seen))
        facts = {fact.id: fact for reads in seen for fact in reads.facts}
        return files, frozenset(facts.values())


class Fact:
    """A value and its dependencies.

    Args:
        directory: The package.
        key: The provider and its arguments.
        known: The stored fact of an earlier run.
    """

    __slots__ = ("_encoded", "_known", "_value", "directory", "error", "key", "reads")

    def __init__(self, directory: str, key: Key, known: StoredFact | None = None) -> None:
        self.directory = directory
        self.key = key
        self.error: ViewError | None = None
        """The error, if there is no value."""
        self.reads = Reads()
        self._value: object = _UNSET
        self._known = known
        self._encoded = _UNSET if known is None else known.encoded

    @property
    def id(self) -> FactId:
        """Its id among the facts of all packages."""
        return self.directory, self.key

    @property
    def value(self) -> object:
        """The value returned by the provider."""
        if self._value is _UNSET:
            self._value = decode(self._encoded)
        return self._value

    @property
    def encoded(self) -> object:
        """Its value or error, encoded with ``encode``: equal for equal values."""
        if self.error is not None:
            return _FAILED, str(self.error)
        if self._encoded is _UNSET:
            self._encoded = encode(self._value)
        return self._encoded

    def stored(self) -> tuple[StoredFact, Iterable[Fact]]:
        """Return the stored form for a later run, and the facts that it depends on."""
        if self._known is not None:
            return self._known, self.reads.facts
        files, facts = self.reads.all()
        return StoredFact(files, tuple(fact.id for fact in facts), self.encoded), facts

    @property
    def is_of_files(self) -> bool:
        """Whether it was computed in this run, only from files."""
        return self._known is None and not self.reads.all()[1]

    def make(self, provide: Callable[[], object]) -> None:
        """Call its provider, recording its dependencies."""
        with recorded(self.reads):
            try:
                self._value = provide()
            except ViewError as error:
                self.error = error


class StoredFact(NamedTuple):
    """A stored fact."""

    files: frozenset[str]
    """The files that it depends on, by ``Package.full_path``."""
    facts: tuple[FactId, ...]
    """The facts that it depends on."""
    encoded: Any

    @property
    def has_failed(self) -> bool:
        """Whether there was no value."""
        return isinstance(self.encoded, tuple) and self.encoded[0] == _FAILED


Settled = dict[FactId, StoredFact | Fact | None]
"""The facts that were requested in this run: as stored, or computed again with the same value;
``None`` for others."""


class recorded:  # noqa: N801  used like a function; a generator would take twice the time
    """Record accesses in the block in ``reads``, and only there."""

    __slots__ = ("_reads",)

    def __init__(self, reads: Reads) -> None:
        self._reads = reads

    def __enter__(self) -> None:
        _recorders.append(self._reads)

    def __exit__(self, *_: object) -> None:
        _recorders.pop()


def current() -> Reads:
    """Return the current record of accesses."""
    return _recorders[-1] if _recorders else Reads()


def note_file(path: str) -> None:
    """Record that the content of a file was accessed."""
    if _recorders:
        _recorders[-1].files.add(path)


def note_fact(fact: Fact) -> None:
    """Record that a fact was used."""
    if _recorders:
        _recorders[-1].facts.add(fact)


def note_view(reads: Reads) -> None:
    """Record that something derived from ``reads`` was used."""
    if _recorders and _recorders[-1] is not reads:
        _recorders[-1].views.add(reads)


def is_followed(path: str) -> bool:
    """Return whether changes of the content of a file are tracked."""
    return path.endswith(_FOLLOWED)
