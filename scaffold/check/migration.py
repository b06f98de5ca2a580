"""Compares the findings for two distributions: what a migration breaks or changes."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterable, Mapping, Sequence
from contextlib import suppress
from types import MappingProxyType
from typing import TYPE_CHECKING

from scaffold import distributions, lazy_re
from scaffold.check import conflicts
from scaffold.check.rules.engine_rules import (
    FileTooLarge,
    PackageOfRos1,
    RuleCrashed,
    UnparsableFile,
)
from scaffold.check.session import Session
from scaffold.check.several import without_distribution
from scaffold.diagnostic import Diagnostic, Severity
from scaffold.model.discovery.colcon import IGNORE_MARKERS
from scaffold.model.python.conditions.distribution_branches import is_run
from scaffold.record import NamedTuple
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.check.result import Result
    from scaffold.check.rules.rule import Rule
    from scaffold.distributions import Distribution
    from scaffold.model.discovery.targets import Target
    from scaffold.model.package import Package

    Known = Collection[tuple[str, str, str, str]]

_AREAS = ("PX", "CM", "SP", "LY", "TS", "NM", "IM", "ND", "MS", "LF", "PF", "TY", "UR", "BR")
_OF_PYTHON = ("E9", "F7", "F82")
"""Style codes that depend on the Python version."""

_OF_ENGINE = (UnparsableFile.code, RuleCrashed.code, FileTooLarge.code, PackageOfRos1.code)

CODES = (*_AREAS, *_OF_PYTHON, *_OF_ENGINE)
"""The codes that a move may change, or their beginnings: all but those of mere style.

What only the tool is concerned with is not among them: a suppression that nothing needs on the
target breaks nothing, and the distributions that are kept may need it.
"""

UNEXAMINED = conflicts.UNREADABLE | {"E902", *_OF_ENGINE}
"""The codes of unchecked files."""

ORDER = ("I100", "I101", "I201")
"""The codes of unsorted imports, which renamed modules may cause."""


class Consequences(NamedTuple):
    """The effects of a migration on one package."""

    result: Result
    breaks: Sequence[Diagnostic]
    changes: Sequence[Diagnostic]
    """Code that runs but behaves differently."""
    deprecated: Sequence[Diagnostic]
    unexamined: Sequence[Diagnostic]
    """Files that cannot be read."""

    @classmethod
    def of(
        cls, result: Result, rules: Iterable[type[Rule]], known: Known, origin: Distribution
    ) -> Consequences:
        """Classify the findings in a package, without advice other than deprecations.

        Code in a branch for the target has never run elsewhere, so it is no change.

        Args:
            result: The findings for the target.
            rules: The rules; see `Rule.is_removal` and `Rule.is_deprecation`.
            known: The findings for the source distribution.
            origin: The source distribution.
        """
        directory = result.package.directory
        before = {
            path for place, path, code, _ in known if place == directory and code in UNEXAMINED
        }
        removals = {rule.code for rule in rules if rule.is_removal}
        deprecations = {rule.code for rule in rules if rule.is_deprecation}
        breaks: list[Diagnostic] = []
        changes: list[Diagnostic] = []
        deprecated: list[Diagnostic] = []
        unexamined: list[Diagnostic] = []
        for item in result.diagnostics:
            if item.code in UNEXAMINED and item.location.path in before:
                if not _is_ignored(result.package, item.location.path):
                    unexamined.append(item)
            elif (
                item.code.startswith(_OF_PYTHON)
                or item.severity is Severity.ERROR
                or item.code in removals
            ):
                breaks.append(item)
            elif item.code in deprecations:
                deprecated.append(item)
            elif item.severity is Severity.WARNING and _ran_on(origin, result.package, item):
                changes.append(item)
        return cls(result, breaks, changes, deprecated, unexamined)

    @property
    def diagnostics(self) -> Sequence[Diagnostic]:
        """All consequences."""
        return [*self.breaks, *self.changes, *self.deprecated]

    @property
    def is_done(self) -> bool:
        """Whether the package runs on the target as before, as far as known."""
        return not (self.breaks or self.changes or self.unexamined)


def _ran_on(origin: Distribution, package: Package, item: Diagnostic) -> bool:
    """Return whether the place of a finding may run on the source distribution."""
    if item.location.path in package.python_files:
        with suppress(ViewError), distributions.targeting(origin):
            return is_run(package.module(item.location.path), item.location)
    return True


def _is_ignored(package: Package, path: str) -> bool:
    """Return whether a file is in a directory with COLCON_IGNORE or AMENT_IGNORE."""
    parents = path.split("/")[:-1]
    directories = ("/".join(parents[:end]) for end in range(1, len(parents) + 1))
    return any(
        package.has(f"{directory}/{name}") for directory in directories for name in IGNORE_MARKERS
    )


class MigratingSession(Session):
    """A session that reports what the source distribution does not report."""

    known: Known = ()
    """The findings for the source, as returned by `identities`."""
    improved: Collection[str] = ()
    """The codes of findings that are worse for the source, except errors: see `deprecations`."""
    at_target: Known | None = None
    """Of a distribution that is kept: what is found for the target. What breaks without being found
    there is reported, although it was found before: it is right for one of the two alone."""

    def _report(self, target: Target, diagnostics: list[Diagnostic]) -> list[Diagnostic]:
        """Return new findings and unchecked files; lines are ignored, as they may have moved."""
        reported = super()._report(target, diagnostics)
        directory = target.package.directory
        return [
            item
            for item in reported
            if item.code in UNEXAMINED
            or (
                self._is_new(_identity(directory, item), item)
                and (item.code not in self.improved or item.severity is Severity.ERROR)
            )
        ]

    def _is_new(self, identity: tuple[str, str, str, str], item: Diagnostic) -> bool:
        if identity not in self.known:
            return True
        is_error = item.severity is Severity.ERROR
        return is_error and self.at_target is not None and identity not in self.at_target


class OrderSession(Session):
    """A session that reports unsorted imports only in files that were mostly sorted."""

    unordered: Mapping[tuple[str, str], int] = MappingProxyType({})
    """The number of unsorted imports, by directory and path of the file."""

    def _report(self, target: Target, diagnostics: list[Diagnostic]) -> list[Diagnostic]:
        reported = super()._report(target, diagnostics)
        directory = target.package.directory
        now = Counter(item.location.path for item in reported)
        return [
            item
            for item in reported
            if now[item.location.path] > self.unordered.get((directory, item.location.path), 0)
        ]


def deprecations(rules: Iterable[type[Rule]]) -> frozenset[str]:
    """Return the codes of deprecations, which are removed in later distributions."""
    return frozenset(rule.code for rule in rules if rule.is_deprecation)


def unordered(results: Sequence[Result]) -> Mapping[tuple[str, str], int]:
    """Return the number of unsorted imports, by directory and path of the file."""
    return Counter(
        (result.package.directory, item.location.path)
        for result in results
        for item in result.diagnostics
        if item.code in ORDER
    )


def identities(results: Sequence[Result]) -> set[tuple[str, str, str, str]]:
    """Return the identities of findings, the same for two distributions."""
    return {
        _identity(result.package.directory, item)
        for result in results
        for item in result.diagnostics
    }


def _identity(directory: str, item: Diagnostic) -> tuple[str, str, str, str]:
    """Return the identity of a finding; one with another exception was broken before."""
    message = _EXCEPTION.sub("", without_distribution(item.message))
    return directory, item.location.path, item.code, message


_EXCEPTION = lazy_re.compile(r"\b[A-Z]\w*Error\b")
