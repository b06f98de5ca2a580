"""The options of a smoke run."""

from __future__ import annotations

import signal
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from scaffold.distributions import Distribution
from scaffold.smoke.cleanup.workspace_lock import WAIT

Progress = Callable[[str], None]
"""Called with the current activity in a few words."""


@dataclass(frozen=True)
class Options:
    """The options of a run; times are in seconds."""

    duration: float = 5.0
    """The time to observe after the first sign of life."""
    timeout: float = 20.0
    """The limit from the start of an executable to its first sign of life and messages."""
    build_timeout: float = 900.0
    signals: tuple[signal.Signals, ...] = (signal.SIGINT,)
    workspace: Path | None = None
    """The directory for build, install and log; ``None``: the scratch directory."""
    keep: bool = False
    workspace_wait: float = WAIT
    """The time to wait for another run in the same workspace."""
    jobs: int = 4
    """The number of executables run in parallel, each in its own domain."""
    run_only: frozenset[str] | None = None
    """The packages whose executables are run; the others are built as dependencies."""

    test: bool = False
    """Whether the tests of the packages are run as well."""

    together: bool = False
    """Whether all executables of a package are also run in one domain."""

    wanted: Sequence[Distribution] = ()
    """The accepted distributions; any if empty."""

    launch: bool = False
    """Whether the launch files of a package are also run."""

    ros: str | None = None
    """The environment to use; ``None``: the first usable one."""

    def runs(self, package: str) -> bool:
        """Return whether the executables of a package are run."""
        return self.run_only is None or package in self.run_only
