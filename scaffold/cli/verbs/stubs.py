"""``ros2-scaffold stubs [PATH...]``."""

from __future__ import annotations

import argparse
import os
from typing import TYPE_CHECKING

from scaffold import distributions
from scaffold.cli import distro, terminal

if TYPE_CHECKING:
    from collections.abc import Sequence

    from scaffold.model.package import Package
    from scaffold.model.workspace.workspace import Workspace

TYPINGS = "typings"
"""The directory in which Pylance and pyright look for stubs."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Define the flags of the verb."""
    from scaffold.cli import flags

    parser.add_argument(
        "paths",
        nargs="*",
        metavar="PATH",
        help="packages or workspaces whose interfaces get stubs (default: the current directory)",
    )
    parser.add_argument(
        "--output",
        default=TYPINGS,
        metavar="DIR",
        help=f"directory of the stubs (default: {TYPINGS}, where Pylance and pyright look for "
        "them)",
    )
    parser.add_argument(
        "--force", action="store_true", help="overwrite files that this verb did not write"
    )
    parser.add_argument(
        "--distro",
        metavar="NAME",
        help="the ROS 2 distribution (default: what `new --distro` created the package here for, "
        f"the oldest of several, else {distributions.DEFAULT})",
    )
    flags.add_looking(parser)


def run(options: argparse.Namespace) -> int:
    """Write the stubs; return the exit code."""
    from scaffold.cli.exit_codes import CLEAN
    from scaffold.model.workspace.definitions import definitions_for
    from scaffold.types.stubs import typings
    from scaffold.types.stubs.libraries import stub_files

    workspace = _workspace(options.paths or ["."])
    if options.distro is not None:
        distribution = distributions.named(options.distro, distro.FLAG)
    else:
        distribution = (distro.recorded(".") or [distributions.JAZZY])[0]
    with distributions.targeting(distribution):
        stubs = stub_files(distribution, definitions_for(workspace))
    plan = typings.plan(options.output, stubs, force=options.force)
    if options.diff:
        terminal.show_patch(plan.diff())
        return CLEAN
    written, count = plan.changes, len(stubs)
    if not options.dry_run:
        plan.write(force=True)
    verb = "would be written" if options.dry_run else "written"
    terminal.show(f"{options.output}: {count} stubs, {len(written)} {verb}")
    terminal.show(_next_steps(options.output))
    return CLEAN


def _next_steps(output: str) -> str:
    """Return the remaining configuration steps."""
    default = os.path.normpath(output) == TYPINGS
    pyright = (
        "Pylance and pyright read it without configuration"
        if default
        else f'Pylance and pyright need `"stubPath": "{output}"`'
    )
    return f'{pyright}, mypy needs `mypy_path = "{output}"`; others: docs/stubs.md'


def _workspace(paths: Sequence[str]) -> Workspace[Package]:
    from scaffold.errors import InputError
    from scaffold.model.discovery import targets as discovery
    from scaffold.model.workspace.workspace import Workspace

    for path in paths:
        if not os.path.isdir(path):
            raise InputError(f"{path}: no such directory")
    try:
        targets = discovery.find(list(paths))
    except InputError:  # a directory without packages is fine: the libraries have stubs as well
        targets = []
    return Workspace(target.package for target in targets)
