"""The options of a smoke run."""

from __future__ import annotations

import signal
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from scaffold.distributions import Distribution
from scaffold.smoke.cleanup.workspace_lock import WAIT

Progress = Callable[[str], None]
"""Called with what is going on, in a few words."""


@dataclass(frozen=True)
class Options:
    """How a run is done; times are in seconds."""

    duration: float = 5.0
    """Observation after the first sign of life."""
    timeout: float = 20.0
    """From the start of an executable to its first sign of life and to its first messages."""
    build_timeout: float = 900.0
    signals: tuple[signal.Signals, ...] = (signal.SIGINT,)
    workspace: Path | None = None
    """Where build, install and log go; ``None``: into the scratch directory."""
    keep: bool = False
    workspace_wait: float = WAIT
    """For another run in the same workspace to end."""
    jobs: int = 4
    """Executables that run at the same time, each in its own domain."""
    run_only: frozenset[str] | None = None
    """The packages whose executables are run; the others are built, as those need them."""

    test: bool = False
    """Whether the tests of the packages are run as well."""

    together: bool = False
    """Whether all executables of a package are also run in one domain."""

    wanted: Sequence[Distribution] = ()
    """The distributions that count; any without one."""

    launch: bool = False
    """Whether the launch files of a package are also run."""

    ros: str | None = None
    """The environment to take; ``None``: the first that can be used."""

    def runs(self, package: str) -> bool:
        """Tell whether the executables of a package are run."""
        return self.run_only is None or package in self.run_only
