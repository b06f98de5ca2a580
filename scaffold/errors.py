"""Errors that the user can resolve, each with a one-line message."""

from __future__ import annotations


class ScaffoldError(Exception):
    """An error in the user's input or environment; the text says what to do (exit 2)."""


class ConfigError(ScaffoldError):
    """A configuration file or a flag has an invalid value."""


class ContentError(ScaffoldError):
    """A rule file or a template is broken."""


class InputError(ScaffoldError):
    """A name, a type or a number given by the user is not acceptable."""


class ConflictError(ScaffoldError):
    """Writing would destroy something that exists."""


class LockedError(ScaffoldError):
    """Another process is changing the package."""


class EnvironmentMissingError(ScaffoldError):
    """No ROS 2 environment was found."""


class OutOfTimeError(Exception):
    """Checking a file exceeded the time limit."""


EXHAUSTED: tuple[type[Exception], ...] = (RecursionError, MemoryError, OutOfTimeError)
"""Exceptions raised if a file exhausts memory, recursion or time."""
EXHAUSTION = (
    "nested too deeply",
    "takes too long to check",
    "nested too deeply, or too large for the available memory",
)
"""The message of `exhausted`."""


def exhausted(error: BaseException) -> str:
    """Return the message for one of ``EXHAUSTED``."""
    if isinstance(error, RecursionError):
        return EXHAUSTION[0]
    return EXHAUSTION[1 if isinstance(error, OutOfTimeError) else 2]
