"""The only access to standard output and error; ``tests/cli/test_terminal.py`` ensures that.

Text from checked files is escaped (``scaffold.printable``). If standard output cannot be written,
the run ends; if standard error cannot be written, only the messages are lost.
"""

from __future__ import annotations

import os
import sys

from scaffold.errors import EnvironmentMissingError
from scaffold.printable import json_text, printable, printable_lines, write_lines

OUTPUT = "standard output"

_STREAMS = (0, 1, 2)
"""The file descriptors of standard input, output and error."""


def prepare() -> None:
    """Make sure that there are standard streams.

    A closed one is opened on /dev/null: a file opened later would get its descriptor, and
    messages would be written to that file.

    Raises:
        EnvironmentMissingError: standard output is closed.
    """
    was_closed = [number for number in _STREAMS if _is_closed(number)]
    for _ in was_closed:
        os.open(os.devnull, os.O_RDWR)  # gets the lowest free number
    if sys.stdin is None:
        sys.stdin = open(os.devnull, encoding="utf-8")  # noqa: SIM115  until the process ends
    if sys.stderr is None:
        sys.stderr = open(os.devnull, "w", encoding="utf-8")  # noqa: SIM115  likewise
    if sys.stdout is None:
        sys.stdout = open(os.devnull, "w", encoding="utf-8")  # noqa: SIM115  likewise
        raise EnvironmentMissingError(f"{OUTPUT} is closed: redirect it to {os.devnull} instead")


def _is_closed(number: int) -> bool:
    try:
        os.fstat(number)
    except OSError:
        return True
    return False


def show(text: str) -> None:
    """Write lines to standard output."""
    write_report(printable_lines(text) + "\n")


def show_json(data: object) -> None:
    """Write data for programs to standard output."""
    write_report(json_text(data) + "\n")


def show_patch(text: str) -> None:
    """Write a patch to standard output; a file gets every character as it is."""
    try:
        write_lines(text, sys.stdout)
    except UnicodeEncodeError:
        write_report(text)
    except OSError as error:
        raise _of_output(error) from error


def write_bytes(data: bytes) -> None:
    """Write the content of a file to standard output, every byte as it is."""
    try:
        sys.stdout.flush()
        sys.stdout.buffer.write(data)
    except OSError as error:
        raise _of_output(error) from error


def write_report(text: str) -> None:
    """Write a report, whose foreign text is already escaped."""
    try:
        try:
            sys.stdout.write(text)
        except UnicodeEncodeError:
            coding = sys.stdout.encoding
            sys.stdout.write(text.encode(coding, "backslashreplace").decode(coding))
    except OSError as error:
        raise _of_output(error) from error


def note(text: str) -> None:
    """Write a note to standard error."""
    say(f"note: {text}")


def warn(text: str) -> None:
    """Write a warning to standard error."""
    say(f"ros2-scaffold: warning: {text}")


def error(text: str) -> None:
    """Write the error that ends the run to standard error."""
    say(f"ros2-scaffold: error: {text}")


def say(text: str) -> None:
    """Write a line to standard error."""
    write_error(printable(text) + "\n")


def say_lines(text: str) -> None:
    """Write lines to standard error."""
    write_error(printable_lines(text) + "\n")


def write_error(text: str) -> None:
    """Write already escaped text to standard error."""
    try:
        sys.stderr.write(text)
        sys.stderr.flush()
    except OSError:
        _give_up(sys.stderr.fileno())


def flush() -> None:
    """Flush the output now, while a failure can still set the exit code."""
    try:
        sys.stdout.flush()
    except OSError as error:
        raise _of_output(error) from error


def settle() -> None:
    """Discard output that cannot be written, so that the process exits cleanly."""
    try:
        sys.stdout.flush()
    except OSError:
        _give_up(sys.stdout.fileno())


def _give_up(number: int) -> None:
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, number)
    os.close(nowhere)


def _of_output(error: OSError) -> OSError:
    error.filename = error.filename or OUTPUT
    return error
