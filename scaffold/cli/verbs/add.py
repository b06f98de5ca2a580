"""``ros2-scaffold add KIND [NAME]``."""

from __future__ import annotations

import argparse
import os
from typing import TYPE_CHECKING

from scaffold.cli import terminal
from scaffold.cli.generating import add_report, package_report

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from scaffold.check.session import Session
    from scaffold.configuration.config import Config
    from scaffold.diagnostic import Diagnostic
    from scaffold.distributions import Distribution
    from scaffold.generate.add.add import Added
    from scaffold.generate.add.rendered_part import Target, Wanted
    from scaffold.generate.questions.questions import Given
    from scaffold.generate.templates.template import Question, Template
    from scaffold.model.package import Package
    from scaffold.writing.plan import WritePlan


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Define the flags of the verb and those of the parts' questions."""
    from scaffold.cli import flags, settings
    from scaffold.cli.generating import question_groups
    from scaffold.configuration import content
    from scaffold.generate import parts
    from scaffold.generate.templates import loading

    own = settings.load(flags.content_in(parser)).content
    templates = loading.load(content.roots("templates", own))
    parser.usage = f"{parser.prog} KIND [NAME] [OPTION ...]"
    parser.epilog = question_groups.SEE_ALSO
    kinds = parts.addable(templates)
    listed = "; ".join(
        f"{section}: {', '.join(names)}" for section, names in parts.sections(templates).items()
    )
    kind = parser.add_argument("kind", metavar="KIND", help=f"{listed}")
    kind.completer = lambda **_: kinds  # type: ignore[attr-defined]  # argcomplete
    name = parser.add_argument(
        "name",
        metavar="NAME",
        nargs="?",
        help="name of the node, interface or program; not for extras",
    )
    name.completer = lambda **_: ()  # type: ignore[attr-defined]  # argcomplete
    package = parser.add_argument_group("the package")
    package.add_argument(
        "--package-directory",
        metavar="DIR",
        help="directory of the package (default: that of the current directory)",
    )
    package.add_argument(
        "--launch",
        metavar="FILE",
        default="",
        help="a launch file of the package to add the node to; no other is edited",
    )
    names_of_flags = {question.name for question in _flag_questions(templates)}
    question_groups.add(parser, templates.values(), only=names_of_flags, package=package)
    writing = parser.add_argument_group("output")
    flags.add_answers(writing)
    flags.add_looking(writing)
    writing.add_argument(
        "--force", action="store_true", help="overwrite existing files that differ"
    )
    flags.add_content(parser.add_argument_group("templates"))


def run(options: argparse.Namespace) -> int:
    """Add something to a package; return the exit code."""
    from scaffold import distributions
    from scaffold.configuration import config

    directory = _directory(options.package_directory)
    settings = config.load(content=tuple(options.content))
    targets = _targets(options, directory, settings)
    with distributions.targeting(targets[0]):
        return _run(options, directory, settings, targets)


def _targets(options: argparse.Namespace, directory: str, settings: Config) -> list[Distribution]:
    """Return the distributions of a package.

    Raises:
        InputError: its record differs from the flag.
    """
    from scaffold import distributions
    from scaffold.cli import distro
    from scaffold.errors import InputError

    recorded = distro.recorded(directory)
    flag = getattr(options, distro.ANSWER, None)  # user templates may not have this question
    if recorded is None:
        return distro.chosen(flag, settings)
    if flag is not None and distro.wanted(flag, settings) != recorded:
        command = f"ros2-scaffold update {distro.FLAG} {','.join(flag)} {directory}"
        raise InputError(
            f"{distro.FLAG}: the package is for {distributions.titles(recorded)}; "
            f"`{command}` changes that; nothing was changed"
        )
    return recorded


def _run(
    options: argparse.Namespace,
    directory: str,
    settings: Config,
    targets: Sequence[Distribution],
) -> int:
    """Add something to a package for some distributions."""
    from scaffold.check.rules import registry
    from scaffold.check.selection import Selection
    from scaffold.check.session import Session
    from scaffold.cli import writing
    from scaffold.cli.exit_codes import CLEAN, FINDINGS, INTERNAL_ERROR
    from scaffold.configuration import content
    from scaffold.generate import repository
    from scaffold.generate.add import add
    from scaffold.generate.checking import WITHOUT_WORKSPACE

    target, wanted = _target_and_wanted(options, directory, settings, targets)
    selection = Selection(ignore=WITHOUT_WORKSPACE)
    session = Session(registry.load(content.roots("rules")), selection)
    is_dry = options.diff or options.dry_run
    with writing.held(target.package.directory, is_dry=is_dry):
        before = session.check(target.package)
        _refuse_broken(target.package, before, force=options.force)
        added = add.add(target, wanted)
        plan = _plan(target.package, added, is_named=wanted.name is not None, force=options.force)
        above = repository.plan(target.place, added.above)
        if above is not None:
            _refuse_differing(above, [*added.above], force=options.force)
        findings = _findings(session, before, added)
        _refuse_elsewhere(session, target.package, added, targets[1:])
        if _is_defect(session, findings, added):
            add_report.report_defects(target.package, findings)
            return INTERNAL_ERROR
        if not is_dry:
            plan.write(force=True, around=above)
    for note in [*added.remarks, *(add_report.line(target.package, item) for item in findings)]:
        terminal.note(note)
    _show(options, target.package, added, plan, above)
    return FINDINGS if any(item.is_needed for item in added.by_hand) else CLEAN


def _target_and_wanted(
    options: argparse.Namespace,
    directory: str,
    settings: Config,
    targets: Sequence[Distribution],
) -> tuple[Target, Wanted]:
    """Return the selected package, and what to add to it."""
    from scaffold.cli.distro import ANSWER
    from scaffold.configuration import content
    from scaffold.errors import InputError
    from scaffold.generate import parts
    from scaffold.generate.add.rendered_part import Target, Wanted
    from scaffold.generate.questions.defaults import User
    from scaffold.generate.questions.questions import Given, choose
    from scaffold.generate.templates import loading
    from scaffold.generate.templates.template import PARTS, Role
    from scaffold.generate.update import update
    from scaffold.model.package import Package
    from scaffold.writing.transaction import RECORD

    # The package is read again once it is locked, as another run may be writing it.
    before = Package.at(directory)
    recorded = update.recorded_content(before.tree, directory, settings.content)
    roots = content.roots("templates", (*recorded, *settings.content))
    templates = loading.load(roots)
    chosen = templates[choose(options.kind, parts.addable(templates), "KIND")]
    is_part = chosen.role in PARTS
    if is_part and options.name is None:
        raise InputError(f"NAME is required: the name of the {chosen.role.value}")
    if not is_part and options.name is not None:
        raise InputError(f"NAME does not apply to {chosen.name}, which is for the whole package")
    if options.launch and chosen.role is not Role.NODE:
        raise InputError(f"--launch: does not apply to {chosen.name}, which is not a node")
    target = Target(Package.at(directory), roots, templates, User(directory))
    given = _given_answers(options, templates, settings)
    given[ANSWER] = Given([item.name for item in targets], RECORD)
    return target, Wanted(chosen, options.name, given, options.launch)


def _flag_questions(templates: Mapping[str, Template]) -> list[Question]:
    """Return the questions for flags; the name is a separate argument."""
    from scaffold.generate import parts
    from scaffold.generate.add.regenerate import OF_PACKAGES
    from scaffold.generate.questions import questions
    from scaffold.generate.templates.template import BASE

    kinds = [templates[kind] for kind in parts.addable(templates)]
    names = {kind.name_question for kind in kinds}
    own = [item for item in questions.unique(kinds) if item.name not in names]
    general = [question for question in templates[BASE].questions if question.name in OF_PACKAGES]
    return [*own, *general]


def _given_answers(
    options: argparse.Namespace, templates: Mapping[str, Template], settings: Config
) -> dict[str, Given]:
    """Return the user's answers, without those that an existing package implies."""
    from scaffold.generate.add.regenerate import OF_PACKAGES
    from scaffold.generate.questions import defaults, questions

    asked = _flag_questions(templates)
    table = questions.from_table(
        defaults.configured(settings), questions.unique(templates.values())
    )
    names = {question.name for question in asked} - {*OF_PACKAGES}
    configured = {name: value for name, value in table.items() if name in names}
    answered = questions.from_file(options.answers, asked) if options.answers else {}
    return {**configured, **answered, **questions.from_flags(options, asked)}


def _directory(given: str | None) -> str:
    """Return the directory of the selected package."""
    from scaffold.errors import InputError
    from scaffold.files.disk import Disk
    from scaffold.files.tree import MANIFEST
    from scaffold.model.discovery import colcon

    if given is not None:
        if not os.path.isfile(os.path.join(given, MANIFEST)):
            raise InputError(f"{given} is not a package: it has no {MANIFEST}")
        return os.path.normpath(given)
    directory = colcon.package_around(Disk(), os.getcwd())
    if directory is None:
        raise InputError(
            f"no {MANIFEST} here or above: change to a package or use --package-directory"
        )
    return os.path.relpath(directory)


def _refuse_broken(package: Package, before: list[Diagnostic], *, force: bool) -> None:
    """Raise if a file of the package cannot be parsed; ``--force`` needs only those it edits."""
    from scaffold.check.rules.engine_rules import UnparsableFile
    from scaffold.errors import InputError

    for diagnostic in before:
        if (diagnostic.code == UnparsableFile.code or diagnostic.code.startswith("E9")) and not (
            force
        ):
            raise InputError(
                f"{add_report.line(package, diagnostic)}; fix it first, or ignore it with --force; "
                "nothing was changed"
            )


def _findings(session: Session, before: list[Diagnostic], added: Added) -> list[Diagnostic]:
    """Return the findings that are new and unexpected."""
    from scaffold.generate.add import add

    diagnostics = add.new_diagnostics(before, session.check(added.package))
    return [diagnostic for diagnostic in diagnostics if not added.is_expected(diagnostic)]


def _refuse_elsewhere(
    session: Session, package: Package, added: Added, others: Sequence[Distribution]
) -> None:
    """Raise InputError if the addition has errors on other distributions of the package."""
    from scaffold import distributions
    from scaffold.diagnostic import Severity
    from scaffold.errors import InputError
    from scaffold.generate.add import add
    from scaffold.model.package import Package

    for other in others:
        with distributions.targeting(other):
            before = session.check(Package(package.tree, directory=package.directory))
            after = session.check(Package(added.package.tree, directory=package.directory))
        for diagnostic in add.new_diagnostics(before, after):
            if diagnostic.severity is Severity.ERROR and not added.is_expected(diagnostic):
                raise InputError(
                    f"{distributions.titles([other])}, which the package is also for: "
                    f"{add_report.line(package, diagnostic)}; nothing was changed"
                )


def _plan(package: Package, added: Added, *, is_named: bool, force: bool) -> WritePlan:
    """Plan the writes; shared files are edited, files of the part must be new."""
    from scaffold.files.tree import DiskTree
    from scaffold.writing.plan import WritePlan

    tree = package.tree if isinstance(package.tree, DiskTree) else None
    plan = WritePlan.of(package.root or ".", added.files, executable=added.executable, tree=tree)
    what_to_do = f"{'choose another name, or ' if is_named else ''}overwrite it with --force"
    launch = next((path for path in added.new if path.startswith("launch/")), None)
    if launch is not None:
        what_to_do = (
            f"`add KIND NAME --launch {launch}` starts a new node there; nothing was changed"
        )
    _refuse_differing(plan, added.new, package.directory, what_to_do, force=force)
    return plan


def _refuse_differing(
    plan: WritePlan,
    new: Sequence[str],
    where: str = "",
    what_to_do: str = "overwrite it with --force",
    *,
    force: bool,
) -> None:
    """Raise if a new file exists already and differs."""
    differing = [
        file.path
        for file in plan.files
        if file.path in new and file.before not in {None, file.content}
    ]
    if differing and not force:
        raise package_report.conflict(differing, where or plan.root, what_to_do)


def _is_defect(session: Session, diagnostics: list[Diagnostic], added: Added) -> bool:
    """Return whether an edit or a template caused an error.

    Findings in other files are ignored: some are checked only now that there is a program. So are
    findings about existing lines.
    """
    from scaffold.diagnostic import Severity

    if any(item.is_needed for item in added.by_hand):
        return False
    others = [path for path in added.package.files if path not in added.files]
    errors = [
        item
        for item in diagnostics
        if item.severity is Severity.ERROR
        and item.location.path not in others
        and not any(path in item.message for path in others)
    ]
    return bool(errors and added.without_own(errors, session.check(added.unedited)))


def _show(
    options: argparse.Namespace,
    package: Package,
    added: Added,
    plan: WritePlan,
    above: WritePlan | None,
) -> None:
    """Print the diff or the summary, and the edits left to the user."""
    if options.diff:
        terminal.show_patch(add_report.diff(plan, above))
    else:
        terminal.show(add_report.summary(options, package, added, plan, above))
    for line in package_report.by_hand(package.directory, added.by_hand):
        terminal.say(line)
