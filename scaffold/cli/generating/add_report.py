"""The output of ``add``: written and edited files, next commands, defects."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from scaffold.cli import terminal
from scaffold.cli.generating import package_report

if TYPE_CHECKING:
    import argparse

    from scaffold.diagnostic import Diagnostic
    from scaffold.generate.add.add import Added
    from scaffold.model.package import Package
    from scaffold.writing.plan import WritePlan


def report_defects(package: Package, diagnostics: list[Diagnostic]) -> None:
    """Report errors that the addition would cause in a package."""
    for diagnostic in diagnostics:
        terminal.say(line(package, diagnostic))
    terminal.say(
        "ros2-scaffold: internal error: the checker finds errors in the added files; nothing was "
        "changed; please open an issue in the repository of this tool"
    )


def line(package: Package, diagnostic: Diagnostic) -> str:
    """Format a diagnostic."""
    at = diagnostic.location
    path = os.path.normpath(os.path.join(package.directory, at.path))
    return f"{path}:{at.line}:{at.column}: {diagnostic.code} {diagnostic.message}"


def diff(plan: WritePlan, above: WritePlan | None) -> str:
    """Return the diff of the files of a package, and of those above it."""
    from scaffold.generate.update.provenance import HIDDEN

    return plan.diff(hidden=HIDDEN) + (above.diff() if above is not None else "")


def summary(
    options: argparse.Namespace,
    package: Package,
    added: Added,
    plan: WritePlan,
    above: WritePlan | None,
) -> str:
    """Return the written and edited files, and the next commands."""
    from scaffold.generate import repository
    from scaffold.generate.update.provenance import HIDDEN
    from scaffold.writing.planned_file import State

    words = {State.NEW: "new", State.DIFFERING: "edited", State.SAME: "unchanged"}
    rows = [
        (os.path.normpath(os.path.join(package.directory, file.path)), words[file.state], file.path)
        for file in plan.files
    ]
    rows += [
        (package_report.shortest(file.target), words[file.state], f"{repository.MARK}{file.path}")
        for file in (above.files if above is not None else ())
    ]
    width = max((len(path) for path, _, _ in rows), default=0)
    lines = [
        f"{path:{width}}  {', '.join(filter(None, [word, added.notes.get(name, '')]))}"
        for path, word, name in rows
    ]
    if options.dry_run:
        patch = diff(plan, above).rstrip("\n")
        return "\n".join([*lines, "", patch, "Nothing was changed (--dry-run)."])
    if not plan.changes and not (above is not None and above.changes):
        if added.by_hand:
            return "\n".join([*lines, "Nothing was changed."])
        return "\n".join([*lines, "", "Everything is already there; nothing was changed."])
    ours = {*added.new, *(f"{repository.MARK}{path}" for path in added.above), *HIDDEN}
    if all(path in ours for _, _, path in rows) and added.start is None:
        return "\n".join(lines)
    return "\n".join([*lines, "", *_next_commands(package, added)])


def _next_commands(package: Package, added: Added) -> list[str]:
    from scaffold.generate import destination

    top = destination.workspace(os.path.dirname(os.path.realpath(package.directory)))
    shown = package_report.shortest(top) if top else ""
    lines = package_report.next_commands(package.directory, package.name, shown)
    return [*lines, f"    {added.start}"] if added.start else lines
