"""Tells which facts of an earlier run are still the same after some files were edited."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import TYPE_CHECKING

from scaffold import time_limit
from scaffold.model.facts import Fact, FactId, Key, StoredFact, ask_again
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package


class EarlierFacts:
    """The facts that a verdict of an earlier run depends on.

    Args:
        package: The package of the verdict.
        stored: The facts, also of packages around it.
        edited: The Python files that were edited since, by ``Package.full_path``.
    """

    def __init__(
        self, package: Package, stored: Mapping[FactId, StoredFact], edited: Collection[str]
    ) -> None:
        self._stored = stored
        self._edited = edited
        self._facts: dict[FactId, Fact | None] = {}
        self._homes: dict[str, Package] = {
            item.directory: item for item in package.known_workspace or ()
        }
        self._homes[package.directory] = package
        for directory in {directory for directory, _ in stored} & self._homes.keys():
            self._homes[directory].assume_facts(_Recall(self, directory))

    def fact(self, wanted: FactId) -> Fact | None:
        """Return a fact that has the value it had, ``None`` if it has another.

        Where its files were edited it is made again.
        """
        if wanted not in self._facts:
            self._facts[wanted] = self.recall(wanted) or self._made_again(wanted)
        return self._facts[wanted]

    def end(self) -> None:
        """Stop recalling facts; packages compute them again.

        What is recalled for this package need not hold for others, which depend on other packages.
        """
        for directory in {directory for directory, _ in self._stored} & self._homes.keys():
            self._homes[directory].forget_facts()

    def recall(self, wanted: FactId) -> Fact | None:
        """Return a fact if nothing that it was made of has changed."""
        stored = self._stored.get(wanted)
        if stored is None or not stored.files.isdisjoint(self._edited) or stored.has_failed:
            return None
        used = [self.fact(item) for item in stored.facts]
        facts = [item for item in used if item is not None]
        if len(facts) < len(used):
            return None
        result = Fact(*wanted, stored)
        result.reads.files |= stored.files
        result.reads.facts.update(facts)
        return result

    def _made_again(self, wanted: FactId) -> Fact | None:
        directory, key = wanted
        home = self._homes.get(directory)
        if home is None or wanted not in self._stored:
            return None
        try:
            with time_limit.limited():
                ask_again(home, key)
        except ViewError:
            pass  # the fact says so
        except Exception:  # noqa: BLE001  whoever asks for it fails in the same way
            return None
        result = home.known_fact(key)
        is_same = result is not None and result.encoded == self._stored[wanted].encoded
        return result if is_same else None


class _Recall:
    """Looks for facts of one package."""

    def __init__(self, facts: EarlierFacts, directory: str) -> None:
        self._facts = facts
        self._directory = directory

    def __call__(self, key: Key) -> Fact | None:
        """Return a fact if nothing that it was made of has changed."""
        return self._facts.recall((self._directory, key))
