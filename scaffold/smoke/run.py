"""Runs one executable: starts, observes and stops it, and cleans up."""

from __future__ import annotations

import asyncio
import signal
import time
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path

from scaffold import lazy_re
from scaffold.smoke.expectation import Expectation
from scaffold.smoke.isolation import domain
from scaffold.smoke.isolation.station import Isolation, Stations
from scaffold.smoke.lifecycle import Lifecycles
from scaffold.smoke.observe import ANSWER_TIMEOUT, LAST_ANSWER_TIMEOUT, ObserverError
from scaffold.smoke.processes import output, process, table
from scaffold.smoke.processes.ending import end
from scaffold.smoke.processes.process import Origin
from scaffold.smoke.processes.remains import remains
from scaffold.smoke.processes.usage import Meter, measuring
from scaffold.smoke.result import Answer, Observation, Problem, Stop
from scaffold.smoke.scenario.model import FILE

RETRIES = 2
SETTLING = 1.0
"""Seconds between the last change of the graph and the signal."""
ENDING = 2.0
"""Seconds for a program to end after an exception."""

_GIVING = f"if it needs arguments, set `arguments` of the executable in {FILE}"

_LATE_CALL = lazy_re.compile(r"context is (?:invalid|not valid)")
"""Errors of calls after a signal: rclpy ends the context at once, even during a callback."""


@dataclass(frozen=True)
class RunSettings:
    """The settings that all runs share."""

    variables: Mapping[str, str]
    """The variables of the environment with the built packages."""
    stations: Stations
    install: Path
    scratch: Path
    origin: Origin
    duration: float
    timeout: float


@dataclass
class NodeRun:
    """The outcome of a run."""

    observation: Observation = field(default_factory=Observation)
    stop: Stop = field(default_factory=lambda: Stop(None, None, 0.0))
    problems: list[Problem] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    joined: bool = False
    """Whether it showed a sign of life and was running until it was asked to stop."""
    seconds: float = 0.0
    """From its start to the end of the observation."""
    doubtful: Problem | None = None
    """A problem that may be due to rclpy, to be confirmed by another run."""

    @property
    def stopped_cleanly(self) -> bool:
        """Return whether it was running and stopped without a problem."""
        return self.joined and not self.problems


async def run(
    plan: RunSettings,
    executable: Path,
    expectation: Expectation,
    label: str,
    number: signal.Signals,
    *,
    brief: bool = False,
    first: NodeRun | None = None,
) -> NodeRun:
    """Run an executable until it has been observed, and stop it with a signal.

    rclpy itself occasionally loses a signal, or lets the interrupted call fail. What
    looks like that is tried again, and is only reported if it happens again.

    Args:
        plan: The settings common to all runs.
        executable: The file, started with the arguments of its scenario.
        expectation: The expectation from its source.
        label: Names the run, as a relative path.
        number: The signal to stop it with.
        brief: Whether to observe only until it is running, to test the signal.
        first: Receives the result, also of an interrupted run.
    """
    first = first or NodeRun()
    await _run_once(plan, executable, expectation, label, number, first, brief=brief)
    for attempt in range(RETRIES):
        if first.doubtful is None:
            break
        again = f"{label}-{attempt + 2}"
        other = NodeRun()
        # As long as the first one: what a node does after a while may be why it does not stop.
        await _run_once(plan, executable, expectation, again, number, other, brief=brief)
        if other.stopped_cleanly:
            first.problems.remove(first.doubtful)
            doubt = first.doubtful.message
            first.notes.append(f"a race in rclpy in {attempt + 1} of {attempt + 2} runs: {doubt}")
            first.stop = other.stop
            break
    return first


async def _run_once(
    plan: RunSettings,
    executable: Path,
    expectation: Expectation,
    label: str,
    number: signal.Signals,
    trial: NodeRun,
    *,
    brief: bool,
) -> None:
    try:
        async with plan.stations.one(plan.variables) as station:
            attempt = _Run(plan, expectation, number, trial, station, brief=brief)
            await attempt.execute(executable, label)
    except ObserverError as error:
        trial.problems.append(Problem(str(error)))


class _Run:
    def __init__(
        self,
        plan: RunSettings,
        expectation: Expectation,
        number: signal.Signals,
        trial: NodeRun,
        station: Isolation,
        *,
        brief: bool,
    ) -> None:
        self._plan = plan
        self._expectation = expectation
        self._number = number
        self._trial = trial
        self._station = station
        self._observer = station.observer
        self._brief = brief
        self._hangs = ""
        self._lifecycles: Lifecycles | None = None
        self._scenario = expectation.scenario
        self._answers: dict[tuple[str, str], Answer] = {}

    async def execute(self, executable: Path, label: str) -> None:
        origin = self._plan.origin.below(label)
        variables = self._station.variables(self._plan.variables)
        directory = self._plan.scratch / "runs" / label
        command = [str(executable), *self._scenario.command()]
        self._observer.watch_fields(
            {
                topic.name: [field.path for field in topic.fields]
                for topic in self._scenario.topics
                if topic.fields
            }
        )
        try:
            running = await process.start(command, variables, directory, origin)
        except OSError as error:
            self._report(f"cannot be started: {error.strerror}")
            return
        try:
            async with measuring(running.group) as meter:
                try:
                    await self._watch(running, meter)
                except asyncio.CancelledError:
                    with suppress(ObserverError):
                        await self._record_observation(running, meter, LAST_ANSWER_TIMEOUT)
                    raise
                await self._record_observation(running, meter)
            if self._lifecycles is not None:
                await self._lifecycles.lead(self._scenario.transitions_down)
                self._trial.observation = replace(
                    self._trial.observation, transitions=tuple(self._lifecycles.transitions)
                )
            self._trial.joined = self._trial.observation.alive and running.exit_code is None
            self._observer.dismiss()
            if output.traceback(output.read(running.err)) is not None:
                # It may be about to end because of that: a signal would hide it.
                await running.ended_within(ENDING)
            if running.exit_code is None:
                await self._stop(running)
            else:
                self._ended_by_itself(running)
            for item in await remains({label: running}):
                self._report(item.message)
        finally:
            await running.close()

    async def _record_observation(
        self, running: process.Running, meter: Meter, timeout: float = ANSWER_TIMEOUT
    ) -> None:
        """Record the observation so far."""
        observation = await self._observer.observation(timeout)
        meter.measure()
        transitions = tuple(self._lifecycles.transitions) if self._lifecycles else ()
        observation = replace(observation, answers=self._answers, transitions=transitions)
        self._trial.observation = _relative_to_start(running, observation, meter)
        self._trial.seconds = time.monotonic() - running.started

    async def _watch(self, running: process.Running, meter: Meter) -> None:
        observer, plan = self._observer, self._plan
        if not await observer.wait_for(observer.has_seen_anything, plan.timeout, running):
            if running.exit_code is None:
                self._never_joined(running)
            return
        meter.begin()
        if not self._brief:
            for stimulus in self._scenario.stimuli:
                observer.publish(stimulus)
            self._lifecycles = Lifecycles(observer, running, plan.timeout)
            duration = self._scenario.duration or plan.duration
            await self._lifecycles.pause(duration, self._scenario.transitions_up)
        left = running.started + plan.timeout - time.monotonic()
        await observer.wait_for(self._has_seen_all(), left, running)
        # A signal in the middle of a constructor would tell about nothing but that.
        await observer.settle(SETTLING, plan.timeout, running)
        if not self._brief:
            await self._call(running)

    async def _call(self, running: process.Running) -> None:
        for call in self._scenario.calls:
            if running.exit_code is None:
                answer = await self._observer.call(call, self._plan.timeout, running)
                self._answers[call.kind, call.name] = answer

    def _has_seen_all(self) -> Callable[[], bool]:
        topics = [
            publication.topic
            for publication in self._expectation.publications
            if publication.certain
        ]
        offers = self._expectation.offers
        return lambda: (
            all(self._observer.count(topic) for topic in topics)
            and all(map(self._observer.offers, offers))
        )

    def _never_joined(self, running: process.Running) -> None:
        members = [running.group, *(item.pid for item in table.descendants(running.group))]
        others = domain.domains_of(members) - {self._station.number}
        if others:
            where = ", ".join(map(str, sorted(others)))
            self._report(
                f"uses ROS domain {where} instead of ROS_DOMAIN_ID ({self._station.number}), so "
                "it could not be observed"
            )
            return
        if self._expectation.is_node is False:
            self._trial.notes.append("runs without a node")
            return
        self._hangs = f"hangs: no node appeared within {self._plan.timeout:g} s"

    # -- the end

    def _ended_by_itself(self, running: process.Running) -> None:
        seconds = time.monotonic() - running.started
        code = running.exit_code
        errors = output.read(running.err)
        trace = output.traceback(errors)
        self._trial.stop = Stop(None, code, seconds, trace)
        if self._is_expected(code) and (trace is None or code):
            return
        if self._expectation.exit_code is not None and trace is None:
            self._report(f"exited on its own, {self._unexpected(code)}", _last_output(running))
            return
        lack = None if self._scenario.arguments else _missing_arguments(running)
        if code and lack is not None:
            lines = tuple(output.short(trace)) if trace else _last_output(running)
            self._report(f"exited, {ending(code)}: {lack}; {_GIVING}", lines)
            return
        when = f"after {seconds:.1f} s" if self._trial.observation.alive else "at start"
        reason = output.exception(trace) if trace else output.named_error(errors)
        how = ending(code) + (f": {reason}" if reason else "")
        lines = tuple(output.short(trace)) if trace else _last_output(running)
        self._report(f"crashed {when}, {how}", lines)

    async def _stop(self, running: process.Running) -> None:
        said = _last_output(running)
        self._report_exception(running)
        written = output.size(running.err)
        done = await end(running, self._number)
        trace = output.traceback(output.read(running.err, written))
        self._trial.stop = Stop(done.sent[-1], running.exit_code, done.seconds, trace)
        where = tuple(output.short(trace)) if trace else ()
        if done.was_ignored:
            self._report(done.of_ignored, doubtful=done.was_missed)
        if self._hangs:
            # The traceback of the interrupted program shows where it was.
            self._report(self._hangs, said + where)
        elif not done.was_ignored and not self._is_clean(running.exit_code, trace):
            how = self._unexpected(running.exit_code)
            how += f": {output.exception(trace)}" if trace else ""
            last_lines = tuple(output.tail(output.read(running.err, written)))
            self._report(
                f"does not stop cleanly on {done.asked}, {how}",
                where or last_lines,
                doubtful=trace is not None and is_late_call(output.exception(trace)),
            )

    def _is_expected(self, code: int | None) -> bool:
        return code == (self._expectation.exit_code or 0)

    def _is_clean(self, code: int | None, trace: str | None) -> bool:
        return self._is_expected(code) and (trace is None or bool(code))

    def _unexpected(self, code: int | None) -> str:
        wanted = self._expectation.exit_code
        if wanted is None or self._is_expected(code):
            return ending(code)
        return f"{ending(code)}, but {FILE} expects {wanted}"

    def _report_exception(self, running: process.Running) -> None:
        """Report an exception that did not end the executable: in a thread, or printed by it."""
        trace = output.traceback(output.read(running.err))
        if trace is not None:
            message = f"exception at run time: {output.exception(trace)}"
            self._report(message, tuple(output.short(trace)))

    def _report(self, message: str, lines: tuple[str, ...] = (), *, doubtful: bool = False) -> None:
        shown = output.relative((message, *lines), self._plan.install)
        problem = Problem(shown[0], tuple(shown[1:]))
        self._trial.problems.append(problem)
        if doubtful:
            self._trial.doubtful = problem


def _relative_to_start(
    running: process.Running, observation: Observation, meter: Meter
) -> Observation:
    """Return an observation with times relative to the start of the executable."""
    started = time.time() - (time.monotonic() - running.started)
    topics = (
        topic if topic.first is None else replace(topic, first_after=topic.first - started)
        for topic in observation.topics
    )
    return replace(observation, topics=tuple(topics), usage=meter.usage())


def is_late_call(exception: str) -> bool:
    """Return whether an error is due to a call after rclpy ended its context."""
    return bool(_LATE_CALL.search(exception.partition("RCLError: ")[2]))


def ending(code: int | None) -> str:
    """Describe how a process ended."""
    if code is not None and code < 0:
        try:
            return f"killed by {signal.Signals(-code).name}"
        except ValueError:
            return f"killed by signal {-code}"
    return f"exit code {code}"


def _missing_arguments(running: process.Running) -> str | None:
    return output.missing_arguments(output.read(running.out) + output.read(running.err))


def _last_output(running: process.Running) -> tuple[str, ...]:
    """Return the last lines of the output of an executable."""
    return tuple(output.tail(output.read(running.err)) or output.tail(output.read(running.out)))
