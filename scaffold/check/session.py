"""One run of `check`: style in the background, rules, suppression, in reading order."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING

from scaffold.check import runner, suppression
from scaffold.check.ament_rules import AMENT_RULES
from scaffold.check.engine_rules import (
    INTERNAL_RULES,
    FileTooLarge,
    RuleCrashed,
    TooManyFindings,
    UnparsableFile,
)
from scaffold.check.rule import Rule
from scaffold.check.selection import Selection
from scaffold.diagnostic import MOST_FINDINGS, Diagnostic, Severity
from scaffold.model.discovery.targets import Target
from scaffold.model.package import Package
from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from scaffold.ament import StyleCheck


PARALLEL_FROM = 8
"""Packages from which on worker processes cost less than they save."""


class Result(NamedTuple):
    """What was found in one package."""

    package: Package
    files: int
    diagnostics: list[Diagnostic]


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


def _do_nothing() -> None:
    pass


class Session:
    """Rules and a selection, ready to run over packages."""

    def __init__(self, rules: Sequence[type[Rule]], selection: Selection) -> None:
        self.selection = selection
        self._areas = {rule.code[:2] for rule in all_rules(rules)}
        wanted = [*rules, *AMENT_RULES]
        self._rules = [rule() for rule in wanted if selection.wants(rule.code)]
        self._ran = {rule.code for rule in self._rules}
        self.after_rule: Callable[[], None] = _do_nothing
        """Called after each rule that ran over a package, for who shows how far it is."""

    def run(self, targets: Sequence[Target]) -> Iterator[Result]:
        """Check packages, several at a time where that pays; yield in the order given."""
        if len(targets) < PARALLEL_FROM:
            yield from self.run_batch(targets)
            return
        from scaffold.check.parallel import batches

        yield from batches(self.run_batch, targets)

    def run_batch(self, targets: Sequence[Target], style: StyleCheck | None = None) -> list[Result]:
        """Check packages in this process, with one start of the style backend for all.

        Args:
            targets: The packages.
            style: The style backend, where it has been started for them.
        """
        style = style or self._start_style([target.package for target in targets])
        results: list[Result] = []
        for target in targets:
            found = self._check_rules(target.package)
            found += style.diagnostics(target.package) if style else []
            result = Result(target.package, len(target.package.files), self._report(target, found))
            results.append(result)
            _ = target.package.identity  # while the manifest is at hand
            target.package.forget()
        return results

    def check(self, package: Package, style: StyleCheck | None = None) -> list[Diagnostic]:
        """Check one package, for instance one in memory; see `run_batch`."""
        (result,) = self.run_batch([Target(package)], style)
        return result.diagnostics

    def check_style(self, target: Target) -> list[Diagnostic]:
        """Check the style of one package only; see `check`."""
        style = self._start_style([target.package])
        if style is None:
            return []
        result = self._report(target, style.diagnostics(target.package))
        target.package.forget()
        return result

    @property
    def rule_count(self) -> int:
        """How many rules run over a package."""
        return len(self._rules)

    def _counted_rules(self) -> Iterator[Rule]:
        for rule in self._rules:
            yield rule
            self.after_rule()

    def _start_style(self, packages: Sequence[Package]) -> StyleCheck | None:
        chosen = self.selection.select
        if chosen and all(prefix[:2] in self._areas for prefix in chosen):
            return None
        from scaffold.ament import StyleCheck

        return StyleCheck(packages)

    def _check_rules(self, package: Package) -> list[Diagnostic]:
        if package.parse_errors:
            # They were met for other packages: the verdict must not depend on who came first.
            package.forget()
            _ = package.name  # which everybody asks for: a malformed manifest is told of
        said = runner.check(package, self._counted_rules())
        return suppression.apply(package, said, self._ran)

    def _report(self, target: Target, found: list[Diagnostic]) -> list[Diagnostic]:
        """Return what is asked for, in reading order, each thing once."""
        # flake8 has its own code for a Python file that does not parse.
        told = {d.location.path for d in found if d.code.startswith("E9")}
        unreadable = (UnparsableFile.code, FileTooLarge.code)
        return sorted(
            (
                d
                for d in _bounded([*dict.fromkeys(found)])
                if not (d.code in unreadable and d.location.path in told)
                and (target.only is None or d.location.path in target.only)
                and (d.code == RuleCrashed.code or self.selection.wants(d.code))
                and self.selection.wants_at(d.code, d.location.path)
            ),
            key=lambda d: d.sort_key,
        )


def _bounded(found: list[Diagnostic]) -> list[Diagnostic]:
    """Leave out what one code says too often, and say so."""
    if len(found) <= MOST_FINDINGS:
        return found
    counts: dict[str, int] = {}
    kept: list[Diagnostic] = []
    for one in found:
        counts[one.code] = count = counts.get(one.code, 0) + 1
        if count <= MOST_FINDINGS:
            kept.append(one)
        elif count == MOST_FINDINGS + 1:
            said = f"{one.code} is found more than {MOST_FINDINGS} times"
            kept.append(TooManyFindings().report(one.location, f"{said}; the rest is not shown"))
    return kept


def all_rules(rules: Sequence[type[Rule]]) -> list[type[Rule]]:
    """Return rules of content directories, of ament's linters and of the engine, by code."""
    return sorted([*rules, *AMENT_RULES, *INTERNAL_RULES], key=lambda rule: rule.code)
