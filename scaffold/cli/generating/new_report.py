"""The output of ``new``: the files of a package, next commands, defects of templates."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from scaffold.cli import terminal
from scaffold.cli.generating import package_report

if TYPE_CHECKING:
    import argparse
    from collections.abc import Sequence

    from scaffold.diagnostic import Diagnostic
    from scaffold.generate.draft import Draft
    from scaffold.writing.plan import WritePlan


def report_defects(defects: Sequence[Diagnostic], made: Draft) -> int:
    """Report defects of a package, which are those of its templates; return the exit code."""
    from scaffold.cli.exit_codes import INTERNAL_ERROR, USAGE_ERROR
    from scaffold.generate.templates import render

    lines = [
        f"{defect.location.path}:{defect.location.line}:{defect.location.column}: "
        f"{defect.code} {defect.message}"
        for defect in defects
    ]
    if render.are_built_in(made.roots):
        for line in lines:
            terminal.say(line)
        terminal.say(
            "ros2-scaffold: internal error: the templates render a package that the checker "
            "rejects; nothing was written; please report it to their authors"
        )
        return INTERNAL_ERROR
    templates = made.rendered.templates
    for line, defect in zip(lines, defects, strict=True):
        template = templates.get(defect.location.path)
        terminal.error(f"{line} (rendered from {template})" if template else line)
    terminal.note("nothing was written: the templates are at fault")
    return USAGE_ERROR


def diff(plan: WritePlan, above: WritePlan | None) -> str:
    """Return the diff of the files of a package, and of those above it."""
    return plan.diff() + (above.diff() if above is not None else "")


def summary(
    options: argparse.Namespace, files: str, made: Draft, plan: WritePlan, above: WritePlan | None
) -> str:
    """Return the files, the diff of existing ones, and the next commands."""
    lines = [files]
    if not plan.is_new:
        differences = diff(plan, above)
        lines += ["", differences.rstrip("\n")] if options.dry_run and differences else []
    if options.dry_run:
        return "\n".join([*lines, "", "Nothing was written (--dry-run)."])
    return "\n".join([*lines, "", *_next_commands(options, made)])


def files(made: Draft, plan: WritePlan, above: WritePlan | None) -> str:
    """Return the tree of a package with notes, and the files above it."""
    from scaffold.generate.repository import MARK

    rows = [
        (min(os.path.relpath(file.target), file.target, key=len), f"{MARK}{file.path}")
        for file in (above.files if above is not None else ())
    ]
    width = max((len(path) for path, _ in rows), default=0)
    lines = [f"{path:{width}}  {made.rendered.notes.get(key, '')}".rstrip() for path, key in rows]
    return "\n".join([*_tree(made, plan), *lines])


def _tree(made: Draft, plan: WritePlan) -> list[str]:
    from scaffold.generate.update import provenance
    from scaffold.writing.planned_file import State

    notes_of = {**provenance.PURPOSES, **made.rendered.notes}
    words = {State.NEW: "", State.DIFFERING: "overwritten", State.SAME: "unchanged"}
    rows: list[tuple[str, str]] = [(f"{made.name}/", "")]
    parents: list[str] = []
    for file in sorted(plan.files, key=lambda file: _reading_order(file.path)):
        *above, name = file.path.split("/")
        for depth, parent in enumerate(above):
            if above[: depth + 1] != parents[: depth + 1]:
                rows.append(("    " * (depth + 1) + parent + "/", ""))
        parents = above
        notes = [notes_of.get(file.path, ""), words.get(file.state, "")]
        note = ", ".join(note for note in notes if note)
        rows.append(("    " * (len(above) + 1) + name, note))
    width = max(len(name) for name, _ in rows)
    return [f"{name:{width}}  {note}".rstrip() for name, note in rows]


def _reading_order(path: str) -> tuple[tuple[bool, str], ...]:
    """Sort files of a directory before the directories in it."""
    *above, name = path.split("/")
    return (*((True, parent) for parent in above), (False, name))


def _next_commands(options: argparse.Namespace, made: Draft) -> list[str]:
    from scaffold.generate import destination

    parent = options.destination_directory
    directory = os.path.normpath(os.path.join(parent, made.name))
    return [
        *package_report.next_commands(
            directory, made.name, destination.workspace(parent) or parent
        ),
        *(f"    ros2 run {made.name} {executable}" for executable in made.executables),
        *(f"    ros2 launch {made.name} {name}" for name in _launch_files(made)),
    ]


def _launch_files(made: Draft) -> list[str]:
    """Return the names of the launch files that the package installs."""
    paths = (path.partition("/") for path in sorted(made.rendered.files))
    return [name for directory, _, name in paths if directory == "launch"]
