"""The result of `check`: findings per package, and their counts."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import TYPE_CHECKING

from scaffold.diagnostic import Diagnostic, Severity
from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from scaffold.check.cache.facts import Settled
    from scaffold.model.package import Package
    from scaffold.model.reads import FactId, StoredFact


class Part(NamedTuple):
    """The findings of one unit: a rule in a package, or all rules that read one file."""

    files: frozenset[str]
    """The files that it depends on, by ``Package.full_path``."""
    facts: frozenset[FactId]
    """The facts of this and other packages that it depends on."""
    diagnostics: tuple[Diagnostic, ...]


class Verdict(NamedTuple):
    """The findings in a package, in parts with their dependencies.

    That is on condition that nothing but files that are followed (`scaffold.model.reads`) was
    edited: after any other change nothing in it holds.
    """

    parts: Mapping[str, Part]
    """By the code of a rule that looks at the package; by path for all rules that look at that
    file alone; by code and path for others that look at files one by one."""
    style: Mapping[str, Sequence[Diagnostic]]
    """What the linters of Python style find, by path."""
    unparsable: Sequence[Diagnostic]
    """The files that could not be read, each with the reason."""
    facts: Mapping[FactId, StoredFact]
    """The facts that the parts depend on, also through others."""
    types: Mapping[str, Part] = {}
    """What types show in files, by path, before anything is suppressed."""
    configuring: frozenset[str] = frozenset()
    """The files that say by what style is judged, by ``Package.full_path``."""


class Earlier(NamedTuple):
    """The findings of an earlier check of a package, and the edits since."""

    verdict: Verdict
    """Its style is that of the files as they are now."""
    edited: Collection[str]
    """Files of this and other packages, by ``Package.full_path``."""
    settled: Settled
    """What this run has found out about the facts of the verdict."""

    @classmethod
    def of(cls, package: Package, verdict: Verdict, edited: Collection[str]) -> Earlier:
        """Return what is left after some files were edited."""
        style = {
            path: item
            for path, item in verdict.style.items()
            if package.full_path(path) not in edited
        }
        return cls(verdict._replace(style=style), edited, {})


class Result(NamedTuple):
    """The findings in one package."""

    package: Package
    files: int
    diagnostics: list[Diagnostic]
    verdict: Verdict | None = None
    """The same in parts, where a later check can make use of it."""
    foreign: tuple[str, ...] = ()
    """Of each file that is not the user's, and was skipped, what makes it so."""

    def without_fixes(self) -> Result:
        """Return the same findings with no fix for any."""
        return self._replace(diagnostics=[item._replace(fix=None) for item in self.diagnostics])


class Ruled(NamedTuple):
    """The findings of the rules in a package."""

    files: int
    diagnostics: list[Diagnostic]
    verdict: Verdict | None
    """The same in parts."""
    style: Mapping[str, Sequence[Diagnostic]] = {}
    """The style of the files that are not to be checked again, by path."""
    foreign: tuple[str, ...] = ()
    """Of the files that are not the user's, what makes them so."""
    suppressed: tuple[Diagnostic, ...] = ()
    """What was found, and is not among the diagnostics."""


class Summary(NamedTuple):
    """Counts over a whole run."""

    packages: int
    files: int
    errors: int
    warnings: int
    infos: int

    @classmethod
    def of(cls, results: Sequence[Result]) -> Summary:
        """Count."""
        severities = [d.severity for result in results for d in result.diagnostics]
        return cls(
            len(results),
            sum(result.files for result in results),
            severities.count(Severity.ERROR),
            severities.count(Severity.WARNING),
            severities.count(Severity.INFO),
        )
