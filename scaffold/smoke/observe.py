"""Observes an executable from another process."""

from __future__ import annotations

import asyncio
import json
import time
from collections import Counter
from collections.abc import AsyncIterator, Callable, Mapping, Sequence
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Any, Protocol, cast

from scaffold.smoke.expectation import Offer
from scaffold.smoke.processes import output, process
from scaffold.smoke.processes.process import Origin
from scaffold.smoke.result import (
    Answer,
    Endpoint,
    FieldFigures,
    Log,
    LogLine,
    Observation,
    Spread,
    Topic,
)
from scaffold.smoke.scenario.model import Call, Stimulus

PROBE = Path(__file__).with_name("probe")
_COPY = "ros2_scaffold_probe"
START_TIMEOUT = 120.0
"""Seconds for the start of an interpreter and the import of rclpy on a busy machine."""
ANSWER_TIMEOUT = 30.0
LAST_ANSWER_TIMEOUT = 2.0
"""Seconds for the last response in an interrupted run."""
END_TIMEOUT = 5.0
LONGEST_LINE = 2**24
"""The size limit of an event in bytes: the report has several messages of every topic."""

_OF_EVERY_NODE = (
    "/describe_parameters",
    "/get_parameter_types",
    "/get_parameters",
    "/list_parameters",
    "/set_parameters",
    "/set_parameters_atomically",
    "/get_type_description",
)
"""Services that every node has."""
_ACTION_SERVICE = "/_action/send_goal"
_ACTION_TYPE = "_SendGoal"
_ACTION = "/_action/"


class Watched(Protocol):
    """The observed processes; the observation ends with them."""

    @property
    def exit_code(self) -> int | None:
        """``None`` while it runs."""

    async def wait(self) -> None:
        """Wait for its end."""


class ObserverError(Exception):
    """The observer itself failed; the text says how."""


@asynccontextmanager
async def observing(
    python: str, variables: Mapping[str, str], directory: Path, origin: Origin
) -> AsyncIterator[Observer]:
    """Run the probe for the duration of the block.

    Args:
        python: The interpreter that has rclpy.
        variables: The environment variables, which select the domain.
        directory: For the files of the probe.
        origin: The run that it belongs to.

    Raises:
        ObserverError: the probe does not start.
    """
    # A copy: modules next to the original would shadow those of ROS.
    for module in PROBE.glob("*.py"):
        with process.writing(directory / _COPY / module.name) as copy:
            copy.write(module.read_bytes())
    code = f"import sys; sys.path.insert(0, {str(directory)!r}); import {_COPY}.main as probe"
    try:
        probe = await process.start_with_pipes(
            [python, "-c", f"{code}; probe.main()"],
            variables,
            directory,
            origin,
            limit=LONGEST_LINE,
        )
    except OSError as error:
        raise ObserverError(f"the observer cannot be started: {error.strerror}") from error
    observer = Observer(probe)
    reader = asyncio.create_task(observer.read())
    try:
        await observer.get_ready()
        yield observer
    finally:
        observer.dismiss()
        try:
            if observer.is_ready:
                await probe.ended_within(END_TIMEOUT)
        finally:
            await probe.close()
            reader.cancel()


class Observer:
    """The reports of the probe so far."""

    def __init__(self, probe: process.Running) -> None:
        self._stdin = cast("asyncio.StreamWriter", probe.stdin)
        self._stdout = cast("asyncio.StreamReader", probe.stdout)
        self._errors = probe.err
        self._changed = asyncio.Event()
        self.is_ready = False
        self._ended = False
        self._nodes: set[str] = set()
        self._doubled: set[str] = set()
        self._topics: dict[str, dict[str, Any]] = {}
        self._services: dict[str, str] = {}
        self._counts: dict[str, int] = {}
        self._reports: list[Mapping[str, Any]] = []
        self._graph_changed = time.monotonic()
        self._called = 0
        self._answers: dict[int, Answer] = {}
        self._refused: list[tuple[str, str]] = []

    def has_seen_anything(self) -> bool:
        """Return whether a node or a publisher has appeared."""
        return bool(self._nodes) or any(topic["publishers"] for topic in self._topics.values())

    def count(self, topic: str) -> int:
        """Return the number of messages of a topic, counting only the first few."""
        return self._counts.get(topic, 0)

    def offers(self, offer: Offer) -> bool:
        """Return whether a service or an action has appeared."""
        ending = _ACTION_SERVICE if offer.kind == "action" else ""
        return offer.name + ending in self._services

    def offering(self, ending: str, kind: str) -> list[str]:
        """Return the prefixes of the names of services of a type with an ending."""
        return sorted(
            name.removesuffix(ending)
            for name, type_name in self._services.items()
            if name.endswith(ending) and type_name == kind
        )

    async def wait_for(
        self, condition: Callable[[], bool], timeout: float, running: Watched
    ) -> bool:
        """Wait until the condition holds after an event, the executable ends, or the time is up.

        Raises:
            ObserverError: the probe has ended.
        """
        deadline = time.monotonic() + timeout
        ended = asyncio.ensure_future(running.wait())
        try:
            while not condition():
                left = deadline - time.monotonic()
                if left <= 0 or ended.done():
                    return condition()
                await self._event_or(ended, left)
        finally:
            ended.cancel()
        return True

    async def pause(self, seconds: float, running: Watched) -> None:
        """Continue to observe for a while, or until the executable ends."""
        await self.wait_for(lambda: False, seconds, running)

    async def settle(self, seconds: float, timeout: float, running: Watched) -> None:
        """Wait until no entities have been added for a while."""
        deadline = time.monotonic() + timeout
        while running.exit_code is None:
            now = time.monotonic()
            left = min(self._graph_changed + seconds, deadline) - now
            if left <= 0:
                return
            await self.pause(left, running)

    def watch_fields(self, paths: Mapping[str, Sequence[str]]) -> None:
        """Record values of fields by topic; to be called before the executable is started."""
        if paths:
            self._send("fields", topics=paths)

    def publish(self, stimulus: Stimulus) -> None:
        """Start to publish messages."""
        self._send(
            "publish",
            topic=stimulus.topic,
            type=stimulus.type,
            message=stimulus.message,
            rate=stimulus.rate_hz,
        )

    async def call(self, call: Call, timeout: float, running: Watched) -> Answer:
        """Call a service or an action; return its answer.

        Raises:
            ObserverError: the probe has ended.
        """
        number = self._called = self._called + 1
        self._send(
            "call",
            id=number,
            kind=call.kind,
            name=call.name,
            type=call.type,
            request=call.request,
            timeout=timeout,
        )
        if not await self.wait_for(lambda: number in self._answers, timeout * 2, running):
            return Answer(None, "it exited before it answered")
        return self._answers[number]

    def dismiss(self) -> None:
        """Stop the probe."""
        self._stdin.close()

    async def observation(self, timeout: float = ANSWER_TIMEOUT) -> Observation:
        """Return the observation so far.

        Args:
            timeout: Seconds for the response of the probe.

        Raises:
            ObserverError: the probe has ended or does not answer.
        """
        asked = time.monotonic()
        self._send("report")
        while not self._reports:
            left = asked + timeout - time.monotonic()
            if left <= 0:
                raise ObserverError(f"the observer did not answer within {timeout:g} s")
            await self._event_or(None, left)
        return self._as_observation(self._reports.pop())

    async def get_ready(self) -> None:
        """Wait until the probe is ready.

        Raises:
            ObserverError: it does not.
        """
        deadline = time.monotonic() + START_TIMEOUT
        while not self.is_ready:
            left = deadline - time.monotonic()
            if left <= 0:
                raise ObserverError(f"the observer did not start within {START_TIMEOUT:g} s")
            await self._event_or(None, left)

    async def read(self) -> None:
        """Process the events of the probe until it ends."""
        async for line in self._stdout:
            self._handle(json.loads(line))
            self._changed.set()
        self._ended = True
        self._changed.set()

    # -- inside

    async def _event_or(self, other: asyncio.Future[None] | None, timeout: float) -> None:
        """Wait for an event of the probe, another event, or the timeout."""
        if self._ended:
            last = "".join(output.tail(output.read(self._errors), 1))
            raise ObserverError(f"the observer has exited: {last or 'no message'}")
        self._changed.clear()
        event = asyncio.ensure_future(self._changed.wait())
        futures: set[asyncio.Future[Any]] = {event} if other is None else {event, other}
        try:
            await asyncio.wait(futures, timeout=timeout, return_when=asyncio.FIRST_COMPLETED)
        finally:
            event.cancel()

    def _send(self, command: str, **values: object) -> None:
        if not self._ended and not self._stdin.is_closing():
            self._stdin.write(json.dumps({"command": command, **values}).encode() + b"\n")

    def _handle(self, event: Mapping[str, Any]) -> None:
        kind = event["event"]
        if kind == "ready":
            self.is_ready = True
        elif kind == "message":
            self._counts[event["topic"]] = event["count"]
        elif kind == "report":
            self._reports.append(event)
        elif kind == "answer":
            self._answers[event["id"]] = Answer(event["value"], event["error"])
        elif kind == "refused":
            self._refused.append((event["topic"], event["error"]))
        else:
            self._take_graph(event)

    def _take_graph(self, graph: Mapping[str, Any]) -> None:
        """Keep the largest graph, as that of an executable that has ended is empty."""
        self._graph_changed = time.monotonic()
        self._nodes.update(graph["nodes"])
        self._doubled = {name for name, count in Counter(graph["nodes"]).items() if count > 1}
        self._services.update(graph["services"])
        for topic in graph["topics"]:
            previous = self._topics.setdefault(topic["name"], topic)
            for key in ("publishers", "subscribers"):
                previous[key] = max(previous[key], topic[key])
            previous["types"] = sorted({*previous["types"], *topic["types"]})
            if len(topic["endpoints"]) >= len(previous["endpoints"]):
                previous["endpoints"] = topic["endpoints"]  # later entries are more complete

    def _as_observation(self, report: Mapping[str, Any]) -> Observation:
        received, until = report["topics"], report["now"]
        return Observation(
            nodes=tuple(sorted(self._nodes)),
            topics=tuple(
                _as_topic(seen, received.get(name, {}), until)
                for name, seen in sorted(self._topics.items())
                if _ACTION not in name
            ),
            services=tuple(
                (name, kind)
                for name, kind in sorted(self._services.items())
                if not name.endswith(_OF_EVERY_NODE) and _ACTION not in name
            ),
            actions=tuple(
                (name.removesuffix(_ACTION_SERVICE), kind.removesuffix(_ACTION_TYPE))
                for name, kind in sorted(self._services.items())
                if name.endswith(_ACTION_SERVICE)
            ),
            parameters=report["parameters"],
            log=Log(
                report["log"]["counts"], tuple(LogLine(**line) for line in report["log"]["lines"])
            ),
            fields={
                name: {path: FieldFigures(**figures) for path, figures in fields.items()}
                for name, fields in report["fields"].items()
            },
            refused=tuple(self._refused),
            doubled=tuple(sorted(self._doubled)),
        )


def _as_topic(seen: Mapping[str, Any], received: Mapping[str, Any], until: float) -> Topic:
    count = received.get("count", 0)
    lost = received.get("lost")
    span = received["last"] - received["first"] if count else 0.0
    sent = count - 1 + (lost or 0)
    return Topic(
        name=seen["name"],
        type=seen["type"],
        publishers=seen["publishers"],
        subscribers=seen["subscribers"],
        count=count,
        rate_hz=round(sent / span, 3) if count > 1 and span > 0 else None,
        span=span,
        watched=until - received["first"] if count else 0.0,
        messages=tuple(received.get("messages", ())),
        types=tuple(seen["types"]),
        error=received.get("error"),
        endpoints=tuple(Endpoint(**endpoint) for endpoint in seen["endpoints"]),
        first=received["first"] if count else None,
        lost=lost,
        interval=_spread(received.get("interval")),
        bytes=received.get("bytes", 0),
        size=_spread(received.get("size")),
        delay=_spread(received.get("delay")),
        transport=_spread(received.get("transport")),
        rates=tuple((seconds, hertz) for seconds, hertz in received.get("rates", ())),
    )


def _spread(figures: Mapping[str, Any] | None) -> Spread | None:
    return None if figures is None else Spread(**figures)
