"""Building packages with colcon."""

from __future__ import annotations

import asyncio
import glob
import os
import shutil
import time
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from scaffold import lazy_re
from scaffold.model.package import Package as Source
from scaffold.smoke.environment import Environment
from scaffold.smoke.processes import output, process
from scaffold.smoke.processes.process import Origin
from scaffold.smoke.result import Build

_COMPILED = (".c", ".cc", ".cpp", ".cxx", ".h", ".hpp", ".msg", ".srv", ".action", ".idl")
"""Files that need a compiler, or from which such files are generated."""

_INCLUDES = Path(__file__).parents[1] / "embedded" / "includes.cmake"

_JOB = lazy_re.compile(
    r"\[(?P<time>[\d.]+)\] \((?P<name>[^)]*)\) "
    r"Job(?P<what>Queued|Started|Ended|Skipped)(?P<rest>.*)"
)
_REPEAT_STARTS = "--- stderr: "
_REPEAT_ENDS = "---"
"""The lines around package logs that colcon repeats on the console."""
_SUCCESS = lazy_re.compile(r"'rc': 0\b")


@dataclass(frozen=True)
class Layout:
    """The directories in which colcon builds and installs."""

    build: Path
    install: Path
    log: Path

    @classmethod
    def below(cls, root: Path) -> Layout:
        """Return the layout of a workspace."""
        return cls(root / "build", root / "install", root / "log")


async def build(
    environment: Environment,
    packages: Sequence[Source],
    layout: Layout,
    scratch: Path,
    *,
    origin: Origin,
    timeout: float,
    with_tests: bool = False,
    done: dict[str, Build] | None = None,
) -> dict[str, Build]:
    """Build packages; return the results by name.

    Colcon is started again for packages that were not reached because another one made it fail.

    Args:
        environment: The ROS 2 to build with.
        packages: The packages, which are built in place; nothing is written to them.
        layout: The directories for build, install and log.
        scratch: A directory for the output of colcon itself.
        origin: The run that it belongs to.
        timeout: Seconds after which the build is aborted.
        with_tests: Whether tests are built as well.
        done: Receives the results, also of an interrupted build.
    """
    deadline = time.monotonic() + timeout
    done = {} if done is None else done
    left, latest = [*packages], layout.log / "latest_build"
    while left:
        before = _resolved(latest)
        try:
            build_output, exit_code, left_running = await _run(
                command(environment, left, layout, with_tests=with_tests),
                variables(environment, scratch),
                scratch / "colcon",
                origin,
                deadline,
            )
        except asyncio.CancelledError:
            if _resolved(latest) != before:
                log = _Log.read(latest, "", succeeded=False)
                done.update({p.name: log.result(p) for p in left if log.has_ended(p.name)})
            raise
        if exit_code is None:
            build_output += f"\nthe build did not finish within {timeout:g} s\n"
        log = _Log.read(latest, build_output, succeeded=exit_code == 0, left_running=left_running)
        later = [] if exit_code is None else _left_for_later(left, log)
        done.update({item.name: log.result(item) for item in left if item not in later})
        left = later
    return done


def _left_for_later(packages: Sequence[Source], log: _Log) -> list[Source]:
    """Return the packages that colcon did not reach because another one made it fail."""
    later = [package for package in packages if log.had_no_turn(package.name)]
    return later if len(later) < len(packages) else []


def _resolved(path: Path) -> str:
    return os.path.realpath(path)


async def _run(
    command: list[str], variables: Mapping[str, str], out: Path, origin: Origin, deadline: float
) -> tuple[str, int | None, list[str]]:
    """Return the output of colcon, its exit code, and its remaining processes.

    The exit code is ``None`` after a timeout.
    """
    run = await process.start(command, variables, out, origin)
    try:
        in_time = await run.ended_within(deadline - time.monotonic())
        left_running = await run.finish() if in_time else []
    finally:
        await run.close()
    return (
        output.read(run.out) + output.read(run.err),
        run.exit_code if in_time else None,
        left_running,
    )


def command(
    environment: Environment,
    packages: Sequence[Source],
    layout: Layout,
    *,
    with_tests: bool = False,
) -> list[str]:
    """Return the command line of colcon."""
    merged = layout.install / ".colcon_install_layout"
    is_merged = merged.is_file() and merged.read_text(encoding="utf-8").strip() == "merged"
    return [
        environment.colcon,
        "--log-base",
        str(layout.log),
        "build",
        "--paths",
        *(glob.escape(os.path.realpath(package.directory)) for package in packages),
        "--build-base",
        str(layout.build),
        "--install-base",
        str(layout.install),
        *(["--merge-install"] if is_merged else []),
        "--continue-on-error",
        "--cmake-args",
        f"-DBUILD_TESTING={'ON' if with_tests else 'OFF'}",
        *_cmake_arguments(environment, packages),
    ]


def variables(environment: Environment, scratch: Path) -> dict[str, str]:
    """Return the variables of the build."""
    made = {
        **environment.variables,
        # Defaults and mixins of the user would change the build.
        "COLCON_HOME": str(scratch / "colcon"),
        # setup.py may import modules next to it: nothing is written to the sources.
        "PYTHONDONTWRITEBYTECODE": "1",
    }
    path = environment.variables.get("PATH")
    if not shutil.which("make", path=path) and shutil.which("ninja", path=path):
        made.setdefault("CMAKE_GENERATOR", "Ninja")
    return made


def _cmake_arguments(environment: Environment, packages: Sequence[Source]) -> Iterator[str]:
    if environment.kind == "wheels":
        # Their CMake is newer than that of Jazzy and has more warnings.
        yield "-DCMAKE_WARN_DEPRECATED=OFF"
    if any(path.endswith(_COMPILED) for package in packages for path in package.files):
        if environment.kind == "wheels":
            yield f"-DCMAKE_PROJECT_INCLUDE={_INCLUDES}"
        return
    # `project(name)` asks for two compilers that a package of Python never calls.
    stand_in = shutil.which("true") or "true"
    for language, variable, names in (
        ("C", "CC", ("cc", "gcc", "clang")),
        ("CXX", "CXX", ("c++", "g++", "clang++")),
    ):
        if not _has_compiler(environment.variables, variable, names):
            # With `project(name NONE)` both are unused, which needs no warning.
            yield "--no-warn-unused-cli"
            yield f"-DCMAKE_{language}_COMPILER={stand_in}"
            yield f"-DCMAKE_{language}_COMPILER_FORCED=1"


def _has_compiler(variables: Mapping[str, str], variable: str, names: tuple[str, ...]) -> bool:
    if variables.get(variable):
        return True
    path = variables.get("PATH")
    return any(shutil.which(name, path=path) for name in names)


def without_repeats(console: str) -> str:
    """Return the output of colcon itself, without the repeated logs of packages."""
    lines = console.splitlines(keepends=True)
    ends = {index for index, line in enumerate(lines) if line.rstrip("\n") == _REPEAT_ENDS}
    last_end = max(ends, default=-1)
    kept: list[str] = []
    is_repeat = False
    for index, line in enumerate(lines):
        if not is_repeat and line.startswith(_REPEAT_STARTS) and index < last_end:
            is_repeat = True
        if not is_repeat:
            kept.append(line)
        elif index in ends:
            is_repeat = False
    return "".join(kept)


@dataclass
class _Job:
    queued: str = ""
    """The first message of colcon about it, with its dependencies in quotes."""
    started: float = 0.0
    ended: float | None = None
    succeeded: bool = False
    skipped: bool = False


@dataclass(frozen=True)
class _Log:
    """The output of one run of colcon."""

    directory: Path
    jobs: Mapping[str, _Job] | None
    """The jobs by package; ``None`` if colcon lacks colcon-output."""
    console: str
    """The stdout and stderr of colcon itself."""
    succeeded: bool
    left_running: tuple[str, ...] = ()
    """Processes that survived the build."""

    @classmethod
    def read(
        cls, directory: Path, text: str, *, succeeded: bool, left_running: Iterable[str] = ()
    ) -> _Log:
        events = directory / "events.log"
        if not events.exists():
            return cls(directory, None, without_repeats(text), succeeded, tuple(left_running))
        jobs: dict[str, _Job] = {}
        for line in output.read(events).splitlines():
            event = _JOB.match(line)
            if event is None:
                continue
            job = jobs.setdefault(event["name"], _Job())
            if event["what"] == "Queued":
                job.queued = event["rest"]
            elif event["what"] == "Started":
                job.started = float(event["time"])
            elif event["what"] == "Ended":
                job.ended = float(event["time"])
                job.succeeded = bool(_SUCCESS.search(event["rest"]))
            else:
                job.skipped = True
        return cls(directory, jobs, without_repeats(text), succeeded, tuple(left_running))

    def has_ended(self, name: str) -> bool:
        """Return whether the build of a package ended."""
        job = (self.jobs or {}).get(name)
        return job is not None and job.ended is not None

    def had_no_turn(self, name: str) -> bool:
        """Return whether the build ended before this package for an unrelated reason."""
        job = (self.jobs or {}).get(name)
        return job is not None and job.skipped and not self._failed_dependencies(job)

    def result(self, package: Source) -> Build:
        name = package.name
        written = output.read(self.directory / name / "stdout_stderr.log")
        of_colcon = output.complaints(self.console, os.path.realpath(package.directory))
        left = (f"left a process running: {command}" for command in self.left_running)
        warnings = (*of_colcon, *output.warnings(written), *left)
        if self.jobs is None:
            errors = () if self.succeeded else tuple(output.errors(self.console))
            return Build(ok=self.succeeded, errors=errors, warnings=warnings)
        job = self.jobs.get(name)
        if job is None:
            # Also if colcon failed before it started: then it reports the reason.
            why = [] if self.succeeded else output.errors(self.console)
            return Build(ok=False, errors=("not built: colcon does not find the package", *why))
        seconds = 0.0 if job.ended is None else job.ended - job.started
        errors = () if job.succeeded else tuple(self._errors(job, written))
        return Build(ok=job.succeeded, seconds=seconds, errors=errors, warnings=warnings)

    def _errors(self, job: _Job, written: str) -> list[str]:
        failed = self._failed_dependencies(job)
        if failed:
            return [f"not built: it depends on {', '.join(failed)}, which failed"]
        # A broken setup.py makes colcon itself fail, which then has the reason.
        has_reason = written.strip() and job.ended and output.PASSED_ON not in written
        return output.errors(written if has_reason else self.console)

    def _failed_dependencies(self, job: _Job) -> list[str]:
        return [
            name
            for name, other in (self.jobs or {}).items()
            if other.ended is not None and not other.succeeded and f"'{name}'" in job.queued
            if other is not job
        ]
