"""Reporters: functions that write the results of a check to a stream."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from importlib import import_module
from typing import TextIO, cast

from scaffold.check.session import Result

Reporter = Callable[[Sequence[Result], TextIO], None]

NAMES = ("text", "json")
"""A reporter is a module of this package, of that name, with a function ``report``."""


def get(name: str) -> Reporter:
    """Return a reporter by name; only its own module is imported."""
    return cast("Reporter", import_module(f"{__name__}.{name}").report)
