"""Writes the fixes of ``check --fix`` and ``check --add-noqa``, or shows them as a patch."""

from __future__ import annotations

import argparse
import os
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from scaffold.cli import terminal

if TYPE_CHECKING:
    from scaffold.check.fixes.fixer import Fixed
    from scaffold.check.session import Session
    from scaffold.diagnostic import Diagnostic
    from scaffold.files.tree import Tree
    from scaffold.model.discovery.targets import Target
    from scaffold.model.package import Package
    from scaffold.writing.plan import WritePlan

_NAMED = 10
"""The number of files listed in a note."""


def write(
    options: argparse.Namespace,
    session: Session,
    targets: Sequence[Target],
    find_again: Callable[[], Sequence[Target]],
) -> tuple[list[Fixed], bool]:
    """Fix packages, and write them or show the patch.

    A package that another process is changing is skipped; the others are fixed.

    Args:
        options: The flags of `check`.
        session: The rules to fix with.
        targets: The packages.
        find_again: Finds the packages again, if they may have changed.

    Returns:
        The packages that were written or shown, and whether any was rejected.
    """
    from contextlib import ExitStack

    from scaffold.check.fixes import workspace_fixer
    from scaffold.cli import writing
    from scaffold.cli.interactive.progress import Bar

    with ExitStack() as stack:
        held = writing.hold_all(stack, _roots(targets), is_dry=options.diff)
        if held.has_waited:  # packages found before may have changed
            targets = find_again()
        targets = [item for item in targets if item.package.root in held.roots]
        trees = [target.package.tree for target in targets]
        with Bar() as bar:
            fixed = workspace_fixer.fix(targets, session, bar, unsafe=options.unsafe_fixes)
        written, is_refused = put(options, [*zip(fixed, trees, strict=True)])
    return written, held.has_failed or is_refused


def put(
    options: argparse.Namespace, packages: Sequence[tuple[Fixed, Tree | None]]
) -> tuple[list[Fixed], bool]:
    """Write fixed packages, or show the patch.

    Args:
        options: The flags, which say whether to only show the patch.
        packages: The fixed packages, with those on disk if available.

    Returns:
        The packages that were written or shown, and whether any was rejected.
    """
    from scaffold.errors import ScaffoldError

    plans: list[WritePlan] = []
    written: list[Fixed] = []
    for item, tree in packages:
        try:
            plan = _plan(item, tree)
            if not options.diff:
                plan.write(force=True)
        except ScaffoldError as error:
            terminal.error(str(error))
        else:
            plans.append(plan)
            written.append(item)
    if options.diff:
        terminal.show_patch(_patch(plans))
    for item in written:
        _note_links(item)
    return written, len(written) < len(packages)


def fix_count(count: int) -> str:
    """Return ``1 fix``, ``2 fixes``."""
    return "1 fix" if count == 1 else f"{count} fixes"


def note_unexamined(diagnostics: Sequence[tuple[Package, Diagnostic]]) -> bool:
    """Note the files that could not be examined and are missing from the patch.

    Args:
        diagnostics: The remaining findings, with the packages.

    Returns:
        Whether there are any.
    """
    from scaffold.check.migration import UNEXAMINED
    from scaffold.printable import printable
    from scaffold.reporters.paths import shown
    from scaffold.reporters.summary import count

    paths = sorted(
        {
            shown(at, diagnostic.location.path)
            for at, diagnostic in diagnostics
            if diagnostic.code in UNEXAMINED
        }
    )
    if paths:
        named = ", ".join(map(printable, paths[:_NAMED]))
        more = f" and {len(paths) - _NAMED} more" if len(paths) > _NAMED else ""
        terminal.note(f"{count(len(paths), 'file')} not examined: {named}{more}")
    return bool(paths)


def _roots(targets: Sequence[Target]) -> list[str]:
    return [target.package.root for target in targets if target.package.root is not None]


def _note_links(fixed: Fixed) -> None:
    """Note the files that are not fixed because they are symlinks out of the package."""
    from scaffold.writing.plan import target_outside

    root = fixed.package.directory
    for path in sorted({diagnostic.location.path for diagnostic in fixed.diagnostics}):
        target = target_outside(root, path)
        if target is not None:
            place = os.path.join(root, path)
            terminal.note(f"{place}: not fixed: a link to {target}, outside of the package")


def _plan(fixed: Fixed, tree: Tree | None) -> WritePlan:
    """Return the plan for writing a fixed package, compared with the files on disk.

    Raises:
        ConflictError: a file changed after it was read.
    """
    from scaffold.errors import ConflictError
    from scaffold.files.tree import DiskTree
    from scaffold.writing.plan import WritePlan

    plan = WritePlan.of(
        fixed.package.directory,
        fixed.changed,
        executable=fixed.executable,
        remove=fixed.removed,
        tree=tree if isinstance(tree, DiskTree) else None,
    )
    for file in plan.files:
        is_content = file.path in fixed.changed or file.path in fixed.removed
        if is_content and file.before != fixed.before.get(file.path):
            raise ConflictError(
                f"{file.path} in {plan.root} changed after it was read; nothing was written; run "
                "the command again"
            )
    return plan


def _patch(plans: Sequence[WritePlan]) -> str:
    from scaffold.writing import patch

    base = patch.base([plan.root for plan in plans])
    return "".join(plan.diff(relative_to=base) for plan in plans)
