"""The packages selected on the command line, and what is excluded from them."""

from __future__ import annotations

import argparse
import os
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from scaffold.check.result import Result
    from scaffold.check.session import Session
    from scaffold.files.disk import Disk
    from scaffold.model.discovery.targets import Target


def common_directory(paths: Sequence[str], disk: Disk) -> str:
    """Return the common directory of all paths, where the search for the configuration starts."""
    places = [os.path.abspath(path) for path in paths]
    return os.path.commonpath(
        [place if disk.is_directory(place) else os.path.dirname(place) for place in places]
    )


def find_targets(options: argparse.Namespace, session: Session, disk: Disk | None) -> list[Target]:
    """Find the packages; add a note on excluded ones to the report."""
    from scaffold.model.discovery import targets as discovery
    from scaffold.reporters.summary import count

    adjustments = session.adjustments
    if adjustments.foreign is not None:
        adjustments.foreign.packages.clear()  # of an earlier search, for another distribution
    excluded: set[str] = set()
    targets = discovery.find(
        options.paths,
        disk,
        whole_packages=options.whole_packages,
        exclusion=adjustments.exclusion,
        skipped=excluded,
        foreign=adjustments.foreign,
        policy=options.policy,
    )
    if adjustments.exclusion.patterns:
        packages = sum(map(os.path.isdir, excluded))
        files = len(excluded) - packages
        for target in targets:
            files += sum(
                adjustments.excludes(target.package, path) for path in target.package.files
            )
        parts = [count(packages, "package")] if packages else []
        parts += [count(files, "file")] if files or not packages else []
        origin = adjustments.exclusion.origin
        options.notes += (f"excluded by {os.path.relpath(origin)}: {', '.join(parts)}",)
    return targets


def foreign_note(session: Session, results: Sequence[Result]) -> tuple[str, ...]:
    """Return the note about skipped foreign files, if there are any."""
    from scaffold.model.discovery.foreign import ENVIRONMENTS, WHERE
    from scaffold.reporters.summary import count

    foreign = session.adjustments.foreign
    packages = foreign.packages if foreign is not None else []
    files = [kind for result in results for kind in result.foreign]
    parts: list[str] = []
    for kind, where in WHERE.items():
        numbers = ((packages.count(kind), "package"), (files.count(kind), "file"))
        shown = [count(number, noun) for number, noun in numbers if number]
        parts += [f"{' and '.join(shown)} {where}"] if shown else []
    parts[-1:] = [f"{part} (--include-all checks them)" for part in parts[-1:]]
    environments = files.count(ENVIRONMENTS)
    parts += [count(environments, "virtual environment")] if environments else []
    return (f"excluded by default: {', '.join(parts)}",) if parts else ()


def note_unfinished(targets: Sequence[Target]) -> bool:
    """Note the packages that an interrupted run was changing; return whether there are any."""
    from scaffold.cli import writing

    roots = [target.package.root for target in targets if target.package.root is not None]
    unfinished = [root for root in roots if writing.note_unfinished(root)]
    return bool(unfinished)
