"""The types of the JSON report, from which its schema is generated."""

from __future__ import annotations

from typing import Any, Literal, TypedDict


class Spread(TypedDict):
    """Statistics of numbers: times in seconds, sizes in bytes."""

    count: int
    mean: float
    deviation: float
    least: float
    greatest: float


class Qos(TypedDict):
    """Quality of service; durations in seconds, null for no limit."""

    reliability: str
    durability: str
    history: str
    depth: int
    deadline: float | None
    lifespan: float | None
    liveliness: str
    liveliness_lease_duration: float | None


class Endpoint(TypedDict):
    """A publisher or a subscription."""

    kind: Literal["publisher", "subscription"]
    node: str
    type: str
    qos: Qos


class Topic(TypedDict):
    """A topic as observed by another process."""

    name: str
    type: str
    publishers: int
    subscribers: int
    rate_hz: float | None
    count: int
    messages: list[Any]
    endpoints: list[Endpoint]
    first_after: float | None
    lost: int | None
    interval: Spread | None
    bytes: int
    size: Spread | None
    bandwidth: float | None
    delay: Spread | None
    transport: Spread | None
    rates: list[list[float]]


class Named(TypedDict):
    """A service or an action."""

    name: str
    type: str


class Transition(TypedDict):
    """The result of a state transition of a managed node."""

    node: str
    name: Literal["configure", "activate", "deactivate", "cleanup", "shutdown"]
    before: str
    after: str
    seconds: float
    error: str | None


class LogLine(TypedDict):
    """A line that a node has logged."""

    level: str
    node: str
    text: str
    time: float


class Log(TypedDict):
    """All lines counted by level, the first of each level kept."""

    counts: dict[str, int]
    lines: list[LogLine]


class Usage(TypedDict):
    """The resource usage of an executable and its descendants."""

    cpu_seconds: float
    cpu_percent: float | None
    memory: int
    memory_peak: int


class Stop(TypedDict):
    """How an executable ended; a negative exit code is the signal that killed it."""

    signal: str | None
    exit_code: int | None
    seconds: float
    traceback: str | None


class _Stops(TypedDict, total=False):
    stops: list[Stop]


class Executable(_Stops):
    """An executable, or all of a package together."""

    name: str
    ok: bool
    interrupted: bool
    nodes: list[str]
    topics: list[Topic]
    services: list[Named]
    actions: list[Named]
    parameters: dict[str, dict[str, Any] | None]
    transitions: list[Transition]
    log: Log
    usage: Usage | None
    stop: Stop
    problems: list[str]
    notes: list[str]


class Build(TypedDict):
    """The result of colcon for a package."""

    ok: bool
    interrupted: bool
    seconds: float
    errors: list[str]
    warnings: list[str]


class Case(TypedDict):
    """A test of a package."""

    name: str
    outcome: Literal["passed", "failed", "skipped"]
    message: str


class Tests(TypedDict):
    """The tests of a package run by `colcon test`."""

    ok: bool
    error: str
    cases: list[Case]


class Package(TypedDict):
    """A package."""

    name: str
    dependency: bool
    worker: str | None
    build: Build
    executables: list[Executable]
    together: Executable | None
    launches: list[Executable]
    tests: Tests | None


class Environment(TypedDict):
    """The ROS 2 environment of the run."""

    kind: str
    distribution: str
    prefix: str
    rmw: str


class Report(TypedDict):
    """The report of `ros2-scaffold smoke --format json`."""

    schema_version: Literal[1]
    environment: Environment
    packages: list[Package]
    ok: bool
    ended_early: str | None
    seconds: float
