"""Runs all executables of a package in one domain, and checks their connections."""

from __future__ import annotations

import asyncio
import signal
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import AsyncExitStack, suppress
from dataclasses import dataclass, replace
from difflib import get_close_matches
from pathlib import Path

from scaffold import lazy_re
from scaffold.smoke.lifecycle import Lifecycles
from scaffold.smoke.lifecycle import problems as failed
from scaffold.smoke.observe import LAST_ANSWER_TIMEOUT, Observer, ObserverError
from scaffold.smoke.processes import output, process
from scaffold.smoke.processes.ending import GRACE, end
from scaffold.smoke.processes.remains import remains
from scaffold.smoke.result import Endpoint, Executable, Observation, Problem, Topic
from scaffold.smoke.run import SETTLING, RunSettings, ending
from scaffold.smoke.scenario.model import NOTHING, Scenario

NAME = "all together"

_KEPT = ("transient_local", "transient", "persistent")
_DIED = lazy_re.compile(
    r"\[ERROR\] \[(?P<name>[^\]]+)\]: process has died \[pid \d+, exit code (?P<code>-?\d+)"
)
"""The message of launch about a dead node."""
_ASKED = "user interrupted with ctrl-c (SIGINT)"
"""The message of launch when it receives a signal."""
_IGNORED = lazy_re.compile(
    r"\[ERROR\] \[(?P<name>[^\]]+)\]: process\[[^\]]+\] failed to terminate '(?P<seconds>[\d.]+)' "
    r"seconds after receiving '(?P<signal>SIGINT)'"
)
"""The message of launch about a node that ignored a signal."""


@dataclass(frozen=True)
class Group:
    """The executables that run in one domain."""

    name: str
    """For people."""
    label: str
    """Names the run, as a relative path."""
    commands: Mapping[str, Sequence[str]]
    """By name for people."""
    grace: float = GRACE
    """Seconds that they have to obey SIGINT."""


def of_executables(package: str, paths: Sequence[Path], scenarios: Mapping[str, Scenario]) -> Group:
    """Return all executables of a package, with their arguments and parameters."""
    commands = {
        path.name: [str(path), *scenarios.get(path.name, NOTHING).command()] for path in paths
    }
    return Group(NAME, f"{package}/together", commands)


async def run_together(
    plan: RunSettings, group: Group, record: Callable[[Executable], None]
) -> None:
    """Start commands in one domain, observe them, and stop them.

    Args:
        plan: The settings common to all runs.
        group: The commands.
        record: Receives the result, also of an interrupted run.
    """
    begun = time.monotonic()
    result = Executable(group.name, interrupted=True)
    try:
        async with plan.stations.one(plan.variables) as station, AsyncExitStack() as stack:
            variables = station.variables(plan.variables)
            runs: dict[str, process.Running] = {}
            stack.push_async_callback(_close, runs)
            for name, words in group.commands.items():
                label = f"{group.label}/{name}"
                directory = plan.scratch / "runs" / label
                runs[name] = await process.start(
                    words, variables, directory, plan.origin.below(label)
                )
            observer = station.observer
            every = _All([*runs.values()])
            lifecycles = Lifecycles(observer, every, plan.timeout)
            try:
                await _watch(plan, observer, every, lifecycles)
            except asyncio.CancelledError:
                with suppress(ObserverError):
                    seen = await observer.observation(LAST_ANSWER_TIMEOUT)
                    result = replace(result, observation=seen)
                raise
            seen = await observer.observation()
            await lifecycles.lead(NOTHING.transitions_down)
            seen = replace(seen, transitions=tuple(lifecycles.transitions))
            observer.dismiss()
            problems = [*ended(runs), *connections(seen), *failed(seen.transitions)]
            problems += [Problem(text) for text in await _stop(runs, group.grace)]
            shown = [_relative(problem, plan.install) for problem in problems]
            result = Executable(group.name, seen, problems=tuple(shown))
    except (ObserverError, OSError) as error:
        result = Executable(group.name, problems=(Problem(str(error)),))
    finally:
        record(replace(result, seconds=time.monotonic() - begun))


async def _watch(plan: RunSettings, observer: Observer, runs: _All, lifecycles: Lifecycles) -> None:
    if await observer.wait_for(observer.has_seen_anything, plan.timeout, runs):
        await lifecycles.pause(plan.duration, NOTHING.transitions_up)
        await observer.settle(SETTLING, plan.timeout, runs)


class _All:
    """Several executables, observed until the last of them ends."""

    def __init__(self, runs: Sequence[process.Running]) -> None:
        self._runs = runs

    @property
    def exit_code(self) -> int | None:
        """The exit code of the last one, once all have ended."""
        codes = [running.exit_code for running in self._runs]
        return None if None in codes else codes[-1]

    async def wait(self) -> None:
        """Wait until all have ended."""
        for running in self._runs:
            await running.wait()


async def _stop(runs: Mapping[str, process.Running], grace: float) -> list[str]:
    """Interrupt all at once, like ^C in a terminal; return the problems on shutdown."""
    running = {name: item for name, item in runs.items() if item.exit_code is None}
    endings = await asyncio.gather(*(end(item, signal.SIGINT, grace) for item in running.values()))
    # Interrupted once more, a program that ends may have been one whose signal rclpy has lost.
    ignored = [
        ((name,), done.of_ignored)
        for name, done in zip(running, endings, strict=True)
        if done.was_ignored and not done.was_missed
    ]
    left = [(item.commands, item.message) for item in await remains(runs)]
    return [
        *below_launch(runs),
        *(
            message if len(runs) == 1 else f"{' or '.join(names)} {message}"
            for names, message in (*ignored, *left)
        ),
    ]


def below_launch(runs: Mapping[str, process.Running]) -> Iterator[str]:
    """Yield nodes that died before they were asked to end, and those that did not obey."""
    for running in runs.values():
        written = output.read(running.out) + output.read(running.err)
        for died in _DIED.finditer(written.partition(_ASKED)[0]):
            yield f"{died['name']} died, {ending(int(died['code']))}"
        for node in _IGNORED.finditer(written):
            yield (
                f"{node['name']} ignored {node['signal']}: still running after {node['seconds']} s"
            )


def _relative(problem: Problem, install: Path) -> Problem:
    message, *lines = output.relative((problem.message, *problem.output), install)
    return Problem(message, tuple(lines))


async def _close(runs: Mapping[str, process.Running]) -> None:
    await asyncio.gather(*(running.close() for running in runs.values()))


def ended(runs: Mapping[str, process.Running]) -> Iterator[Problem]:
    """Yield commands that ended before they were stopped."""
    for name, running in runs.items():
        if running.exit_code:
            written = output.read(running.out) + output.read(running.err)
            trace = output.traceback(written)
            how = ending(running.exit_code) + (f": {output.exception(trace)}" if trace else "")
            lines = output.short(trace) if trace else output.tail(written)
            yield Problem(f"{name} exited while running with the others, {how}", tuple(lines))


def connections(seen: Observation) -> Iterator[Problem]:
    """Yield why nodes do not communicate: types, quality of service, names."""
    for topic in seen.topics:
        publishers = [item for item in topic.endpoints if item.kind == "publisher"]
        subscriptions = [item for item in topic.endpoints if item.kind == "subscription"]
        for publisher in publishers:
            for subscription in subscriptions:
                reason = _mismatch(publisher, subscription)
                if reason:
                    yield Problem(
                        f"{topic.name}: {subscription.node} receives nothing from "
                        f"{publisher.node}: "
                        f"{reason}"
                    )
    yield from _misspelled(seen.topics)


def _mismatch(publisher: Endpoint, subscription: Endpoint) -> str:
    """Return why a subscription receives nothing from a publisher; empty if it does."""
    if publisher.type != subscription.type:
        return f"the types {publisher.type} and {subscription.type} differ"
    offered, wanted = publisher.qos, subscription.qos
    if (offered["reliability"], wanted["reliability"]) == ("best_effort", "reliable"):
        return "the publisher offers best effort, the subscription requests reliable"
    if offered["durability"] == "volatile" and wanted["durability"] in _KEPT:
        return (
            "the publisher offers volatile, the subscription requests "
            f"{_spaced(wanted['durability'])}"
        )
    if wanted.get("deadline") is not None and (
        offered.get("deadline") is None or offered["deadline"] > wanted["deadline"]
    ):
        return (
            f"the subscription requests a deadline of {wanted['deadline']:g} s, which the "
            "publisher does not offer"
        )
    if (offered.get("liveliness"), wanted.get("liveliness")) == ("automatic", "manual_by_topic"):
        return (
            "the publisher offers automatic liveliness, the subscription requests manual by topic"
        )
    return ""


def _misspelled(topics: Sequence[Topic]) -> Iterator[Problem]:
    """Yield subscriptions without publishers, if there is a publisher with a similar name."""
    unheard = {topic.name: topic for topic in topics if topic.publishers and not topic.subscribers}
    for topic in topics:
        if topic.publishers or not topic.subscribers:
            continue
        same_type = [name for name, other in unheard.items() if other.type == topic.type]
        for similar in get_close_matches(topic.name, same_type, 1, cutoff=0.75):
            yield Problem(
                f"nothing publishes {topic.name}, which {_nodes(topic)} subscribes to; "
                f"{_nodes(unheard[similar])} publishes {similar}, which nobody subscribes to"
            )


def _nodes(topic: Topic) -> str:
    return ", ".join(sorted({endpoint.node for endpoint in topic.endpoints})) or "a node"


def _spaced(name: str) -> str:
    return name.replace("_", " ")
