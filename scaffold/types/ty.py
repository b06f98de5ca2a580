"""Runs ty, a type checker, in the background and parses its output.

ty runs in a directory that contains only the files written for it, with its own configuration and
environment: of the user's files, it reads only those to check.
"""

from __future__ import annotations

import os
import selectors
import signal
import time
from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache

from scaffold import distributions, lazy_re
from scaffold.errors import ScaffoldError
from scaffold.files import cache
from scaffold.files.disk import digest
from scaffold.programs import bundled
from scaffold.record import NamedTuple

VERSION = "0.0.105"
"""The version whose messages the rules parse; pinned in pyproject.toml as well."""
SECONDS = 60.0
"""The timeout for ty after everything else is done; the largest workspaces take 8 seconds."""
_VERSIONS = "types_programs"
"""The kind of cached files that tell which programs have that version."""
_MOST_VERSIONS = 16
MAX_OUTPUT = 64_000_000
MOST_CRASHES = 40
"""The maximum number of crashes in one run, while searching for the file that causes them."""
MAX_ARGUMENTS = 100_000
"""The maximum size of file names for one process; the system allows at least 128 KiB."""

KINDS = (
    "import-not-found",
    "missing-module-member",
    "missing-attribute",
    "missing-argument",
    "too-many-positional-arguments",
    "unknown-argument",
    "parameter-already-assigned",
    "positional-only-parameter-as-kwarg",
    "invalid-argument-type",
    "no-matching-overload",
    "invalid-assignment",
    "unsupported-operator",
    "not-callable",
    "not-subscriptable",
    "not-iterable",
    "invalid-await",
    "invalid-context-manager",
    "invalid-raise",
    "redundant-condition",
    "unsupported-bool-conversion",
)
"""The rules of ty that our rules are based on; all others are off."""

_NARROWED = lazy_re.compile(r" & ~Always(?:Falsy|Truthy)")
"""Matches what a condition narrowed a type to, such as a non-empty string."""
CONFIGURATION = "ty.toml"
LIBRARY = "lib"
"""Where the importable packages of the workspace are, relative to the project."""


class UnavailableError(ScaffoldError):
    """Types cannot be checked; the message says why."""


class CrashError(UnavailableError):
    """The type checker failed, possibly because of one of the files."""


class TyDiagnostic(NamedTuple):
    """One report of ty; lines and columns count from 1."""

    kind: str
    line: int
    column: int
    end_line: int
    end_column: int
    message: str


class Run:
    """A run over some files of a project, started on construction.

    Args:
        project: The directory with the files and the configuration.
        environment: The Python environment with the stubs.
        files: Paths relative to the project.

    Raises:
        UnavailableError: ty cannot be started or has another version.
        OSError: the configuration cannot be written.
    """

    def __init__(self, project: str, environment: str, files: Sequence[str]) -> None:
        self.project = project
        self._environment = environment
        self._chunks = list(_chunks([os.path.join(project, path) for path in files]))
        self._running: _Process | None = None
        self._count = len(files)
        self._crashes = 0
        self._crashed: list[str] = []
        _require_version(identity())
        os.makedirs(os.path.join(project, LIBRARY), exist_ok=True)
        with open(os.path.join(project, CONFIGURATION), "w", encoding="utf-8") as file:
            file.write(_configuration())
        self._start(self._chunks[0])

    def results(self) -> Mapping[str, list[TyDiagnostic]]:
        """Wait, and return the reports by file.

        Raises:
            UnavailableError: ty fails or hangs.
        """
        result: dict[str, list[TyDiagnostic]] = {}
        try:
            for at, chunk in enumerate(self._chunks):
                if at:
                    self._start(chunk)
                for path, diagnostic in self._reported(chunk):
                    place = os.path.relpath(os.path.abspath(path), self.project)
                    result.setdefault(place, []).append(diagnostic)
        finally:
            self.close()
        return result

    def _reported(self, files: Sequence[str]) -> list[tuple[str, TyDiagnostic]]:
        """Return the reports about files; a file that crashes ty does not affect the others."""
        assert self._running is not None  # noqa: S101  it was started for these files
        try:
            return list(_parse(self._running.output(SECONDS)))
        except CrashError:
            self._crashes += 1
            if len(files) == 1 or self._crashes > MOST_CRASHES:
                if self._crashes > MOST_CRASHES or len(self._crashed) + 1 == self._count:
                    raise
                self._crashed.append(files[0])
                return []
        result: list[tuple[str, TyDiagnostic]] = []
        middle = len(files) // 2
        for half in (files[:middle], files[middle:]):
            self._start(half)
            result += self._reported(half)
        return result

    def close(self) -> None:
        """End the process if it still runs."""
        if self._running is not None:
            self._running.close()
            self._running = None

    def _start(self, files: Sequence[str]) -> None:
        options = {
            "--output-format": "gitlab",
            "--color": "never",
            "--config-file": os.path.join(self.project, CONFIGURATION),
            "--project": self.project,
            "--python": self._environment,
        }
        words = [word for option in options.items() for word in option]
        self._running = _Process(["check", "--exit-zero", *words, "--", *files], self.project)


class _Process:
    """A running ty."""

    def __init__(self, arguments: Sequence[str], directory: str) -> None:
        program = executable()
        # Nothing else of the user's environment: variables may name configurations.
        environment = {
            "HOME": directory,
            "XDG_CONFIG_HOME": directory,
            # The workers of this tool need the other cores, and waiting threads cost time as well.
            "TY_MAX_PARALLELISM": str(max(len(os.sched_getaffinity(0)) // 2, 1)),
        }
        reading, writing = os.pipe()
        actions = [
            (os.POSIX_SPAWN_DUP2, writing, 1),
            (os.POSIX_SPAWN_OPEN, 2, os.devnull, os.O_WRONLY, 0o666),
            (os.POSIX_SPAWN_OPEN, 0, os.devnull, os.O_RDONLY, 0o666),
        ]
        try:
            self._id = os.posix_spawn(
                program, [program, *arguments], environment, file_actions=actions
            )
        except OSError as error:
            os.close(reading)
            raise UnavailableError(f"ty cannot be started: {error}") from error
        finally:
            os.close(writing)
        self._pipe = reading

    def output(self, seconds: float) -> bytes:
        """Wait for the end, and return the output.

        Raises:
            UnavailableError: it fails, takes too long, or writes too much.
        """
        output = _read(self._pipe, seconds)
        if output is None:
            self.close()
            raise UnavailableError(f"ty did not finish within {seconds:g} s")
        code = os.waitstatus_to_exitcode(self._wait())
        if code != 0:
            raise CrashError(f"ty failed (exit status {code})")
        return output

    def close(self) -> None:
        """Stop the process; does nothing if it has ended."""
        if self._id:
            os.kill(self._id, signal.SIGKILL)
            self._wait()

    def _wait(self) -> int:
        os.close(self._pipe)
        _, status = os.waitpid(self._id, 0)
        self._id = 0
        return status


def _read(pipe: int, seconds: float) -> bytes | None:
    """Return the whole output of a pipe; ``None`` if it takes too long or is too large."""
    parts: list[bytes] = []
    total = 0
    deadline = time.monotonic() + seconds
    with selectors.DefaultSelector() as selector:
        selector.register(pipe, selectors.EVENT_READ)
        while total <= MAX_OUTPUT and selector.select(max(deadline - time.monotonic(), 0)):
            part = os.read(pipe, 1 << 20)
            if not part:
                return b"".join(parts)
            parts.append(part)
            total += len(part)
    return None


def _parse(output: bytes) -> Iterator[tuple[str, TyDiagnostic]]:
    if output.strip() == b"[]":
        return  # most files have no reports, and json takes long to import
    import json

    try:
        for entry in json.loads(output):
            place = entry["location"]["positions"]
            begin, end = place["begin"], place["end"]
            kind = entry["check_name"]
            if kind == "panic":  # in one file, and the others were skipped
                raise CrashError(f"ty failed: {entry['description']}")
            yield (
                entry["location"]["path"],
                TyDiagnostic(
                    kind,
                    *(begin["line"], begin["column"]),
                    *(end["line"], end["column"]),
                    _NARROWED.sub("", entry["description"].removeprefix(f"{kind}: ")),
                ),
            )
    except (ValueError, KeyError, TypeError) as error:
        raise UnavailableError(f"the output of ty cannot be read: {error!r}") from error


def _chunks(files: Sequence[str]) -> Iterator[list[str]]:
    chunk: list[str] = []
    size = 0
    for path in files:
        chunk.append(path)
        size += len(os.fsencode(path)) + 9
        if size > MAX_ARGUMENTS:
            yield chunk
            chunk, size = [], 0
    if chunk:
        yield chunk


def _configuration() -> str:
    rules = "".join(f'{kind} = "error"\n' for kind in KINDS)
    return f"""\
[environment]
python-version = "{distributions.target().python_version}"
python-platform = "linux"
root = ["{LIBRARY}"]

[src]
respect-ignore-files = false

[rules]
all = "ignore"
{rules}"""


_FOUND: dict[str, str] = {}


def executable() -> str:
    """Return the program.

    Raises:
        UnavailableError: there is none.
    """
    if "ty" not in _FOUND:
        program = bundled.find("ty")
        if program is None:
            raise UnavailableError(f"ty is not installed; pip install 'ty=={VERSION}'")
        _FOUND["ty"] = program
    return _FOUND["ty"]


@lru_cache(maxsize=1)
def _require_version(identity: str) -> None:
    """Check that the program has the expected version, once for each program.

    Raises:
        UnavailableError: it has another version.
    """
    kept = cache.directory(_VERSIONS)
    place = kept and os.path.join(kept, digest(identity.encode("utf-8", "surrogateescape")))
    if place and cache.read_sealed(place, VERSION.encode()) is not None:
        return
    output = _Process(["--version"], os.sep).output(SECONDS)
    version = (output.decode(errors="replace").split() or [""])[-1]
    if output.split()[:2] != [b"ty", VERSION.encode()]:
        raise UnavailableError(
            f"{executable()} is version {version or 'unknown'}; pip install 'ty=={VERSION}'"
        )
    if kept and place and cache.write_sealed(place, VERSION.encode(), b""):
        cache.trim(kept, _MOST_VERSIONS)


def identity() -> str:
    """Return a signature that changes when another ty is installed.

    Raises:
        UnavailableError: there is none.
    """
    try:
        status = os.stat(executable())
    except OSError as error:
        raise UnavailableError(f"ty cannot be started: {error}") from error
    return f"{executable()}:{status.st_size}:{status.st_mtime_ns}"
