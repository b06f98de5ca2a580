"""The result of `check`: findings per package, and their counts."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import TYPE_CHECKING

from scaffold.diagnostic import Diagnostic, Severity
from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from scaffold.model.package import Package
    from scaffold.model.reads import FactId, Settled, StoredFact


class Part(NamedTuple):
    """The findings of one unit: a rule in a package, or all rules that read one file."""

    files: frozenset[str]
    """The files that it depends on, by ``Package.full_path``."""
    facts: frozenset[FactId]
    """The facts of this and other packages that it depends on."""
    diagnostics: tuple[Diagnostic, ...]


class Verdict(NamedTuple):
    """The findings in a package, in parts with their dependencies.

    Valid only if nothing but tracked files (`scaffold.model.reads`) was
    edited: after any other change it is invalid.
    """

    parts: Mapping[str, Part]
    """By the code of a rule that looks at the package; by path for all rules that look at that
    file alone; by code and path for others that look at files one by one."""
    style: Mapping[str, Sequence[Diagnostic]]
    """Style findings by path."""
    unparsable: Sequence[Diagnostic]
    """The unreadable files, each with the reason."""
    facts: Mapping[FactId, StoredFact]
    """The facts that the parts depend on, also through others."""
    types: Mapping[str, Part] = {}
    """Type findings by path, before suppression."""
    configuring: frozenset[str] = frozenset()
    """The files that configure style, by ``Package.full_path``."""


class Earlier(NamedTuple):
    """The findings of an earlier check of a package, and the edits since."""

    verdict: Verdict
    """The earlier verdict, with current style findings."""
    edited: Collection[str]
    """Edited files of this and other packages, by ``Package.full_path``."""
    settled: Settled
    """The checked facts of the verdict in this run."""

    @classmethod
    def of(cls, package: Package, verdict: Verdict, edited: Collection[str]) -> Earlier:
        """Return the results that are still valid after some files were edited."""
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
    """The findings in parts, if a later check can reuse them."""
    foreign: tuple[str, ...] = ()
    """The kinds of skipped foreign files."""

    def without_fixes(self) -> Result:
        """Return the findings without fixes."""
        return self._replace(diagnostics=[item._replace(fix=None) for item in self.diagnostics])


class Ruled(NamedTuple):
    """The findings of the rules in a package."""

    files: int
    diagnostics: list[Diagnostic]
    verdict: Verdict | None
    """The findings in parts."""
    style: Mapping[str, Sequence[Diagnostic]] = {}
    """The style findings of files that need not be checked again, by path."""
    foreign: tuple[str, ...] = ()
    """The kinds of foreign files."""
    suppressed: tuple[Diagnostic, ...] = ()
    """The suppressed findings."""


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
