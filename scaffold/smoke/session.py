"""Builds packages, runs and observes every executable, and says what is wrong."""

from __future__ import annotations

import asyncio
import os
import signal
import time
from collections.abc import Callable, Coroutine, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, TypeVar

from scaffold import distributions
from scaffold.distributions import Distribution
from scaffold.errors import InputError
from scaffold.files.tree import MANIFEST
from scaffold.model.discovery.targets import Target
from scaffold.model.package import Package as Source
from scaffold.reporters.paths import in_repository
from scaffold.smoke import environment as environments
from scaffold.smoke import run as trial
from scaffold.smoke.build import Layout, build
from scaffold.smoke.cleanup import leftovers
from scaffold.smoke.cleanup.interruption import Interruption
from scaffold.smoke.cleanup.leftovers import Run
from scaffold.smoke.cleanup.workspace_lock import WAIT, locked
from scaffold.smoke.embedded.interfaces import provide
from scaffold.smoke.environment import Environment
from scaffold.smoke.expectation import Expectation, compare, wrong_rates
from scaffold.smoke.isolation.station import Stations
from scaffold.smoke.processes import process, supervisor
from scaffold.smoke.result import Build, Executable, PackageResult, Problem, Smoke, Tests
from scaffold.smoke.run import NodeRun, RunSettings
from scaffold.smoke.scenario import verdicts
from scaffold.smoke.scenario.model import FILE, NOTHING, Scenario
from scaffold.smoke.scenario.reader import scenarios
from scaffold.smoke.scenario.verdicts import overridden
from scaffold.smoke.together import run_together

Result = TypeVar("Result")

Progress = Callable[[str], None]
"""Called with what is going on, in a few words."""

_INTERFACES = (".msg", ".srv", ".action", ".idl")
_EARLY_STATIONS = 4
"""Observers that are started during the build; more of them would slow it down."""


@dataclass(frozen=True)
class Options:
    """How a run is done; times are in seconds."""

    duration: float = 5.0
    """Observation after the first sign of life."""
    timeout: float = 20.0
    """From the start of an executable to its first sign of life and to its first messages."""
    build_timeout: float = 900.0
    signals: tuple[signal.Signals, ...] = (signal.SIGINT,)
    workspace: Path | None = None
    """Where build, install and log go; ``None``: into the scratch directory."""
    keep: bool = False
    workspace_wait: float = WAIT
    """For another run in the same workspace to end."""
    jobs: int = 4
    """Executables that run at the same time, each in its own domain."""
    run_only: frozenset[str] | None = None
    """The packages whose executables are run; the others are built, as those need them."""

    test: bool = False
    """Whether the tests of the packages are run as well."""

    together: bool = False
    """Whether all executables of a package are also run in one domain."""

    wanted: Sequence[Distribution] = ()
    """The distributions that count; any without one."""

    def runs(self, package: str) -> bool:
        """Tell whether the executables of a package are run."""
        return self.run_only is None or package in self.run_only


def smoke(
    sources: Sequence[Source],
    options: Options,
    *,
    variables: Mapping[str, str] | None = None,
    progress: Progress | None = None,
    announce: Progress | None = None,
    interruption: Interruption | None = None,
) -> Smoke:
    """Build packages, run what they install, and compare it with what the sources say.

    Args:
        sources: The packages; they are not changed.
        options: How it is done.
        variables: The environment variables to start from; those of this process.
        progress: Called with what is going on.
        announce: Called with what the user should know, such as what a run waits for.
        interruption: Takes the signals that ask for the end; without it, only this run does.

    Raises:
        InputError: another run holds the workspace, or a ``smoke.yaml`` has a mistake.
        EnvironmentMissingError: there is no ROS 2 to do it with.
        InterruptedBySignalError: a signal asked for the end.
    """
    begun = time.monotonic()
    stated = {source.name: _scenarios(source) for source in sources}
    interruption = interruption or Interruption()
    tell = announce or (lambda _: None)
    with ExitStack() as stack:
        stack.enter_context(interruption)
        stack.enter_context(interruption.later())
        stack.enter_context(_subreaper())
        with interruption.at_once():
            leftovers.sweep()
            if options.workspace is not None:
                stack.enter_context(locked(options.workspace, options.workspace_wait, tell))
        run = stack.enter_context(leftovers.recorded_run(keep=options.keep))
        with interruption.at_once():
            selected = environments.select(
                os.environ if variables is None else variables,
                wanted=options.wanted,
                paths=[os.path.relpath(source.directory) for source in sources],
                origin=run.origin,
            )
        stack.enter_context(distributions.targeting(_distribution_of(selected)))
        session = _Session(selected, run, options, progress, stated, tell)
        packages = interruption.run(lambda: session.run(sources))
        stack.close()
        interruption.check()
    return Smoke(
        environment={
            "kind": selected.kind,
            "distribution": selected.distribution,
            "prefix": selected.prefix,
            "rmw": selected.rmw,
        },
        packages=packages,
        notes=selected.notes,
        scratch=str(run.scratch) if options.keep else None,
        seconds=time.monotonic() - begun,
    )


def _distribution_of(environment: Environment) -> Distribution:
    """Return the distribution of an environment; that of the packages, if it is not known."""
    is_known = environment.distribution in distributions.NAMES
    return distributions.named(environment.distribution) if is_known else distributions.target()


def _scenarios(source: Source) -> Mapping[str, Scenario]:
    if not source.has(FILE):
        return {}
    from scaffold.model.programs.executables import programs_of

    programs = programs_of(source)
    return scenarios(source, programs.sources if programs.complete else ())


def packages_of(targets: Sequence[Target]) -> list[Source]:
    """Return the packages that can be built; of a single file, the package that it is in.

    Raises:
        InputError: a file belongs to no package.
    """
    for target in targets:
        if not target.package.has(MANIFEST):
            raise InputError(f"{target.package.directory}: no {MANIFEST}; nothing to build")
    return [target.package for target in targets]


@contextmanager
def _subreaper() -> Iterator[None]:
    """Let what has lost its supervisor come to this process."""
    supervisor.become_subreaper()
    try:
        yield
    finally:
        supervisor.become_subreaper(enabled=False)


class _Session:
    def __init__(
        self,
        environment: Environment,
        run: Run,
        options: Options,
        progress: Progress | None,
        scenarios: Mapping[str, Mapping[str, Scenario]],
        announce: Progress,
    ) -> None:
        self._announce = announce
        self._plan: RunSettings | None = None
        self._environment = environment
        self._scenarios = scenarios
        self._scratch = run.scratch
        self._origin = run.origin
        self._options = options
        self._progress = progress
        self._layout = Layout.below(options.workspace or run.scratch)
        self._stations = Stations(environment.python, run.scratch, run.origin)
        self._slots = asyncio.Semaphore(options.jobs)
        self._running: set[str] = set()
        self._expected: dict[str, dict[str, Expectation]] = {}

    async def run(self, sources: Sequence[Source]) -> tuple[PackageResult, ...]:
        try:
            await self._provide_interfaces(sources)
            builds = await self._build(sources) if sources else {}
            built = [
                source
                for source in sources
                if builds[source.name].ok and self._options.runs(source.name)
            ]
            executables = await self._run_all(built) if built else {}
            together = await self._run_together(built) if built and self._options.together else {}
            tests = await self._test(built) if built and self._options.test else {}
        finally:
            await self._stations.close()
        return tuple(
            PackageResult(
                source.name,
                builds[source.name],
                executables.get(source.name, ()),
                in_repository(source, MANIFEST),
                is_dependency=not self._options.runs(source.name),
                tests=tests.get(source.name),
                together=together.get(source.name),
            )
            for source in sources
        )

    async def _provide_interfaces(self, sources: Sequence[Source]) -> None:
        self._environment = await provide(
            self._environment,
            sources,
            self._scratch,
            origin=self._origin.below("interfaces"),
            timeout=self._options.build_timeout,
            tell=self._tell,
            announce=self._announce,
        )

    async def _build(self, sources: Sequence[Source]) -> dict[str, Build]:
        """Build; meanwhile read the sources and get ready for what they are likely to have."""
        self._tell(f"building {', '.join(source.name for source in sources)}")
        building = asyncio.create_task(
            build(
                self._environment,
                sources,
                self._layout,
                self._scratch,
                origin=self._origin.below("build"),
                timeout=self._options.build_timeout,
                with_tests=self._options.test,
            )
        )
        await asyncio.sleep(0)  # the build begins first
        from scaffold.smoke.declared import expectations

        for source in filter(lambda item: self._options.runs(item.name), sources):
            derived, stated = expectations(source), self._scenarios[source.name]
            self._expected[source.name] = {
                name: overridden(derived.get(name, Expectation()), stated.get(name, NOTHING))
                for name in {**derived, **stated}
            }
        if not any(path.endswith(_INTERFACES) for source in sources for path in source.files):
            # Observers have to know the messages: these come with the environment.
            likely = sum(len(of_package) for of_package in self._expected.values())
            count = min(likely, self._options.jobs, _EARLY_STATIONS)
            self._stations.open_early(self._environment.variables, count)
        return await building

    async def _run_all(self, sources: Sequence[Source]) -> dict[str, tuple[Executable, ...]]:
        plan = await self._settings()
        runs = [
            (source.name, item) for source in sources for item in self._of_package(plan, source)
        ]
        done = await _together([item for _, item in runs])
        result: dict[str, list[Executable]] = {}
        for (name, _), executable in zip(runs, done, strict=True):
            result.setdefault(name, []).append(executable)
        return {name: tuple(executables) for name, executables in result.items()}

    async def _settings(self) -> RunSettings:
        if self._plan is None:
            self._plan = RunSettings(
                variables=await self._sourced(),
                stations=self._stations,
                install=self._layout.install,
                scratch=self._scratch,
                origin=self._origin,
                duration=self._options.duration,
                timeout=self._options.timeout,
            )
        return self._plan

    async def _run_together(self, built: Sequence[Source]) -> dict[str, Executable]:
        """Run the executables of each package in one domain, if there are several."""
        plan = await self._settings()
        result: dict[str, Executable] = {}
        for source in built:
            stated = self._scenarios[source.name]
            paths = [
                path
                for path in installed(source.name, plan.variables) or ()
                if not stated.get(path.name, NOTHING).skip
            ]
            if len(paths) > 1:
                self._tell(f"running all of {source.name} together")
                result[source.name] = await run_together(plan, source.name, paths, stated)
        return result

    async def _test(self, built: Sequence[Source]) -> dict[str, Tests]:
        from scaffold.smoke.testing import run_tests

        self._tell(f"testing {', '.join(source.name for source in built)}")
        return await run_tests(
            self._environment,
            built,
            self._layout,
            self._scratch,
            origin=self._origin.below("test"),
            timeout=self._options.build_timeout,
        )

    async def _sourced(self) -> dict[str, str]:
        """Return the variables with the built packages in them."""
        install = self._layout.install
        setup = install / "local_setup.sh"
        begin = {**self._environment.variables, "COLCON_CURRENT_PREFIX": str(install)}
        command, variables = environments.sourcing(setup, begin)
        origin = self._origin.below("setup")
        shell = await process.start(command, variables, self._scratch / "setup", origin)
        try:
            await shell.ended_within(environments.TIMEOUT)
        finally:
            await shell.close()
        sourced = environments.sourced_variables(setup, shell.captured())
        sourced.pop("COLCON_CURRENT_PREFIX", None)
        return sourced

    def _of_package(
        self, plan: RunSettings, source: Source
    ) -> list[Coroutine[Any, Any, Executable]]:
        package = source.name
        expected = self._expected[package]
        paths = installed(package, plan.variables)
        found = {path.name: path for path in paths or ()}
        where = f"in lib/{package}" if paths is not None else "in a package of the ament index"
        return [
            self._one(plan, source, found[name], expected.get(name, Expectation()))
            if name in found
            else _missing(name, where)
            for name in sorted({*found, *expected})
            if not (name in expected and expected[name].scenario.skip)
        ]

    async def _one(
        self, plan: RunSettings, source: Source, path: Path, expectation: Expectation
    ) -> Executable:
        label = f"{source.name}/{path.name}"
        async with self._slots:
            begun = time.monotonic()
            self._tell_running(label, started=True)
            trials: list[NodeRun] = []
            for number in self._options.signals:
                run = f"{label}/{number.name}"
                brief = bool(trials)
                if brief and not trials[0].joined:
                    break
                if brief:
                    one = await trial.run(plan, path, expectation, run, number, brief=True)
                else:
                    one = await _observed(plan, path, expectation, run, number)
                trials.append(one)
            self._tell_running(label, started=False)
        return replace(
            _judge(path.name, trials, expectation),
            source=in_repository(source, expectation.source) if expectation.source else "",
            seconds=time.monotonic() - begun,
        )

    def _tell_running(self, label: str, *, started: bool) -> None:
        (self._running.add if started else self._running.discard)(label)
        if self._running:
            self._tell(f"running {', '.join(sorted(self._running))}")

    def _tell(self, text: str) -> None:
        if self._progress is not None:
            self._progress(text)


async def _observed(
    plan: RunSettings, path: Path, expectation: Expectation, label: str, number: signal.Signals
) -> NodeRun:
    """Observe an executable, and once more when its rate is wrong: that may be the machine's."""
    first = await trial.run(plan, path, expectation, label, number)
    wrong = wrong_rates(expectation, first.observation) if first.stopped_cleanly else []
    if not wrong:
        return first
    other = await trial.run(plan, path, expectation, f"{label}-again", number)
    if not other.stopped_cleanly or wrong_rates(expectation, other.observation):
        return first
    other.notes.append(f"in the first of two runs only: {wrong[0].message}")
    return other


async def _together(runs: Sequence[Coroutine[Any, Any, Result]]) -> list[Result]:
    """Run coroutines at the same time; all have ended when this ends, in whatever way.

    ``asyncio.gather`` would go on as soon as the first of them is cancelled.
    """
    tasks = [asyncio.create_task(run) for run in runs]
    if not tasks:
        return []
    try:
        await asyncio.wait(tasks, return_when=asyncio.FIRST_EXCEPTION)
    finally:
        for task in tasks:
            task.cancel()
        await asyncio.wait(tasks)
    return [task.result() for task in tasks]


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


async def _missing(name: str, where: str) -> Executable:
    return Executable(
        name, problems=(Problem(f"ros2 run does not find it: it is declared, but not {where}"),)
    )


def _judge(name: str, trials: Sequence[NodeRun], expectation: Expectation) -> Executable:
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
    if finished and not problems:
        notes.append(f"finished by itself after {first.stop.seconds:.1f} s")
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
