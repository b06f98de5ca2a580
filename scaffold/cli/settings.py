"""Loads the configuration for a verb, and warns about what is ignored."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from scaffold.cli import terminal

if TYPE_CHECKING:
    from scaffold.configuration.config import Config

_ANSWERS = "new."


def load(content: Sequence[str] = ()) -> Config:
    """Read the configuration; warn on standard error of ignored parts.

    Args:
        content: Content directories given as flags.

    Raises:
        ConfigError: a file cannot be used.
    """
    from scaffold.configuration import config

    settings = config.load(content=tuple(content))
    warn(settings.warnings)
    return settings


def validate_answers(settings: Config, *, of_user: bool = True) -> None:
    """Raise InputError if the table ``[new]`` has a key that no template asks for.

    Args:
        settings: The configuration.
        of_user: Whether to validate the user's own file as well.
    """
    from scaffold.configuration import config, content
    from scaffold.files.disk import Disk

    excluded = None if of_user else config.user_file(Disk())
    origins = {item.origin for key, item in settings.values.items() if key.startswith(_ANSWERS)}
    if not origins - {excluded} or settings.warnings:
        return  # ignored content may have templates with this question
    from scaffold.generate.questions import defaults, questions
    from scaffold.generate.templates import loading

    templates = loading.load(content.roots("templates", settings.content))
    table = {
        key: item
        for key, item in defaults.configured(settings).items()
        if excluded is None or not item.origin.startswith(f"{excluded}:")
    }
    questions.from_table(table, questions.unique(templates.values()))


def warn(warnings: Iterable[str]) -> None:
    """Warn on standard error of ignored parts."""
    if "_ARGCOMPLETE" not in os.environ:  # the shell would print it within the command line
        for warning in warnings:
            terminal.warn(warning)
