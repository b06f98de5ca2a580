"""``ros2-scaffold update [DIR]``."""

from __future__ import annotations

import argparse
import os
from typing import TYPE_CHECKING

from scaffold.cli import terminal

if TYPE_CHECKING:
    from collections.abc import Sequence

    from scaffold.distributions import Distribution
    from scaffold.generate.update.update import Updated
    from scaffold.writing.plan import WritePlan


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Define the flags of the verb."""
    from scaffold.cli import distro, flags

    parser.add_argument(
        "directory",
        nargs="?",
        default=".",
        metavar="DIR",
        help="a package created by `new` (default: the current directory)",
    )
    parser.add_argument(
        distro.FLAG,
        action="append",
        metavar="NAMES",
        help="change ROS 2 distributions of the package, separated by commas",
    )
    flags.add_looking(parser)
    flags.add_content(parser)


def run(options: argparse.Namespace) -> int:
    """Update a package to the current templates; 1 when there are conflicts to resolve."""
    from scaffold import distributions
    from scaffold.cli import distro
    from scaffold.errors import InputError

    directory = os.path.normpath(options.directory)
    if not os.path.isdir(directory):
        raise InputError(f"{directory}: no such directory")
    flag = options.distro
    moved = None if flag is None else distributions.several(",".join(flag), distro.FLAG)
    targets = moved or distro.recorded(directory) or [distributions.JAZZY]
    with distributions.targeting(targets[0]):
        return _run(options, directory, moved)


def _run(options: argparse.Namespace, directory: str, moved: Sequence[Distribution] | None) -> int:
    """Update a package, and move it to other distributions if requested."""
    from scaffold.cli import settings, writing
    from scaffold.cli.exit_codes import CLEAN, FINDINGS
    from scaffold.configuration import content
    from scaffold.files.tree import DiskTree
    from scaffold.generate import repository
    from scaffold.generate.questions.defaults import User
    from scaffold.generate.templates import loading
    from scaffold.generate.update import update
    from scaffold.generate.update.provenance import HIDDEN
    from scaffold.writing.plan import WritePlan

    given = settings.load(options.content).content
    recorded = update.recorded_content(DiskTree(directory), directory, given)
    roots = content.roots("templates", (*recorded, *given))
    templates = loading.load(roots)
    place = repository.place_of(directory)
    is_dry = options.diff or options.dry_run
    with writing.held(directory, is_dry=is_dry):
        tree = DiskTree(directory)
        updated = update.update(
            tree, directory, roots, templates, User(directory), place, moved=moved
        )
        files = repository.inside(updated.files)
        plan = WritePlan.of(directory, files, executable=updated.executable, tree=tree)
        above = repository.plan(place, repository.above(updated.files))
        if not is_dry:
            plan.write(force=True, around=above)
    if options.diff:
        terminal.show_patch(plan.diff(hidden=HIDDEN))
        terminal.show_patch(above.diff() if above else "")
    for remark in updated.remarks:
        terminal.note(remark)
    if not options.diff:
        terminal.show(_summary(options, updated, plan, above))
        if moved and updated.files and not options.dry_run:
            terminal.show(_next_steps(directory, moved))
    return FINDINGS if updated.conflicts else CLEAN


def _summary(
    options: argparse.Namespace, updated: Updated, plan: WritePlan, above: WritePlan | None
) -> str:
    """Return a line for each changed file, and instructions for conflicts."""
    from scaffold.generate.repository import MARK
    from scaffold.writing.planned_file import State

    if not updated.changed:
        return "The package is up to date with the templates."
    words = {State.NEW: "new", State.DIFFERING: "merged", State.SAME: "unchanged"}
    lines: list[str] = []
    files = {file.path: file for file in plan.files}
    files |= {f"{MARK}{file.path}": file for file in (above.files if above else ())}
    for path, file in files.items():
        if path not in updated.changed:
            continue
        count = updated.conflicts.get(path, 0)
        note = f", {count} conflict{'s' if count > 1 else ''} to resolve" if count else ""
        lines.append(f"{path}: {words[file.state]}{note}")
    if options.dry_run:
        lines.append("Nothing was written (--dry-run).")
    elif updated.conflicts:
        lines.append("Resolve the conflicts between <<<<<<< and >>>>>>>, then run the tests.")
    return "\n".join(lines)


def _next_steps(directory: str, moved: Sequence[Distribution]) -> str:
    """Return the remaining steps for new distributions, about the user's own code."""
    from shlex import quote

    from scaffold import distributions

    names = ",".join(item.name for item in moved)  # the configuration may set other ones
    return (
        f"The package is now for {distributions.titles(moved)}. To see what your own code "
        "needs:\n"
        f"    ros2-scaffold check --distro {names} {quote(directory)}"
    )
