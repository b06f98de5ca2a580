"""``ros2-scaffold migrate [PATHS] --to NAME``."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from scaffold import distributions
from scaffold.cli import distro, fixing, terminal

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from scaffold.check.migration import Consequences, MigratingSession, OrderSession
    from scaffold.check.result import Result
    from scaffold.check.session import Session
    from scaffold.cli.choices import Choices
    from scaffold.configuration.config import Config
    from scaffold.diagnostic import Diagnostic
    from scaffold.distributions import Distribution
    from scaffold.model.discovery.targets import Target
    from scaffold.model.package import Package

HEADINGS = ("breaks", "changes silently", "deprecated")
COUNTED = ("break", "change silently", "deprecated")


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
        metavar="NAMES",
        help="distributions that they are to run on as well, separated by commas: fixes write "
        "only what all of them have",
    )
    parser.add_argument(
        "--fix", action="store_true", help="apply what is safe, and report what is left"
    )
    parser.add_argument("--diff", action="store_true", help="show what --fix would change")
    parser.add_argument("--format", choices=("text", "json"), default="text", help="output format")


def run(options: argparse.Namespace) -> int:
    """Report what a move changes, and fix what is safe; return the exit code."""
    from scaffold.check import registry
    from scaffold.check.migration import Consequences, identities
    from scaffold.cli.choices import Choices
    from scaffold.cli.exit_codes import CLEAN, FINDINGS, USAGE_ERROR
    from scaffold.cli.settings import warn
    from scaffold.cli.verbs import check
    from scaffold.configuration import config, content
    from scaffold.files.disk import Disk

    directory = check.common_directory(options.paths, Disk())
    settings = config.load(directory, (), Disk())
    warn(settings.warnings)
    choices = Choices(settings, registry.load(content.roots("rules", settings.content)))
    _complete(options, choices)
    session = _session(choices)
    target = distributions.named(options.to, "--to")
    kept = distributions.several(options.keep, "--keep") if options.keep else []
    origin = _origin(options, target, settings, session)
    has_failed = False
    with distributions.targeting(origin):
        session.known = identities(_checked(options, session))
        ordering = _ordering(options, choices) if options.fix else None
    with distributions.targeting(target, origin, kept):
        targets = check.find_targets(options, session, None)
        if options.fix or options.diff:
            written, has_failed = fixing.write(
                options, session, targets, lambda: check.find_targets(options, session, None)
            )
            count = sum(item.applied for item in written)
            verb = "would be applied" if options.diff else "applied"
            terminal.say(f"{check.fix_count(count)} {verb}")
            if options.diff:
                return FINDINGS if count else CLEAN
            if ordering is not None:
                with distributions.targeting(origin):
                    has_failed |= _sort_imports(options, ordering)
            directories = [item.package.directory for item in written]
            has_failed |= _move(directories, distributions.ordered([*kept, target]), settings)
        results = _checked(options, session)
    deprecations = {rule.code for rule in choices.rules if rule.is_deprecation}
    consequences = [Consequences.of(result, deprecations) for result in results]
    if options.format == "json":
        terminal.show_json(_as_data(consequences, origin, target, kept))
    else:
        terminal.show("\n".join(_lines(consequences, origin, target)))
    if session.types_failure:
        terminal.error(f"types are not checked: {session.types_failure}")
        has_failed = True
    is_left = any(item.breaks or item.changes for item in consequences)
    return USAGE_ERROR if has_failed else FINDINGS if is_left else CLEAN


def _origin(
    options: argparse.Namespace, target: Distribution, settings: Config, session: MigratingSession
) -> Distribution:
    """Return where packages come from: the oldest that they are for, and that is not the target.

    Raises:
        InputError: there is no distribution of a name, or nothing to move.
    """
    from scaffold.cli.verbs import check
    from scaffold.errors import InputError

    if options.origin:
        candidates = [distributions.named(options.origin, "--from")]
    else:
        default = [distributions.named(distributions.DEFAULT)]
        candidates = distro.wanted(None, settings) or [
            origin
            for item in check.find_targets(options, session, None)
            for origin in distro.recorded(item.package.directory) or default
        ]
        if all(item.place == target.place for item in candidates):
            candidates += default  # they have been moved before, which may be repeated
    others = [item for item in candidates if item.place != target.place]
    if not others:
        last = candidates[-1]
        message = f"the packages are for {last.title} already"
        if last.name != target.name:
            message += f", which is the same as {target.title} for Python packages"
        raise InputError(f"{message}: --from names where they come from")
    return distributions.ordered(others)[0]


def _ordering(options: argparse.Namespace, choices: Choices) -> OrderSession:
    """Return what sorts imports; files whose imports are not in order now are left alone."""
    from scaffold.check.migration import ORDER, OrderSession, unordered

    selection = choices.selection([",".join(ORDER)])
    session = OrderSession(choices.rules, selection, choices.adjustments())
    session.unordered = unordered(_checked(options, session))
    return session


def _sort_imports(options: argparse.Namespace, session: OrderSession) -> bool:
    """Sort imports that are not in order any more, by their new names; return whether that failed.

    That is judged for where the packages come from: nothing but the fixes has changed there.
    """
    from scaffold.cli.verbs import check

    targets = check.find_targets(options, session, None)
    _, has_failed = fixing.write(
        options, session, targets, lambda: check.find_targets(options, session, None)
    )
    return has_failed


def _move(directories: Sequence[str], targets: Sequence[Distribution], settings: Config) -> bool:
    """Say in the records of packages what they are for now; return whether that failed."""
    from scaffold.cli import records
    from scaffold.errors import ScaffoldError

    titles = distributions.titles(targets)
    has_failed = False
    has_others = False
    for directory in directories:
        try:
            is_moved = records.move(directory, targets)
        except ScaffoldError as error:
            terminal.error(str(error))
            has_failed = True
            continue
        has_others = has_others or is_moved is None
        if is_moved:
            terminal.note(
                f"{directory}: recorded as a package for {titles}; `ros2-scaffold update` brings "
                "what its templates have for that"
            )
    named = distro.wanted(None, settings)
    usual = named or [distributions.named(distributions.DEFAULT)]
    if usual != [*targets] and (named or has_others):
        names = ",".join(target.name for target in targets)
        terminal.note(
            f"`check` without --distro checks for {distributions.titles(usual)}: set {distro.KEY} "
            f"of the configuration, or pass --distro {names}"
        )
    return has_failed


def _complete(options: argparse.Namespace, choices: Choices) -> None:
    """Set what the functions of `check` ask for besides the flags of this verb."""
    options.whole_packages = True
    options.unsafe_fixes = False
    options.policy = choices.policy()
    options.notes = ()


def _session(choices: Choices) -> MigratingSession:
    from scaffold.check.migration import AREAS, MigratingSession

    selection = choices.selection([",".join(AREAS)])
    return MigratingSession(choices.rules, selection, choices.adjustments(), has_types=True)


def _checked(options: argparse.Namespace, session: Session) -> list[Result]:
    from scaffold.cli.interactive import progress
    from scaffold.cli.verbs import check

    targets: Sequence[Target] = check.find_targets(options, session, None)
    return list(progress.shown(session.run(targets), len(targets), "packages"))


def _lines(
    consequences: Sequence[Consequences], origin: Distribution, target: Distribution
) -> Iterator[str]:
    """Yield the report: packages with what happens to them, then the counts."""
    from scaffold.reporters.summary import count, fixable

    for item in consequences:
        groups = [*zip(HEADINGS, item[1:], strict=True)]
        if not item.diagnostics:
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
    parts = [
        f"{count(len(consequences), 'package')} from {origin.title} to {target.title}: "
        + (named if every else "nothing changes")
    ]
    fixes = fixable(every, unsafe=False)
    yield "; ".join([*parts, fixes] if fixes else parts)


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
    origin: Distribution,
    target: Distribution,
    kept: Sequence[Distribution],
) -> dict[str, object]:
    from scaffold.reporters import json

    def listed(item: Consequences, diagnostics: Sequence[Diagnostic]) -> list[dict[str, object]]:
        result = item.result._replace(diagnostics=list(diagnostics))
        return [*json.diagnostics([result], [target.name])]

    return {
        "schema_version": json.SCHEMA_VERSION,
        "from": origin.name,
        "to": target.name,
        "keep": [one.name for one in kept],
        "packages": [
            {
                "name": item.result.package.name,
                "breaks": listed(item, item.breaks),
                "changes": listed(item, item.changes),
                "deprecated": listed(item, item.deprecated),
            }
            for item in consequences
        ],
    }
