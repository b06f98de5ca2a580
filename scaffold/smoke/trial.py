"""One run of one executable: start it, watch it, stop it, and leave nothing behind."""

from __future__ import annotations

import asyncio
import signal
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from scaffold.smoke import output, process, shared_memory
from scaffold.smoke.expectation import Expectation
from scaffold.smoke.observe import ObserverError
from scaffold.smoke.result import Observation, Problem, Stop
from scaffold.smoke.station import Station, Stations

SETTLING = 1.0
"""Seconds between the last change of the graph and the signal."""
CHILDREN_LOOKS = 20
CHILDREN_PERIOD = 0.05
"""The children of an executable may live so often so many seconds longer than itself."""


@dataclass(frozen=True)
class Plan:
    """What is the same for all runs."""

    variables: Mapping[str, str]
    """Those of the environment with the built packages in it."""
    stations: Stations
    install: Path
    scratch: Path
    mark: str
    duration: float
    timeout: float


@dataclass
class Trial:
    """What came of a run."""

    observation: Observation = field(default_factory=Observation)
    stop: Stop = field(default_factory=lambda: Stop(None, None, 0.0))
    problems: list[Problem] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    joined: bool = False
    """Whether something of it was seen and it was running until it was told to stop."""
    seconds: float = 0.0
    """From its start to the end of the observation."""


async def run(
    plan: Plan,
    executable: Path,
    expectation: Expectation,
    label: str,
    number: signal.Signals,
    *,
    brief: bool = False,
) -> Trial:
    """Run an executable until it has been observed, and stop it with a signal.

    Args:
        plan: What is the same for all runs.
        executable: The file, started without arguments.
        expectation: What its source says about it.
        label: Names the run, as a relative path.
        number: The signal to stop it with.
        brief: Observe only until it is up: the run is about the signal.
    """
    trial = Trial()
    segments: set[str] = set()
    try:
        async with plan.stations.one(plan.variables) as station:
            one = _Run(plan, expectation, number, trial, station, segments, brief=brief)
            await one.execute(executable, label)
    except ObserverError as error:
        trial.problems.append(Problem(str(error)))
    finally:
        shared_memory.remove_unused(segments)
    return trial


class _Run:
    def __init__(
        self,
        plan: Plan,
        expectation: Expectation,
        number: signal.Signals,
        trial: Trial,
        station: Station,
        segments: set[str],
        *,
        brief: bool,
    ) -> None:
        self._plan = plan
        self._expectation = expectation
        self._number = number
        self._trial = trial
        self._station = station
        self._observer = station.observer
        self._segments = segments
        self._brief = brief
        self._hangs = ""

    async def execute(self, executable: Path, label: str) -> None:
        mark = f"{self._plan.mark}/{label}"
        variables = self._station.variables(self._plan.variables)
        directory = self._plan.scratch / "runs" / label
        try:
            running = await process.start([str(executable)], variables, directory, mark)
        except OSError as error:
            self._report(f"cannot be started: {error.strerror}")
            return
        self._observer.guard(running.group)
        try:
            await self._watch(running)
            self._remember_segments(running, mark)
            self._trial.observation = await self._observer.observation()
            self._trial.seconds = time.monotonic() - running.started
            self._trial.joined = self._trial.observation.alive and running.exit_code is None
            self._observer.dismiss(running.group)
            if running.exit_code is None:
                await self._stop(running)
            else:
                self._ended_by_itself(running)
            await self._look_for_children(mark)
        finally:
            await running.kill()
            process.sweep(mark)

    async def _watch(self, running: process.Running) -> None:
        observer, plan = self._observer, self._plan
        if not await observer.wait_for(observer.has_seen_anything, plan.timeout, running):
            if running.exit_code is None:
                self._never_joined()
            return
        if not self._brief:
            await observer.pause(plan.duration, running)
        left = running.started + plan.timeout - time.monotonic()
        await observer.wait_for(self._heard_all(), left, running)
        # A signal in the middle of a constructor would tell about nothing but that.
        await observer.settle(SETTLING, plan.timeout, running)

    def _heard_all(self) -> Callable[[], bool]:
        topics = [one.topic for one in self._expectation.publications if one.certain]
        return lambda: all(self._observer.count(topic) for topic in topics)

    def _never_joined(self) -> None:
        if self._expectation.is_node is False:
            self._trial.notes.append("runs without a node")
            return
        self._hangs = f"hangs: no node appeared within {self._plan.timeout:g} s"

    # -- the end

    def _ended_by_itself(self, running: process.Running) -> None:
        seconds = time.monotonic() - running.started
        code = running.exit_code
        trace = output.traceback(output.read(running.err))
        self._trial.stop = Stop(None, code, seconds, trace)
        if not code and trace is None:
            return
        when = f"after {seconds:.1f} s" if self._trial.observation.alive else "at start"
        how = ending(code) + (f": {output.exception(trace)}" if trace else "")
        lines = tuple(output.short(trace)) if trace else _said(running)
        self._report(f"crashed {when}, {how}", lines)

    async def _stop(self, running: process.Running) -> None:
        said = _said(running)
        self._report_exception(running)
        written = running.err.stat().st_size
        done = await process.end(running, self._number)
        trace = output.traceback(output.read(running.err, written))
        self._trial.stop = Stop(done.signal, running.exit_code, done.seconds, trace)
        if done.signal != done.asked:
            self._report(
                f"ignored {done.asked}: it was still running after {process.GRACE:g} s, "
                f"{done.signal} ended it"
            )
        where = tuple(output.short(trace)) if trace else ()
        if self._hangs:
            # The traceback of the interrupted program shows where it was.
            self._report(self._hangs, said + where)
        elif done.signal == done.asked and (running.exit_code or trace):
            how = ending(running.exit_code) + (f": {output.exception(trace)}" if trace else "")
            last = output.tail(output.read(running.err, written))
            self._report(f"does not stop cleanly on {done.asked}, {how}", where or tuple(last))

    def _report_exception(self, running: process.Running) -> None:
        """Report an exception that did not end the executable: of a thread, or printed by it."""
        trace = output.traceback(output.read(running.err))
        if trace is not None:
            what = f"an exception while it ran: {output.exception(trace)}"
            self._report(what, tuple(output.short(trace)))

    def _report(self, message: str, lines: tuple[str, ...] = ()) -> None:
        shown = output.relative(lines, self._plan.install)
        self._trial.problems.append(Problem(message, tuple(shown)))

    async def _look_for_children(self, mark: str) -> None:
        for _ in range(CHILDREN_LOOKS):
            if not process.marked(mark):
                return
            await asyncio.sleep(CHILDREN_PERIOD)
        for command in process.sweep(mark):
            self._report(f"leaves a process running: {command}")

    def _remember_segments(self, running: process.Running, mark: str) -> None:
        pids = [running.group, self._observer.pid, *process.marked(mark)]
        self._segments.update(shared_memory.used_by(pids))


def ending(code: int | None) -> str:
    """Say how a process ended."""
    if code is not None and code < 0:
        try:
            return f"killed by {signal.Signals(-code).name}"
        except ValueError:
            return f"killed by signal {-code}"
    return f"exit code {code}"


def _said(running: process.Running) -> tuple[str, ...]:
    """Return the last lines of what an executable has written."""
    return tuple(output.tail(output.read(running.err)) or output.tail(output.read(running.out)))
