"""What a move to another distribution changes: what is found for it and not for the one before."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import TYPE_CHECKING

from scaffold.check.session import Session
from scaffold.check.several import without_distribution
from scaffold.diagnostic import Diagnostic, Severity
from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from scaffold.check.result import Result
    from scaffold.model.discovery.targets import Target

    Known = Collection[tuple[str, str, str, str]]

AREAS = ("PX", "CM", "SP", "LY", "TS", "NM", "IM", "ND", "MS", "LF", "PF", "TY", "SC")
"""The beginnings of the codes that a move may change: all but those of style."""

ORDER = ("I100", "I101", "I201")
"""The codes of imports that are not in order, as modules with other names may leave them."""


class Consequences(NamedTuple):
    """What a move does to one package."""

    result: Result
    breaks: Sequence[Diagnostic]
    changes: Sequence[Diagnostic]
    """What runs and does something else."""
    deprecated: Sequence[Diagnostic]

    @classmethod
    def of(cls, result: Result, deprecations: Collection[str]) -> Consequences:
        """Sort what is found in a package; advice that is about no deprecation is left out.

        Args:
            result: What is found.
            deprecations: The codes of what works, and will go; see `Rule.is_deprecation`.
        """
        breaks: list[Diagnostic] = []
        changes: list[Diagnostic] = []
        deprecated: list[Diagnostic] = []
        for item in result.diagnostics:
            if item.severity is Severity.ERROR:
                breaks.append(item)
            elif item.code in deprecations:
                deprecated.append(item)
            elif item.severity is Severity.WARNING:
                changes.append(item)
        return cls(result, breaks, changes, deprecated)

    @property
    def diagnostics(self) -> Sequence[Diagnostic]:
        """All of them."""
        return [*self.breaks, *self.changes, *self.deprecated]


class MigratingSession(Session):
    """Reports what is not known of the distribution that the packages come from."""

    known: Known = ()
    """What is found there, as `identities` returns it."""

    def _report(self, target: Target, diagnostics: list[Diagnostic]) -> list[Diagnostic]:
        """Return what is new; lines may have moved since, so that places do not count."""
        reported = super()._report(target, diagnostics)
        directory = target.package.directory
        return [item for item in reported if _identity(directory, item) not in self.known]


class OrderSession(Session):
    """Reports imports that are not in order, in files where they were before the fixes."""

    unordered: Collection[tuple[str, str]] = ()
    """The directories and paths of the other files."""

    def _report(self, target: Target, diagnostics: list[Diagnostic]) -> list[Diagnostic]:
        reported = super()._report(target, diagnostics)
        directory = target.package.directory
        return [item for item in reported if (directory, item.location.path) not in self.unordered]


def unordered(results: Sequence[Result]) -> set[tuple[str, str]]:
    """Return the directories and paths of files whose imports are not in order."""
    return {
        (result.package.directory, item.location.path)
        for result in results
        for item in result.diagnostics
        if item.code in ORDER
    }


def identities(results: Sequence[Result]) -> set[tuple[str, str, str, str]]:
    """Return what makes findings the same for two distributions."""
    return {
        _identity(result.package.directory, item)
        for result in results
        for item in result.diagnostics
    }


def _identity(directory: str, item: Diagnostic) -> tuple[str, str, str, str]:
    return directory, item.location.path, item.code, without_distribution(item.message)
