"""Reads the configuration for a verb, and tells the user which of it was ignored."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from scaffold.cli import terminal

if TYPE_CHECKING:
    from scaffold.configuration.config import Config


def load(content: Sequence[str] = ()) -> Config:
    """Read the configuration; say on standard error what was ignored.

    Args:
        content: Content directories given as flags.

    Raises:
        ConfigError: a file cannot be used.
    """
    from scaffold.configuration import config

    settings = config.load(content=tuple(content))
    warn(settings.warnings)
    return settings


def warn(warnings: Iterable[str]) -> None:
    """Say on standard error what was ignored."""
    if "_ARGCOMPLETE" not in os.environ:  # there it would be written between the user's words
        for warning in warnings:
            terminal.warn(warning)
