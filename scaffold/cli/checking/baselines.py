"""``check --baseline`` and ``check --write-baseline``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from scaffold.cli import terminal
from scaffold.errors import InputError

if TYPE_CHECKING:
    import argparse
    from collections.abc import Sequence

    from scaffold.check.result import Result
    from scaffold.check.session import Session
    from scaffold.files.disk import Disk
    from scaffold.model.discovery.targets import Target


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Define the flags."""
    group = parser.add_argument_group("accepted findings")
    group.add_argument(
        "--write-baseline",
        metavar="FILE",
        help="write all findings to a file instead of reporting them",
    )
    group.add_argument(
        "--baseline",
        metavar="FILE",
        help="report only findings that are not in this file, and count only these for the exit "
        "code; --fix fixes the others as well",
    )


def validate(options: argparse.Namespace, disk: Disk) -> None:
    """Reject conflicting flags, and read the baseline before the check.

    Args:
        options: The flags of `check`; the entries are stored here.
        disk: Records the content of the baseline.

    Raises:
        InputError: flags contradict each other, or there is no such baseline.
    """
    options.accepted = None
    if options.write_baseline is not None:
        for flag in ("baseline", "fix", "diff", "reference", "stdin_filename", "output_file"):
            if getattr(options, flag):
                name = flag.replace("_", "-")
                raise InputError(f"--write-baseline writes all findings: omit --{name}")
    elif options.baseline is not None:
        from scaffold.reporters import baseline

        options.accepted = baseline.read(options.baseline, disk)


def write(options: argparse.Namespace, results: Sequence[Result]) -> int:
    """Write the baseline; return the exit code.

    Raises:
        InputError: the file cannot be written.
    """
    from scaffold.check.rules.engine_rules import RuleCrashed
    from scaffold.cli import reports
    from scaffold.cli.exit_codes import CLEAN, INTERNAL_ERROR
    from scaffold.reporters import baseline
    from scaffold.reporters.summary import count

    path = options.write_baseline
    reports.write_file(path, baseline.text(results).encode("utf-8", "replace"), "--write-baseline")
    diagnostics = [item for result in results for item in result.diagnostics]
    crashes = sum(item.code == RuleCrashed.code for item in diagnostics)
    terminal.show(f"{count(len(diagnostics) - crashes, 'finding')} written to {path}")
    return INTERNAL_ERROR if crashes else CLEAN


def hide(
    options: argparse.Namespace,
    results: Sequence[Result],
    targets: Sequence[Target],
    session: Session,
) -> list[Result]:
    """Return results without the findings of the baseline, and add a note to the report."""
    if options.accepted is None:
        return [*results]
    from scaffold.reporters import baseline

    kept, note = baseline.hide(options.accepted, results, targets, session, options.baseline)
    options.notes += (note,)
    return kept
