"""The data model of ``smoke.yaml``."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

FILE = "smoke.yaml"

TRANSITIONS = ("configure", "activate", "deactivate", "cleanup", "shutdown")
"""The transitions that a managed node is taken through, in this order."""


@dataclass(frozen=True)
class FieldExpectation:
    """Expected values of a message field; ``None``: any."""

    path: str
    """Such as ``header.frame_id`` or ``ranges[0]``."""
    changes: bool | None = None
    """Whether it has at least two values."""
    minimum: float | None = None
    maximum: float | None = None
    equals: Any = None
    has_equals: bool = False


@dataclass(frozen=True)
class TopicExpectation:
    """A topic that is published."""

    name: str
    type: str | None = None
    rate_hz: float | None = None
    any_rate: bool = False
    """Whether any rate is accepted."""
    tolerance: float | None = None
    """The tolerance of the rate, as a fraction."""
    fields: tuple[FieldExpectation, ...] = ()


@dataclass(frozen=True)
class Call:
    """A request to a service, or a goal for an action."""

    kind: str
    """``service`` or ``action``."""
    name: str
    type: str
    request: Mapping[str, Any] = field(default_factory=dict)
    answer: Mapping[str, Any] = field(default_factory=dict)
    """Expected fields of the response; others are ignored."""


@dataclass(frozen=True)
class Stimulus:
    """Messages to publish to an executable."""

    topic: str
    type: str
    message: Mapping[str, Any] = field(default_factory=dict)
    rate_hz: float = 1.0


@dataclass(frozen=True)
class Scenario:
    """How to run an executable, and what to expect."""

    arguments: tuple[str, ...] = ()
    parameters: Mapping[str, Any] = field(default_factory=dict)
    topics: tuple[TopicExpectation, ...] = ()
    calls: tuple[Call, ...] = ()
    stimuli: tuple[Stimulus, ...] = ()
    duration: float | None = None
    exit_code: int | None = None
    skip: bool = False
    transitions: tuple[str, ...] = TRANSITIONS
    """The transitions of managed nodes."""

    @property
    def transitions_up(self) -> tuple[str, ...]:
        """The transitions before the observation: up to the last to configure or activate."""
        last = max(
            (i for i, name in enumerate(self.transitions) if name in {"configure", "activate"}),
            default=-1,
        )
        return self.transitions[: last + 1]

    @property
    def transitions_down(self) -> tuple[str, ...]:
        """The transitions after the observation."""
        return self.transitions[len(self.transitions_up) :]

    def command(self) -> list[str]:
        """Return the arguments of the executable."""
        from json import dumps

        words = [*self.arguments]
        if self.parameters:
            words.append("--ros-args")
        for name, value in self.parameters.items():
            words += ["-p", f"{name}:={dumps(value)}"]
        return words


NOTHING = Scenario()
