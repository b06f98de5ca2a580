"""The base class of rules: metadata, examples and ``check``."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from contextlib import AbstractContextManager
from typing import TYPE_CHECKING, ClassVar, Protocol

from scaffold import distributions
from scaffold.diagnostic import Diagnostic, Effect, Severity
from scaffold.edits import Fix, Safety
from scaffold.source import Location

if TYPE_CHECKING:
    from scaffold.model.package import Package


class Located(Protocol):
    """Anything that has a location: an element, a command, or a location itself."""

    @property
    def location(self) -> Location:
        """The place."""


class Report:
    """An expected diagnostic of an example, as shown to users.

    ``"line:column: message"`` is the short form of one without a fix, with the usual severity.

    Args:
        at: The place, ``path:line:column``, or ``line:column`` in the only file of the example.
        message: The message.
        fix: The title of a safe fix.
        unsafe_fix: The title of a fix that ``--unsafe-fixes`` applies.
        severity: The severity where it is not the usual one of the rule.
    """

    def __init__(
        self,
        at: str,
        message: str,
        *,
        fix: str | None = None,
        unsafe_fix: str | None = None,
        severity: Severity | None = None,
    ) -> None:
        self.at = at
        self.message = message
        self.fix = fix
        self.unsafe_fix = unsafe_fix
        self.severity = severity

    @classmethod
    def parse(cls, text: str) -> Report:
        """Parse the short form of a report."""
        at, _, message = text.partition(": ")
        return cls(at, message)

    def within(self, files: Iterable[str]) -> Report:
        """Return it with a path, by default that of the only file."""
        if self.at.count(":") > 1:
            return self
        (path,) = files
        fixes = {"fix": self.fix, "unsafe_fix": self.unsafe_fix}
        return Report(f"{path}:{self.at}", self.message, **fixes, severity=self.severity)

    @property
    def path(self) -> str:
        """The file of the diagnostic."""
        return self.at.rsplit(":", 2)[0]

    @property
    def line(self) -> int:
        """The line, from 1."""
        return int(self.at.rsplit(":", 2)[1])


class Example:
    """A package and what a rule reports about it: a test and a part of the documentation.

    Args:
        title: What it shows.
        files: Text by path; a path ending in ``/`` is an empty directory.
        reports: The diagnostics in reading order; none for an accepted package.
        fixed: The files that the fixes change or add; ``None`` when there is no fix.
        executable: The files with an executable bit.
        neighbors: Other packages of the workspace: files by path, by package directory.
        rosdep_keys: The rosdep keys; ``None`` for a machine without a cache.
        distro: The distribution that the package is checked for.
        moved_from: The source distribution of a migration; empty otherwise.
    """

    def __init__(
        self,
        title: str,
        files: Mapping[str, str],
        *reports: Report | str,
        fixed: Mapping[str, str] | None = None,
        executable: tuple[str, ...] = (),
        neighbors: Mapping[str, Mapping[str, str]] | None = None,
        rosdep_keys: tuple[str, ...] | None = None,
        distro: str = distributions.DEFAULT,
        moved_from: str = "",
    ) -> None:
        self.title = title
        self.files = files
        self._reports = reports
        self.fixed = fixed
        self.executable = executable
        self.neighbors = neighbors or {}
        self.rosdep_keys = rosdep_keys
        self.distro = distro
        self.moved_from = moved_from

    def targeting(self) -> AbstractContextManager[None]:
        """Return the context manager that sets the target."""
        origin = distributions.named(self.moved_from) if self.moved_from else None
        return distributions.targeting(distributions.named(self.distro), origin)

    @property
    def reports(self) -> tuple[Report, ...]:
        """The reports, each with a path."""
        reports = (Report.parse(item) if isinstance(item, str) else item for item in self._reports)
        return tuple(report.within(self.files) for report in reports)


_EFFECTS = {
    **dict.fromkeys(("BR", "MS", "PF", "TY"), Effect.INFERRED),
    "CM": Effect.SPOILS_INSTALL,
    **dict.fromkeys(("IM", "LF", "SP", "UR"), Effect.STOPS_START),
    **dict.fromkeys(("LY", "NM", "PX", "TS"), Effect.DECLARED_WRONG),
    "LY02": Effect.UNPUBLISHABLE,
    **dict.fromkeys(("CM07", "CM08"), Effect.STYLE),
    **dict.fromkeys(("PX06", "PX07"), Effect.STOPS_BUILD),
}
"""The usual effects of flaws by area, if not that a program stops at some point."""


class Rule:
    """A rule; its docstring says what the flaw is, **Why.**, **Fix.** and **Source.**."""

    code: ClassVar[str]
    """Two letters of the area and three digits."""
    name: ClassVar[str]
    """The name of the flaw; the file has the same name with underscores."""
    severity: ClassVar[Severity] = Severity.ERROR
    other_severities: ClassVar[Mapping[Severity, str]] = {}
    """Severities that a diagnostic may have instead, each with the condition for it."""
    effect: ClassVar[Effect | None] = None
    """The effect of the flaw, if it is not that of most flaws of the area: see ``usual_effect``."""
    release_refused: ClassVar[str] = ""
    """Why this flaw blocks a release, so that it is an error with `check --release`."""
    is_fixed_for_all: ClassVar[bool] = False
    """Whether fixed code also runs on earlier distributions, which need no fix."""
    is_deprecation: ClassVar[bool] = False
    """Whether its findings, unless errors, are about deprecations: see ``migrate``."""
    is_removal: ClassVar[bool] = False
    """Whether its findings, including warnings, are about removals: see ``migrate``."""
    is_about_moves: ClassVar[bool] = False
    """Whether it only reports in ``migrate``, so that a suppression may be unused elsewhere."""
    since: ClassVar[str] = "0.1"
    """The version of ros2-scaffold that introduced it."""
    examples: ClassVar[tuple[Example, ...]]

    @classmethod
    def usual_effect(cls) -> Effect:
        """Return the effect of the flaw, which determines its position on the screen."""
        if cls.effect is not None:
            return cls.effect
        of_area = _EFFECTS.get(cls.code[:2], Effect.STOPS_PROGRAM)
        return _EFFECTS.get(cls.code[:4], of_area)

    @classmethod
    def fix_safety(cls) -> Safety | None:
        """Return the safety of the fixes of the rule, derived from its examples."""
        reports = [report for example in cls.examples for report in example.reports]
        if any(report.fix is not None for report in reports):
            return Safety.SAFE
        if any(report.unsafe_fix is not None for report in reports):
            return Safety.UNSAFE
        return None

    def check(self, package: Package) -> Iterator[Diagnostic]:
        """Yield the findings; a missing view ends the check silently."""
        raise NotImplementedError

    def report(
        self,
        at: Located,
        message: str,
        fix: Fix | None = None,
        *,
        severity: Severity | None = None,
        cause: str = "",
        effect: Effect | None = None,
    ) -> Diagnostic:
        """Return a diagnostic of this rule.

        Args:
            at: An object whose location is that of the diagnostic.
            message: What is wrong, what happens, what to do.
            fix: The automatic fix.
            severity: One of ``other_severities``, instead of the usual one.
            cause: Shared by findings with the same cause, also of other rules, which are shown as
                one. Findings with the same message need none.
            effect: The effect, if it is not that of most findings of this rule.
        """
        severity = severity or self.severity
        place = at.location
        return Diagnostic(self.code, self.name, severity, place, message, fix, cause, effect=effect)
