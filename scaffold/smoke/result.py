"""What a smoke run finds out: plain data for the reporters."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True)
class Problem:
    """Something that is wrong, with the lines of output that show it."""

    message: str
    output: tuple[str, ...] = ()

    def __str__(self) -> str:
        return "\n".join((self.message, *self.output))


@dataclass(frozen=True)
class Topic:
    """A topic as another process saw it."""

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
    """All types in use on the topic: more than one is a mistake."""
    error: str | None = None
    """Why the messages could not be read."""


@dataclass(frozen=True)
class Observation:
    """What another process saw of an executable."""

    nodes: tuple[str, ...] = ()
    topics: tuple[Topic, ...] = ()
    services: tuple[tuple[str, str], ...] = ()
    """Name and type of services, without those that every node has and those of actions."""
    actions: tuple[tuple[str, str], ...] = ()

    @property
    def alive(self) -> bool:
        """Tell whether anything of the executable was seen."""
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
    """As Python tells it: negative for the number of a signal that killed it."""
    seconds: float
    """From the first signal, or from the start when it finished by itself, to the end."""
    traceback: str | None = None


@dataclass(frozen=True)
class Executable:
    """One executable of a package."""

    name: str
    observation: Observation = Observation()
    stops: tuple[Stop, ...] = ()
    """One for every run: a second signal to be tried takes a second run."""
    problems: tuple[Problem, ...] = ()
    notes: tuple[str, ...] = ()

    @property
    def ok(self) -> bool:
        """Tell whether nothing is wrong."""
        return not self.problems


@dataclass(frozen=True)
class Build:
    """What colcon said about one package."""

    ok: bool
    seconds: float = 0.0
    errors: tuple[str, ...] = ()
    """The lines of the output that tell why it failed."""
    warnings: tuple[str, ...] = ()


@dataclass(frozen=True)
class PackageResult:
    """One package."""

    name: str
    build: Build
    executables: tuple[Executable, ...] = ()

    @property
    def ok(self) -> bool:
        """Tell whether it was built and all its executables are as they should be."""
        return self.build.ok and all(executable.ok for executable in self.executables)


@dataclass(frozen=True)
class Smoke:
    """The result of a run."""

    environment: Mapping[str, str]
    """``kind``, ``prefix`` and ``rmw``."""
    packages: tuple[PackageResult, ...]
    notes: tuple[str, ...] = ()
    scratch: str | None = None
    """The directory of the run, when it was kept."""
    seconds: float = field(default=0.0, compare=False)

    @property
    def ok(self) -> bool:
        """Tell whether all packages are as they should be."""
        return all(package.ok for package in self.packages)
