"""Decides which cached facts are still valid after some files were edited."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from scaffold import time_limit
from scaffold.model.facts import ask_again
from scaffold.model.reads import Fact, FactId, Key, Settled, StoredFact
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.check.result import Earlier
    from scaffold.model.package import Package


_UNASKED: Any = object()


class EarlierFacts:
    """The facts that a cached result depends on.

    Args:
        package: The package of the result.
        stored: The facts, also of packages around it.
        edited: The files that were edited since, by ``Package.full_path``.
        settled: The facts checked in this run, which is extended.
    """

    def __init__(
        self,
        package: Package,
        stored: Mapping[FactId, StoredFact],
        edited: Collection[str],
        settled: Settled,
    ) -> None:
        self._stored = stored
        self._edited = edited
        self._settled = settled
        self._recalled: dict[FactId, Fact] = {}
        self._homes: dict[str, Package] = {
            item.directory: item for item in package.known_workspace or ()
        }
        self._homes[package.directory] = package
        for directory in {directory for directory, _ in stored} & self._homes.keys():
            self._homes[directory].assume_facts(_Recall(self, directory))

    def hold(self, wanted: Iterable[FactId]) -> bool:
        """Return whether facts still have their values.

        Those of edited files are computed again.
        """
        settled = self._settled
        for item in wanted:
            known = settled.get(item, _UNASKED)
            if known is _UNASKED:
                known = settled[item] = self._unchanged(item) or self._made_again(item)
            if known is None:
                return False
        return True

    def end(self) -> None:
        """Stop recalling facts; packages compute them again, unless they did in this run.

        Facts recalled for this package need not be valid for others, which see other packages.
        """
        for directory in {directory for directory, _ in self._stored} & self._homes.keys():
            self._homes[directory].end_assumptions()

    def recall(self, wanted: FactId) -> Fact | None:
        """Return a fact if its value is known to be unchanged."""
        stored = self._settled.get(wanted) or self._unchanged(wanted)
        if isinstance(stored, StoredFact):
            self._settled[wanted] = stored
            recalled = self._recalled.get(wanted)
            if recalled is not None:
                return recalled
            fact = self._recalled[wanted] = Fact(*wanted, stored)
            # Views of this package may be used by another, which does not know their dependencies.
            fact.reads.facts.update(item for item in map(self.recall, stored.facts) if item)
            return fact
        return stored

    def _unchanged(self, wanted: FactId) -> StoredFact | None:
        """Return a fact if none of its dependencies has changed."""
        stored = self._stored.get(wanted)
        if stored is None or not stored.files.isdisjoint(self._edited) or stored.has_failed:
            return None
        return stored if self.hold(stored.facts) else None

    def _made_again(self, wanted: FactId) -> Fact | None:
        directory, key = wanted
        package = self._homes.get(directory)
        if package is None or wanted not in self._stored:
            return None
        try:
            with time_limit.limited():
                ask_again(package, key)
        except ViewError:
            pass  # the fact raises the error
        except Exception:  # noqa: BLE001  the rule that needs it fails in the same way
            return None
        result = package.known_fact(key)
        is_same = result is not None and result.encoded == self._stored[wanted].encoded
        return result if is_same else None


@contextmanager
def recalled(package: Package, earlier: Earlier | None) -> Iterator[None]:
    """Provide a package with the facts of an earlier check, if there was one."""
    if earlier is None:
        yield
        return
    facts = EarlierFacts(package, earlier.verdict.facts, earlier.edited, earlier.settled)
    try:
        yield
    finally:
        facts.end()


class _Recall:
    """Looks up cached facts of one package."""

    def __init__(self, facts: EarlierFacts, directory: str) -> None:
        self._facts = facts
        self._directory = directory

    def __call__(self, key: Key) -> Fact | None:
        """Return a fact if its value is known to be unchanged."""
        return self._facts.recall((self._directory, key))


def to_store(
    facts: Iterable[Fact], taken_over: Iterable[FactId], settled: Settled
) -> Mapping[FactId, StoredFact]:
    """Return facts for a later run, with all their dependencies.

    Args:
        facts: The facts that this run computed or recalled.
        taken_over: The facts that reused results depend on.
        settled: The checked facts of the earlier run.
    """
    stored: Settled = {fact.id: fact for fact in facts}
    pending = [*stored, *taken_over]
    result: dict[FactId, StoredFact] = {}
    while pending:
        wanted = pending.pop()
        if wanted in result:
            continue
        item = stored.get(wanted) or settled.get(wanted)
        if isinstance(item, Fact):
            item, used = item.stored()
            for fact in used:
                stored.setdefault(fact.id, fact)
        if item is not None:
            result[wanted] = item
            pending += item.facts
    return result
