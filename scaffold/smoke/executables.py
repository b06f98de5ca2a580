"""Runs the executables of packages in parallel, and evaluates each."""

from __future__ import annotations

import asyncio
import os
import time
from collections.abc import Callable, Coroutine, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from signal import Signals
from typing import Any

from scaffold.model.package import Package as Source
from scaffold.reporters.paths import in_repository
from scaffold.smoke import lifecycle
from scaffold.smoke import run as trial
from scaffold.smoke.expectation import Expectation, compare, wrong_rates
from scaffold.smoke.options import Options
from scaffold.smoke.processes.uninterrupted import uninterrupted
from scaffold.smoke.result import Executable, Problem
from scaffold.smoke.run import NodeRun, RunSettings
from scaffold.smoke.scenario import verdicts

Expectations = Mapping[str, Mapping[str, Expectation]]
"""By package and executable."""


class ExecutableRuns:
    """Runs executables, as many in parallel as there are jobs.

    Args:
        plan: The settings common to all runs.
        options: The options of the run.
        expected: The expectations of the executables.
        tell: Called with the current activity.
    """

    def __init__(
        self,
        plan: RunSettings,
        options: Options,
        expected: Expectations,
        tell: Callable[[str], None],
    ) -> None:
        self._plan = plan
        self._options = options
        self._expected = expected
        self._tell = tell
        self._slots = asyncio.Semaphore(options.jobs)
        self._running: set[str] = set()
        self._ended = 0
        self._total = 0

    async def run(self, packages: Sequence[Source], done: dict[str, dict[str, Executable]]) -> None:
        """Run all executables of packages.

        Args:
            packages: The built packages.
            done: Receives the results by package and name, also when the run is interrupted.
        """
        runs = []
        for package in packages:
            of_package = done.setdefault(package.name, {})
            runs += self._of_package(package, of_package)
        self._total = len(runs)
        await _gather(runs)

    def _of_package(
        self, source: Source, done: dict[str, Executable]
    ) -> list[Coroutine[Any, Any, None]]:
        package = source.name
        expected = self._expected[package]
        paths = installed(package, self._plan.variables)
        by_name = {path.name: path for path in paths or ()}
        where = f"in lib/{package}" if paths is not None else "in a package of the ament index"
        runs = []
        for name in sorted({*by_name, *expected}):
            expectation = expected.get(name, Expectation())
            if name not in by_name:
                done[name] = _missing(name, where)
            elif not expectation.scenario.skip:
                done[name] = Executable(name, interrupted=True)  # until it has run
                runs.append(self._run_one(source, by_name[name], expectation, done))
        return runs

    async def _run_one(
        self, source: Source, path: Path, expectation: Expectation, done: dict[str, Executable]
    ) -> None:
        label = f"{source.name}/{path.name}"
        async with self._slots:
            begun = time.monotonic()
            self._tell_running(label, started=True)
            trials = [NodeRun()]
            judged = None
            try:
                await self._run_trials(path, expectation, label, trials)
                judged = _summarize(path.name, trials, expectation)
            finally:
                done[path.name] = replace(
                    judged or _unfinished(path.name, trials[0]),
                    source=in_repository(source, expectation.source) if expectation.source else "",
                    seconds=time.monotonic() - begun,
                )
            self._tell_running(label, started=False)

    async def _run_trials(
        self, path: Path, expectation: Expectation, label: str, trials: list[NodeRun]
    ) -> None:
        """Run an executable once for every signal; the first run is the observed one."""
        first, *others = self._options.signals
        await _observed(self._plan, path, expectation, f"{label}/{first.name}", first, trials)
        for number in others:
            if trials[0].joined:
                run = f"{label}/{number.name}"
                other = await trial.run(self._plan, path, expectation, run, number, brief=True)
                trials.append(other)

    def _tell_running(self, label: str, *, started: bool) -> None:
        (self._running.add if started else self._running.discard)(label)
        self._ended += not started
        if self._running:
            names = ", ".join(sorted(self._running))
            self._tell(f"{self._ended} of {self._total} done, running {names}")


async def _observed(
    plan: RunSettings,
    path: Path,
    expectation: Expectation,
    label: str,
    number: Signals,
    trials: list[NodeRun],
) -> None:
    """Observe an executable, again if its rate is wrong, which may be due to a busy machine."""
    first = await trial.run(plan, path, expectation, label, number, first=trials[0])
    wrong = wrong_rates(expectation, first.observation) if first.stopped_cleanly else []
    if not wrong:
        return
    other = await trial.run(plan, path, expectation, f"{label}-again", number)
    if other.stopped_cleanly and not wrong_rates(expectation, other.observation):
        other.notes.append(f"in the first of two runs only: {wrong[0].message}")
        trials[0] = other


async def _gather(runs: Sequence[Coroutine[Any, Any, None]]) -> None:
    """Run coroutines concurrently; all have ended when this returns or raises.

    ``asyncio.gather`` would go on as soon as the first of them is cancelled.
    """
    tasks = [asyncio.create_task(run) for run in runs]
    if not tasks:
        return
    try:
        await asyncio.wait(tasks, return_when=asyncio.FIRST_EXCEPTION)
    finally:
        for task in tasks:
            task.cancel()
        await uninterrupted(asyncio.wait(tasks))
    for task in tasks:
        task.result()


def installed(package: str, variables: Mapping[str, str]) -> list[Path] | None:
    """Return the executables of a package as ``ros2 run`` finds them; ``None``: no package."""
    for prefix in variables.get("AMENT_PREFIX_PATH", "").split(os.pathsep):
        if not os.path.exists(f"{prefix}/share/ament_index/resource_index/packages/{package}"):
            continue
        result: list[Path] = []
        for parent, directories, names in os.walk(os.path.join(prefix, "lib", package)):
            directories[:] = sorted(name for name in directories if not name.startswith("."))
            paths = (Path(parent, name) for name in sorted(names))
            result += [path for path in paths if os.access(path, os.X_OK)]
        return result
    return None


def _missing(name: str, where: str) -> Executable:
    return Executable(
        name, problems=(Problem(f"ros2 run does not find it: it is declared, but not {where}"),)
    )


def _summarize(name: str, trials: Sequence[NodeRun], expectation: Expectation) -> Executable:
    """Put the runs of an executable together; the first one is the one that was observed."""
    first = trials[0]
    problems = list(first.problems)
    notes = list(first.notes)
    finished = first.stop.signal is None and not first.problems
    if first.joined or finished:
        seen, said = compare(expectation, first.observation, first.seconds, finished=finished)
        problems += seen
        notes += said
        problems += verdicts.problems(expectation.scenario, first.observation)
        problems += lifecycle.problems(first.observation.transitions)
    if finished and not problems:
        notes.append(f"exited on its own after {first.stop.seconds:.1f} s")
    for other in trials[1:]:
        notes += other.notes
        problems += [problem for problem in other.problems if problem not in problems]
    return Executable(
        name=name,
        observation=first.observation,
        stops=tuple(item.stop for item in trials),
        problems=tuple(problems),
        notes=tuple(notes),
    )


def _unfinished(name: str, trial: NodeRun) -> Executable:
    """Return what was seen of an executable until its run was interrupted."""
    return Executable(
        name,
        trial.observation,
        problems=tuple(trial.problems),
        notes=tuple(trial.notes),
        interrupted=True,
    )
