"""Reporters: each writes the results of a check to a stream."""

from __future__ import annotations

from collections.abc import Sequence
from importlib import import_module
from typing import TYPE_CHECKING, Protocol, TextIO, cast

from scaffold import distributions
from scaffold.diagnostic import Severity
from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from scaffold.check.result import Result
    from scaffold.distributions import Distribution


class ReportOptions(NamedTuple):
    """Display options; none of them changes machine-readable output."""

    unsafe: bool = False
    """Whether unsafe fixes are counted as well, as requested by the user."""
    severity: Severity = Severity.INFO
    """The lowest severity shown in text."""
    everything: bool = False
    """Whether a terminal shows more than one screen."""
    style: bool = False
    """Whether a terminal shows style findings that it would fold into one line."""
    source: bool | None = None
    """Whether source lines are shown; ``None``: only on a terminal."""
    statistics: bool = False
    """Whether counts are shown instead of findings."""
    quiet: bool = False
    """Whether the summary is skipped."""
    notes: tuple[str, ...] = ()
    """Lines above the summary: what is missing from the report, and why."""
    distributions: tuple[Distribution, ...] = (distributions.JAZZY,)
    """The distributions that were checked for."""


class Reporter(Protocol):
    """Writes the results of a check to a stream."""

    def __call__(self, results: Sequence[Result], out: TextIO, options: ReportOptions) -> None:
        """Write.

        Args:
            results: Of all packages, in the order to report them in.
            out: The stream.
            options: The display options.
        """


NAMES = ("text", "json", "sarif", "github", "gitlab", "junit")
"""A reporter is a module of this package, of that name, with a function ``report``."""


def get(name: str) -> Reporter:
    """Return a reporter by name; only its own module is imported."""
    return cast("Reporter", import_module(f"{__name__}.{name}").report)
