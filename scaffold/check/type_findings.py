"""Type checker findings, from a new run or from the cache."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import partial
from typing import TYPE_CHECKING

from scaffold.check import runner, suppression
from scaffold.check.cache.facts import to_store
from scaffold.check.result import Earlier, Part
from scaffold.check.rules import type_rules
from scaffold.files.disk import size
from scaffold.record import NamedTuple
from scaffold.types.check import TypeCheck

if TYPE_CHECKING:
    from scaffold.check.rules.type_rules import TypeRule
    from scaffold.diagnostic import Diagnostic
    from scaffold.model.package import Package
    from scaffold.model.reads import Fact, FactId, StoredFact


BATCH = 2_000_000
"""Bytes of Python from which on the type checker is started again for the packages that follow:
what it has read stays in its memory, some 60 times as much."""


class Typed(NamedTuple):
    """The type findings in a package."""

    diagnostics: Sequence[Diagnostic] = ()
    parts: Mapping[str, Part] = {}
    """The findings by path, before suppression, without files whose findings are not stored."""
    facts: Mapping[FactId, StoredFact] = {}
    """The facts that the parts depend on."""


class TypeFindings:
    """Checks the types of packages, in batches; the first one starts immediately.

    Each starts when what is reported about the one before it has been read.

    Args:
        rules: The rules that evaluate its reports.
        packages: The packages, in the order in which they are asked about.
        is_wanted: Tells by package and path whether a file is to be checked.
        earlier: Earlier results of some packages, by directory.
    """

    def __init__(
        self,
        rules: Sequence[TypeRule],
        packages: Sequence[Package],
        is_wanted: Callable[[Package, str], bool],
        earlier: Mapping[str, Earlier],
    ) -> None:
        self._rules = rules
        self._is_wanted = is_wanted
        self._earlier = {place: _of_types(item) for place, item in earlier.items()}
        self._kept: Mapping[str, Part] = {}
        """The reused findings in the current package."""
        self._batches = [*_batches(packages)]
        self._numbers = {
            id(package): number for number, batch in enumerate(self._batches) for package in batch
        }
        self._checks: dict[int, TypeCheck] = {}
        """The started runs, by the number of the batch: at most two."""
        self.failure = ""
        """Why types are not checked; empty if they are."""
        self._start(0)

    def _start(self, number: int) -> None:
        if number < len(self._batches) and not self.failure:
            check = self._checks[number] = TypeCheck(
                self._batches[number],
                lambda package, path: path not in self._kept and self._is_wanted(package, path),
                self._recalling,
                partial(type_rules.is_any_wrong, self._rules),
            )
            self.failure = check.failure

    def _check_of(self, package: Package) -> TypeCheck | None:
        """Return the check of a package after its reports were read, ``None`` if there is none."""
        number = self._numbers[id(package)]
        for other in [other for other in self._checks if other < number]:
            self._checks.pop(other).close()
        if number not in self._checks:
            self._start(number)
        check = self._checks.get(number)
        if check is not None:
            check.by_file(package)
            self.failure = self.failure or check.failure
            if number + 1 not in self._checks:
                self._start(number + 1)
        return None if self.failure else check

    @contextmanager
    def _recalling(self, package: Package) -> Iterator[None]:
        """Provide a package with the facts of an earlier run."""
        check = runner.Check(package, self._earlier.get(package.directory))
        self._kept = check.parts
        try:
            yield
        finally:
            check.end()

    def close(self) -> None:
        """End the type checker."""
        for check in self._checks.values():
            check.close()

    def of(self, package: Package) -> Typed:
        """Return the type findings in a package."""
        types = self._check_of(package)
        if types is None:
            return Typed()
        reported = types.by_file(package)
        check = runner.Check(package, self._earlier.get(package.directory))
        if reported:
            type_rules.give(package, reported)
        diagnostics = check.run(self._rules if reported else ())
        if diagnostics or types.may_suppress(package):
            codes = {rule.code for rule in self._rules}
            diagnostics = suppression.apply(package, diagnostics, codes)
        verdict = check.verdict({})
        check.end()
        if verdict is None:
            return Typed(diagnostics)
        parts = dict(check.parts)
        facts: set[Fact] = set()
        for path, reads in types.reached_by(package).items():
            judged = verdict.parts.get(path, _NOTHING)
            files, used = reads.all()
            facts |= used
            ids = frozenset(item.id for item in used)
            parts[path] = judged._replace(files=judged.files | files, facts=judged.facts | ids)
        return Typed(diagnostics, parts, {**verdict.facts, **to_store(facts, (), {})})


_NOTHING = Part(frozenset(), frozenset(), ())


def _batches(packages: Sequence[Package]) -> Iterator[list[Package]]:
    """Yield the packages in batches of about the same size."""
    batch: list[Package] = []
    total = 0
    for package in packages:
        if total > BATCH:
            yield batch
            batch, total = [], 0
        batch.append(package)
        python = (path for path in package.tree.files if path.endswith(".py"))
        total += sum(size(os.path.join(package.place or "", path)) for path in python)
    if batch:
        yield batch


def _of_types(earlier: Earlier) -> Earlier:
    """Return the reusable type findings."""
    verdict = earlier.verdict
    return earlier._replace(verdict=verdict._replace(parts=verdict.types, unparsable=()))
