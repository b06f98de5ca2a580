"""``ros2-scaffold new PACKAGE``."""

from __future__ import annotations

import argparse
import os
import sys
from typing import TYPE_CHECKING

from scaffold.cli import terminal
from scaffold.cli.generating import new_report, package_report
from scaffold.errors import InputError
from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping, Sequence
    from typing import Any

    from scaffold.cli.interactive.wizard import Asked
    from scaffold.configuration.config import Config
    from scaffold.generate.draft import Draft
    from scaffold.generate.edit.addition import ByHand
    from scaffold.generate.questions.questions import Given
    from scaffold.generate.repository import Place
    from scaffold.generate.templates.template import Template
    from scaffold.writing.plan import WritePlan


class _Plans(NamedTuple):
    """What is written of a package, and what is left to the user."""

    inside: WritePlan
    """The files of the package."""
    above: WritePlan | None
    """The files at the top of the repository around it."""
    left: Mapping[str, ByHand | None]
    """The existing files that may have entries of others."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Define the flags of the verb and those of the templates' questions."""
    from scaffold.cli import flags, settings
    from scaffold.cli.generating import question_groups
    from scaffold.configuration import content
    from scaffold.generate import parts
    from scaffold.generate.templates import loading

    parser.usage = f"{parser.prog} [PACKAGE] [OPTION ...]"
    own = settings.load(flags.content_in(parser)).content
    templates = loading.load(content.roots("templates", own))
    parser.set_defaults(templates=templates, rule_process=None)
    kinds = {kind: templates[kind].questions for kind in parts.kinds(templates)}
    parser.epilog = question_groups.SEE_ALSO
    question_groups.add(parser, _in_order(templates), kinds)
    writing = parser.add_argument_group("output")
    writing.add_argument(
        "--destination-directory",
        metavar="DIR",
        default=".",
        help="parent directory of the new package (default: the current directory)",
    )
    flags.add_answers(writing)
    flags.add_looking(writing)
    writing.add_argument(
        "--force", action="store_true", help="overwrite files of an existing package that differ"
    )
    flags.add_content(parser.add_argument_group("templates"))


def run(options: argparse.Namespace) -> int:
    """Write a package; return the exit code."""
    from scaffold import distributions
    from scaffold.configuration import config, content
    from scaffold.generate import target
    from scaffold.generate.templates import loading

    settings = config.load(content=tuple(options.content))
    roots = content.roots("templates", settings.content)
    templates = loading.load(roots) if options.content else options.templates
    given = _given_answers(options, templates, settings)
    with distributions.targeting(target.of(given)[0]):
        return _run(options, roots, templates, given)


def _run(
    options: argparse.Namespace,
    roots: list[str],
    templates: dict[str, Template],
    given: dict[str, Given],
) -> int:
    """Write a package for the target, asking on a terminal for missing answers."""
    from scaffold.cli import distro
    from scaffold.cli.exit_codes import CLEAN, FINDINGS
    from scaffold.errors import ScaffoldError
    from scaffold.generate import checking, dependency_names, destination

    command = None
    if "package" not in given:
        given, command = _interview(options, roots, templates, given)
    try:
        named, doubts = _dependencies(options, given)
        made, around = _drafted(options, roots, templates, given)
        _refuse_conflicts(made.conflicts)
        destination.check(options.destination_directory, made.name)
        check = checking.Check(made, options.rule_process)
        plans = _planned(options, made, around)
    except ScaffoldError:
        if command is not None:
            terminal.say_lines(
                f"Your answers as a command, to correct and run again:\n    {command}"
            )
        raise
    defects = [defect for defect in check.end() if not dependency_names.is_about(defect, named)]
    if defects:
        return new_report.report_defects(defects, made)
    if not options.dry_run and not options.diff:
        plans = _write(options, made, plans)
    for remark in (*made.remarks, *doubts, *distro.note_of_new(given)):
        terminal.note(remark)
    _show(options, made, plans, command)
    by_hand = [item for item in plans.left.values() if item is not None]
    directory = os.path.join(options.destination_directory, made.name)
    for line in package_report.by_hand(directory, by_hand):
        terminal.say(line)
    return FINDINGS if by_hand else CLEAN


def _drafted(
    options: argparse.Namespace,
    roots: list[str],
    templates: dict[str, Template],
    given: Mapping[str, Given],
) -> tuple[Draft, Place]:
    """Return the package, and the repository that it is for."""
    from scaffold.generate import draft, repository
    from scaffold.generate.questions.defaults import User

    around = repository.place_of(options.destination_directory, is_parent=True)
    user = User(options.destination_directory)
    return draft.draft(roots, templates, given, user, place=around), around


def _show(options: argparse.Namespace, made: Draft, plans: _Plans, command: str | None) -> None:
    """Show the patch, or the files and the next commands.

    Args:
        options: The flags.
        made: The package.
        plans: What is written.
        command: The answers to the questions as a command, if they were asked.
    """
    plan, above, _ = plans
    if options.diff:
        terminal.show_patch(new_report.diff(plan, above))
        return
    has_preview = command is not None and not options.dry_run
    files = f"{plan.root}: written" if has_preview else new_report.files(made, plan, above)
    terminal.show(new_report.summary(options, files, made, plan, above))
    if command is not None:
        terminal.show(f"\nThe same as a command:\n    {command}")


def _refuse_conflicts(conflicts: Sequence[str]) -> None:
    """Raise InputError if nodes of the package would not connect."""
    if conflicts:
        raise InputError(conflicts[0])


def _interview(
    options: argparse.Namespace,
    roots: list[str],
    templates: dict[str, Template],
    given: dict[str, Given],
) -> Asked:
    """Ask questions on a terminal.

    Raises:
        InputError: there is no terminal.
    """
    from scaffold.generate import connections, destination, draft
    from scaffold.generate.questions.defaults import User

    if not (sys.stdin.isatty() and sys.stdout.isatty()):
        raise InputError("PACKAGE is required: the name of the new package; see `new --help`")
    from scaffold.cli.interactive import wizard

    user = User(options.destination_directory)

    def try_name(name: str) -> None:
        destination.check(options.destination_directory, name)
        _refuse_existing(options, name)

    def try_package(answers: Mapping[str, Given]) -> Mapping[str, Any]:
        _dependencies(options, answers)
        made = draft.compose(roots, templates, answers, User(options.destination_directory))
        _refuse_conflicts(connections.conflicts(made.context["nodes"], templates))
        return made.answers

    def preview(answers: Mapping[str, Given]) -> str:
        made, around = _drafted(options, roots, templates, answers)
        plan, above, _ = _planned(options, made, around)
        return new_report.files(made, plan, above)

    trial = wizard.Trial(try_name, try_package, preview)
    return wizard.ask(templates, given, user, trial, _besides_answers(options))


def _dependencies(
    options: argparse.Namespace, given: Mapping[str, Given]
) -> tuple[Sequence[str], Sequence[str]]:
    """Return the dependencies that the user requests, and notes on them.

    Raises:
        InputError: one is certainly wrong.
    """
    from scaffold.generate import dependency_names
    from scaffold.generate.questions import answer_types

    wanted = given.get("dependencies")
    if wanted is None:
        return (), ()
    try:
        names = answer_types.dependencies(wanted.value)
    except InputError as error:
        raise InputError(f"{wanted.origin}: {error}") from error
    where = options.destination_directory
    return names, tuple(dependency_names.notes(names, wanted.origin, where))


def _besides_answers(options: argparse.Namespace) -> list[str]:
    """Return the options of this verb other than answers, as on a command line."""
    words: list[str] = []
    if options.destination_directory != ".":
        words += ["--destination-directory", options.destination_directory]
    if options.answers:
        words += ["--answers", options.answers]
    for directory in options.content:
        words += ["--content", directory]
    return [*words, "--force"] if options.force else words


def _in_order(templates: dict[str, Template]) -> list[Template]:
    """Return the base first: its questions are the general ones."""
    from scaffold.generate.templates.template import BASE

    return [templates[BASE], *(item for name, item in templates.items() if name != BASE)]


def _given_answers(
    options: argparse.Namespace, templates: dict[str, Template], settings: Config
) -> dict[str, Given]:
    from scaffold.cli import distro
    from scaffold.generate.questions import defaults, questions

    asked = questions.unique(_in_order(templates))
    configured = questions.from_table(defaults.configured(settings), asked)
    answered = questions.from_file(options.answers, asked) if options.answers else {}
    given = {**configured, **answered, **questions.from_flags(options, asked)}
    return given if distro.ANSWER in given else {**given, **distro.usual(settings)}


def _left_to_owners(
    options: argparse.Namespace, made: Draft, around: Place
) -> dict[str, ByHand | None]:
    """Return the existing files that may have entries of others."""
    from scaffold.generate import repository

    directory = os.path.join(options.destination_directory, made.name)
    inner = repository.place_of_files(directory)

    def there(path: str) -> bytes | None:
        name = path.removeprefix(repository.MARK)
        return repository.read(around if name != path else inner, name)

    return repository.left_to_owners(around, made.name, made.rendered.files, there)


def _planned(options: argparse.Namespace, made: Draft, around: Place) -> _Plans:
    """Plan all writes."""
    left = _left_to_owners(options, made, around)
    plan = _plan(options, made, left)
    return _Plans(plan, _plan_above(made, around, left, force=options.force), left)


def _plan(options: argparse.Namespace, made: Draft, left: Collection[str]) -> WritePlan:
    """Plan the writes; an existing package is not changed without ``--force``."""
    from scaffold.generate import repository
    from scaffold.generate.update import provenance
    from scaffold.writing.plan import WritePlan

    directory = _refuse_existing(options, made.name)
    files = repository.inside(made.rendered.files)
    files = {path: text for path, text in files.items() if path not in left}
    has_attributes = os.path.lexists(os.path.join(directory, provenance.ATTRIBUTES))
    is_new = not has_attributes and provenance.ATTRIBUTES not in files
    files |= provenance.Provenance.of(made).files(is_new=is_new)
    return WritePlan.of(directory, files, executable=made.rendered.executable)


def _write(options: argparse.Namespace, made: Draft, plans: _Plans) -> _Plans:
    """Write; return the plans that were followed."""
    from scaffold.cli import writing

    plan, above, left = plans
    if plan.is_new:
        plan.write(force=options.force, around=above)
        return plans
    with writing.held(plan.root, is_dry=False):
        # Locks the existing files.
        plan = _plan(options, made, left)
        plan.write(force=options.force, around=above)
    return plans._replace(inside=plan)


def _plan_above(
    made: Draft, around: Place, left: Collection[str], *, force: bool
) -> WritePlan | None:
    """Plan the writes at the top of the repository around the new package."""
    from scaffold.generate import repository

    files = {path: text for path, text in made.rendered.files.items() if path not in left}
    plan = repository.plan(around, repository.above(files))
    if plan is not None and plan.conflicts and not force:
        hint = "--force overwrites; nothing was written"
        raise package_report.conflict(plan.conflicts, plan.root, hint)
    return plan


def _refuse_existing(options: argparse.Namespace, name: str) -> str:
    """Return the directory of a package; raise if it exists and may not be overwritten."""
    from scaffold.cli import writing
    from scaffold.errors import ConflictError
    from scaffold.writing.stage import sweep
    from scaffold.writing.transaction import is_unfinished

    directory = os.path.normpath(os.path.join(options.destination_directory, name))
    if os.path.islink(directory):
        raise ConflictError(f"{directory} is a link to {os.path.realpath(directory)}")
    if os.path.lexists(directory) and not options.force:
        # It may be left by a killed run.
        sweep(options.destination_directory)
        sweep(directory)
        if is_unfinished(directory):
            with writing.held(directory, is_dry=options.dry_run or options.diff):
                pass
        hint = "--force overwrites the files that differ"
        raise ConflictError(f"{directory} already exists; {hint}")
    return directory
