"""All executables of a package in one domain: do their nodes connect?"""

from __future__ import annotations

import signal
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import AsyncExitStack
from difflib import get_close_matches
from pathlib import Path

from scaffold.smoke.observe import ObserverError
from scaffold.smoke.processes import output, process
from scaffold.smoke.result import Endpoint, Executable, Observation, Problem, Topic
from scaffold.smoke.run import SETTLING, RunSettings, ending
from scaffold.smoke.scenario.model import NOTHING, Scenario

NAME = "all together"

_KEPT = ("transient_local", "transient", "persistent")


async def run_together(
    plan: RunSettings, package: str, paths: Sequence[Path], scenarios: Mapping[str, Scenario]
) -> Executable:
    """Start all executables of a package in one domain, observe them, and stop them.

    Args:
        plan: What is the same for all runs.
        package: The name of the package.
        paths: The executables.
        scenarios: What their author expects, by name: for arguments and parameters.
    """
    begun = time.monotonic()
    try:
        async with plan.stations.one(plan.variables) as station, AsyncExitStack() as stack:
            variables = station.variables(plan.variables)
            runs: dict[str, process.Running] = {}
            for path in paths:
                label = f"{package}/together/{path.name}"
                words = [str(path), *scenarios.get(path.name, NOTHING).command()]
                directory = plan.scratch / "runs" / label
                running = await process.start(words, variables, directory, plan.origin.below(label))
                stack.push_async_callback(running.close)
                runs[path.name] = running
            observer = station.observer
            every = _All([*runs.values()])
            if await observer.wait_for(observer.has_seen_anything, plan.timeout, every):
                await observer.pause(plan.duration, every)
                await observer.settle(SETTLING, plan.timeout, every)
            seen = await observer.observation()
            observer.dismiss()
            problems = [*_ended(runs), *connections(seen)]
            for running in runs.values():
                await _stop(running)
    except (ObserverError, OSError) as error:
        return Executable(NAME, problems=(Problem(str(error)),))
    return Executable(
        NAME,
        seen,
        problems=tuple(problems),
        seconds=time.monotonic() - begun,
    )


class _All:
    """Several executables, observed until the last of them ends."""

    def __init__(self, runs: Sequence[process.Running]) -> None:
        self._runs = runs

    @property
    def exit_code(self) -> int | None:
        """That of the last one, once all have ended."""
        codes = [running.exit_code for running in self._runs]
        return None if None in codes else codes[-1]

    async def wait(self) -> None:
        """Wait for the end of all."""
        for running in self._runs:
            await running.wait()


async def _stop(running: process.Running) -> None:
    if running.exit_code is None:
        await process.end(running, signal.SIGINT)
    await running.finish()


def _ended(runs: Mapping[str, process.Running]) -> Iterator[Problem]:
    for name, running in runs.items():
        if running.exit_code:
            lines = tuple(output.tail(output.read(running.err)))
            yield Problem(f"{name} ended among the others, {ending(running.exit_code)}", lines)


def connections(seen: Observation) -> Iterator[Problem]:
    """Yield what keeps nodes from talking to each other: types, quality of service, names."""
    for topic in seen.topics:
        publishers = [item for item in topic.endpoints if item.kind == "publisher"]
        subscriptions = [item for item in topic.endpoints if item.kind == "subscription"]
        for publisher in publishers:
            for subscription in subscriptions:
                reason = _mismatch(publisher, subscription)
                if reason:
                    yield Problem(
                        f"{topic.name}: {subscription.node} gets nothing from {publisher.node}: "
                        f"{reason}"
                    )
    yield from _misspelled(seen.topics)


def _mismatch(publisher: Endpoint, subscription: Endpoint) -> str:
    """Return why nothing comes from a publisher to a subscription; empty if it does."""
    if publisher.type != subscription.type:
        return f"it publishes {publisher.type}, the other subscribes to {subscription.type}"
    offered, wanted = publisher.qos, subscription.qos
    if (offered["reliability"], wanted["reliability"]) == ("best_effort", "reliable"):
        return "it publishes best effort, the other wants reliable"
    if offered["durability"] == "volatile" and wanted["durability"] in _KEPT:
        return f"it publishes volatile, the other wants {_words(wanted['durability'])}"
    if wanted.get("deadline") is not None and (
        offered.get("deadline") is None or offered["deadline"] > wanted["deadline"]
    ):
        return f"the other wants a deadline of {wanted['deadline']:g} s, which it does not promise"
    if (offered.get("liveliness"), wanted.get("liveliness")) == ("automatic", "manual_by_topic"):
        return "its liveliness is automatic, the other wants manual by topic"
    return ""


def _misspelled(topics: Sequence[Topic]) -> Iterator[Problem]:
    """Yield subscriptions that nothing serves, next to a publisher that nobody hears."""
    unheard = {topic.name: topic for topic in topics if topic.publishers and not topic.subscribers}
    for topic in topics:
        if topic.publishers or not topic.subscribers:
            continue
        same_type = [name for name, other in unheard.items() if other.type == topic.type]
        for near in get_close_matches(topic.name, same_type, 1, cutoff=0.75):
            yield Problem(
                f"nothing publishes {topic.name}, to which {_nodes(topic)} subscribes; "
                f"{_nodes(unheard[near])} publishes {near}, to which nobody does"
            )


def _nodes(topic: Topic) -> str:
    return ", ".join(sorted({endpoint.node for endpoint in topic.endpoints})) or "a node"


def _words(name: str) -> str:
    return name.replace("_", " ")
