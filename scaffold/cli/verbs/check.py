"""``ros2-scaffold check [PATHS]``."""

from __future__ import annotations

import argparse
import os
from typing import TYPE_CHECKING, TypeVar

from scaffold import distributions
from scaffold.cli import distro, terminal
from scaffold.cli.checking import baselines, outcome, since
from scaffold.cli.checking.check_flags import add_arguments
from scaffold.cli.packages import (
    common_directory,
    find_targets,
    foreign_note,
    note_unfinished,
)

if TYPE_CHECKING:
    from collections.abc import Sequence

    from scaffold.check.fixes.fixer import Fixed
    from scaffold.check.result import Result
    from scaffold.check.rules.rule import Rule
    from scaffold.check.session import Session
    from scaffold.cli.choices import Choices
    from scaffold.configuration.config import Config
    from scaffold.distributions import Distribution
    from scaffold.files.disk import Disk
    from scaffold.model.discovery.targets import Target

    _Kind = TypeVar("_Kind", bound=Session)

__all__ = ["add_arguments", "run"]


def run(options: argparse.Namespace) -> int:
    """Check packages; return the exit code."""
    from scaffold.check.rules import registry
    from scaffold.cli import reports, stated_distro
    from scaffold.cli.checking import standard_input
    from scaffold.cli.choices import Choices
    from scaffold.cli.settings import validate_answers, warn
    from scaffold.configuration import config, content
    from scaffold.files.disk import Disk

    options.notes = ()
    reports.validate(options)
    is_unsaved = standard_input.validate(options)
    disk = Disk()
    baselines.validate(options, disk)
    since.validate(options)
    _validate_noqa(options)
    _validate_cluster(options)
    directory = common_directory([options.stdin_filename] if is_unsaved else options.paths, disk)
    settings = config.load(directory, tuple(options.content), disk)
    warn(settings.warnings)
    validate_answers(settings, of_user=False)
    rules = registry.load(content.roots("rules", settings.content))
    choices = Choices(settings, rules)
    options.policy = choices.policy()
    session = _session(options, rules, choices, _kind_of_session(options))
    if options.cluster is not None:
        _give_settings(session, options, choices, settings)
    wanted = distro.wanted(options.distro, settings)
    options.refused = frozenset()
    by_record, targets = ({}, None) if wanted else _recorded(options, session, disk)
    named = wanted or [item for items in by_record.values() for item in items]
    options.distributions = distributions.ordered(named or [distributions.JAZZY])
    left_out = () if targets is None else options.notes
    noted = distro.note(options.distributions)
    if not (named or noted or is_unsaved):
        noted = stated_distro.note(directory, options.distributions, disk)
    options.notes = (*noted, *left_out)
    if len(options.distributions) > 1:
        from scaffold.check.several import AgreedSession
        from scaffold.cli.checking.several_targets import SeveralTargets

        agreeing = (
            session
            if isinstance(session, AgreedSession)
            else _session(options, rules, choices, AgreedSession)
        )
        return SeveralTargets(options, agreeing, settings, disk, by_record).run()
    with distributions.targeting(options.distributions[0]):
        return _run(options, session, settings, disk, directory, targets)


def _recorded(
    options: argparse.Namespace, session: Session, disk: Disk
) -> tuple[dict[str, Sequence[Distribution]], list[Target] | None]:
    """Return the distributions of packages by directory; empty if all have the default.

    The packages are returned as well, since they were searched for the default. Those whose
    record names an unknown or no longer supported distribution are noted and skipped.

    Raises:
        InputError: these are all packages.
    """
    from scaffold.errors import InputError
    from scaffold.model.discovery import colcon

    targets = None
    if options.stdin_filename:
        around = colcon.package_around(disk, os.path.dirname(disk.real(options.stdin_filename)))
        directories = [around] if around is not None else []
    else:
        targets = find_targets(options, session, disk)
        directories = [target.package.directory for target in targets]
    default = [distributions.JAZZY]
    by_record: dict[str, Sequence[Distribution]] = {}
    refused: dict[str, InputError] = {}
    for directory in directories:
        try:
            by_record[directory] = distro.recorded(directory, disk, is_needed=True) or default
        except InputError as error:
            refused[directory] = error
    if refused and not by_record:
        raise next(iter(refused.values()))
    for reason in refused.values():
        terminal.error(f"not checked: {reason}")
    options.refused = frozenset(refused)
    if all(named == default for named in by_record.values()):
        return {}, targets
    return {**by_record, **dict.fromkeys(refused, ())}, None


def _run(
    options: argparse.Namespace,
    session: Session,
    settings: Config,
    disk: Disk,
    directory: str,
    targets: list[Target] | None,
) -> int:
    """Check, or fix, for the target; return the exit code."""
    from scaffold.check.cache.results import ResultCache
    from scaffold.cli import reports
    from scaffold.cli.interactive import progress

    if options.stdin_filename:
        return _check_unsaved(options, session, disk)
    targets = find_targets(options, session, disk) if targets is None else targets
    targets = [target for target in targets if target.package.directory not in options.refused]
    if options.fix or options.diff or options.add_noqa:
        return _fix(options, session, targets)
    if options.reference:
        return _reference(targets)
    is_unfinished = note_unfinished(targets)
    # User rules may access anything, and notes must appear in every run.
    is_forgotten = settings.content or is_unfinished or options.write_baseline or options.since
    is_forgotten = is_forgotten or options.cluster is not None or options.refused
    entry = None if is_forgotten else outcome.run_entry(options, targets, options.distributions[0])
    change = since.Since(directory, options.since, targets) if options.since else None
    targets = change.targets() if change else targets
    memory = ResultCache(entry.last if entry else None, targets, is_saved=entry is not None)
    results = list(progress.shown(memory.run(session), len(targets), "packages"))
    options.notes += foreign_note(session, results)
    outcome.note_unchecked(session)
    if options.write_baseline:
        return baselines.write(options, results)
    if change:
        results, note = change.limit(results, session)
        options.notes += (note,)
    reported = baselines.hide(options, results, targets, session)
    output = reports.write(options, reported, outcome.report_options(options))
    code = outcome.final_code(options, session, reported)
    if entry and not session.types_failure and memory.save(entry, disk, results):
        outcome.save_report(options, [entry], code, output, settings)
    return code


def _kind_of_session(options: argparse.Namespace) -> type[Session]:
    from scaffold.check.session import Session

    if options.add_noqa:
        from scaffold.check.fixes.noqa import SuppressingSession

        return SuppressingSession
    if options.cluster is not None:
        from scaffold.check.cluster.on_cluster import ClusterSession

        return ClusterSession
    return Session


def _session(
    options: argparse.Namespace, rules: list[type[Rule]], choices: Choices, kind: type[_Kind]
) -> _Kind:
    selection = choices.selection(options.select, options.ignore)
    return kind(
        rules,
        selection,
        choices.adjustments(is_release=options.release, include_all=options.include_all),
        has_types=not options.no_types,
        is_reference=options.reference_config,
        line_length=choices.line_length,
    )


def _validate_noqa(options: argparse.Namespace) -> None:
    from scaffold.errors import InputError

    for flag in ("fix", "reference", "stdin_filename", "since", "baseline", "write_baseline"):
        if options.add_noqa and getattr(options, flag):
            raise InputError(f"--add-noqa only adds comments: omit --{flag.replace('_', '-')}")


def _validate_cluster(options: argparse.Namespace) -> None:
    from scaffold.errors import InputError

    local = ("fix", "diff", "add_noqa", "reference", "stdin_filename", "since", "content")
    for flag in local if options.cluster is not None else ():
        if getattr(options, flag):
            raise InputError(f"--{flag.replace('_', '-')} cannot be combined with --cluster")


def _give_settings(
    session: Session, options: argparse.Namespace, choices: Choices, config: Config
) -> None:
    """Give a session the settings for the sessions of cluster workers."""
    from scaffold.check.cluster.batch import Settings
    from scaffold.check.cluster.on_cluster import ClusterSession
    from scaffold.errors import InputError

    if config.content:
        raise InputError(
            f"{config.directories[0].origin}: 'content' cannot be combined with --cluster: "
            "workers only have the built-in rules"
        )
    if isinstance(session, ClusterSession):
        session.address = options.cluster
        session.tell = terminal.note
        session.settings = Settings(
            session.selection,
            session.adjustments,
            has_types=not options.no_types,
            is_reference=options.reference_config,
            line_length=choices.line_length,
            paths=(*options.paths,),
            whole_packages=options.whole_packages,
            policy=options.policy,
        )


def _check_unsaved(options: argparse.Namespace, session: Session, disk: Disk) -> int:
    """Check or fix standard input; with fixes, standard output gets only the fixed text."""
    from scaffold.cli import reports
    from scaffold.cli.checking import standard_input

    path = options.stdin_filename
    text = standard_input.read(path, disk)
    target = standard_input.target_of(text, path, disk, options.policy)
    if options.fix:
        _, result = standard_input.fix(session, target, unsafe=options.unsafe_fixes)
        (result,) = baselines.hide(options, [result], [target], session)
        terminal.write_error(reports.text([result], outcome.report_options(options)))
    else:
        (result,) = baselines.hide(options, session.run_batch([target]), [target], session)
        outcome.note_unchecked(session)
        reports.write(options, [result], outcome.report_options(options))
    return outcome.final_code(options, session, [result])


def _fix(options: argparse.Namespace, session: Session, targets: Sequence[Target]) -> int:
    """Fix, or show the patch; report the remaining findings."""
    from scaffold.check.result import Result
    from scaffold.cli.checking import fixing
    from scaffold.cli.exit_codes import USAGE_ERROR
    from scaffold.model.discovery.targets import Target

    def find_again() -> list[Target]:
        targets = find_targets(options, session, None)
        return [item for item in targets if item.package.directory not in options.refused]

    written, has_failed = fixing.write(options, session, targets, find_again)
    if has_failed and not written:
        return USAGE_ERROR  # the errors say why nothing was fixed, and nothing was checked
    results = [Result(item.package, len(item.package.files), item.diagnostics) for item in written]
    limits = {target.package.directory: target.only for target in targets}
    checked = [Target(result.package, limits.get(result.package.directory)) for result in results]
    results = baselines.hide(options, results, checked, session)
    outcome.note_unchecked(session)
    code = _report_fixes(options, session, results, written)
    return USAGE_ERROR if has_failed else code


def _report_fixes(
    options: argparse.Namespace,
    session: Session,
    results: list[Result],
    fixed: Sequence[Fixed],
) -> int:
    from scaffold.cli import reports
    from scaffold.cli.checking import fixing
    from scaffold.cli.exit_codes import CLEAN, FINDINGS

    count = sum(item.applied for item in fixed)
    done = _comments(count) if options.add_noqa else f"{fixing.fix_count(count)} applied"
    terminal.say(f"{fixing.fix_count(count)}, nothing written" if options.diff else done)
    unsettled = sorted({code for item in fixed for code in item.unsettled})
    if unsettled:
        terminal.note(f"the fixes of {', '.join(unsettled)} do not converge; fix these by hand")
    if options.diff:
        left = [(result.package, item) for result in results for item in result.diagnostics]
        return FINDINGS if fixing.note_unexamined(left) or count else CLEAN
    reports.write(options, results, outcome.report_options(options))
    return outcome.final_code(options, session, results)


def _reference(targets: Sequence[Target]) -> int:
    """Compare the docstring rules with pydocstyle; each difference is a defect of this tool."""
    from scaffold.ament.pep257 import reference
    from scaffold.cli.exit_codes import CLEAN, INTERNAL_ERROR
    from scaffold.reporters.paths import shown

    count = 0
    for package, difference in reference.differences([target.package for target in targets]):
        count += 1
        place = f"{shown(package, difference.path)}:{difference.line}"
        terminal.show(f"{place}: {difference.message}")
    terminal.show(f"{count or 'no'} differences from pydocstyle")
    return INTERNAL_ERROR if count else CLEAN


def _comments(count: int) -> str:
    return f"noqa added to {'1 line' if count == 1 else f'{count} lines'}"
