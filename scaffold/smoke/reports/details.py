"""Formats measurements, QoS, parameters and logs as text."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from json import dumps
from typing import Any

from scaffold.smoke.result import Endpoint, Log, Observation, Spread, Topic, Transition, Usage

_SHOWN_WIDTH = 100
_SHOWN_LINES = 10
_OF_EVERY_NODE = ("use_sim_time", "start_type_description_service", "qos_overrides.")
_MILLI = 1e3
_UNITS = ("B", "kB", "MB", "GB")
_FULL_UNIT = 1000.0


def count(number: int, noun: str) -> str:
    """Return a number with its noun in the right form."""
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"


def flow(value: object) -> str:
    """Return a value in the flow style of YAML, as short as possible."""
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{key}: {flow(item)}" for key, item in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(flow(item) for item in value) + "]"
    return dumps(value, ensure_ascii=False)


def shortened(text: str) -> str:
    """Return a text that fits on a line."""
    return text if len(text) <= _SHOWN_WIDTH else text[: _SHOWN_WIDTH - 3] + "..."


def size(number: float) -> str:
    """Return a number of bytes with a unit."""
    for unit in _UNITS[:-1]:
        if number < _FULL_UNIT:
            return f"{number:.0f} {unit}" if unit == "B" else f"{number:.1f} {unit}"
        number /= _FULL_UNIT
    return f"{number:.1f} {_UNITS[-1]}"


def milliseconds(spread: Spread) -> str:
    """Format times like `ros2 topic hz`."""
    return (
        f"{spread.mean * _MILLI:.2f} ms, deviation {spread.deviation * _MILLI:.2f} ms, "
        f"{spread.least * _MILLI:.2f} to {spread.greatest * _MILLI:.2f} ms"
    )


def of_transitions(transitions: Sequence[Transition]) -> Iterator[str]:
    """Yield the states of managed nodes, one line per node."""
    for node in dict.fromkeys(item.node for item in transitions):
        steps = [item for item in transitions if item.node == node]
        went = ", ".join(
            f"{item.name} to {item.after} in {item.seconds:.2f} s"
            if item.ok
            else f"{item.name} failed"
            for item in steps
        )
        yield f"states of {node}: {steps[0].before}; {went}"


def of_topic(topic: Topic) -> Iterator[str]:
    """Yield details of the messages and endpoints of a topic."""
    if topic.first_after is not None:
        yield f"first message {topic.first_after:.2f} s after the start"
    if topic.interval is not None:
        yield f"interval {milliseconds(topic.interval)}"
    if topic.size is not None:
        rate = "" if topic.bandwidth is None else f", {size(topic.bandwidth)}/s"
        yield f"size {size(topic.size.mean)}{rate}"
    if topic.lost:
        yield f"{count(topic.lost, 'message')} lost between node and observer"
    if topic.delay is not None:
        yield f"age when sent, from the header: {milliseconds(topic.delay)}"
    if topic.transport is not None:
        yield f"transport {milliseconds(topic.transport)}"
    for endpoint in topic.endpoints:
        yield f"{endpoint.kind} of {endpoint.node}: {quality(endpoint)}"


def quality(endpoint: Endpoint) -> str:
    """Return the quality of service of an endpoint: known settings other than defaults."""
    qos = endpoint.qos
    parts = [str(qos[name]).replace("_", " ") for name in ("reliability", "durability")]
    if qos["history"] != "unknown":
        parts.append(f"{qos['history']} {qos['depth']}".replace("_", " "))
    parts += [
        f"{name.replace('_', ' ')} {qos[name]:g} s"
        for name in ("deadline", "lifespan", "liveliness_lease_duration")
        if qos.get(name) is not None
    ]
    if qos.get("liveliness") not in {None, "automatic", "unknown"}:
        parts.append(f"liveliness {qos['liveliness']}".replace("_", " "))
    return ", ".join(parts)


def of_executable(seen: Observation) -> Iterator[str]:
    """Yield parameters, the log, and the resource usage."""
    for node, values in seen.parameters.items():
        if values is None:
            yield f"parameters of {node}: no answer"
        for name, value in own_parameters(values or {}):
            yield f"parameter {name} = {shortened(flow(value))}"
    yield from _log(seen.log)
    if seen.usage is not None:
        yield usage(seen.usage)


def own_parameters(values: Mapping[str, Any]) -> list[tuple[str, Any]]:
    """Return the parameters of a node without those that every node has."""
    return [item for item in values.items() if not item[0].startswith(_OF_EVERY_NODE)]


def usage(used: Usage) -> str:
    """Return the resource usage of an executable."""
    percent = "" if used.cpu_percent is None else f", {used.cpu_percent:.0f} % of a core"
    return f"memory {size(used.memory)}, at most {size(used.memory_peak)}{percent}"


def warnings(log: Log) -> Iterator[str]:
    """Yield one line about logged warnings and errors, with the first of them."""
    counts = {level: log.counts.get(level, 0) for level in ("fatal", "error", "warn")}
    if any(counts.values()):
        first = next((line.text for line in log.lines if line.level in counts), "")
        yield f"logged {_levels(counts)}: {shortened(first)}"


def _log(log: Log) -> Iterator[str]:
    if log.counts:
        yield f"logged {_levels(log.counts)}"
    for line in log.lines[:_SHOWN_LINES]:
        yield f"  {line.level.upper()} {line.node}: {shortened(line.text)}"


def _levels(counts: Mapping[str, int]) -> str:
    return ", ".join(_level_counts(counts.items()))


def _level_counts(items: Iterable[tuple[str, int]]) -> Iterator[str]:
    nouns = {"warn": "warning", "error": "error", "fatal": "fatal error"}
    for level, number in items:
        if number:
            yield count(number, nouns[level]) if level in nouns else f"{number} {level}"
