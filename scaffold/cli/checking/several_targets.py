"""``check`` for several distributions: one check for each, one report."""

from __future__ import annotations

from typing import TYPE_CHECKING

from scaffold import distributions
from scaffold.cli import terminal
from scaffold.cli.checking import baselines, fixing, outcome
from scaffold.cli.checking.since import Since
from scaffold.cli.packages import (
    common_directory,
    find_targets,
    foreign_note,
    note_unfinished,
)

if TYPE_CHECKING:
    import argparse
    from collections.abc import Mapping, Sequence

    from scaffold.check.cache.runs import RunEntry
    from scaffold.check.result import Result
    from scaffold.check.several import AgreedSession
    from scaffold.configuration.config import Config
    from scaffold.distributions import Distribution
    from scaffold.files.disk import Disk
    from scaffold.model.discovery.targets import Target

    ByDistribution = dict[Distribution, list[Result]]

ONE_AT_A_TIME = ("add_noqa", "reference")
"""The flags that work for one distribution only."""


class SeveralTargets:
    """A check for several distributions.

    Args:
        options: The flags of `check`.
        session: The rules.
        settings: The configuration.
        disk: Records accesses outside of the packages.
        by_record: The targets of packages by directory; all targets for others.
    """

    def __init__(
        self,
        options: argparse.Namespace,
        session: AgreedSession,
        settings: Config,
        disk: Disk,
        by_record: Mapping[str, Sequence[Distribution]],
    ) -> None:
        self._options = options
        self._session = session
        self._settings = settings
        self._disk = disk
        self._notes = options.notes
        self._by_record = by_record
        self._is_mixed = len({tuple(named) for named in by_record.values() if named}) > 1
        self._targets: Sequence[Target] = ()
        self._runs: list[RunEntry] = []

    def run(self) -> int:
        """Check, or fix; return the exit code."""
        from scaffold.errors import InputError

        for flag in ONE_AT_A_TIME:
            if getattr(self._options, flag):
                name = f"--{flag.replace('_', '-')}"
                raise InputError(
                    f"{name} works for one distribution at a time; select it with --distro"
                )
        if self._options.stdin_filename:
            return self._run_unsaved()
        if self._is_mixed and (self._options.fix or self._options.diff):
            titles = distributions.titles(self._options.distributions)
            raise InputError(
                f"the packages are for {titles}, which differ between them: fix the packages of "
                "each distribution separately, by their paths"
            )
        if self._options.fix or self._options.diff:
            return self._fix()
        return self._report(self._checked(), is_saved=True)

    def _run_unsaved(self) -> int:
        """Check or fix standard input; with fixes, standard output gets only the fixed text."""
        from scaffold.check.several import agreed, merged
        from scaffold.cli import reports
        from scaffold.cli.checking import standard_input

        options, session = self._options, self._session
        path = options.stdin_filename
        text = standard_input.read(path, self._disk)
        by_distribution = self._checked_unsaved(text)
        if options.fix:
            *others, latest = options.distributions
            session.agreed = agreed(by_distribution)
            with distributions.targeting(latest, kept=others):
                target = standard_input.target_of(text, path, self._disk, options.policy)
                text, _ = standard_input.fix(session, target, unsafe=options.unsafe_fixes)
            session.agreed = None
            by_distribution = self._checked_unsaved(text)
        results = merged(by_distribution, session.codes_fixed_for_all)
        results = baselines.hide(options, results, self._targets, session)
        if options.fix:
            terminal.write_error(reports.text(results, outcome.report_options(options)))
        else:
            outcome.note_unchecked(session)
            reports.write(options, results, outcome.report_options(options))
        return outcome.final_code(options, session, results)

    def _checked_unsaved(self, text: bytes) -> ByDistribution:
        from scaffold.cli.checking import standard_input

        options = self._options
        by_distribution: ByDistribution = {}
        for distribution in options.distributions:
            others = [item for item in options.distributions if item is not distribution]
            with distributions.targeting(distribution, kept=others):
                target = standard_input.target_of(
                    text, options.stdin_filename, self._disk, options.policy
                )
                by_distribution[distribution] = self._session.run_batch([target])
            self._targets = [target]
        return by_distribution

    def _fix(self) -> int:
        """Apply fixes valid for all of them, and report the remaining findings for each."""
        from scaffold.check.several import agreed
        from scaffold.cli.exit_codes import CLEAN, FINDINGS, USAGE_ERROR

        options, session = self._options, self._session
        *others, latest = options.distributions
        session.agreed = agreed(self._checked())
        with distributions.targeting(latest, kept=others):
            targets = find_targets(options, session, None)
            written, has_failed = fixing.write(
                options, session, targets, lambda: find_targets(options, session, None)
            )
        session.agreed = None
        count = sum(item.applied for item in written)
        if options.diff:
            terminal.say(f"{fixing.fix_count(count)}, nothing written")
            left = [
                (item.package, diagnostic) for item in written for diagnostic in item.diagnostics
            ]
            code = FINDINGS if fixing.note_unexamined(left) or count else CLEAN
            return USAGE_ERROR if has_failed else code
        terminal.say(f"{fixing.fix_count(count)} applied")
        code = self._report(self._checked(), is_saved=False)
        return USAGE_ERROR if has_failed else code

    def _checked(self) -> ByDistribution:
        """Check for each distribution, using cached results."""
        from scaffold.check.cache.results import ResultCache
        from scaffold.cli.interactive import progress

        options, session = self._options, self._session
        by_distribution: ByDistribution = {}
        self._runs, every = [], []
        directory = common_directory(options.paths, self._disk)
        since_notes: dict[Distribution, str] = {}
        for distribution in options.distributions:
            options.notes = self._notes
            others = [item for item in options.distributions if item is not distribution]
            with distributions.targeting(distribution, kept=others):
                self._targets = [
                    target
                    for target in find_targets(options, session, self._disk)
                    if distribution in self._by_record.get(target.package.directory, [distribution])
                ]
                change = None
                if options.since:
                    change = Since(directory, options.since, self._targets)
                    self._targets = change.targets()
                every += self._targets
                entry = None if change else self._entry(distribution)
                memory = ResultCache(
                    entry.last if entry else None, self._targets, is_saved=entry is not None
                )
                results = list(progress.shown(memory.run(session), len(self._targets), "packages"))
                if change is not None:
                    results, since_notes[distribution] = change.limit(results, session)
                by_distribution[distribution] = results
                if entry and not session.types_failure and memory.save(entry, self._disk, results):
                    self._runs.append(entry)
            options.notes += foreign_note(session, results)
            outcome.note_unchecked(session)
        options.notes += _since_notes(since_notes)
        self._targets = [*{target.package.directory: target for target in every}.values()]
        return by_distribution

    def _report(self, by_distribution: ByDistribution, *, is_saved: bool) -> int:
        from scaffold.check.several import merged
        from scaffold.cli import reports

        options, session = self._options, self._session
        results = merged(by_distribution, session.codes_fixed_for_all)
        if options.write_baseline:
            return baselines.write(options, results)
        reported = baselines.hide(options, results, self._targets, session)
        output = reports.write(options, reported, outcome.report_options(options))
        code = outcome.final_code(options, session, reported)
        if is_saved and len(self._runs) == len(options.distributions):
            outcome.save_report(options, self._runs, code, output, self._settings)
        return code

    def _entry(self, distribution: Distribution) -> RunEntry | None:
        """Return the cache entry for the findings for one distribution, if any."""
        options = self._options
        is_unfinished = note_unfinished(self._targets)
        if self._settings.content or is_unfinished or options.write_baseline or self._is_mixed:
            return None
        if options.cluster is not None or options.refused:
            return None
        return outcome.run_entry(options, self._targets, distribution)


def _since_notes(by_distribution: Mapping[Distribution, str]) -> tuple[str, ...]:
    """Return the notes on the change, merged if they are the same for all."""
    if len({*by_distribution.values()}) < len(by_distribution):
        return (*dict.fromkeys(by_distribution.values()),)
    return tuple(f"{distribution.title}: {note}" for distribution, note in by_distribution.items())
