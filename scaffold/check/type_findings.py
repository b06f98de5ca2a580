"""Type checker findings, from a new run or from the cache."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import partial
from typing import TYPE_CHECKING

from scaffold.check import runner, suppression
from scaffold.check.cache.facts import to_store
from scaffold.check.result import Earlier, Part
from scaffold.check.rules import type_rules
from scaffold.record import NamedTuple
from scaffold.types.check import TypeCheck

if TYPE_CHECKING:
    from scaffold.check.rules.type_rules import TypeRule
    from scaffold.diagnostic import Diagnostic
    from scaffold.model.package import Package
    from scaffold.model.reads import Fact, FactId, StoredFact


class Typed(NamedTuple):
    """The type findings in a package."""

    diagnostics: Sequence[Diagnostic] = ()
    parts: Mapping[str, Part] = {}
    """The findings by path, before suppression, without files whose findings are not stored."""
    facts: Mapping[FactId, StoredFact] = {}
    """The facts that the parts depend on."""


class TypeFindings:
    """Checks the types of packages; the type checker starts immediately.

    Args:
        rules: The rules that evaluate its reports.
        packages: The packages.
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
        self._earlier = {place: _of_types(item) for place, item in earlier.items()}
        self._kept: Mapping[str, Part] = {}
        """The reused findings in the current package."""
        self._check = TypeCheck(
            packages,
            lambda package, path: path not in self._kept and is_wanted(package, path),
            self._recalling,
            partial(type_rules.is_any_wrong, rules),
        )

    @contextmanager
    def _recalling(self, package: Package) -> Iterator[None]:
        """Provide a package with the facts of an earlier run."""
        check = runner.Check(package, self._earlier.get(package.directory))
        self._kept = check.parts
        try:
            yield
        finally:
            check.end()

    @property
    def failure(self) -> str:
        """Why types are not checked; empty if they are."""
        return self._check.failure

    def close(self) -> None:
        """End the type checker."""
        self._check.close()

    def of(self, package: Package) -> Typed:
        """Return the type findings in a package."""
        reported = self._check.by_file(package)
        if self.failure:
            return Typed()
        check = runner.Check(package, self._earlier.get(package.directory))
        if reported:
            type_rules.give(package, reported)
        diagnostics = check.run(self._rules if reported else ())
        if diagnostics or self._check.may_suppress(package):
            codes = {rule.code for rule in self._rules}
            diagnostics = suppression.apply(package, diagnostics, codes)
        verdict = check.verdict({})
        check.end()
        if verdict is None:
            return Typed(diagnostics)
        parts = dict(check.parts)
        facts: set[Fact] = set()
        for path, reads in self._check.reached_by(package).items():
            judged = verdict.parts.get(path, _NOTHING)
            files, used = reads.all()
            facts |= used
            ids = frozenset(item.id for item in used)
            parts[path] = judged._replace(files=judged.files | files, facts=judged.facts | ids)
        return Typed(diagnostics, parts, {**verdict.facts, **to_store(facts, (), {})})


_NOTHING = Part(frozenset(), frozenset(), ())


def _of_types(earlier: Earlier) -> Earlier:
    """Return the reusable type findings."""
    verdict = earlier.verdict
    return earlier._replace(verdict=verdict._replace(parts=verdict.types, unparsable=()))
