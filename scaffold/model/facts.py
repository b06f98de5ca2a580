"""Facts: small cached values computed from files, so that dependents need not reparse.

Results that depend on a fact are valid until its value changes, whatever else changes in the files.
Facts about unchanged files come from the cache without parsing.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from functools import wraps
from importlib import import_module
from typing import Any, Concatenate, ParamSpec, TypeVar

from scaffold.model import reads
from scaffold.model.reads import Fact, Key

Words = ParamSpec("Words")
Value = TypeVar("Value")
Store = TypeVar("Store", bound="FactStore")


class FactStore:
    """The facts about one package, including those of an earlier run."""

    def __init__(self, directory: str) -> None:
        self.directory = directory
        """The path of the root as given by the user; empty for a package in memory."""
        self._facts: dict[Key, Fact] = {}
        self._recalls: list[Callable[[Key], Fact | None]] = []

    def fact(self, key: Key, make: Callable[[], Value]) -> Value:
        """Return a fact; see the decorator `fact`."""
        fact = self._facts.get(key) or self._recall(key)
        if fact is None:
            fact = Fact(self.directory, key)
            fact.make(make)
            self._facts[key] = fact
        reads.note_fact(fact)
        if fact.error is not None:
            raise fact.error
        value: Any = fact.value
        return value  # type: ignore[no-any-return]  # what make made

    def known_fact(self, key: Key) -> Fact | None:
        """Return a fact that was requested, or is known from an earlier run."""
        return self._facts.get(key) or self._recall(key)

    @property
    def facts(self) -> Sequence[Fact]:
        """The requested facts."""
        return [*self._facts.values()]

    def assume_facts(self, recall: Callable[[Key], Fact | None]) -> None:
        """Use the facts of an earlier run that are still valid."""
        self._recalls.append(recall)

    def forget_facts(self) -> None:
        """Drop the facts, including those of an earlier run."""
        self._facts.clear()
        self._recalls.clear()

    def end_assumptions(self) -> None:
        """Drop the facts of an earlier run, and those that depend on them."""
        self._recalls.clear()
        self._facts = {key: fact for key, fact in self._facts.items() if fact.is_of_files}

    def _recall(self, key: Key) -> Fact | None:
        for recall in self._recalls:
            fact = recall(key)
            if fact is not None:
                self._facts[key] = fact
                return fact
        return None


def fact(
    function: Callable[Concatenate[Store, Words], Value],
) -> Callable[Concatenate[Store, Words], Value]:
    """Decorate a function of a package and strings to return a fact.

    Its value consists of strings, numbers, enumerations, and collections and records of these;
    it must not be changed. The function may raise ViewError.
    """
    name = f"{function.__module__}:{function.__qualname__}"

    @wraps(function)
    def ask(package: Store, /, *words: Words.args, **named: Words.kwargs) -> Value:
        return package.fact((name, *words), lambda: function(package, *words, **named))

    return ask


def ask_again(package: FactStore, key: Key) -> None:
    """Compute a fact by its key; raises ViewError like its provider, LookupError without one."""
    module, _, name = str(key[0]).partition(":")
    provider: Any = sys.modules.get(module) or import_module(module)
    for part in name.split("."):
        provider = getattr(provider, part, None)
    if provider is None:
        raise LookupError(name)
    provider(package, *key[1:])
