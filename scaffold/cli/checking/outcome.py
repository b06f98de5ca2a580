"""The end of a run of `check`: notes, report, cache entry, exit code."""

from __future__ import annotations

from typing import TYPE_CHECKING

from scaffold.cli import terminal
from scaffold.cli.checking.check_flags import OF_REPORT

if TYPE_CHECKING:
    import argparse
    from collections.abc import Sequence

    from scaffold.check.cache.runs import ReportEntry, RunEntry
    from scaffold.check.result import Result
    from scaffold.check.session import Session
    from scaffold.configuration.config import Config
    from scaffold.distributions import Distribution
    from scaffold.model.discovery.targets import Target
    from scaffold.reporters import ReportOptions


def report_options(options: argparse.Namespace) -> ReportOptions:
    """Return the report options given by the flags."""
    from scaffold.diagnostic import Severity
    from scaffold.reporters import ReportOptions

    return ReportOptions(
        unsafe=options.unsafe_fixes,
        severity=Severity(options.severity),
        everything=options.all,
        style=options.style or options.all,
        source=options.show_source,
        statistics=options.statistics,
        quiet=options.quiet,
        notes=options.notes,
        distributions=tuple(options.distributions),
    )


def run_entry(
    options: argparse.Namespace, targets: Sequence[Target], distribution: Distribution
) -> RunEntry | None:
    """Return the cache entry for the findings for a distribution, if any."""
    entry: ReportEntry | None = options.entry
    if entry is None:
        return None
    kept_out = {"command_line", "distributions", "distro", "entry", "notes", "paths"}
    kept_out |= {"whole_packages", *OF_REPORT}
    flags = sorted((name, value) for name, value in vars(options).items() if name not in kept_out)
    asked = [(target.package.directory, sorted(target.only or ())) for target in targets]
    names = [item.name for item in options.distributions]
    return entry.run([distribution.name, *names, repr((flags, asked))])


def save_report(
    options: argparse.Namespace,
    runs: Sequence[RunEntry],
    code: int,
    output: str | None,
    settings: Config,
) -> None:
    """Cache a report, unless it was written to a file or depends on the commit."""
    from scaffold.cli import reports

    if output is not None and not options.whole_packages:
        notes = reports.separate_notes(options, report_options(options))
        options.entry.save(runs, code, output, settings.warnings, notes)


def note_unchecked(session: Session) -> None:
    """Note what was not checked, and why: types, or packages."""
    from scaffold.reporters.summary import count

    for reason, packages in session.unchecked.items():
        names = sorted({*packages})  # once for all distributions
        terminal.error(f"{count(len(names), 'package')} not checked: {reason}: {', '.join(names)}")
    if session.types_failure:
        failure = session.types_failure
        terminal.error(f"types are not checked: {failure}; --no-types skips them")


def final_code(options: argparse.Namespace, session: Session, results: list[Result]) -> int:
    """Return the exit code; packages that could not be checked decide it."""
    from scaffold.cli.exit_codes import INTERNAL_ERROR, USAGE_ERROR

    code = _exit_code(results, is_zero=options.exit_zero)
    is_partial = session.types_failure or session.unchecked or options.refused
    return USAGE_ERROR if is_partial and code != INTERNAL_ERROR else code


def _exit_code(results: list[Result], *, is_zero: bool = False) -> int:
    """Return 0 if there is only advice, 1 if there are findings, 3 if a rule crashed.

    Args:
        results: Of all packages.
        is_zero: Whether findings are ignored for the exit code.
    """
    from scaffold.check.rules.engine_rules import RuleCrashed
    from scaffold.cli.exit_codes import CLEAN, FINDINGS, INTERNAL_ERROR
    from scaffold.diagnostic import Severity

    diagnostics = [diagnostic for result in results for diagnostic in result.diagnostics]
    if any(diagnostic.code == RuleCrashed.code for diagnostic in diagnostics):
        return INTERNAL_ERROR
    has_findings = any(item.severity is not Severity.INFO for item in diagnostics)
    return FINDINGS if has_findings and not is_zero else CLEAN
