"""``ros2-scaffold migrate [PATHS] --to NAME``."""

from __future__ import annotations

import argparse
from contextlib import ExitStack
from typing import TYPE_CHECKING

from scaffold import distributions
from scaffold.cli import distro, terminal

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from scaffold.check.fixes.fixer import Fixed
    from scaffold.cli.choices import Choices
    from scaffold.cli.migrating.moves import Moved, Mover
    from scaffold.configuration.config import Config
    from scaffold.distributions import Distribution

_ADVICE = "use --to for the distribution to migrate to, and --keep for those that must keep working"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Define the flags of the verb."""
    parser.add_argument(
        "paths",
        nargs="*",
        default=["."],
        metavar="PATH",
        help="packages or workspaces (default: the current directory)",
    )
    parser.add_argument(
        "--to", required=True, metavar="NAME", help="the distribution to migrate the packages to"
    )
    parser.add_argument(
        "--from",
        dest="origin",
        metavar="NAME",
        help=f"the distribution to migrate them from (default: {distro.KEY} of the configuration, "
        "else what "
        f"`new --distro` created them for, else {distributions.DEFAULT})",
    )
    parser.add_argument(
        "--keep",
        action="append",
        metavar="NAMES",
        help="distributions that must keep working, separated by commas: fixes use only what all "
        "of them have",
    )
    parser.add_argument(
        "--fix",
        action="store_true",
        help="apply safe fixes and report what is left; the new distribution is recorded in a "
        "package once nothing in it breaks or changes silently and all files can be read",
    )
    parser.add_argument(
        "--unsafe-fixes",
        action="store_true",
        help="also apply fixes that need review, such as links to packages that may export no "
        "targets",
    )
    parser.add_argument("--diff", action="store_true", help="show what --fix would change")
    parser.add_argument("--format", choices=("text", "json"), default="text", help="output format")


def run(options: argparse.Namespace) -> int:
    """Report what a move changes, and fix what is safe; return the exit code."""
    from scaffold.check.rules import registry
    from scaffold.cli.choices import Choices
    from scaffold.cli.exit_codes import CLEAN, FINDINGS, USAGE_ERROR
    from scaffold.cli.migrating import move_report, origins
    from scaffold.cli.migrating.moves import Move, Mover
    from scaffold.cli.packages import common_directory
    from scaffold.cli.settings import warn
    from scaffold.configuration import config, content
    from scaffold.files.disk import Disk

    directory = common_directory(options.paths, Disk())
    settings = config.load(directory, (), Disk())
    warn(settings.warnings)
    choices = Choices(settings, registry.load(content.roots("rules", settings.content)))
    _complete(options, choices)
    target = distributions.named(options.to, "--to", _ADVICE)
    kept = distributions.several(",".join(options.keep), "--keep") if options.keep else []
    mover = Mover(options, choices)
    with ExitStack() as stack:
        directories, has_failed = _locked_directories(stack, options, mover)
        found = origins.find(options.origin, settings, target, kept, directories)
        for note in origins.notes(found, target):
            terminal.note(note)
        moves = [
            mover.move(Move(origin, moving, target, kept))
            for origin, moving in found.directories.items()
        ]
        if options.fix or options.diff:
            targets = distributions.ordered([*kept, target])
            is_refused, is_changed = _write_or_show(options, moves, targets, settings)
            has_failed |= is_refused
            if options.diff:
                is_clean = not _note_unexamined(moves) and not is_changed
                return USAGE_ERROR if has_failed else CLEAN if is_clean else FINDINGS
    items = sorted(
        (item for move in moves for item in move.consequences),
        key=lambda item: directories.index(item.result.package.directory),
    )
    if options.format == "json":
        terminal.show_json(move_report.as_data(items, found, target, kept))
    else:
        lines = move_report.lines(items, found, target, is_unsafe=options.unsafe_fixes)
        terminal.show("\n".join(lines))
    for failure in dict.fromkeys(move.types_failure for move in moves if move.types_failure):
        terminal.error(f"types are not checked: {failure}")
        has_failed = True
    is_done = all(item.is_done for item in items)
    return USAGE_ERROR if has_failed else CLEAN if is_done else FINDINGS


def _locked_directories(
    stack: ExitStack, options: argparse.Namespace, mover: Mover
) -> tuple[list[str], bool]:
    """Return the directories of the packages, locked if they are written to.

    A package that another process is changing is skipped; then the second value is true.

    Raises:
        InputError: there is none.
    """
    from scaffold.cli import writing
    from scaffold.cli.packages import find_targets
    from scaffold.errors import InputError

    packages = [item.package for item in find_targets(options, mover.session(is_back=False), None)]
    if not packages:
        raise InputError(_nothing_found(options))
    if not (options.fix or options.diff):
        return [package.directory for package in packages], False
    roots = [package.root for package in packages if package.root is not None]
    held = writing.hold_all(stack, roots, is_dry=options.diff)
    free = [package.directory for package in packages if package.root in held.roots]
    return free, held.has_failed


def _nothing_found(options: argparse.Namespace) -> str:
    """Return why there is no package to move."""
    if options.notes:
        return f"no package to migrate; {'; '.join(options.notes)}"
    return f"{', '.join(options.paths)}: not in a ROS 2 package"


def _write_or_show(
    options: argparse.Namespace,
    moves: Sequence[Moved],
    targets: Sequence[Distribution],
    settings: Config,
) -> tuple[bool, bool]:
    """Write the fixes and the records of packages, or show the patch.

    The record of a package with remaining consequences is kept, so that the next run reports them.

    Args:
        options: The flags.
        moves: The moved packages.
        targets: The new distributions.
        settings: The configuration, which overrides the records.

    Returns:
        Whether a package was rejected, and whether anything changes.
    """
    from scaffold.cli.checking import fixing
    from scaffold.cli.migrating import records
    from scaffold.cli.migrating.records import Recorded
    from scaffold.reporters.summary import count

    fixed = {path: item for move in moves for path, item in move.fixed.items()}
    arrived = [path for move in moves for path in move.arrived]
    before = {path: distro.recorded_names(path) for path in arrived}
    recorded = _with_records(fixed, arrived, targets)
    changes = [(item, None) for item in {**fixed, **recorded}.values() if item.is_change]
    written, is_refused = fixing.put(options, changes)
    done = {item.package.directory for item in written}
    number = sum(item.applied for item in written)
    would = "would be " if options.diff else ""
    text = f"{fixing.fix_count(number)} {would}applied"
    moved = {path: before[path] or () for path in recorded if path in done}
    if moved:
        packages = count(len(moved), "package")
        text += f"; {packages} {would}recorded for {distributions.titles(targets)}"
    terminal.say(text)
    if not options.diff:
        has_others = any(before[path] is None for path in arrived)
        for note in records.notes(Recorded(moved, has_others), targets, settings):
            terminal.note(note)
        _note_held(moves, arrived, targets)
    return is_refused, bool(changes)


def _with_records(
    fixed: Mapping[str, Fixed], arrived: Sequence[str], targets: Sequence[Distribution]
) -> dict[str, Fixed]:
    """Return the packages to write, including changed records, by directory."""
    from scaffold.cli.migrating import records
    from scaffold.writing.transaction import RECORD

    result: dict[str, Fixed] = {}
    for path in arrived:
        planned = records.plan(path, targets) if path in fixed else None
        if planned is not None:
            before = {**fixed[path].before, RECORD: planned[0]}
            changed = {**fixed[path].changed, RECORD: planned[1]}
            result[path] = fixed[path]._replace(before=before, changed=changed)
    return result


def _note_unexamined(moves: Sequence[Moved]) -> bool:
    """Note the files that could not be read; return whether there are any."""
    from scaffold.cli.checking import fixing

    every = [item for move in moves for item in move.consequences]
    return fixing.note_unexamined(
        [(at.result.package, diagnostic) for at in every for diagnostic in at.unexamined]
    )


def _note_held(
    moves: Sequence[Moved], arrived: Sequence[str], targets: Sequence[Distribution]
) -> None:
    """Say which packages are not recorded yet."""
    from scaffold.cli.migrating import records

    every = [item for move in moves for item in move.consequences]
    left = [item for item in every if item.result.package.directory not in arrived]
    note = records.held(
        [item.result.package.directory for item in left],
        targets,
        has_unread=any(item.unexamined for item in left),
    )
    if note:
        terminal.note(note)


def _complete(options: argparse.Namespace, choices: Choices) -> None:
    """Set the flags of `check` that this verb lacks."""
    options.whole_packages = True
    options.policy = choices.policy()
    options.notes = ()
