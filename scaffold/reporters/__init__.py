"""Reporters: functions that write the results of a check to a stream."""

from __future__ import annotations

from collections.abc import Sequence
from importlib import import_module
from typing import Protocol, TextIO, cast

from scaffold.check.session import Result


class Reporter(Protocol):
    """Writes the results of a check to a stream."""

    def __call__(self, results: Sequence[Result], out: TextIO, *, unsafe: bool = False) -> None:
        """Write.

        Args:
            results: Of all packages, in the order to report them in.
            out: The stream.
            unsafe: Whether the user asked for unsafe fixes.
        """


NAMES = ("text", "json")
"""A reporter is a module of this package, of that name, with a function ``report``."""


def get(name: str) -> Reporter:
    """Return a reporter by name; only its own module is imported."""
    return cast("Reporter", import_module(f"{__name__}.{name}").report)
