"""Compares an observed executable with what its source declares."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from scaffold.smoke.result import Observation, Problem, Topic
from scaffold.smoke.scenario.model import NOTHING, Scenario

TOLERANCE = 0.05
TOLERANCE_FAST = 0.15
"""Of rates above ``FAST`` Hz: timers of Python drift, and a busy machine is late."""
FAST = 100.0

ENOUGH_MESSAGES = 5
ENOUGH_SECONDS = 1.0
ENOUGH_SECONDS_SLOW = 3.0
"""A rate is judged over the first two, or, for slow topics, over the last."""
LATENESS = 0.05
"""Seconds by which the first or the last message may be late."""
PATIENCE = 2
"""Periods without a message before a topic counts as silent."""
_SIM_TIME = "use_sim_time"


@dataclass(frozen=True)
class Publication:
    """A topic that the source publishes."""

    topic: str
    """Resolved: with its leading slash."""
    type: str | None = None
    """Such as ``std_msgs/msg/String``."""
    rate_hz: float | None = None
    """``None`` if the number is unknown."""
    certain: bool = False
    """Whether it is published without a precondition."""
    never: bool = False
    """Whether the publisher is created but never used."""
    sources: int = 1
    """The number of timers and calls behind the rate: so many messages may arrive at once."""
    timer_hz: float | None = None
    """How often timers publish it, unless their callbacks return or raise before."""
    tolerance: float | None = None
    """Of the rate, if the author specifies it."""
    is_managed: bool = False
    """A managed node publishes it, once it is active."""
    stated_by: str = ""
    """The file with the expectations of the author; empty for the source."""


@dataclass(frozen=True)
class Offer:
    """A service or an action that the source offers."""

    kind: str
    """``service`` or ``action``."""
    name: str
    """Resolved: with its leading slash."""
    type: str | None = None
    """Such as ``std_srvs/srv/SetBool``."""


@dataclass(frozen=True)
class Expectation:
    """The behavior that the source of an executable declares."""

    publications: tuple[Publication, ...] = ()
    offers: tuple[Offer, ...] = ()
    is_node: bool | None = None
    """Whether it uses rclpy; ``None`` if the source is unknown."""
    runs_nothing: bool = False
    """Whether it is a script that defines nodes but creates none."""
    source: str | None = None
    """The file with the expectation."""
    exit_code: int | None = None
    """What the author expects; ``None``: 0."""
    scenario: Scenario = NOTHING


def compare(
    expectation: Expectation, observation: Observation, seconds: float, *, finished: bool = False
) -> tuple[list[Problem], list[str]]:
    """Return the problems and the notes.

    Args:
        expectation: The expectation from the source.
        observation: The observation.
        seconds: How long it ran until the end of the observation.
        finished: Whether it has exited on its own without an error.
    """
    problems = [
        *(
            Problem(f"{t.name} has several types: {', '.join(t.types)}")
            for t in observation.topics
            if len(t.types) > 1
        ),
        *(Problem(f"{t.name} cannot be read: {t.error}") for t in observation.topics if t.error),
    ]
    notes = [
        f"several nodes are named {name}: calls of its services and parameters reach an "
        "arbitrary one"
        for name in observation.doubled
    ]
    if finished:
        return [*_finished_early(expectation, observation, seconds), *problems], notes
    for publication in expectation.publications:
        topic = observation.topic(publication.topic)
        statement = _expectation_text(publication, expectation)
        if topic is None or not topic.publishers:
            problems.append(Problem(f"nothing publishes {publication.topic}: {statement}"))
        elif publication.type and publication.type not in topic.types:
            problems.append(
                Problem(f"{topic.name} has the type {', '.join(topic.types)}: {statement}")
            )
        elif not topic.count:
            problem, note = _silence_problems(
                publication, topic, seconds, statement + _stands_still(observation)
            )
            problems += problem
            notes += note
        elif publication.rate_hz:
            problems += _wrong_rate(publication, topic, statement)
    return [*problems, *_not_offered(expectation, observation)], notes


def wrong_rates(expectation: Expectation, observation: Observation) -> list[Problem]:
    """Return the problems that may be caused by a busy machine."""
    return [
        problem
        for publication in expectation.publications
        if (topic := observation.topic(publication.topic)) is not None
        and topic.count
        and publication.rate_hz
        for problem in _wrong_rate(publication, topic, _expectation_text(publication, expectation))
    ]


def _not_offered(expectation: Expectation, observation: Observation) -> Iterator[Problem]:
    """Yield the services and actions that are missing, or of another type."""
    for offer in expectation.offers:
        seen = dict(observation.services if offer.kind == "service" else observation.actions)
        message = f"{expectation.source or 'the source'} offers {offer.type or 'it'}"
        if offer.name not in seen:
            yield Problem(f"nothing offers the {offer.kind} {offer.name}: {message}")
        elif offer.type and offer.type != seen[offer.name]:
            yield Problem(f"{offer.name} has the type {seen[offer.name]}: {message}")


def _finished_early(
    expectation: Expectation, observation: Observation, seconds: float
) -> list[Problem]:
    """Return the problem of a program that should have kept running."""
    if expectation.runs_nothing:
        return [Problem(f"exited on its own: nothing in {expectation.source} spins its node")]
    for publication in expectation.publications:
        topic = observation.topic(publication.topic)
        is_due = publication.certain or publication.timer_hz
        if is_due and (topic is None or not topic.count):
            statement = _expectation_text(publication, expectation)
            return [
                Problem(
                    f"exited on its own after {seconds:.1f} s, before a message on "
                    f"{publication.topic}: {statement}"
                )
            ]
    return []


def _expectation_text(publication: Publication, expectation: Expectation) -> str:
    shown_type = publication.type or "it"
    hertz = publication.rate_hz or publication.timer_hz
    rate = f" at {hertz:g} Hz" if hertz else ""
    if publication.stated_by:
        return f"{publication.stated_by} expects {shown_type}{rate}"
    return f"{expectation.source or 'the source'} publishes {shown_type}{rate}"


def _silence_problems(
    publication: Publication, topic: Topic, seconds: float, text: str
) -> tuple[list[Problem], list[str]]:
    rate = publication.rate_hz
    if rate and seconds < PATIENCE / rate:
        return [], [f"no message on {topic.name} yet: its period is {1 / rate:g} s"]
    if publication.never:
        return [Problem(f"no message on {topic.name}: no running code calls publish()")], []
    if not publication.certain:
        return [], [f"no message on {topic.name}: it is only published on some event"]
    return [Problem(f"no message on {topic.name} within {seconds:.1f} s: {text}")], []


def _stands_still(observation: Observation) -> str:
    """Return why timers do not run, if known."""
    clock = observation.topic("/clock")
    if clock is not None and clock.publishers:
        return ""
    waiting = [
        node for node, values in observation.parameters.items() if (values or {}).get(_SIM_TIME)
    ]
    return (
        f"; {', '.join(waiting)} has {_SIM_TIME}, and nothing publishes /clock" if waiting else ""
    )


def _wrong_rate(publication: Publication, topic: Topic, text: str) -> list[Problem]:
    rate = publication.rate_hz or 0.0
    expected = rate * topic.watched
    if expected >= ENOUGH_MESSAGES and topic.count + (topic.lost or 0) < expected / 2:
        many = "message" if topic.count == 1 else "messages"
        return [
            Problem(f"only {topic.count} {many} on {topic.name} in {topic.watched:.1f} s: {text}")
        ]
    enough = topic.count >= ENOUGH_MESSAGES or topic.span >= ENOUGH_SECONDS_SLOW
    if topic.rate_hz is None or topic.span < ENOUGH_SECONDS or not enough:
        return []
    tolerance = publication.tolerance or (TOLERANCE_FAST if rate > FAST else TOLERANCE)
    at_the_ends = (publication.sources - 1 + rate * LATENESS) / topic.span
    if abs(topic.rate_hz - rate) <= tolerance * rate + at_the_ends:
        return []
    return [Problem(f"{topic.name} is published at {topic.rate_hz:g} Hz: {text}")]
