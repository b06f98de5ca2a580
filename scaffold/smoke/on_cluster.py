"""Runs packages on the workers of a cluster, and merges the results."""

from __future__ import annotations

import os
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from signal import Signals

from scaffold.cluster import sources
from scaffold.cluster.client import Done, connected
from scaffold.files.tree import MANIFEST
from scaffold.model.package import Package
from scaffold.reporters.paths import in_repository
from scaffold.smoke.cleanup import leftovers
from scaffold.smoke.cleanup.interruption import InterruptedBySignalError, Interruption
from scaffold.smoke.options import Options, Progress
from scaffold.smoke.result import Build, Executable, PackageResult, Smoke
from scaffold.smoke.selection import with_dependencies
from scaffold.smoke.session import smoke


@dataclass(frozen=True)
class Task:
    """A package to run, with the packages that it needs."""

    name: str
    archives: Mapping[str, bytes]
    """Sources by name of the package."""
    options: Options


@dataclass(frozen=True)
class Outcome:
    """The result of a worker."""

    environment: Mapping[str, str]
    package: PackageResult
    ended_early: str


def run_task(task: Task) -> Outcome:
    """Build and run a package; called on a worker."""
    with leftovers.recorded_run() as run:
        packages = [
            sources.unpack(data, run.scratch / str(number) / name)
            for number, (name, data) in enumerate(task.archives.items())
        ]
        result = smoke(packages, task.options)
        package_of_task = next(package for package in packages if package.name == task.name)
        (own,) = (package for package in result.packages if package.name == task.name)
        executables = tuple(
            _relative(executable, package_of_task) for executable in own.executables
        )
        return Outcome(
            result.environment, replace(own, executables=executables), result.ended_early
        )


def _relative(executable: Executable, package: Package) -> Executable:
    """Return the source path of an executable relative to its package."""
    if not executable.source:
        return executable
    path = os.path.relpath(os.path.abspath(executable.source), package.directory)
    return replace(executable, source=path)


def smoke_on_cluster(
    address: str,
    packages: Sequence[Package],
    options: Options,
    *,
    progress: Progress,
    announce: Progress,
    interruption: Interruption,
) -> Smoke:
    """Run packages on a cluster, each in a task of its own.

    Args:
        address: The address of the scheduler.
        packages: The packages to run, with their dependencies.
        options: The options of each run.
        progress: Called with the current activity.
        announce: Called with each finished package.
        interruption: Handles the signals that end the run.

    Raises:
        EnvironmentMissingError: there is no usable cluster.
    """
    begun = time.monotonic()
    wanted = [package for package in packages if options.runs(package.name)]
    tasks = _tasks(packages, wanted, options)
    done: dict[str, Done[Outcome]] = {}
    ended_early = ""
    with connected(address, announce) as cluster:
        progress(f"running {len(tasks)} packages on {address}")
        try:
            with interruption.at_once():
                for item in cluster.map(run_task, tasks):
                    done[item.name] = item
                    announce(f"{item.name}: {_verdict(item)} ({len(done)} of {len(tasks)})")
        except InterruptedBySignalError as end:
            ended_early = f"interrupted by {Signals(end.number).name}"
    return Smoke(
        environment={
            "kind": _on_workers("kind", done) or "unknown",
            "distribution": _on_workers("distribution", done),
            "prefix": address,
            "rmw": _on_workers("rmw", done) or "unknown",
        },
        packages=tuple(_of_package(package, done.get(package.name)) for package in wanted),
        seconds=time.monotonic() - begun,
        ended_early=ended_early,
    )


def _tasks(
    packages: Sequence[Package], wanted: Sequence[Package], options: Options
) -> dict[str, Task]:
    """Return a task for each package to run, by its name."""
    archives = {package.name: sources.pack(package) for package in packages}
    return {
        package.name: Task(
            package.name,
            {name: archives[name] for name in sorted(with_dependencies(packages, {package.name}))},
            replace(options, run_only=frozenset({package.name})),
        )
        for package in wanted
    }


def _on_workers(key: str, done: Mapping[str, Done[Outcome]]) -> str:
    """Return what the environments of the workers have, separated by commas."""
    return ", ".join(
        sorted({item.result.environment[key] for item in done.values() if item.result})
    )


def _verdict(item: Done[Outcome]) -> str:
    if item.result is None:
        return item.error
    return f"{'ok' if item.result.package.ok else 'not ok'}, on {item.worker}"


def _of_package(package: Package, done: Done[Outcome] | None) -> PackageResult:
    """Return the result of a package with the paths of this machine."""
    manifest = in_repository(package, MANIFEST)
    if done is None:
        build = Build(ok=False, interrupted=True)
        return PackageResult(package.name, build, manifest=manifest, ran=False)
    if done.result is None:
        return PackageResult(package.name, Build(ok=False, errors=(done.error,)), manifest=manifest)
    result = done.result.package
    if done.result.ended_early and result.build.interrupted:
        build = Build(ok=False, errors=(done.result.ended_early,))
        result = replace(result, build=build)
    executables = tuple(
        replace(item, source=in_repository(package, item.source) if item.source else "")
        for item in result.executables
    )
    return replace(result, executables=executables, manifest=manifest, worker=done.worker)
