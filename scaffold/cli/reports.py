"""The destination of a report: standard output or a file, and the job summary."""

from __future__ import annotations

import os
import sys
from contextlib import suppress
from io import StringIO
from typing import TYPE_CHECKING

from scaffold.cli import terminal
from scaffold.errors import InputError

if TYPE_CHECKING:
    import argparse
    from collections.abc import Sequence

    from scaffold.check.result import Result
    from scaffold.reporters import ReportOptions

JOB_SUMMARY = "GITHUB_STEP_SUMMARY"
"""The variable with the file for the Markdown summary of a GitHub job."""


def validate(options: argparse.Namespace) -> None:
    """Make sure that a report can be written, before the work starts.

    Raises:
        InputError: it cannot.
    """
    path = options.output_file
    if path is None:
        return
    if options.diff:
        raise InputError("--diff writes a patch to standard output: omit --output-file")
    validate_path(path)


def validate_path(path: str | None) -> None:
    """Make sure that a file can be written.

    Raises:
        InputError: it cannot.
    """
    if path is None:
        return
    if os.path.isdir(path):
        raise InputError(f"--output-file {path}: is a directory, not a file")
    directory = os.path.dirname(path)
    if not os.path.isdir(directory or os.curdir):
        raise InputError(f"--output-file {path}: there is no directory {directory!r}; create it")


def write(
    options: argparse.Namespace, results: Sequence[Result], shown: ReportOptions
) -> str | None:
    """Report results in the requested format, to the requested place.

    Args:
        options: The flags of `check`.
        results: The results of all packages, in the order of the report.
        shown: The results to show.

    Returns:
        The standard output; ``None`` if the run also writes elsewhere.

    Raises:
        InputError: the file cannot be written.
    """
    from scaffold import reporters
    from scaffold.reporters import summary

    path = options.output_file
    output = _Copy(is_terminal=path is None and sys.stdout.isatty())
    reporters.get(options.format)(results, output, shown)
    text = output.getvalue()
    if options.format == "github":
        from scaffold.reporters import github

        add_job_summary(github.job_summary(results, shown))
    for note in separate_notes(options, shown):
        terminal.say(note)
    if path is None:
        terminal.write_report(text)
        return text if options.format != "github" else None
    write_file(path, text.encode("utf-8", "backslashreplace"), "--output-file")
    if not shown.quiet:
        terminal.say(f"{summary.summary(results, shown)}; the report is in {path}")
    return None


def separate_notes(options: argparse.Namespace, shown: ReportOptions) -> Sequence[str]:
    """Return the notes for standard error: those that are not part of the report."""
    is_noted = options.format == "text" and options.output_file is None
    if is_noted or shown.quiet:
        return ()
    is_ignored = options.severity != "info" and options.format != "text"
    ignored = f"note: --severity has no effect: --format {options.format} shows all findings"
    return (*shown.notes, ignored) if is_ignored else shown.notes


def text(results: Sequence[Result], shown: ReportOptions) -> str:
    """Return the report for people, without colors."""
    from scaffold import reporters

    output = _Copy(is_terminal=False)
    reporters.get("text")(results, output, shown)
    return output.getvalue()


class _Copy(StringIO):
    """Standard output that is recorded for the cache."""

    def __init__(self, *, is_terminal: bool) -> None:
        super().__init__()
        self._is_terminal = is_terminal

    def isatty(self) -> bool:
        """Return whether it is a terminal."""
        return self._is_terminal


def add_job_summary(text: str) -> None:
    """Add Markdown to the summary of a job of GitHub, if this is one."""
    path = os.environ.get(JOB_SUMMARY)
    if not path:
        return
    try:
        with open(path, "a", encoding="utf-8", errors="backslashreplace") as file:
            file.write(text)
    except OSError as error:
        terminal.warn(f"cannot write the job summary: {path}: {error.strerror}")


def write_file(path: str, content: bytes, flag: str) -> None:
    """Write a file atomically; write directly to devices.

    Args:
        path: The file.
        content: The content.
        flag: The flag with the file, for messages.

    Raises:
        InputError: the system reports an error.
    """
    from scaffold.files import temporary
    from scaffold.writing import new_files

    target = os.path.realpath(path)
    aside = os.path.join(os.path.dirname(target), temporary.name())
    try:
        if os.path.exists(path) and not os.path.isfile(path):
            with open(path, "wb") as file:
                file.write(content)
            return
        try:
            new_files.write(aside, content, executable=False, like=target, is_durable=False)
            os.replace(aside, target)
        except BaseException:
            with suppress(OSError):
                os.unlink(aside)
            raise
    except OSError as error:
        raise InputError(f"{flag} {path}: {error.strerror or error}") from error
