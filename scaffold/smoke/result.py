"""The results of a smoke run, as plain data for the reporters."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True)
class Problem:
    """A problem, with the lines of output that show it."""

    message: str
    output: tuple[str, ...] = ()

    def __str__(self) -> str:
        return "\n".join((self.message, *self.output))


@dataclass(frozen=True)
class Spread:
    """Statistics of numbers: sizes in bytes, times in seconds."""

    count: int
    mean: float
    deviation: float
    least: float
    greatest: float


@dataclass(frozen=True)
class Endpoint:
    """A publisher or a subscription."""

    kind: str
    """``publisher`` or ``subscription``."""
    node: str
    type: str
    qos: Mapping[str, Any]
    """Policies in lower case; durations in seconds, ``None`` for no limit."""


@dataclass(frozen=True)
class Topic:
    """A topic as observed by another process."""

    name: str
    type: str
    publishers: int
    subscribers: int = 0
    count: int = 0
    """Messages received."""
    rate_hz: float | None = None
    """Messages per second between the first and the last; ``None`` for fewer than two."""
    span: float = 0.0
    """Seconds between the first and the last message."""
    watched: float = 0.0
    """Seconds between the first message and the end of the observation."""
    messages: tuple[Any, ...] = ()
    """The first messages, as nested dictionaries."""
    types: tuple[str, ...] = ()
    """All types in use on the topic; more than one is an error."""
    error: str | None = None
    """Why the messages could not be read."""
    endpoints: tuple[Endpoint, ...] = ()
    first: float | None = None
    """When the first message was sent, in seconds of ``time.time``."""
    first_after: float | None = None
    """Seconds from the start of the executable to its first message."""
    lost: int | None = None
    """Messages that were sent and not received; ``None`` if the middleware does not count them."""
    interval: Spread | None = None
    """The intervals between messages."""
    bytes: int = 0
    """The size of all messages, serialized."""
    size: Spread | None = None
    """The sizes of messages, serialized."""
    delay: Spread | None = None
    """The times from the stamp in the header to sending."""
    transport: Spread | None = None
    """The times from sending to arrival."""
    rates: tuple[tuple[float, float], ...] = ()
    """Seconds since the first message, and the rate until then."""

    @property
    def bandwidth(self) -> float | None:
        """Bytes per second; ``None`` without a rate."""
        return None if self.rate_hz is None or self.size is None else self.rate_hz * self.size.mean


@dataclass(frozen=True)
class LogLine:
    """A line that a node has logged."""

    level: str
    node: str
    text: str
    time: float


@dataclass(frozen=True)
class Log:
    """The log of nodes: counts by level, and the first lines of each level."""

    counts: Mapping[str, int] = field(default_factory=dict)
    lines: tuple[LogLine, ...] = ()


@dataclass(frozen=True)
class FieldFigures:
    """The values of a field in the messages of a topic."""

    count: int
    changes: int
    """How often it differed from the message before."""
    first: Any
    last: Any
    least: float | None
    greatest: float | None
    error: str = ""


@dataclass(frozen=True)
class Answer:
    """The response of a service or an action."""

    value: Mapping[str, Any] | None
    error: str = ""


@dataclass(frozen=True)
class Transition:
    """The result of a state transition of a managed node."""

    node: str
    name: str
    """Such as ``configure``."""
    before: str
    """The state, such as ``unconfigured``."""
    after: str
    seconds: float
    error: str = ""
    """Why it failed."""

    @property
    def ok(self) -> bool:
        """Return whether it succeeded."""
        return not self.error


@dataclass(frozen=True)
class Usage:
    """The resource usage of an executable and its descendants."""

    cpu_seconds: float
    """Since its start."""
    cpu_percent: float | None
    """The percentage of one processor during the observation."""
    memory: int
    """Bytes in memory at the end of the observation."""
    memory_peak: int
    """The observed maximum."""


@dataclass(frozen=True)
class Observation:
    """The observation of an executable by another process."""

    nodes: tuple[str, ...] = ()
    topics: tuple[Topic, ...] = ()
    services: tuple[tuple[str, str], ...] = ()
    """Name and type of services, without those that every node has and those of actions."""
    actions: tuple[tuple[str, str], ...] = ()
    parameters: Mapping[str, Mapping[str, Any] | None] = field(default_factory=dict)
    """By node and name; ``None`` for a node that has not answered."""
    log: Log = Log()
    usage: Usage | None = None
    fields: Mapping[str, Mapping[str, FieldFigures]] = field(default_factory=dict)
    """By topic and path; those that the author has expectations about."""
    answers: Mapping[tuple[str, str], Answer] = field(default_factory=dict)
    """By kind and name."""
    refused: tuple[tuple[str, str], ...] = ()
    """Topics that could not be published, with the reason."""
    transitions: tuple[Transition, ...] = ()
    """The transitions of managed nodes."""
    doubled: tuple[str, ...] = ()
    """Names shared by several nodes at the end."""

    @property
    def alive(self) -> bool:
        """Return whether the executable showed a sign of life."""
        return bool(self.nodes or any(topic.publishers for topic in self.topics))

    def topic(self, name: str) -> Topic | None:
        """Return the topic of a name."""
        return next((topic for topic in self.topics if topic.name == name), None)


@dataclass(frozen=True)
class Stop:
    """How an executable ended."""

    signal: str | None
    """The last signal that was sent (``SIGINT``...); ``None``: it finished by itself."""
    exit_code: int | None
    """The exit code as in Python: negative for a signal that killed it."""
    seconds: float
    """The time to the end, from the first signal, or from the start if it finished by itself."""
    traceback: str | None = None


@dataclass(frozen=True)
class Executable:
    """One executable of a package."""

    name: str
    observation: Observation = Observation()
    stops: tuple[Stop, ...] = ()
    """One for every run; each signal needs its own run."""
    problems: tuple[Problem, ...] = ()
    notes: tuple[str, ...] = ()
    source: str = ""
    """Its file, relative to the repository; empty if unknown."""
    seconds: float = field(default=0.0, compare=False)
    interrupted: bool = False
    """Whether the run ended before this executable was finished."""

    @property
    def ok(self) -> bool:
        """Return whether nothing is wrong."""
        return not self.problems and not self.interrupted


@dataclass(frozen=True)
class Build:
    """The result of colcon for a package."""

    ok: bool
    seconds: float = 0.0
    errors: tuple[str, ...] = ()
    """The lines of the output that explain the failure."""
    warnings: tuple[str, ...] = ()
    interrupted: bool = False
    """Whether the run ended before it was built."""


@dataclass(frozen=True)
class TestCase:
    """A test of a package."""

    name: str
    outcome: str
    """``passed``, ``failed`` or ``skipped``."""
    message: tuple[str, ...] = ()
    """The first lines of the failure message."""

    __test__ = False  # no test of pytest


@dataclass(frozen=True)
class Tests:
    """The tests of a package run by ``colcon test``."""

    cases: tuple[TestCase, ...] = ()
    error: str = ""
    """Why colcon itself failed."""

    __test__ = False  # likewise

    @property
    def failed(self) -> tuple[TestCase, ...]:
        """The tests that failed."""
        return tuple(case for case in self.cases if case.outcome == "failed")

    @property
    def ok(self) -> bool:
        """Return whether all passed or were skipped."""
        return not self.failed and not self.error


@dataclass(frozen=True)
class PackageResult:
    """One package."""

    name: str
    build: Build
    executables: tuple[Executable, ...] = ()
    manifest: str = ""
    """Its package.xml, relative to the repository."""
    is_dependency: bool = False
    """Whether it was only built as a dependency, and not run."""
    tests: Tests | None = None
    """``None`` if they were not run."""
    together: Executable | None = None
    """The result of all executables in one domain; ``None`` if not run."""
    ran: bool = True
    """Whether it was run."""
    launches: tuple[Executable, ...] = ()
    """The results of its launch files."""
    worker: str = ""
    """The worker that ran it; empty for this machine."""

    @property
    def runs(self) -> tuple[Executable, ...]:
        """The runs of executables, of all together, and of launch files."""
        together = (self.together,) if self.together else ()
        return (*self.executables, *together, *self.launches)

    @property
    def ok(self) -> bool:
        """Return whether it was built and all its runs are ok."""
        if self.tests is not None and not self.tests.ok:
            return False
        return self.build.ok and all(executable.ok for executable in self.runs)


@dataclass(frozen=True)
class Smoke:
    """The result of a run."""

    environment: Mapping[str, str]
    """``kind``, ``distribution``, ``prefix`` and ``rmw``."""
    packages: tuple[PackageResult, ...]
    notes: tuple[str, ...] = ()
    scratch: str | None = None
    """The directory of the run, if kept."""
    seconds: float = field(default=0.0, compare=False)
    ended_early: str = ""
    """Why the run ended early; empty if it did not."""

    @property
    def ok(self) -> bool:
        """Return whether all packages are ok."""
        return not self.ended_early and all(package.ok for package in self.packages)
