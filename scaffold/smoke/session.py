"""A smoke session: builds packages, runs and observes every executable, reports problems."""

from __future__ import annotations

import asyncio
import os
import signal
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from functools import partial

from scaffold import distributions
from scaffold.distributions import Distribution
from scaffold.errors import InputError
from scaffold.files.tree import CMAKE_LISTS, MANIFEST
from scaffold.model.discovery.targets import Target
from scaffold.model.package import Package as Source
from scaffold.reporters.paths import in_repository
from scaffold.smoke import environment as environments
from scaffold.smoke import launching
from scaffold.smoke.building.build import Layout, build
from scaffold.smoke.building.unavailable import unavailable
from scaffold.smoke.cleanup import leftovers
from scaffold.smoke.cleanup.interruption import InterruptedBySignalError, Interruption
from scaffold.smoke.cleanup.leftovers import Run
from scaffold.smoke.cleanup.workspace_lock import locked
from scaffold.smoke.embedded.interfaces import provide
from scaffold.smoke.environment import Environment
from scaffold.smoke.executables import ExecutableRuns, installed
from scaffold.smoke.expectation import Expectation
from scaffold.smoke.isolation.station import Stations
from scaffold.smoke.options import Options, Progress
from scaffold.smoke.processes import process, supervisor
from scaffold.smoke.processes.uninterrupted import uninterrupted
from scaffold.smoke.result import Build, Executable, PackageResult, Smoke, Tests
from scaffold.smoke.run import RunSettings
from scaffold.smoke.scenario.model import FILE, NOTHING, Scenario
from scaffold.smoke.scenario.reader import scenarios
from scaffold.smoke.scenario.verdicts import overridden
from scaffold.smoke.together import of_executables, run_together
from scaffold.source import ParseError

_INTERFACES = (".msg", ".srv", ".action", ".idl")
_EARLY_STATIONS = 4
"""The number of observers started during the build; more would slow it down."""


def smoke(
    sources: Sequence[Source],
    options: Options,
    *,
    variables: Mapping[str, str] | None = None,
    progress: Progress | None = None,
    announce: Progress | None = None,
    interruption: Interruption | None = None,
) -> Smoke:
    """Build packages, run their executables, and compare the behavior with the sources.

    An interrupted run returns its observations, if there are any.

    Args:
        sources: The packages; they are not changed.
        options: The options of the run.
        variables: The environment variables of this process.
        progress: Called with the current activity.
        announce: Called with messages for the user, such as the reason for waiting.
        interruption: Handles the signals that end the run; by default, only during this run.

    Raises:
        InputError: another run uses the workspace, or a ``smoke.yaml`` is invalid.
        EnvironmentMissingError: there is no usable ROS 2.
        InterruptedBySignalError: a signal ended the run before it started.
    """
    begun = time.monotonic()
    stated = {source.name: _scenarios(source) for source in sources}
    interruption = interruption or Interruption()
    tell = announce or (lambda _: None)
    with ExitStack() as stack:
        run = _begun(stack, options, interruption, tell)
        with interruption.at_once():
            selected = _selected(sources, options, variables, run)
        stack.enter_context(distributions.targeting(_distribution_of(selected)))
        session = _Session(selected, run, options, progress, stated, tell)
        ended_early = _run(session, sources, interruption)
    return Smoke(
        environment=selected.facts(),
        packages=session.results(sources),
        notes=selected.notes,
        scratch=str(run.scratch) if options.keep else None,
        seconds=time.monotonic() - begun,
        ended_early=ended_early,
    )


def _begun(stack: ExitStack, options: Options, interruption: Interruption, tell: Progress) -> Run:
    """Handle signals, adopt orphans, lock the workspace, and record the run."""
    stack.enter_context(interruption)
    stack.enter_context(interruption.later())
    stack.enter_context(_subreaper())
    with interruption.at_once():
        leftovers.sweep()
        if options.workspace is not None:
            stack.enter_context(locked(options.workspace, options.workspace_wait, tell))
    return stack.enter_context(leftovers.recorded_run(keep=options.keep))


def _selected(
    sources: Sequence[Source], options: Options, variables: Mapping[str, str] | None, run: Run
) -> Environment:
    """Return the environment for the packages, and for their launch files if they are run."""
    selected = environments.select(
        os.environ if variables is None else variables,
        forced=options.ros,
        wanted=options.wanted,
        paths=[os.path.relpath(source.directory) for source in sources],
        origin=run.origin,
    )
    if options.launch:
        launching.require(selected, sources, run.origin)
    return selected


def _run(session: _Session, sources: Sequence[Source], interruption: Interruption) -> str:
    """Run a session; return why it ended early, or an empty text."""
    try:
        interruption.run(lambda: session.run(sources), session.say_interrupted)
    except InterruptedBySignalError as end:
        return f"interrupted by {signal.Signals(end.number).name}"
    except OSError as error:
        return _system_error_message(error)
    return ""


def _distribution_of(environment: Environment) -> Distribution:
    """Return the distribution of an environment, or that of the packages if it is unknown."""
    is_known = environment.distribution in distributions.NAMES
    return distributions.named(environment.distribution) if is_known else distributions.target()


def _system_error_message(error: OSError) -> str:
    """Return a message about an error of the system, such as a full disk."""
    reason = error.strerror or str(error) or type(error).__name__
    return reason if error.filename is None else f"{os.fsdecode(error.filename)}: {reason}"


def _scenarios(source: Source) -> Mapping[str, Scenario]:
    if not source.has(FILE):
        return {}
    from scaffold.model.programs.executables import programs_of

    programs = programs_of(source)
    return scenarios(source, programs.sources if programs.complete else ())


def packages_of(targets: Sequence[Target]) -> list[Source]:
    """Return the packages that can be built; for a file, its package.

    Raises:
        InputError: a file belongs to no package.
    """
    for target in targets:
        if not target.package.has(MANIFEST):
            raise InputError(f"{target.package.directory}: no {MANIFEST}; nothing to build")
    return [target.package for target in targets]


@contextmanager
def _subreaper() -> Iterator[None]:
    """Make this process adopt the orphans of killed supervisors."""
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
        self._environment = environment
        self._scenarios = scenarios
        self._scratch = run.scratch
        self._origin = run.origin
        self._options = options
        self._progress = progress
        self._layout = Layout.below(options.workspace or run.scratch)
        self._stations = Stations(environment.python, run.scratch, run.origin)
        self._expected: dict[str, dict[str, Expectation]] = {}
        self._builds: dict[str, Build] = {}
        self._executables: dict[str, dict[str, Executable]] = {}
        self._together: dict[str, Executable] = {}
        self._launches: dict[str, list[Executable]] = {}
        self._tests: dict[str, Tests] = {}
        self._left_out: set[str] = set()

    async def run(self, sources: Sequence[Source]) -> None:
        """Run the session; ``results`` holds the progress."""
        try:
            await self._provide_interfaces(sources)
            sources = self._without_unreadable(self._without_hopeless(sources))
            if sources:
                await self._build(sources)
            built = [
                source
                for source in sources
                if self._builds[source.name].ok and self._options.runs(source.name)
            ]
            if built:
                await self._run(built)
        finally:
            await uninterrupted(self._stations.close())

    def _without_hopeless(self, sources: Sequence[Source]) -> list[Source]:
        """Report missing dependencies; return the packages that can be built.

        Missing run-time dependencies do not prevent a build and a run.
        """
        users: set[str] = set()
        for lack in unavailable(self._environment, sources):
            self._announce(lack.message)
            users |= lack.users
        self._left_out = {
            source.name
            for source in sources
            if source.name in users
            and source.has(CMAKE_LISTS)
            and not self._options.runs(source.name)
        }
        if self._left_out:
            names = ", ".join(sorted(self._left_out))
            self._announce(f"not built, because they cannot be built here and are not run: {names}")
        return [source for source in sources if source.name not in self._left_out]

    def _without_unreadable(self, sources: Sequence[Source]) -> list[Source]:
        """Report packages whose package.xml cannot be parsed; return the others.

        Colcon would ignore the file, build the package as something else, or fail for all of them.
        """
        readable: list[Source] = []
        for source in sources:
            try:
                _ = source.manifest
            except ParseError as error:
                place = f"{MANIFEST}:{error.location.line}:{error.location.column}"
                self._builds[source.name] = Build(
                    ok=False, errors=(f"not built: {place}: {error.message}",)
                )
            else:
                readable.append(source)
        return readable

    def results(self, sources: Sequence[Source]) -> tuple[PackageResult, ...]:
        """Return the results of packages, also after an interruption."""
        return tuple(
            PackageResult(
                source.name,
                self._builds.get(source.name, Build(ok=False, interrupted=True)),
                tuple(self._executables.get(source.name, {}).values()),
                ran=source.name in self._executables,
                manifest=in_repository(source, MANIFEST),
                is_dependency=not self._options.runs(source.name),
                tests=self._tests.get(source.name),
                together=self._together.get(source.name),
                launches=tuple(self._launches.get(source.name, ())),
            )
            for source in sources
            if source.name not in self._left_out
        )

    async def _provide_interfaces(self, sources: Sequence[Source]) -> None:
        self._environment = await provide(
            self._environment,
            sources,
            self._scratch,
            origin=self._origin.below("interfaces"),
            timeout=self._options.build_timeout,
            tell=self._report_progress,
            announce=self._announce,
        )

    async def _build(self, sources: Sequence[Source]) -> None:
        """Build; meanwhile read the sources and prepare for their likely executables."""
        self._report_progress(f"building {', '.join(source.name for source in sources)}")
        building = asyncio.create_task(
            build(
                self._environment,
                sources,
                self._layout,
                self._scratch,
                origin=self._origin.below("build"),
                timeout=self._options.build_timeout,
                with_tests=self._options.test,
                done=self._builds,
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
        await building

    async def _run(self, built: Sequence[Source]) -> None:
        plan = RunSettings(
            variables=await self._sourced(),
            stations=self._stations,
            install=self._layout.install,
            scratch=self._scratch,
            origin=self._origin,
            duration=self._options.duration,
            timeout=self._options.timeout,
        )
        runs = ExecutableRuns(plan, self._options, self._expected, self._report_progress)
        await runs.run(built, self._executables)
        if self._options.together:
            await self._run_together(plan, built)
        if self._options.launch:
            await self._launch(plan, built)
        if self._options.test:
            await self._test(built)

    async def _run_together(self, plan: RunSettings, built: Sequence[Source]) -> None:
        """Run the executables of each package in one domain, if there are several."""
        for source in built:
            stated = self._scenarios[source.name]
            paths = [
                path
                for path in installed(source.name, plan.variables) or ()
                if not stated.get(path.name, NOTHING).skip
            ]
            if len(paths) > 1:
                self._report_progress(f"running all executables of {source.name} together")
                group = of_executables(source.name, paths, stated)
                record = partial(self._together.__setitem__, source.name)
                await run_together(plan, group, record)

    async def _launch(self, plan: RunSettings, built: Sequence[Source]) -> None:
        """Run each launch file of each package in a domain."""
        for source in built:
            done = self._launches.setdefault(source.name, [])
            for group in launching.groups(source.name, self._environment.python, plan.variables):
                self._report_progress(f"launching {group.name} of {source.name}")
                await run_together(plan, group, done.append)

    async def _test(self, built: Sequence[Source]) -> None:
        from scaffold.smoke.building.testing import run_tests

        self._report_progress(f"testing {', '.join(source.name for source in built)}")
        await run_tests(
            self._environment,
            built,
            self._layout,
            self._scratch,
            origin=self._origin.below("test"),
            timeout=self._options.build_timeout,
            done=self._tests,
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

    def say_interrupted(self) -> None:
        """Report what takes time after ^C."""
        self._report_progress("interrupted, stopping all processes")

    def _report_progress(self, text: str) -> None:
        if self._progress is not None:
            self._progress(text)
