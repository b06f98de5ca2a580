"""Compares an observed executable with the expectations in ``smoke.yaml``."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace
from json import dumps
from typing import Any

from scaffold.smoke.expectation import Expectation, Publication
from scaffold.smoke.result import Answer, FieldFigures, Observation, Problem
from scaffold.smoke.scenario.model import (
    FILE,
    Call,
    FieldExpectation,
    Scenario,
    TopicExpectation,
)


def overridden(derived: Expectation, scenario: Scenario) -> Expectation:
    """Return the expectations of the source, overridden by those of the author."""
    topics = {topic.name: topic for topic in scenario.topics}
    publications = [
        _publication(publication, topics.pop(publication.topic))
        if publication.topic in topics
        else publication
        for publication in derived.publications
        if not publication.is_managed or "activate" in scenario.transitions
    ]
    publications += [_publication(Publication(name), topic) for name, topic in topics.items()]
    return replace(
        derived,
        publications=tuple(publications),
        exit_code=scenario.exit_code,
        scenario=scenario,
    )


def _publication(derived: Publication, topic: TopicExpectation) -> Publication:
    rate = None if topic.any_rate else topic.rate_hz or derived.rate_hz
    return replace(
        derived,
        type=topic.type or derived.type,
        rate_hz=rate,
        certain=True,
        never=False,
        timer_hz=None if topic.any_rate else derived.timer_hz,
        tolerance=topic.tolerance,
        stated_by=FILE,
    )


def problems(scenario: Scenario, seen: Observation) -> Iterator[Problem]:
    """Yield differences from the expectations of the author: values of fields, and responses."""
    for name, error in seen.refused:
        yield Problem(f"{FILE} publishes {name}, which fails: {error}")
    for topic in scenario.topics:
        figures = seen.fields.get(topic.name, {})
        for item in topic.fields:
            yield from _of_field(topic.name, item, figures.get(item.path))
    for call in scenario.calls:
        yield from _of_call(call, seen.answers.get((call.kind, call.name)))


def _of_field(
    topic: str, expected: FieldExpectation, seen: FieldFigures | None
) -> Iterator[Problem]:
    subject = f"{expected.path} of {topic}"
    if seen is None or not seen.count:
        why = seen.error if seen is not None and seen.error else "no message was received"
        yield Problem(f"{subject} was not seen: {why}")
        return
    if expected.changes is True and not seen.changes:
        yield Problem(f"{subject} is always {_json(seen.last)}: {FILE} expects it to change")
    if expected.changes is False and seen.changes:
        yield Problem(
            f"{subject} changes from {_json(seen.first)} to {_json(seen.last)}: "
            f"{FILE} expects it to stay constant"
        )
    if expected.has_equals and (seen.changes or not _matches(expected.equals, seen.last)):
        yield Problem(f"{subject} is {_json(seen.last)}: {FILE} expects {_json(expected.equals)}")
    yield from _out_of_range(subject, expected, seen)


def _out_of_range(
    subject: str, expected: FieldExpectation, seen: FieldFigures
) -> Iterator[Problem]:
    if expected.minimum is None and expected.maximum is None:
        return
    if seen.least is None or seen.greatest is None:
        yield Problem(f"{subject} is {_json(seen.last)}: {FILE} expects a number")
        return
    if expected.minimum is not None and seen.least < expected.minimum:
        yield Problem(f"{subject} is {seen.least:g}: {FILE} expects at least {expected.minimum:g}")
    if expected.maximum is not None and seen.greatest > expected.maximum:
        yield Problem(
            f"{subject} is {seen.greatest:g}: {FILE} expects at most {expected.maximum:g}"
        )


def _of_call(call: Call, answer: Answer | None) -> Iterator[Problem]:
    if answer is None:
        yield Problem(f"{call.kind} {call.name} was not called: no node was running yet")
    elif answer.error:
        yield Problem(f"{call.kind} {call.name}: {answer.error}")
    else:
        for name, expected in call.answer.items():
            value = (answer.value or {}).get(name)
            if not _matches(expected, value):
                yield Problem(
                    f"{call.kind} {call.name} returned {name}: {_json(value)}: "
                    f"{FILE} expects {_json(expected)}"
                )


def _matches(expected: object, seen: object) -> bool:
    """Return whether a value is as expected; other fields are ignored."""
    if isinstance(expected, Mapping):
        return isinstance(seen, Mapping) and all(
            name in seen and _matches(value, seen[name]) for name, value in expected.items()
        )
    if isinstance(expected, list):
        return (
            isinstance(seen, (list, tuple))
            and len(seen) == len(expected)
            and all(map(_matches, expected, seen))
        )
    if isinstance(expected, float) or isinstance(seen, float):
        return _is_close(expected, seen)
    return expected == seen


def _is_close(expected: object, seen: object) -> bool:
    numbers = (int, float)
    if not isinstance(expected, numbers) or not isinstance(seen, numbers):
        return False
    return math.isclose(expected, seen, rel_tol=1e-6, abs_tol=1e-9)


def _json(value: Any) -> str:  # noqa: ANN401  of a message
    return dumps(value, ensure_ascii=False)
