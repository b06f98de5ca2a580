"""``ros2-scaffold migrate [PATHS] --to NAME``."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from scaffold import distributions
from scaffold.cli import distro, fixing, terminal
from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from scaffold.check.fixes.fixer import Fixed
    from scaffold.check.migration import Consequences, MigratingSession, OrderSession
    from scaffold.check.result import Result
    from scaffold.check.session import Session
    from scaffold.cli.choices import Choices
    from scaffold.cli.origins import Origins
    from scaffold.configuration.config import Config
    from scaffold.diagnostic import Diagnostic
    from scaffold.distributions import Distribution
    from scaffold.model.discovery.targets import Target
    from scaffold.model.package import Package

HEADINGS = ("breaks", "changes silently", "deprecated", "not examined")
COUNTED = ("break", "change silently", "deprecated")
_ADVICE = "name the one to move to, and with --keep those that packages are to run on as well"


class Move(NamedTuple):
    """Packages that move from one distribution to another."""

    origin: Distribution
    directories: Sequence[str]
    target: Distribution
    kept: Sequence[Distribution]


class Moved(NamedTuple):
    """What became of them."""

    consequences: Sequence[Consequences]
    """Of what is left, where nothing is only shown."""
    arrived: Sequence[str]
    """The directories of packages that were written, and where nothing is left."""
    left: Sequence[str]
    """Those of packages where something is left."""
    fixes: int
    types_failure: str
    has_failed: bool


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
        "--to", required=True, metavar="NAME", help="the distribution that the packages move to"
    )
    parser.add_argument(
        "--from",
        dest="origin",
        metavar="NAME",
        help=f"the one that they run on (default: {distro.KEY} of the configuration, else what "
        f"`new --distro` made them for, else {distributions.DEFAULT})",
    )
    parser.add_argument(
        "--keep",
        action="append",
        metavar="NAMES",
        help="distributions that they are to run on as well, separated by commas: fixes write "
        "only what all of them have",
    )
    parser.add_argument(
        "--fix",
        action="store_true",
        help="apply what is safe, and report what is left; a package is recorded for the new "
        "distribution once nothing in it breaks or changes silently, and all of it can be read",
    )
    parser.add_argument(
        "--unsafe-fixes",
        action="store_true",
        help="also apply fixes that may need a look: links to packages that may export no targets",
    )
    parser.add_argument("--diff", action="store_true", help="show what --fix would change")
    parser.add_argument("--format", choices=("text", "json"), default="text", help="output format")


def run(options: argparse.Namespace) -> int:
    """Report what a move changes, and fix what is safe; return the exit code."""
    from scaffold.check import registry
    from scaffold.cli import origins
    from scaffold.cli.choices import Choices
    from scaffold.cli.exit_codes import CLEAN, FINDINGS, USAGE_ERROR
    from scaffold.cli.settings import warn
    from scaffold.cli.verbs import check
    from scaffold.configuration import config, content
    from scaffold.errors import InputError
    from scaffold.files.disk import Disk

    directory = check.common_directory(options.paths, Disk())
    settings = config.load(directory, (), Disk())
    warn(settings.warnings)
    choices = Choices(settings, registry.load(content.roots("rules", settings.content)))
    _complete(options, choices)
    target = distributions.named(options.to, "--to", _ADVICE)
    kept = distributions.several(",".join(options.keep), "--keep") if options.keep else []
    packages = check.find_targets(options, _session(choices, is_back=False), None)
    directories = [item.package.directory for item in packages]
    if not directories:
        raise InputError(_nothing_found(options))
    found = origins.find(options.origin, settings, target, kept, directories)
    for note in origins.notes(found, target):
        terminal.note(note)
    moves = [
        _moved(options, choices, Move(origin, moving, target, kept))
        for origin, moving in found.directories.items()
    ]
    has_failed = any(move.has_failed for move in moves)
    if options.diff or options.fix:
        count = sum(move.fixes for move in moves)
        done = f"{check.fix_count(count)} {'would be applied' if options.diff else 'applied'}"
        if options.diff:
            terminal.say(done)
            return FINDINGS if count else CLEAN
        has_failed |= _record(moves, distributions.ordered([*kept, target]), settings, done)
    items = sorted(
        (item for move in moves for item in move.consequences),
        key=lambda item: directories.index(item.result.package.directory),
    )
    if options.format == "json":
        terminal.show_json(_as_data(items, found, target, kept))
    else:
        terminal.show("\n".join(_lines(items, found, target, is_unsafe=options.unsafe_fixes)))
    for failure in dict.fromkeys(move.types_failure for move in moves if move.types_failure):
        terminal.error(f"types are not checked: {failure}")
        has_failed = True
    is_done = all(item.is_done for item in items)
    return USAGE_ERROR if has_failed else CLEAN if is_done else FINDINGS


def _nothing_found(options: argparse.Namespace) -> str:
    """Return why there is no package to move."""
    if options.notes:
        return f"no package to move; {'; '.join(options.notes)}"
    return f"{', '.join(options.paths)}: in no ROS 2 package, which is what moves"


def _moved(options: argparse.Namespace, choices: Choices, move: Move) -> Moved:
    """Check packages that come from one distribution, and fix them if that is asked for."""
    from scaffold.check.migration import Consequences, identities

    origin, target = move.origin, move.target
    session = _session(choices, is_back=target.place < origin.place)
    fixed: list[Fixed] = []
    has_failed = False
    with distributions.targeting(origin):
        session.known = identities(_checked(options, session, move))
        ordering = _ordering(options, choices, move) if options.fix else None
    with distributions.targeting(target, origin, move.kept):
        if options.fix or options.diff:
            fixed, has_failed = _fix(options, session, move)
            if ordering is not None:
                with distributions.targeting(origin):
                    _, is_refused = _fix(options, ordering, move)
                has_failed |= is_refused
        results = [] if options.diff else _checked(options, session, move)
    if results:
        results = _with_kept(options, choices, move, session, results)
    written = [item.package.directory for item in fixed]
    consequences = [
        Consequences.of(result, choices.rules, session.known, origin) for result in results
    ]
    done = {
        item.result.package.directory
        for item in consequences
        if item.is_done and not session.types_failure
    }
    return Moved(
        consequences,
        [directory for directory in written if directory in done],
        [directory for directory in written if directory not in done],
        sum(item.applied for item in fixed),
        session.types_failure,
        has_failed,
    )


def _with_kept(
    options: argparse.Namespace,
    choices: Choices,
    move: Move,
    session: MigratingSession,
    results: Sequence[Result],
) -> list[Result]:
    """Add to the results for the target what is found for the distributions that are kept.

    What the packages come from is left out: all that is found there was found before.
    """
    from scaffold.check.several import merged

    by_distribution = {move.target: results}
    for one in move.kept:
        if one.place in (move.origin.place, move.target.place):
            continue
        kept = _session(choices, is_back=one.place < move.origin.place)
        kept.known = session.known
        with distributions.targeting(one, move.origin, move.kept):
            by_distribution[one] = [item.without_fixes() for item in _checked(options, kept, move)]
        session.types_failure = session.types_failure or kept.types_failure
    return merged(by_distribution) if len(by_distribution) > 1 else [*results]


def _fix(options: argparse.Namespace, session: Session, move: Move) -> tuple[list[Fixed], bool]:
    return fixing.write(
        options,
        session,
        _targets(options, session, move),
        lambda: _targets(options, session, move),
    )


def _ordering(options: argparse.Namespace, choices: Choices, move: Move) -> OrderSession:
    """Return what sorts imports that the fixes leave unsorted, by their new names.

    It works for where the packages come from, as nothing but the fixes has changed there; files
    whose imports are not in order now are left alone.
    """
    from scaffold.check.migration import ORDER, OrderSession, unordered

    selection = choices.selection([",".join(ORDER)])
    session = OrderSession(choices.rules, selection, choices.adjustments())
    session.unordered = unordered(_checked(options, session, move))
    return session


def _record(
    moves: Sequence[Moved], targets: Sequence[Distribution], settings: Config, done: str
) -> bool:
    """Say in the records of packages what they are for now; return whether that failed.

    The record of a package where something is left stays, so that the next run reports it again.

    Args:
        moves: What became of the packages.
        targets: What they are for.
        settings: The configuration, which wins over the records.
        done: What was done before.
    """
    from scaffold.cli import records
    from scaffold.reporters.summary import count

    changed = records.move_all([path for move in moves for path in move.arrived], targets)
    titles = distributions.titles(targets)
    if changed.before:
        done += f"; {count(len(changed.before), 'package')} recorded for {titles}"
    terminal.say(done)
    for note in records.notes(changed, targets, settings):
        terminal.note(note)
    held = records.held([path for move in moves for path in move.left], targets)
    if held:
        terminal.note(held)
    return changed.has_failed


def _complete(options: argparse.Namespace, choices: Choices) -> None:
    """Set what the functions of `check` ask for besides the flags of this verb."""
    options.whole_packages = True
    options.policy = choices.policy()
    options.notes = ()


def _session(choices: Choices, *, is_back: bool) -> MigratingSession:
    from scaffold.check.migration import CODES, MigratingSession, deprecations

    selection = choices.selection([",".join(CODES)])
    session = MigratingSession(choices.rules, selection, choices.adjustments(), has_types=True)
    if is_back:
        session.improved = deprecations(choices.rules)
    return session


def _targets(options: argparse.Namespace, session: Session, move: Move) -> list[Target]:
    from scaffold.cli.verbs import check

    found = check.find_targets(options, session, None)
    return [item for item in found if item.package.directory in move.directories]


def _checked(options: argparse.Namespace, session: Session, move: Move) -> list[Result]:
    from scaffold.cli.interactive import progress

    targets = _targets(options, session, move)
    return list(progress.shown(session.run(targets), len(targets), "packages"))


def _lines(
    consequences: Sequence[Consequences], found: Origins, target: Distribution, *, is_unsafe: bool
) -> Iterator[str]:
    """Yield the report: packages with what happens to them, then the counts."""
    from scaffold.cli.origins import sentence, shares
    from scaffold.reporters.summary import count, fixable

    if not found.directories:
        yield (
            f"{sentence([*found.arrived.values()], target)}: nothing to move; "
            "`ros2-scaffold check` reports what is wrong there, --from NAME what another changes"
        )
        return

    for item in consequences:
        groups = [*zip(HEADINGS, item[1:], strict=True)]
        if not any(item[1:]):
            continue
        yield f"{item.result.package.name}:"
        for heading, diagnostics in groups:
            if diagnostics:
                yield f"  {heading}:"
                yield from (f"    {line}" for line in _folded(item.result.package, diagnostics))
    totals = [sum(len(item[at]) for item in consequences) for at in range(1, 4)]
    counts = zip(totals, COUNTED, strict=True)
    named = ", ".join(f"{number} {state}" for number, state in counts)
    every = [one for item in consequences for one in item.diagnostics]
    missed = sum(_unexamined_files(item) for item in consequences)
    nothing = "nothing changes in what was examined" if missed else "nothing changes"
    parts = [f"{shares(found)} to {target.title}: {named if every else nothing}"]
    parts += [f"{count(missed, 'file')} not examined"] if missed else []
    fixes = fixable(every, unsafe=is_unsafe)
    parts += [fixes] if fixes else []
    number = len(found.arrived) - len(found.assumed)
    if number:
        parts.append(f"{number} {'is' if number == 1 else 'are'} for {target.title} already")
    yield "; ".join(parts)


def _unexamined_files(item: Consequences) -> int:
    return len({one.location.path for one in item.unexamined})


def _folded(package: Package, diagnostics: Sequence[Diagnostic]) -> Iterator[str]:
    """Yield each message once, and for each file the other lines that it is about."""
    from scaffold.printable import printable
    from scaffold.reporters import text
    from scaffold.reporters.paths import shown

    same: dict[tuple[str, str], list[Diagnostic]] = {}
    for item in diagnostics:
        same.setdefault((item.code, item.text), []).append(item)
    for first, *others in same.values():
        yield text.line(package, first)
        lines: dict[str, list[str]] = {}
        for item in others:
            lines.setdefault(item.location.path, []).append(str(item.location.line))
        for path, numbers in lines.items():
            yield f"    also {printable(shown(package, path))}:{', '.join(numbers)}"


def _as_data(
    consequences: Sequence[Consequences],
    found: Origins,
    target: Distribution,
    kept: Sequence[Distribution],
) -> dict[str, object]:
    from scaffold.reporters import json

    def listed(item: Consequences, diagnostics: Sequence[Diagnostic]) -> list[dict[str, object]]:
        result = item.result._replace(diagnostics=list(diagnostics))
        return [*json.diagnostics([result], [target.name])]

    origins = {path: origin.name for origin, paths in found.directories.items() for path in paths}
    return {
        "schema_version": json.SCHEMA_VERSION,
        "from": [origin.name for origin in found.directories],
        "to": target.name,
        "keep": [one.name for one in kept],
        "packages": [
            {
                "name": item.result.package.name,
                "from": origins[item.result.package.directory],
                "breaks": listed(item, item.breaks),
                "changes": listed(item, item.changes),
                "deprecated": listed(item, item.deprecated),
                "unexamined": listed(item, item.unexamined),
            }
            for item in consequences
        ],
    }
