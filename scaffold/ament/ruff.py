"""Runs ruff in the background and reads its diagnostics.

It makes two passes over the same files: one for stable rules and one for the whitespace rules of
pycodestyle, which need ``preview``; that would change the findings of the stable rules. ruff reads
no configuration of the user.
"""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from scaffold import distributions
from scaffold.ament.finding import Finding, Replacement
from scaffold.errors import EnvironmentMissingError
from scaffold.programs import bundled
from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from typing import Any

STABLE = "E401,E7,E9,W2,W605,F,C4,Q"
PREVIEW = "E1,E2,E3,E502,W391"
PREVIEW_OFF = "E101,E204,E241,E242"

_COMMON = (
    "check",
    "--isolated",
    "--no-cache",
    "--quiet",
    "--exit-zero",
    "--ignore-noqa",
    "--output-format=json",
    "--no-respect-gitignore",
    "--line-length=99",
)

PASSES = (
    (
        *_COMMON,
        "--no-preview",
        f"--select={STABLE}",
        "--ignore=C420,Q004",
        "--config=lint.dummy-variable-rgx='^_$'",
        "--config=lint.flake8-quotes.inline-quotes='single'",
    ),
    (*_COMMON, "--preview", f"--select={PREVIEW}", f"--ignore={PREVIEW_OFF}"),
)


def passes() -> Iterator[Sequence[str]]:
    """Yield the arguments of both passes, for the syntax of the target's Python."""
    version = distributions.target().python_version.replace(".", "")
    for command, *arguments in PASSES:
        yield (command, f"--target-version=py{version}", *arguments)


MAX_ARGUMENTS = 100_000
"""The maximum size of file names for one process; the system limit is at least 128 KiB."""
MOST_OF_A_LINE = 200
"""The maximum number of findings of one code on one line, of which one is shown."""


class RuffDiagnostic(NamedTuple):
    """One finding of ruff; the code is empty for a syntax error."""

    code: str
    line: int
    column: int
    end_line: int
    end_column: int
    message: str
    fix: tuple[Replacement, ...]
    fix_title: str
    fix_is_unsafe: bool = False


class Run:
    """Both passes over some files, started by the constructor."""

    def __init__(self, files: Sequence[str]) -> None:
        self._chunks = _chunked(files)
        self._running = self._start(self._chunks[0]) if self._chunks else []

    def results(self) -> Mapping[str, list[RuffDiagnostic]]:
        """Wait for ruff, and return its diagnostics by file.

        Raises:
            EnvironmentMissingError: ruff does not run.
        """
        result: dict[str, list[RuffDiagnostic]] = {}
        try:
            for at, chunk in enumerate(self._chunks):
                if at:
                    self._running = self._start(chunk)
                for arguments in passes():
                    output = _collect(*self._running.pop(0))
                    answer = (
                        _check_by_bisection(arguments, chunk) if output is None else _parse(output)
                    )
                    for path, diagnostic in answer:
                        result.setdefault(path, []).append(diagnostic)
        finally:
            self.close()
        return result

    def close(self) -> None:
        """End the processes that are still running."""
        while self._running:
            process, pipe = self._running.pop()
            os.close(pipe)
            os.waitpid(process, 0)

    @staticmethod
    def _start(chunk: Sequence[str]) -> list[tuple[int, int]]:
        return [_spawn([*arguments, "--", *chunk]) for arguments in passes()]


def _check_by_bisection(
    arguments: Sequence[str], files: Sequence[str]
) -> Iterator[tuple[str, RuffDiagnostic]]:
    """Check files of which one crashes ruff, by bisection, so that the others are still checked."""
    if len(files) == 1:
        yield files[0], RuffDiagnostic("", 1, 1, 1, 1, "nested too deeply for its linters", (), "")
        return
    middle = len(files) // 2
    for half in (files[:middle], files[middle:]):
        output = _collect(*_spawn([*arguments, "--", *half]))
        yield from _check_by_bisection(arguments, half) if output is None else _parse(output)


def _chunked(files: Sequence[str]) -> list[Sequence[str]]:
    chunks: list[Sequence[str]] = []
    start = size = 0
    for at, path in enumerate(files):
        size += len(path) + 9
        if size > MAX_ARGUMENTS and at > start:
            chunks.append(files[start:at])
            start, size = at, len(path)
    if start < len(files):
        chunks.append(files[start:])
    return chunks


def _spawn(arguments: Sequence[str]) -> tuple[int, int]:
    """Start ruff; return its process id and the pipe that it writes to."""
    program = executable()
    environment = {key: value for key, value in os.environ.items() if not key.startswith("RUFF_")}
    reading, writing = os.pipe()
    os.set_inheritable(writing, False)  # noqa: FBT003  the function takes no keyword
    actions = [
        (os.POSIX_SPAWN_DUP2, writing, 1),
        (os.POSIX_SPAWN_OPEN, 2, os.devnull, os.O_WRONLY, 0o666),
        (os.POSIX_SPAWN_OPEN, 0, os.devnull, os.O_RDONLY, 0o666),
    ]
    try:
        process = os.posix_spawn(program, [program, *arguments], environment, file_actions=actions)
    except OSError as error:
        os.close(reading)
        raise EnvironmentMissingError(f"ruff cannot be started: {error}") from error
    finally:
        os.close(writing)
    return process, reading


def _collect(process: int, pipe: int) -> bytes | None:
    """Wait for ruff and return what it wrote; ``None`` if its stack overflowed.

    Raises:
        EnvironmentMissingError: it failed otherwise.
    """
    parts: list[bytes] = []
    while part := os.read(pipe, 1 << 20):
        parts.append(part)
    os.close(pipe)
    _, status = os.waitpid(process, 0)
    output = b"".join(parts)
    code = os.waitstatus_to_exitcode(status)
    if code in (-signal.SIGABRT, -signal.SIGSEGV):
        return None
    if code not in (0, 1) or not output.lstrip().startswith(b"["):
        raise EnvironmentMissingError(
            f"{executable()} failed (exit status {code}); is it ruff 0.17?"
        )
    return output


def _parse(output: bytes) -> Iterator[tuple[str, RuffDiagnostic]]:
    if output.strip() == b"[]":
        # Most files are clean, and importing json takes as long as running ruff.
        return
    import json

    counts: dict[tuple[str, str, int], int] = {}
    for entry in json.loads(output):
        start, end = entry["location"], entry["end_location"]
        key = (entry["filename"], entry["code"], start["row"])
        counts[key] = count = counts.get(key, 0) + 1
        if count > MOST_OF_A_LINE:
            continue
        fix = entry["fix"]
        edits: tuple[Replacement, ...] = ()
        if fix and fix["applicability"] in ("safe", "unsafe"):
            edits = tuple(_replacement(edit) for edit in fix["edits"])
        yield (
            entry["filename"],
            RuffDiagnostic(
                _code(entry["code"]),
                start["row"],
                start["column"],
                end["row"],
                end["column"],
                entry["message"],
                edits,
                fix["message"] or "" if fix else "",
                bool(fix) and fix["applicability"] == "unsafe",
            ),
        )


def _code(code: str | None) -> str:
    """Return the code; empty for a syntax error, which ruff gives a name instead."""
    return code if code and code[0].isupper() else ""


def _replacement(edit: Mapping[str, Any]) -> Replacement:
    start, end = edit["location"], edit["end_location"]
    return start["row"], start["column"], end["row"], end["column"], edit["content"]


_FOUND: list[str] = []


def executable() -> str:
    """Return the ruff program that belongs to the running Python, else the one on the PATH.

    Raises:
        EnvironmentMissingError: there is none.
    """
    if not _FOUND:
        _FOUND.append(_find())
    return _FOUND[0]


def _find() -> str:
    program = bundled.find("ruff")
    if program is None:
        raise EnvironmentMissingError("ruff is not installed; pip install 'ruff>=0.17.5,<0.18'")
    return program


def identity() -> str:
    """Return a value that changes when another ruff is installed."""
    status = os.stat(executable())
    return f"{executable()}:{status.st_size}:{status.st_mtime_ns}"


def plain(diagnostic: RuffDiagnostic) -> Finding:
    """Return a finding of ruff unchanged."""
    return Finding(
        diagnostic.code,
        diagnostic.line,
        diagnostic.column,
        worded(diagnostic.message),
        diagnostic.end_line,
        diagnostic.end_column,
        diagnostic.fix,
        diagnostic.fix_title,
        fix_is_unsafe=diagnostic.fix_is_unsafe,
    )


def worded(message: str) -> str:
    """Return a message of ruff in our form: lower case start, no period at the end."""
    message = message.rstrip(".")
    return message[:1].lower() + message[1:] if message[1:2].islower() else message
