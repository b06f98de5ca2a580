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
"""What the paths of files end with that are read through views of the package alone."""
_recorders: list[Reads] = []


class Reads:
    """The files that a result depends on, directly or through views.

    A view may read more files when it is used; that counts for everything made of it, also if
    that was before.
    """

    __slots__ = ("facts", "files", "views")

    def __init__(self) -> None:
        self.files: set[str] = set()
        """The files whose content was accessed."""
        self.facts: set[Fact] = set()
        """What was asked of files without looking at them."""
        self.views: set[Reads] = set()

    def all(self) -> tuple[frozenset[str], frozenset[Fact]]:
        """Return files and facts, those of the views included."""
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
    """A value, and what it was made of.

    Args:
        directory: The package.
        key: The provider and its arguments.
        known: The same as an earlier run stored it.
    """

    __slots__ = ("_encoded", "_known", "_value", "directory", "error", "key", "reads")

    def __init__(self, directory: str, key: Key, known: StoredFact | None = None) -> None:
        self.directory = directory
        self.key = key
        self.error: ViewError | None = None
        """Why there is no value."""
        self.reads = Reads()
        self._value: object = _UNSET
        self._known = known
        self._encoded = _UNSET if known is None else known.encoded

    @property
    def id(self) -> FactId:
        """What it is called among the facts of all packages."""
        return self.directory, self.key

    @property
    def value(self) -> object:
        """What the provider returned."""
        if self._value is _UNSET:
            self._value = decode(self._encoded)
        return self._value

    @property
    def encoded(self) -> object:
        """Its value, or why there is none, as ``encode`` returns it: equal for equal values."""
        if self.error is not None:
            return _FAILED, str(self.error)
        if self._encoded is _UNSET:
            self._encoded = encode(self._value)
        return self._encoded

    def stored(self) -> tuple[StoredFact, Iterable[Fact]]:
        """Return what a later run may know of it, and the facts that it was made of."""
        if self._known is not None:
            return self._known, self.reads.facts
        files, facts = self.reads.all()
        return StoredFact(files, tuple(fact.id for fact in facts), self.encoded), facts

    @property
    def is_of_files(self) -> bool:
        """Whether it was made in this run, of nothing but files."""
        return self._known is None and not self.reads.all()[1]

    def make(self, provide: Callable[[], object]) -> None:
        """Ask its provider; what that looks at counts as the fact's own."""
        with recorded(self.reads):
            try:
                self._value = provide()
            except ViewError as error:
                self.error = error


class StoredFact(NamedTuple):
    """A fact as a run remembers it."""

    files: frozenset[str]
    """The files that it was made of, by ``Package.full_path``."""
    facts: tuple[FactId, ...]
    """The facts that it was made of."""
    encoded: Any

    @property
    def has_failed(self) -> bool:
        """Whether there was no value."""
        return isinstance(self.encoded, tuple) and self.encoded[0] == _FAILED


class recorded:  # noqa: N801  used like a function; a generator would take twice the time
    """Note in ``reads``, and only there, what the block looks at."""

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
    """Note that the content of a file was accessed."""
    if _recorders:
        _recorders[-1].files.add(path)


def note_fact(fact: Fact) -> None:
    """Note that a fact was used."""
    if _recorders:
        _recorders[-1].facts.add(fact)


def note_view(reads: Reads) -> None:
    """Note that something derived from ``reads`` was used."""
    if _recorders and _recorders[-1] is not reads:
        _recorders[-1].views.add(reads)


def is_followed(path: str) -> bool:
    """Tell whether changes of the content of a file are followed."""
    return path.endswith(_FOLLOWED)
